#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <vector>

#include "geodisk/checks/spacing.hpp"
#include "program/human_text.hpp"
#include "program/interrupt.hpp"

namespace geodisk::tools {
namespace {

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

} // namespace geodisk::tools
