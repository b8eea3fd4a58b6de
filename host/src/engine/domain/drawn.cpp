#include "engine/domain/drawn.hpp"

#include <algorithm>
#include <array>
#include <tuple>

#include <geodisk/detail/philox.hpp>

#include "constants.h"
#include "engine/domain/device_mesh.hpp"
#include "engine/domain/face_mask.hpp"
#include "engine/domain/poisson.hpp"
#include "engine/domain/stages.hpp"
#include "mesh/candidate_share.hpp"
#include "records.h"
#include "support/rounded.hpp"

namespace geodisk {
namespace {

using Words = std::array<std::uint32_t, 4>;
using Corners = std::array<float, 3>;

std::uint32_t steps_of(float weight) {
    return static_cast<std::uint32_t>(weight * 0x1p24f);
}

/// Sets the weights to those of a uniform point: weigh_evenly() of the shaders.
void weigh_evenly(ListedCandidate& point, const Words& random) {
    const std::uint32_t alpha = random[2] >> 9 << 1 | 1u;
    const std::uint32_t beta = random[3] >> 9 << 1 | 1u;
    const std::uint32_t both = steps_of(root(static_cast<float>(alpha) * 0x1p-24f));
    point.weight1 = static_cast<std::uint32_t>(std::uint64_t{both} * (kOneWeight - beta) >> 24);
    point.weight2 = both - point.weight1;
}

/// Interpolates linearly at a point of the face.
float interpolated(const Corners& corners, const ListedCandidate& point) {
    const float weight1 = static_cast<float>(point.weight1) * 0x1p-24f;
    const float weight2 = static_cast<float>(point.weight2) * 0x1p-24f;
    const float weight0 = 1.0f - weight1 - weight2;
    return weight0 * corners[0] + weight1 * corners[1] + weight2 * corners[2];
}

/// Moves a uniform point, and returns true if it is kept: propose_by_factors() of the shaders.
bool propose_by_factors(ListedCandidate& point, const Corners& radii, const Corners& spreads,
                        float fraction) {
    const auto [s0, s1, s2] = spreads;
    const float share0 = static_cast<float>(kOneWeight - point.weight1 - point.weight2) * (s1 * s2);
    const float share1 = static_cast<float>(point.weight1) * (s0 * s2);
    const float share2 = static_cast<float>(point.weight2) * (s0 * s1);
    const float sum = share0 + share1 + share2;
    point.weight1 = std::min(steps_of(ratio(share1, sum)), kOneWeight - 1);
    point.weight2 = std::min(steps_of(ratio(share2, sum)), kOneWeight - 1 - point.weight1);
    const float spread = interpolated(spreads, point);
    const float g = 2.0f * interpolated(radii, point);
    return fraction * (g * g) < spread * spread * spread;
}

/// Returns the density of candidates at a point with this density and packing.
float thinned(float density, float packing) {
    const float share = ratio(density, packing);
    return packing * (share < 1 ? candidates_for_share(share, ratio) : 1.0f);
}

bool propose_by_density(const ListedCandidate& point, const Corners& radii,
                        const Corners& densities, float fraction) {
    const float most = std::max({thinned(densities[0], -radii[0]), thinned(densities[1], -radii[1]),
                                 thinned(densities[2], -radii[2])});
    const float packing = -interpolated(radii, point);
    return fraction * most < thinned(interpolated(densities, point), packing);
}

/// Returns true if the candidate is kept. It has uniform weights, and is moved in its face.
bool propose(ListedCandidate& point, const gpu::RadiiRec& radii, const Words& random) {
    const std::uint32_t bits = (random[2] & 511u) << 9 | (random[3] & 511u);
    const float fraction = (static_cast<float>(bits) + 0.5f) * 0x1p-18f;
    const Corners corners{radii.radius0, radii.radius1, radii.radius2};
    const Corners spreads{radii.spread0, radii.spread1, radii.spread2};
    return corners[0] < 0 ? propose_by_density(point, corners, spreads, fraction)
                          : propose_by_factors(point, corners, spreads, fraction);
}

} // namespace

bool is_before(const DrawnCandidate& a, const DrawnCandidate& b, bool has_keys) noexcept {
    const auto order = [has_keys](const DrawnCandidate& c) {
        const auto& [face, weight1, weight2] = c.point;
        return has_keys ? std::tuple(c.stage, c.priority, weight1, weight2, face)
                        : std::tuple(c.stage, c.priority, face, weight1, weight2);
    };
    return order(a) < order(b);
}

CandidateDraw::CandidateDraw(const PreparedMesh& mesh, const SampleParams& params,
                             const JobFrame& frame)
    : surface_(placed(mesh, params, frame)) {
    if (!params.class_factors.empty()) {
        classes_ = class_table(params);
    }
}

void CandidateDraw::draw(std::uint32_t face, std::uint32_t stage,
                         std::vector<DrawnCandidate>& out) const {
    const SampleParams& params = surface_.params;
    if (!takes_samples(params, face)) {
        return;
    }
    const std::uint32_t key = key_of(surface_, face);
    const gpu::RadiiRec radii = radii_of(params, face);
    float mean = stage_intensity(surface_.stages, stage, class_density(params)) *
                 face_area(*surface_.mesh, face, surface_.frame.unit);
    if (params.radii != nullptr) {
        mean = mean * radii.density;
    }
    const Words words = philox(params.seed, {key, 0, stage, gpu::kCountProposal});
    const std::uint32_t count = poisson(mean, words[0], words[1]);
    for (std::uint32_t number = 0; number < count; ++number) {
        Words random = philox(params.seed, {key, number, stage, 0});
        DrawnCandidate drawn{stage, random[0] >> (32u - gpu::kPriorityBits), {face, 0, 0}};
        weigh_evenly(drawn.point, random);
        if (classes_) {
            drawn.priority = priority_with_class(*classes_, drawn.priority, random[1]);
        }
        bool is_kept = params.radii == nullptr || propose(drawn.point, radii, random);
        for (std::uint32_t proposal = 1; proposal < gpu::kMaxProposals && !is_kept; ++proposal) {
            random = philox(params.seed, {key, number, stage, proposal});
            weigh_evenly(drawn.point, random);
            is_kept = propose(drawn.point, radii, random);
        }
        out.push_back(drawn);
    }
}

} // namespace geodisk
