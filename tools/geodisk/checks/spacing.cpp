#include "geodisk/checks/spacing.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <tuple>
#include <utility>
#include <vector>

#include "geodisk/reports/json.hpp"
#include "program/human_text.hpp"
#include "program/interrupt.hpp"

namespace geodisk::tools {
namespace {

std::string count_text(std::size_t count, bool is_complete) {
    return (is_complete ? "" : "at least ") + grouped(count);
}

/// Doubles round at 2^-53; chains of crossings may add up some thousand such errors.
constexpr double kSmallestViolation = 1e-9;
constexpr std::size_t kNamedViolations = 10;

double distance(const BoxParams& box, const SampleRow& a, const SampleRow& b) {
    double sum = 0;
    for (std::size_t axis = 0; axis < box.extents.size(); ++axis) {
        const double apart = std::abs(a.position[axis] - b.position[axis]);
        const double way =
            box.is_periodic ? std::min(apart, std::abs(box.extents[axis] - apart)) : apart;
        sum += way * way;
    }
    return std::sqrt(sum);
}

} // namespace

bool ClosePair::is_violation() const {
    return ratio < 1 - kSmallestViolation;
}

bool is_closer(const ClosePair& pair, const std::optional<ClosePair>& than) {
    return !than || std::tie(pair.ratio, pair.row_a, pair.row_b) <
                        std::tie(than->ratio, than->row_a, than->row_b);
}

void SpacingResult::note_closest(const ClosePair& pair) {
    if (pair.ratio <= cut && is_closer(pair, closest)) {
        closest = pair;
    }
}

bool SpacingResult::add(const ClosePair& pair) {
    note_closest(pair);
    if (pair.is_violation()) {
        violations.push_back(pair);
    }
    is_complete = violations.size() < most;
    return is_complete;
}

void SpacingResult::finish() {
    std::sort(violations.begin(), violations.end(), [](const ClosePair& a, const ClosePair& b) {
        return std::tie(a.row_a, a.row_b, a.distance) < std::tie(b.row_a, b.row_b, b.distance);
    });
    const auto end = std::unique(violations.begin(), violations.end(),
                                 [](const ClosePair& a, const ClosePair& b) {
                                     return a.row_a == b.row_a && a.row_b == b.row_b;
                                 });
    violations.erase(end, violations.end());
    std::stable_sort(violations.begin(), violations.end(),
                     [](const ClosePair& a, const ClosePair& b) { return a.ratio < b.ratio; });
}

std::size_t SpacingResult::violating_samples() const {
    std::vector<std::uint32_t> rows;
    for (const ClosePair& pair : violations) {
        rows.insert(rows.end(), {pair.row_a, pair.row_b});
    }
    std::sort(rows.begin(), rows.end());
    return static_cast<std::size_t>(std::unique(rows.begin(), rows.end()) - rows.begin());
}

std::string SpacingResult::pairs_text() const {
    return (is_complete ? "" : "at least ") + counted(violations.size(), "pair", "pairs");
}

// A sweep along the longest side: from each sample to those ahead, around the box if need be, until
// that side alone keeps them apart.
SpacingResult check_box_spacing(const BoxParams& box, std::span<const SampleRow> rows,
                                ProgressLine& progress) {
    SpacingResult result;
    progress.begin_stage("verifying");
    const auto axis = static_cast<std::size_t>(
        std::max_element(box.extents.begin(), box.extents.end()) - box.extents.begin());
    const auto along = [&](std::uint32_t row) { return rows[row].position[axis]; };
    std::vector<std::uint32_t> order(rows.size());
    std::iota(order.begin(), order.end(), 0u);
    std::sort(order.begin(), order.end(),
              [&](std::uint32_t a, std::uint32_t b) { return along(a) < along(b); });
    const double reach = result.cut * box.min_distance;
    bool goes_on = true;
    for (std::size_t i = 0; i < order.size() && goes_on; ++i) {
        check_interrupted();
        progress.update(static_cast<double>(i) / static_cast<double>(order.size()),
                        grouped(i) + " samples");
        const std::uint32_t row = order[i];
        for (std::size_t step = 1; step < order.size() && goes_on; ++step) {
            const bool around = i + step >= order.size();
            const std::uint32_t other = order[(i + step) % order.size()];
            const double ahead = along(other) - along(row) + (around ? box.extents[axis] : 0);
            if ((around && !box.is_periodic) || ahead > reach) {
                break;
            }
            const auto [low, high] = std::minmax(row, other);
            const double apart = distance(box, rows[low], rows[high]);
            goes_on = result.add({low, high, apart, apart / box.min_distance});
        }
    }
    progress.clear();
    result.finish();
    return result;
}

std::string closest_text(const std::optional<ClosePair>& closest) {
    return closest ? rounded(closest->distance, 9) + " in mesh units, samples " +
                         std::to_string(closest->row_a) + " and " + std::to_string(closest->row_b)
                   : "none, no path joins two of them";
}

std::string smallest_text(const SpacingResult& result, double min_distance) {
    return result.closest ? rounded(result.closest->distance, 9) + ", " +
                                rounded(result.closest->ratio, 9) + " of the minimum distance"
                          : "> " + rounded(result.cut * min_distance, 6);
}

void print_violations(std::ostream& out, const SampleFile& samples, const SpacingResult& result,
                      const std::string& least) {
    out << "violations    " << count_text(result.violations.size(), result.is_complete) << '\n';
    for (std::size_t i = 0; i < std::min(result.violations.size(), kNamedViolations); ++i) {
        const ClosePair& pair = result.violations[i];
        out << "              "
            << "samples " << pair.row_a << " and " << pair.row_b << ": "
            << rounded(pair.distance, 9);
        if (!least.empty()) {
            out << ", " << rounded(pair.ratio, 9) << " of " << least;
        }
        out << '\n';
    }
    if (!result.violations.empty()) {
        out << "too close     " << count_text(result.violating_samples(), result.is_complete)
            << " of " << counted(samples.rows.size(), "sample", "samples") << '\n';
    }
}

std::string violation_text(const SpacingResult& result, const std::string& what) {
    const std::size_t count = result.violations.size();
    return count == 0 ? ""
                      : count_text(count, result.is_complete) +
                            (count == 1 ? " pair of samples is" : " pairs of samples are") +
                            " closer than " + what;
}

Json pair_json(const std::optional<ClosePair>& pair) {
    if (!pair) {
        return nullptr;
    }
    return {{"distance", pair->distance}, {"samples", {pair->row_a, pair->row_b}}};
}

Json violations_json(const SpacingResult& result) {
    Json rows_a = Json::array(), rows_b = Json::array(), distances = Json::array();
    for (const ClosePair& pair : result.violations) {
        rows_a.push_back(pair.row_a);
        rows_b.push_back(pair.row_b);
        distances.push_back(pair.distance);
    }
    return {{"pairs", result.violations.size()}, {"samples", result.violating_samples()},
            {"complete", result.is_complete},    {"rows_a", std::move(rows_a)},
            {"rows_b", std::move(rows_b)},       {"distances", std::move(distances)}};
}

} // namespace geodisk::tools
