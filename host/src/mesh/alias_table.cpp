#include "mesh/alias_table.hpp"

#include <algorithm>
#include <cmath>

namespace geodisk {
namespace {

constexpr std::uint64_t kColumn = std::uint64_t{1} << 32;

/// Weights in units of 2^-32 column whose sum is exactly one column per face.
std::vector<std::uint64_t> integer_weights(std::span<const double> areas, double total) {
    const double scale = static_cast<double>(areas.size()) * static_cast<double>(kColumn);
    std::vector<std::uint64_t> weights(areas.size());
    std::uint64_t sum = 0;
    std::size_t largest = 0;
    for (std::size_t f = 0; f < areas.size(); ++f) {
        weights[f] = static_cast<std::uint64_t>(std::floor(areas[f] / total * scale));
        sum += weights[f];
        largest = areas[f] > areas[largest] ? f : largest;
    }
    // The largest face takes what rounding left over, at most about one unit per face; it holds
    // at least a whole column, so it can also give.
    weights[largest] += areas.size() * kColumn - sum;
    return weights;
}

} // namespace

std::vector<AliasColumn> build_alias_table(std::span<const double> areas, double total) {
    std::vector<std::uint64_t> weights = integer_weights(areas, total);
    std::vector<AliasColumn> table(areas.size());
    std::vector<std::uint32_t> small;
    std::vector<std::uint32_t> large;
    for (std::uint32_t f = 0; f < weights.size(); ++f) {
        (weights[f] < kColumn ? small : large).push_back(f);
    }
    while (!small.empty()) {
        const std::uint32_t poor = small.back();
        const std::uint32_t rich = large.back();
        small.pop_back();
        table[poor] = {static_cast<std::uint32_t>(weights[poor]), rich};
        weights[rich] -= kColumn - weights[poor];
        if (weights[rich] < kColumn) {
            large.pop_back();
            small.push_back(rich);
        }
    }
    // The sums are exact, so what is left fills its column to the brim.
    for (const std::uint32_t full : large) {
        table[full] = {0, full};
    }
    return table;
}

} // namespace geodisk
