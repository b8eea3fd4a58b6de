// Distances between samples computed anew in double precision, on surfaces with the reference
// implementation: what a check finds, and how commands tell it.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <ostream>
#include <span>
#include <string>
#include <vector>

#include <geodisk/box.hpp>

#include "files/samples/sample_file.hpp"
#include "geodisk/inputs/mesh_input.hpp"
#include "geodisk/options/class_options.hpp"
#include "geodisk/outputs/progress.hpp"
#include "geodisk/reports/json_type.hpp"

namespace geodisk::tools {

/// Two rows of the sample file, the lower one first, and their distance.
struct ClosePair {
    std::uint32_t row_a, row_b;
    double distance;
    double ratio; ///< Distance over its minimum; by find_closest() the distance.

    /// Returns true if it is closer than it should be, by more than a billionth.
    bool is_violation() const;
};

/// Violations that are looked for: enough to say that a file is hopeless, and few enough to hold.
inline constexpr std::size_t kMaxViolations = 1'000'000;
/// Pairs of existing samples that are looked for, besides the closest: where the distance is far
/// beyond theirs, each has very many.
inline constexpr std::size_t kMaxExistingPairs = 50'000;

/// Returns true if the pair is closer, by ratio.
bool is_closer(const ClosePair& pair, const std::optional<ClosePair>& than);

struct SpacingResult {
    std::size_t most = kMaxViolations; ///< Violations with which the check stops.
    double cut = 1.25;                 ///< Pairs were looked at up to this ratio.
    std::optional<ClosePair> closest;  ///< By ratio; none if all are farther apart than the cut.
    std::vector<ClosePair> violations; ///< The closest pair first, by ratio.
    bool is_complete = true;           ///< False if the check stopped at too many violations.

    /// Takes a pair that was found, in any order, and more than once if it was found so. It is a
    /// violation when it is closer by more than a billionth. False if there are too many.
    bool add(const ClosePair& pair);
    /// Takes a pair that counts only if it is the closest.
    void note_closest(const ClosePair& pair);
    /// Sorts the violations; of a pair found more than once, the shortest distance counts.
    void finish();

    /// Samples in at least one violation.
    std::size_t violating_samples() const;
    /// Returns "3 pairs", or "at least" so many if the check stopped.
    std::string pairs_text() const;
};

/// Distances that rows must keep: the sum of their radii, one to a row, or as their classes say.
struct PairDistances {
    std::span<const double> radii;
    std::span<const std::uint32_t> classes{}; ///< One to a row, or none.
    ClassTable table{};                       ///< Table of the classes, if there are any.
    double min_distance = 0;                  ///< Largest distance in the table.

    /// Returns the distance for a pair.
    double of(std::uint32_t row_a, std::uint32_t row_b) const {
        return classes.empty() ? radii[row_a] + radii[row_b]
                               : table.factor(classes[row_a], classes[row_b]) * min_distance;
    }
    /// Returns a distance for which each pair is at most as far apart as that of one of its rows.
    double reach(std::uint32_t row) const {
        double reach = classes.empty() ? 2 * radii[row] : 0;
        for (std::size_t other = 0; other < table.count && !classes.empty(); ++other) {
            reach = std::max(reach, table.factor(classes[row], other) * min_distance);
        }
        return reach;
    }
    /// Returns true if each pair is within the reach of both of its rows.
    bool are_found_from_both() const {
        return !classes.empty() ||
               std::ranges::adjacent_find(radii, std::ranges::not_equal_to()) == radii.end();
    }
};

/// Pairs of samples of which some existed before.
struct ExistingSpacing {
    SpacingResult others;         ///< Pairs with a new sample.
    SpacingResult among_existing; ///< Pairs of existing samples, whose distance is the user's.
};

/// Computes the distances of all pairs that are not much farther apart than the minimum distance
/// of the box. Rows must lie in it. Throws UserError when interrupted.
SpacingResult check_box_spacing(const BoxParams& box, std::span<const SampleRow> rows,
                                ProgressLine& progress);

/// The smallest distance in mesh units and its pair, of find_closest().
std::string closest_text(const std::optional<ClosePair>& closest);

/// The smallest distance, and what part of `min_distance` it is, the least for all pairs.
std::string smallest_text(const SpacingResult& result, double min_distance);

/// Prints how many violations there are, the first ones, and how many samples are in them.
/// Unless `least` is empty, it names what the ratio of a pair's distance is to.
void print_violations(std::ostream& out, const SampleFile& samples, const SpacingResult& result,
                      const std::string& least);

/// "3 pairs of samples are closer than WHAT"; empty without violations.
std::string violation_text(const SpacingResult& result, const std::string& what);

/// Distance, rows and candidates of a pair; null without one.
Json pair_json(const std::optional<ClosePair>& pair);
/// Numbers of pairs and samples; rows and distance of each pair, column by column, the closest pair
/// first, for there may be a million.
Json violations_json(const SpacingResult& result);

} // namespace geodisk::tools
