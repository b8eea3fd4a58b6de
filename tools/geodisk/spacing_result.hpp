// What a check of distances finds, and how commands tell it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <ostream>
#include <string>
#include <vector>

#include "common/sample_file.hpp"
#include "geodisk/json_text.hpp"

namespace geodisk::tools {

/// Two rows of the sample file, the lower one first, and their distance.
struct ClosePair {
    std::uint32_t row_a, row_b;
    double distance;
    double ratio; ///< Of the distance to what it should be at least; of find_closest() itself.
};

/// Whether the pair is closer, by ratio.
bool is_closer(const ClosePair& pair, const std::optional<ClosePair>& than);

struct SpacingResult {
    double cut = 1.25;                 ///< Pairs were looked at up to this ratio.
    std::optional<ClosePair> closest;  ///< By ratio; none if all are farther apart than the cut.
    std::vector<ClosePair> violations; ///< The closest pair first, by ratio.
    bool is_complete = true;           ///< False if the check stopped at too many violations.

    /// Takes a pair that was found, in any order, and more than once if it was found so. It is a
    /// violation when it is closer by more than a billionth. False if there are too many.
    bool add(const ClosePair& pair);
    /// Sorts the violations; of a pair found more than once, the shortest distance counts.
    void finish();

    /// Samples in at least one violation.
    std::size_t violating_samples() const;
};

/// The smallest distance, and what part of `min_distance` it is, the least for all pairs.
std::string smallest_text(const SpacingResult& result, double min_distance);

/// Prints how many violations there are, the first ones, and how many samples are in them.
/// `with_ratios` tells what part of the sum of its radii the distance of a pair is.
void print_violations(std::ostream& out, const SampleFile& samples, const SpacingResult& result,
                      bool with_ratios);

/// "3 pairs of samples are closer than WHAT"; empty without violations.
std::string violation_text(const SpacingResult& result, const std::string& what);

/// Distance, rows and candidates of a pair; null without one.
Json pair_json(const std::optional<ClosePair>& pair);
/// Numbers of pairs and samples.
Json violations_json(const SpacingResult& result);

} // namespace geodisk::tools
