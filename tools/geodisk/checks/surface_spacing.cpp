#include <algorithm>
#include <cstdint>

#include <geodisk/params.hpp>

#include "geodisk/checks/near_pairs.hpp"
#include "geodisk/checks/spacing.hpp"
#include "lib/surface.hpp"

namespace geodisk::tools {

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
