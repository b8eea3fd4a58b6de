#include "engine/domain/feature_darts.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <tuple>

#include "constants.h"
#include "engine/domain/face_mask.hpp"
#include "engine/request/check_fields.hpp"
#include "geodisk/detail/philox.hpp"
#include "support/guard.hpp"
#include "support/invalid.hpp"
#include "support/try.hpp"

namespace geodisk {
namespace {

/// Darts per minimum distance along a curve. About 0.75 samples fit there, with few gaps left.
constexpr double kDartsPerDistance = 64;
constexpr double kMaxDarts = 0x1p28;
// Philox counters of darts on half-edges, by the corner of the face; candidates have other stages.
constexpr std::uint32_t kFeatureStage = 0xfea70000u;
/// Returns a half-edge of the edge of h whose face takes samples.
std::optional<std::uint32_t> sampled_edge(const PreparedMesh& mesh, const SampleParams& params,
                                          std::uint32_t h) {
    std::uint32_t other = h;
    do {
        if (takes_samples(params, other / 3)) {
            return other;
        }
        other = around_half_edge(mesh.half_edges()[other].around);
    } while (other != h);
    return std::nullopt;
}

/// Returns a corner at a vertex whose face takes samples, as its half-edge.
std::optional<std::uint32_t> sampled_corner(const PreparedMesh& mesh, const SampleParams& params,
                                            std::uint32_t vertex) {
    const VertexFan& fan = mesh.fans()[vertex];
    const auto corners = mesh.corners().subspan(fan.first_corner, fan.corner_count);
    const auto found = std::ranges::find_if(
        corners, [&](std::uint32_t corner) { return takes_samples(params, corner / 3); });
    return found == corners.end() ? std::nullopt : std::optional(*found);
}

/// Returns the point of h this far from its start, in units of 2^-24 of its length.
ListedCandidate point_on(std::uint32_t h, std::uint32_t steps) {
    std::uint32_t weights[3] = {};
    weights[h % 3] = kOneWeight - steps;
    weights[next_in_face(h) % 3] = steps;
    return {h / 3, weights[1], weights[2]};
}

struct Dart {
    std::uint32_t priority, more_priority; ///< Random words.
    std::uint32_t key, corner, number;     ///< Key and corner of the edge, and number on it.
    ListedCandidate point;

    auto order() const { return std::tie(priority, more_priority, key, corner, number); }
};

/// Returns the darts that an edge expects.
double darts_on(const PreparedMesh& mesh, const SampleParams& params, std::uint32_t h) {
    const double factor = params.radii == nullptr
                              ? 1
                              : double{std::min(params.radii->factors()[h],
                                                params.radii->factors()[next_in_face(h)])};
    return kDartsPerDistance * mesh.half_edges()[h].length / (params.min_distance * factor);
}

/// Appends the darts of an edge, given by its lowest half-edge. Its points are on `on`.
void throw_on(const PreparedMesh& mesh, const SampleParams& params, std::uint32_t h,
              std::uint32_t on, std::vector<Dart>& darts) {
    const std::uint32_t key = params.face_keys.empty() ? h / 3 : params.face_keys[h / 3];
    const bool is_same_way =
        mesh.half_edges()[on].origin == mesh.half_edges()[h].origin; // Never both ends.
    const auto words = [&](std::uint32_t number) {
        return philox(params.seed, {key, number, kFeatureStage + h % 3, 0});
    };
    const double expected = darts_on(mesh, params, h);
    const double whole = std::floor(expected);
    const bool has_more = words(gpu::kCountNumber)[0] * 0x1p-32 < expected - whole;
    const auto count = static_cast<std::uint32_t>(whole) + (has_more ? 1 : 0);
    for (std::uint32_t number = 0; number < count; ++number) {
        const auto random = words(number);
        const auto steps =
            1 + static_cast<std::uint32_t>(std::uint64_t{random[2]} * (kOneWeight - 1) >> 32);
        darts.push_back({random[0], random[1], key, h % 3, number,
                         point_on(on, is_same_way ? steps : kOneWeight - steps)});
    }
}

Result<Done> check(const PreparedMesh& mesh, const SampleParams& params, const Features& features) {
    if (features.mesh() != mesh.identity()) {
        return invalid("the features are of another mesh");
    }
    if (params.darts != 0) {
        return invalid("samples on features come from no darts; leave out `darts`");
    }
    GEODISK_TRY(check_fields(params, RequestField::features));
    if (!features.are_sampled(mesh, params)) {
        return invalid("no feature lies on a face that takes samples");
    }
    double expected = static_cast<double>(features.corners().size());
    for (const std::uint32_t h : features.edges()) {
        expected += darts_on(mesh, params, h) + 1;
    }
    if (!(expected <= kMaxDarts)) {
        return invalid("the minimum distance is too small: the curves would take more than 2^28 "
                       "darts");
    }
    return Done{};
}

} // namespace

bool Features::are_sampled(const PreparedMesh& mesh, const SampleParams& params) const {
    return std::ranges::any_of(
        edges_, [&](std::uint32_t h) { return sampled_edge(mesh, params, h).has_value(); });
}

std::vector<ListedCandidate> feature_darts(const PreparedMesh& mesh, const SampleParams& params,
                                           const Features& features) {
    std::vector<ListedCandidate> candidates;
    for (const std::uint32_t vertex : features.corners()) {
        if (const auto corner = sampled_corner(mesh, params, vertex)) {
            candidates.push_back(point_on(*corner, 0));
        }
    }
    std::vector<Dart> darts;
    std::optional<std::uint32_t> first;
    for (const std::uint32_t h : features.edges()) {
        if (const auto on = sampled_edge(mesh, params, h)) {
            first = first ? first : on;
            throw_on(mesh, params, h, *on, darts);
        }
    }
    std::ranges::sort(darts, [](const Dart& a, const Dart& b) { return a.order() < b.order(); });
    for (const Dart& dart : darts) {
        candidates.push_back(dart.point);
    }
    if (candidates.empty() && first) { // Curves far shorter than the distance.
        candidates.push_back(point_on(*first, kOneWeight / 2));
    }
    return candidates;
}

Result<Domain> feature_domain(const PreparedMesh& mesh, const SampleParams& params,
                              const Features& features) noexcept {
    return guarded([&]() -> Result<Domain> {
        GEODISK_TRY(pool_size(mesh, params));
        GEODISK_TRY(check(mesh, params, features));
        SampleParams own = params;
        own.maximal = false; // The surface may be, with these.
        return listed_domain(mesh, own, feature_darts(mesh, own, features));
    });
}

} // namespace geodisk
