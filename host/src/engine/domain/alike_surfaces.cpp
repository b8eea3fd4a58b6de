#include "engine/domain/alike_surfaces.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <unordered_map>

#include "constants.h"

namespace geodisk {
namespace {

// Fewer surfaces than this that are alike do not crowd a range of orders, see gpu::kListRange.
constexpr std::size_t kFewAlike = 32;
// Candidates of a surface over whose orders equal ones are spread. By measurement.
constexpr double kSpread = 8;
constexpr double kOrdersPerStage = std::uint32_t{1} << gpu::kPriorityBits;

} // namespace

std::vector<AlikeSurfaces> alike_surfaces(PlacedSurfaces surfaces) {
    std::vector<AlikeSurfaces> all;
    std::unordered_map<std::uint64_t, std::size_t> by_seed;
    for (std::size_t i = 0; i < surfaces.size(); ++i) {
        const auto [found, is_new] = by_seed.try_emplace(surfaces[i].params.seed, all.size());
        if (is_new) {
            all.emplace_back();
        }
        AlikeSurfaces& alike = all[found->second];
        const double expected = surfaces[i].stages.expected(0);
        alike.surfaces.push_back(i);
        alike.expected += expected;
        alike.deviation += std::sqrt(expected); // As if all numbers went up and down together.
    }
    return all;
}

void set_lags(std::span<PlacedSurface> surfaces) {
    for (const AlikeSurfaces& alike : alike_surfaces(surfaces)) {
        const auto count = static_cast<double>(alike.surfaces.size());
        if (alike.surfaces.size() <= kFewAlike) {
            continue;
        }
        const double between = kOrdersPerStage * count / alike.expected;
        const double spread = std::clamp(kSpread * between, count, kOrdersPerStage - 1);
        for (std::size_t i = 0; i < alike.surfaces.size(); ++i) {
            const double part = static_cast<double>(i) / count;
            surfaces[alike.surfaces[i]].lag = static_cast<std::uint32_t>(part * spread);
        }
    }
}

} // namespace geodisk
