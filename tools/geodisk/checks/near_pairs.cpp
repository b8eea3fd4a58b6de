#include "geodisk/checks/near_pairs.hpp"

#include <algorithm>
#include <cstdint>
#include <limits>
#include <utility>

#include <geodisk/params.hpp>

#include "kernels/bins.hpp"
#include "kernels/detect.hpp"
#include "lib/surface.hpp"
#include "program/failure.hpp"
#include "program/human_text.hpp"
#include "program/interrupt.hpp"

namespace geodisk::tools {
namespace {

constexpr double kMaxCells = 0x1p26;

std::vector<ref::FacePoint<double>> points_of(std::span<const Sample> samples) {
    std::vector<ref::FacePoint<double>> points;
    points.reserve(samples.size());
    for (const Sample& sample : samples) {
        points.push_back({sample.face, sample.weights[1], sample.weights[2]});
    }
    return points;
}

/// Calls `visit(source, row_a, row_b, distance)` for all pairs within `reach(row)` of one of them,
/// from each such row, until it returns false. The lower row comes first.
template <class Reach, class Visit>
void for_each_pair(const PairSearch& search, ProgressLine& progress, const Reach& reach,
                   const Visit& visit) {
    constexpr double kUnknown = std::numeric_limits<double>::infinity();
    const ref::Surface<double> surface(search.mesh, search.frame);
    const double unit = search.frame.unit;
    const ref::Bins<double> bins(surface, points_of(search.samples));
    ref::Detector<double> detector(surface, bins, ref::double_tolerances(), 1);
    const std::size_t count = search.samples.size();

    std::vector<double> distances(count, kUnknown); // By place, of the current source.
    std::vector<std::uint32_t> near;                // Places with a distance.
    bool goes_on = true;
    for (std::uint32_t source = 0; source < count && goes_on; ++source) {
        const std::uint32_t row = bins.order[source];
        if (!search.is_source(row)) {
            continue;
        }
        check_interrupted();
        progress.update(static_cast<double>(source) / static_cast<double>(count),
                        grouped(source) + " samples");
        detector.set_limit(std::min(reach(row), search.longest) / unit);
        const auto is_other = [&](std::uint32_t place) { return place != source; };
        const auto hit = [&](std::uint32_t place, double distance) {
            if (distances[place] == kUnknown) {
                near.push_back(place);
            }
            distances[place] = std::min(distances[place], distance * unit);
        };
        try {
            detector.run(bins.points[source], is_other, hit);
        } catch (const ref::EndlessDisk& error) {
            throw UserError(ExitCode::bad_input, error.what());
        }
        for (const std::uint32_t place : near) {
            const double distance = std::exchange(distances[place], kUnknown);
            const auto [low, high] = std::minmax(row, bins.order[place]);
            goes_on = visit(row, low, high, distance) && goes_on;
        }
        near.clear();
    }
    progress.clear();
}

/// Notes about pairs that count, or about existing samples.
class Notes {
  public:
    /// Returns true if a pair is to be noted.
    bool takes(const ClosePair& pair, bool is_violation) {
        const bool is_closest = is_closer(pair, closest_);
        if (is_closest) {
            closest_ = pair;
        }
        violations_ += is_violation ? 1 : 0;
        return is_closest || is_violation;
    }
    std::size_t violations() const { return violations_; }
    /// Returns the ratio of the closest pair; there must be one.
    double min_ratio() const { return closest_->ratio; }

  private:
    std::optional<ClosePair> closest_;
    std::size_t violations_ = 0;
};

/// Returns the place of each row in the order of sources.
std::vector<std::uint32_t> places_of(const PairSearch& search) {
    const ref::Surface<double> surface(search.mesh, search.frame);
    const ref::Bins<double> bins(surface, points_of(search.samples));
    std::vector<std::uint32_t> places(bins.order.size());
    for (std::uint32_t place = 0; place < places.size(); ++place) {
        places[bins.order[place]] = place;
    }
    return places;
}

} // namespace

PairSearch search_on(const PreparedMesh& mesh, std::span<const SampleRow> rows, double distance) {
    const double unit = ref::suitable_unit(mesh, distance, kMaxCells);
    // The reference takes lengths beyond all proportion to the mesh for unknown ones.
    PairSearch search{mesh, ref::frame_of(mesh, unit), 2 * ref::longest_path(mesh), {}};
    search.samples.reserve(rows.size());
    for (const SampleRow& row : rows) {
        search.samples.push_back(sample_of(row));
    }
    return search;
}

std::vector<NotedPair> note_pairs(const PairSearch& search, ProgressLine& progress) {
    std::vector<NotedPair> noted;
    Notes others, among_existing;
    const bool is_even = search.distances && search.distances->are_found_from_both();
    bool has_enough = false; // Pairs of existing samples: only closer ones are looked for.
    const auto reach = [&](std::uint32_t row) {
        has_enough = among_existing.violations() >= kMaxExistingPairs;
        const double full = search.reach(row);
        // Pairs with a new sample are found from that one.
        return has_enough && is_even && search.existing[row] != 0
                   ? std::min(full, among_existing.min_ratio() * search.distances->reach(row))
                   : full;
    };
    for_each_pair(
        search, progress, reach,
        [&](std::uint32_t source, std::uint32_t row_a, std::uint32_t row_b, double distance) {
            const double least = search.distances ? search.distances->of(row_a, row_b) : 1;
            const ClosePair pair{row_a, row_b, distance, distance / least};
            const bool is_existing = search.is_existing(pair);
            Notes& notes = is_existing ? among_existing : others;
            const bool is_violation = search.is_violation(pair) && !(is_existing && has_enough);
            if (notes.takes(pair, is_violation)) {
                noted.push_back({source, pair});
            }
            return others.violations() < kMaxViolations;
        });
    return noted;
}

std::vector<NotedPair> merged_pairs(const PairSearch& search, std::vector<NotedPair> noted) {
    const std::vector<std::uint32_t> places = places_of(search);
    std::ranges::stable_sort(noted, {}, [&](const NotedPair& one) { return places[one.source]; });
    std::size_t violations = 0, end = 0;
    for (; end < noted.size(); ++end) {
        const bool is_next = end > 0 && noted[end].source != noted[end - 1].source;
        if (is_next && violations >= kMaxViolations) {
            break;
        }
        const ClosePair& pair = noted[end].pair;
        violations += search.is_violation(pair) && !search.is_existing(pair) ? 1u : 0u;
    }
    noted.resize(end);
    return noted;
}

ExistingSpacing check_spacing(const MeshInput& mesh, std::span<const SampleRow> rows,
                              const PairDistances& distances,
                              std::span<const std::uint32_t> existing, ProgressLine& progress,
                              const NotePairs& note) {
    ExistingSpacing result;
    double largest = rows.empty() ? 1 : 0;
    for (std::uint32_t row = 0; row < rows.size(); ++row) {
        largest = std::max(largest, distances.reach(row));
    }
    PairSearch search = search_on(mesh.prepared, rows, largest);
    // From the sample with the larger radius, every pair is found this way.
    search.distances = distances;
    search.cut = result.others.cut;
    search.existing = existing;
    progress.begin_stage("verifying");
    result.among_existing.most = kMaxExistingPairs;
    bool counts_existing = true;
    std::optional<std::uint32_t> last; // Source of a pair of existing samples.
    for (const auto& [source, pair] : note(search, progress)) {
        if (!search.is_existing(pair)) {
            result.others.add(pair);
            continue;
        }
        // All pairs of a source count, or none.
        counts_existing = source == last ? counts_existing : result.among_existing.is_complete;
        last = source;
        if (counts_existing) {
            result.among_existing.add(pair);
        } else {
            result.among_existing.note_closest(pair);
        }
    }
    result.others.finish();
    result.among_existing.finish();
    return result;
}

std::optional<ClosePair> find_closest(const MeshInput& mesh, std::span<const SampleRow> rows,
                                      ProgressLine& progress, const NotePairs& note) {
    constexpr double kCutFactor = 1.25; // Of the distance expected.
    std::optional<ClosePair> closest;
    if (rows.size() < 2) {
        return closest;
    }
    progress.begin_stage("measuring");
    const double longest = ref::longest_path(mesh.prepared);
    // Samples spread well are no farther apart; of others only few disks are that large.
    double distance =
        distance_for_count(mesh.prepared.statistics().area, static_cast<double>(rows.size()));
    while (!closest) {
        PairSearch search = search_on(mesh.prepared, rows, distance);
        search.cut = kCutFactor * distance;
        for (const auto& [source, pair] : note(search, progress)) {
            if (is_closer(pair, closest)) {
                closest = pair;
            }
        }
        if (search.cut > longest) {
            break;
        }
        distance *= 2;
    }
    return closest;
}

} // namespace geodisk::tools
