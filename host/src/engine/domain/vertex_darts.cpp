#include "engine/domain/vertex_darts.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "engine/domain/face_mask.hpp"
#include "engine/domain/stages.hpp"
#include "engine/request/check_fields.hpp"
#include "geodisk/detail/philox.hpp"
#include "mesh/face_area.hpp"
#include "support/try.hpp"

namespace geodisk {
namespace {

// Philox counter of vertices; candidates have other stages.
constexpr std::uint32_t kVertexStage = 0x7e270000u;

/// Returns the natural logarithm of a number from 0 to 1: the same on every machine, which no
/// library of mathematics promises.
double logarithm(double number) {
    constexpr double kLogarithmOf2 = 0.69314718055994531;
    constexpr int kTerms = 18; // The first that is left out is below 2^-53 of the sum.
    int exponent = 0;
    const double part = std::frexp(number, &exponent); // 0.5 to 1.
    const double ratio = (part - 1) / (part + 1);
    double sum = 0;
    for (int term = kTerms; term >= 0; --term) {
        sum = sum * (ratio * ratio) + 1.0 / (2 * term + 1);
    }
    return 2 * ratio * sum + exponent * kLogarithmOf2;
}

/// A vertex, and when the first of many darts hits it.
struct HitVertex {
    double time;
    std::uint32_t vertex;
    std::uint32_t corner; ///< One of its corners, in a face that takes samples.

    auto order() const { return std::tie(time, vertex); }
};

/// Returns a time by the exponential law of this rate.
double time_of(std::uint64_t seed, std::uint32_t vertex, double rate) {
    const auto words = philox(seed, {vertex, 0, kVertexStage, 0});
    const double uniform =
        (static_cast<double>(std::uint64_t{words[0]} << 21 | words[1] >> 11) + 0.5) * 0x1p-53;
    return -logarithm(uniform) / rate;
}

} // namespace

std::vector<ListedCandidate> vertex_darts(const PreparedMesh& mesh, const SampleParams& params) {
    std::vector<HitVertex> hits;
    for (std::uint32_t vertex = 0; vertex < mesh.vertex_count(); ++vertex) {
        const VertexFan& fan = mesh.fans()[vertex];
        double area = 0;
        std::uint32_t lowest = 0;
        for (const std::uint32_t corner :
             mesh.corners().subspan(fan.first_corner, fan.corner_count)) {
            if (takes_samples(params, corner / 3) && has_area(mesh, corner / 3)) {
                const HalfEdge& edge = mesh.half_edges()[corner];
                lowest = area > 0 ? std::min(lowest, corner) : corner;
                area += edge.length * edge.apex_y / 6;
            }
        }
        if (area > 0) {
            hits.push_back({time_of(params.seed, vertex, area), vertex, lowest});
        }
    }
    std::ranges::sort(hits,
                      [](const HitVertex& a, const HitVertex& b) { return a.order() < b.order(); });
    std::vector<ListedCandidate> candidates;
    candidates.reserve(hits.size());
    for (const HitVertex& hit : hits) {
        std::uint32_t weights[3] = {};
        weights[hit.corner % 3] = kOneWeight;
        candidates.push_back({hit.corner / 3, weights[1], weights[2]});
    }
    return candidates;
}

Result<Domain> vertex_domain(const PreparedMesh& mesh, const SampleParams& params) {
    GEODISK_TRY(check_params(mesh, params));
    GEODISK_TRY(check_fields(params, RequestField::at_vertices));
    return listed_domain(mesh, params, vertex_darts(mesh, params));
}

} // namespace geodisk
