#include "support/replay.hpp"

#include <algorithm>
#include <cmath>
#include <unordered_map>
#include <vector>

#include <doctest/doctest.h>

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

/// Distances from the sample in hand, by rank; of several paths the shortest counts.
class Distances {
  public:
    void note(std::uint32_t q, double distance) {
        const auto [at, fresh] = shortest_.emplace(q, distance);
        at->second = std::min(at->second, distance);
    }
    bool has(std::uint32_t q) const { return shortest_.contains(q); }
    double of(std::uint32_t q) const { return shortest_.at(q); }
    auto begin() const { return shortest_.begin(); }
    auto end() const { return shortest_.end(); }

  private:
    std::unordered_map<std::uint32_t, double> shortest_;
};

/// `limit_with(q)` is the distance below which candidate q conflicts; `hits` are those that do in
/// float.
template <class Limit>
void judge(const Distances& hits, const Distances& truth, const Limit& limit_with,
           const Tolerances& tolerances, ReplayReport& report) {
    for (const auto& [q, distance] : hits) {
        if (!truth.has(q)) {
            ++report.wrong;
            continue;
        }
        report.largest_deviation =
            std::max(report.largest_deviation, std::abs(distance - truth.of(q)) / tolerances.guard);
    }
    for (const auto& [q, distance] : truth) {
        const double limit = limit_with(q);
        if ((distance < limit) == hits.has(q)) {
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
        Distances hits;
        Distances truth;
        floats.detector.run(
            floats.points[rank], [&](std::uint32_t q) { return !decided[floats.bins.order[q]]; },
            [&](std::uint32_t q, float distance) { hits.note(floats.bins.order[q], distance); });
        doubles.detector.run(
            doubles.points[rank], [&](std::uint32_t q) { return !decided[doubles.bins.order[q]]; },
            [&](std::uint32_t q, double distance) { truth.note(doubles.bins.order[q], distance); });
        const auto limit_with = [&](std::uint32_t q) {
            const double limit = tolerances.limit;
            const auto radius = [&](std::uint32_t i) {
                return doubles.surface.radius_at(doubles.points[i]);
            };
            return params.radii == nullptr ? limit : radius(rank) + radius(q) + (limit - 1);
        };
        judge(hits, truth, limit_with, tolerances, report);
        for (const auto& [q, distance] : hits) {
            decided[q] = true;
        }
    }
    return report;
}

void check_deviation(const std::string& name, const ReplayReport& report) {
    MESSAGE(name << ": float distances deviate by at most " << report.largest_deviation
                 << " of the guard");
    CHECK(report.largest_deviation < 1);
}

} // namespace geodisk::test
