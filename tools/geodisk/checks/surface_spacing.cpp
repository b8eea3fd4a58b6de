#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

#include <geodisk/params.hpp>

#include "constants.h"
#include "geodisk/checks/spacing.hpp"
#include "kernels/bins.hpp"
#include "kernels/detect.hpp"
#include "lib/surface.hpp"
#include "program/failure.hpp"
#include "program/human_text.hpp"
#include "program/interrupt.hpp"

namespace geodisk::tools {
namespace {

/// Of the distance expected.
constexpr double kCutFactor = 1.25;
constexpr double kMostCells = 0x1p26;

std::vector<ref::FacePoint<double>> points_of(std::span<const SampleRow> rows) {
    std::vector<ref::FacePoint<double>> points;
    points.reserve(rows.size());
    for (const SampleRow& row : rows) {
        points.push_back({row.face, row.bary[1], row.bary[2]});
    }
    return points;
}

/// Calls `visit(row_a, row_b, distance)` for all pairs not farther apart than `cut_of(row)` of one
/// of them, from each such row, until it returns false. The lower row comes first.
template <class CutOf, class Visit>
void for_each_pair(const MeshInput& mesh, std::span<const SampleRow> rows, double unit,
                   const CutOf& cut_of, ProgressLine& progress, const Visit& visit) {
    constexpr double kUnknown = std::numeric_limits<double>::infinity();
    const ref::Surface<double> surface(mesh.prepared, unit);
    const ref::Bins<double> bins(surface, points_of(rows));
    ref::Detector<double> detector(surface, bins, ref::double_tolerances(), 1);
    // The reference takes lengths beyond all proportion to the mesh for unknown ones.
    const double longest = 2 * ref::longest_path(mesh.prepared);

    std::vector<double> distances(rows.size(), kUnknown); // By place, of the current source.
    std::vector<std::uint32_t> near;                      // Places with a distance.
    bool goes_on = true;
    for (std::uint32_t source = 0; source < rows.size() && goes_on; ++source) {
        check_interrupted();
        progress.update(static_cast<double>(source) / static_cast<double>(rows.size()),
                        grouped(source) + " samples");
        detector.set_limit(std::min(cut_of(bins.order[source]), longest) / unit);
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
            const auto [low, high] = std::minmax(bins.order[source], bins.order[place]);
            goes_on = visit(low, high, distance) && goes_on;
        }
        near.clear();
    }
    progress.clear();
}

} // namespace

GivenSpacing check_spacing(const MeshInput& mesh, std::span<const SampleRow> rows,
                           const PairDistances& distances, std::span<const std::uint32_t> given,
                           ProgressLine& progress) {
    GivenSpacing result;
    const auto is_given = [given](std::uint32_t row) { return !given.empty() && given[row] != 0; };
    double largest = rows.empty() ? 1 : 0;
    for (std::uint32_t row = 0; row < rows.size(); ++row) {
        largest = std::max(largest, distances.reach(row));
    }
    progress.begin_stage("verifying");
    // From the sample with the larger radius, every pair is found this way.
    const auto cut_of = [&](std::uint32_t row) { return result.others.cut * distances.reach(row); };
    for_each_pair(mesh, rows, ref::suitable_unit(mesh.prepared, largest, kMostCells), cut_of,
                  progress, [&](std::uint32_t row_a, std::uint32_t row_b, double distance) {
                      const double ratio = distance / distances.of(row_a, row_b);
                      const ClosePair pair{row_a, row_b, distance, ratio};
                      if (!is_given(row_a) || !is_given(row_b)) {
                          return result.others.add(pair);
                      }
                      if (result.among_given.is_complete) { // Else no reason to stop.
                          result.among_given.add(pair);
                      }
                      return true;
                  });
    result.others.finish();
    result.among_given.finish();
    return result;
}

SpacingResult check_spacing(const MeshInput& mesh, std::span<const SampleRow> rows,
                            std::span<const double> radii, ProgressLine& progress) {
    return check_spacing(mesh, rows, PairDistances{radii}, {}, progress).others;
}

std::optional<ClosePair> find_closest(const MeshInput& mesh, std::span<const SampleRow> rows,
                                      ProgressLine& progress) {
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
        const double cut = kCutFactor * distance;
        for_each_pair(
            mesh, rows, ref::suitable_unit(mesh.prepared, distance, kMostCells),
            [cut](std::uint32_t) { return cut; }, progress,
            [&](std::uint32_t row_a, std::uint32_t row_b, double length) {
                const ClosePair pair{row_a, row_b, length, length};
                if (is_closer(pair, closest)) {
                    closest = pair;
                }
                return true;
            });
        if (cut > longest) {
            break;
        }
        distance *= 2;
    }
    return closest;
}

} // namespace geodisk::tools
