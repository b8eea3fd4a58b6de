#include "support/replay.hpp"

#include <algorithm>
#include <cmath>
#include <unordered_map>
#include <vector>

#include <doctest/doctest.h>

#include "kernels/detect.hpp"
#include "kernels/pool.hpp"
#include "lib/frame.hpp"

namespace geodisk::test {
namespace {

/// One precision's view of the same pool.
template <class Real>
struct Side {
    ref::Surface<Real> surface;
    ref::Pool<Real> pool;
    std::vector<std::uint32_t> ranks;
    ref::Detector<Real> detector;

    Side(const PreparedMesh& mesh, const SampleParams& params, const ref::Tolerances& tolerances,
         Real limit)
        : surface(mesh, params), pool(ref::draw_pool(surface, params)), ranks(pool.ranks()),
          detector(surface, pool.bins, tolerances, limit) {}
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
/// float, where no error exceeds the guard.
template <class Limit>
void judge(const Distances& hits, const Distances& truth, const Limit& limit_with, double guard,
           ReplayReport& report) {
    for (const auto& [q, distance] : hits) {
        if (!truth.has(q)) {
            ++report.wrong;
            continue;
        }
        report.largest_deviation =
            std::max(report.largest_deviation, std::abs(distance - truth.of(q)) / guard);
    }
    for (const auto& [q, distance] : truth) {
        const double limit = limit_with(q);
        if ((distance < limit) == hits.has(q)) {
            continue;
        }
        const double gap = std::abs(distance - limit);
        if (gap > guard) {
            ++report.wrong;
        } else {
            ++report.ties;
            report.largest_gap = std::max(report.largest_gap, gap);
        }
    }
}

} // namespace

ReplayReport replay(const PreparedMesh& mesh, const SampleParams& params, double error_bound) {
    const ref::Frame frame = ref::frame_of(mesh, params);
    const ref::Tolerances tolerances = frame.tolerances(error_bound);
    Side<float> floats(mesh, params, tolerances, tolerances.limit);
    Side<double> doubles(mesh, params, tolerances, tolerances.limit + 2 * tolerances.guard);
    std::vector<bool> decided(floats.pool.size(), false);
    ReplayReport report;
    for (std::uint32_t rank = 0; rank < floats.pool.size(); ++rank) {
        if (decided[rank]) {
            continue;
        }
        decided[rank] = true;
        ++report.accepted;
        Distances hits;
        Distances truth;
        const ref::DiskCount disk = floats.detector.run(
            floats.pool.candidate(rank),
            [&](std::uint32_t place) { return !decided[floats.ranks[place]]; },
            [&](std::uint32_t place, float distance) { hits.note(floats.ranks[place], distance); });
        doubles.detector.run(
            doubles.pool.candidate(rank),
            [&](std::uint32_t place) { return !decided[doubles.ranks[place]]; },
            [&](std::uint32_t place, double distance) {
                truth.note(doubles.ranks[place], distance);
            });
        const auto limit_with = [&](std::uint32_t q) {
            const double limit = tolerances.limit;
            const auto radius = [&](std::uint32_t i) {
                return doubles.surface.radius_at(doubles.pool.candidate(i));
            };
            return params.radii == nullptr ? limit : radius(rank) + radius(q) + (limit - 1);
        };
        judge(hits, truth, limit_with, std::max(tolerances.guard, frame.error_of(disk.chain)),
              report);
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
