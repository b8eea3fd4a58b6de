#include "support/replay.hpp"

#include <cmath>
#include <unordered_map>
#include <unordered_set>
#include <vector>

#include "kernels/candidates.hpp"
#include "kernels/detect.hpp"

namespace geodisk::test {
namespace {

/// One precision's view of the same pool.
template <class Real>
struct Side {
    ref::Surface<Real> surface;
    std::vector<ref::FacePoint<Real>> points;
    ref::Bins<Real> bins;
    ref::Detector<Real> detector;

    Side(const PreparedMesh& mesh, const SampleParams& params, std::uint32_t count,
         const Tolerances& tolerances, Real limit)
        : surface(mesh, params), points(ref::draw_candidates(surface, params.seed, count)),
          bins(surface, points), detector(surface, bins, tolerances, limit) {}
};

/// `limit_with(q)` is the distance below which candidate q conflicts.
template <class Limit>
void judge(const std::unordered_set<std::uint32_t>& hits,
           const std::unordered_map<std::uint32_t, double>& distances, const Limit& limit_with,
           const Tolerances& tolerances, ReplayReport& report) {
    for (const std::uint32_t q : hits) {
        if (distances.count(q) == 0) {
            ++report.wrong;
        }
    }
    for (const auto& [q, distance] : distances) {
        const double limit = limit_with(q);
        if ((distance < limit) == (hits.count(q) != 0)) {
            continue;
        }
        const double gap = std::abs(distance - limit);
        if (gap > tolerances.guard) {
            ++report.wrong;
        } else {
            ++report.ties;
            report.largest_gap = std::max(report.largest_gap, gap);
        }
    }
}

} // namespace

ReplayReport replay(const PreparedMesh& mesh, const SampleParams& params, std::uint32_t chain) {
    const Tolerances tolerances = tolerances_for(mesh, params, chain);
    const std::uint32_t count = pool_size(mesh, params).value();
    Side<float> floats(mesh, params, count, tolerances, tolerances.limit);
    Side<double> doubles(mesh, params, count, tolerances, tolerances.limit + 2 * tolerances.guard);
    std::vector<bool> decided(count, false);
    ReplayReport report;
    for (std::uint32_t rank = 0; rank < count; ++rank) {
        if (decided[rank]) {
            continue;
        }
        decided[rank] = true;
        ++report.accepted;
        std::unordered_set<std::uint32_t> hits;
        std::unordered_map<std::uint32_t, double> distances;
        floats.detector.run(
            floats.points[rank], [&](std::uint32_t q) { return !decided[floats.bins.order[q]]; },
            [&](std::uint32_t q, float) { hits.insert(floats.bins.order[q]); });
        doubles.detector.run(
            doubles.points[rank], [&](std::uint32_t q) { return !decided[doubles.bins.order[q]]; },
            [&](std::uint32_t q, double distance) {
                const auto [at, fresh] = distances.emplace(doubles.bins.order[q], distance);
                at->second = std::min(at->second, distance);
            });
        const auto limit_with = [&](std::uint32_t q) {
            const double limit = tolerances.limit;
            const auto radius = [&](std::uint32_t i) {
                return doubles.surface.radius_at(doubles.points[i]);
            };
            return params.radii == nullptr ? limit : radius(rank) + radius(q) + (limit - 1);
        };
        judge(hits, distances, limit_with, tolerances, report);
        for (const std::uint32_t q : hits) {
            decided[q] = true;
        }
    }
    return report;
}

} // namespace geodisk::test
