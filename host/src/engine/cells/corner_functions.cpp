#include "engine/cells/corner_functions.hpp"

#include <algorithm>
#include <cstddef>
#include <limits>

namespace geodisk {

CornerFunctions::CornerFunctions(const LitFaces& lit, const FacePart& part,
                                 const LitFaces::Target& target,
                                 std::span<const std::uint32_t> lights)
    : lit_(lit), target_(target), nearest_source_(std::numeric_limits<double>::infinity()) {
    for (std::size_t k = 0; k < 3; ++k) {
        corners_[k] = lit.target(part.face, part.corners[k]);
        const double x = corners_[k].at[0].x - target.at[0].x;
        const double y = corners_[k].at[0].y - target.at[0].y;
        squares_[k] = x * x + y * y;
    }
    for (const std::uint32_t light : lights) {
        nearest_source_ = std::min(nearest_source_, double{lit.record(light).sigma});
    }
}

CornerFunction CornerFunctions::of(std::uint32_t light) const {
    CornerFunction function{};
    for (std::size_t k = 0; k < 3; ++k) {
        const auto [distance, outside] = lit_.sight(light, corners_[k]);
        const double from = distance - nearest_source_;
        function.distances[k] = distance;
        function.values[k] = from * from - squares_[k];
        function.lit |= (outside == 0 ? 1u : 0u) << k;
    }
    const double source{lit_.record(light).sigma};
    if (source > nearest_source_) {
        // The second derivative of a distance is at most 1 over that distance.
        const double reach = target_.reach;
        const double straight = lit_.sight(light, target_).distance - source - reach;
        function.bend = straight > 0 ? (source - nearest_source_) / straight * reach * reach
                                     : std::numeric_limits<double>::infinity();
    }
    return function;
}

} // namespace geodisk
