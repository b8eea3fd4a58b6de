#include "engine/cells/near_lights.hpp"

#include <algorithm>
#include <limits>
#include <tuple>

namespace geodisk {

NearLights::Range NearLights::begin(std::uint32_t face) {
    const auto lights = lit_.lights_of(face);
    stack_.assign(lights.begin(), lights.end());
    // Devices record them in any order.
    std::ranges::sort(stack_, {}, [this](std::uint32_t light) {
        const gpu::LitRec& r = lit_.record(light);
        return std::tuple(r.sample_index, r.place, r.sigma, r.x, r.y, r.low, r.high);
    });
    return {0, stack_.size()};
}

// Along the surface distances differ by at most as much as points are apart. So one that lights the
// centroid bounds the distance in all of the target.
NearLights::View NearLights::look(const LitFaces::Target& target, Range lights) {
    View view{{lights.end, lights.end}, false, 0, std::numeric_limits<double>::infinity()};
    seen_.clear();
    for (std::size_t i = lights.first; i < lights.end; ++i) {
        const std::uint32_t light = stack_[i];
        const auto [distance, outside] = lit_.sight(light, target);
        if (outside > target.margin) {
            continue;
        }
        seen_.push_back({light, distance});
        const std::uint32_t sample = sample_of(light);
        if (outside == 0 &&
            (distance < view.distance || (distance == view.distance && sample < view.nearest))) {
            view.is_lit = true;
            view.nearest = sample;
            view.distance = distance;
        }
    }
    const double bound = view.distance + 2 * target.reach + more_;
    for (const auto& [light, distance] : seen_) {
        if (distance <= bound) {
            stack_.push_back(light);
        }
    }
    view.lights.end = stack_.size();
    return view;
}

bool NearLights::is_single(Range lights) const {
    const auto own = at(lights);
    return std::ranges::all_of(
        own, [&](std::uint32_t light) { return sample_of(light) == sample_of(own.front()); });
}

} // namespace geodisk
