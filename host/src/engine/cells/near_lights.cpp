#include "engine/cells/near_lights.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <tuple>

namespace geodisk {
namespace {

// If a part has more lights, most of them are farther than the nearest one all over it.
constexpr std::size_t kMany = 12;

} // namespace

NearLights::Range NearLights::begin(std::uint32_t face) {
    const auto lights = lit_.lights_of(face);
    stack_.assign(lights.begin(), lights.end());
    // Devices record them in any order, and again those of a batch that they repeat.
    const auto content = [this](std::uint32_t light) {
        const gpu::LitRec& r = lit_.record(light);
        return std::tuple(r.sample_index, r.place, r.sigma, r.x, r.y, r.low, r.high);
    };
    std::ranges::sort(stack_, {}, content);
    const auto is_same = [&](std::uint32_t a, std::uint32_t b) { return content(a) == content(b); };
    stack_.erase(std::unique(stack_.begin(), stack_.end(), is_same), stack_.end());
    return {0, stack_.size()};
}

// Along the surface distances differ by at most as much as points are apart. So one that lights the
// centroid bounds the distance in all of the target.
NearLights::View NearLights::look(const FacePart& part, const LitFaces::Target& target,
                                  Range lights) {
    View view{{lights.end, lights.end}, false, 0, std::numeric_limits<double>::infinity(), 0};
    double largest = 0.5;
    seen_.clear();
    for (std::size_t i = lights.first; i < lights.end; ++i) {
        const std::uint32_t light = stack_[i];
        const auto [distance, outside] = lit_.sight(light, target);
        if (outside > target.margin) {
            continue;
        }
        seen_.push_back({light, distance});
        largest = std::max(largest, std::abs(double{lit_.record(light).limit}));
        const std::uint32_t sample = sample_of(light);
        if (outside == 0 &&
            (distance < view.distance || (distance == view.distance && sample < view.nearest))) {
            view.is_lit = true;
            view.nearest = sample;
            view.distance = distance;
        }
    }
    // Lengths of larger disks are scaled down to less than 2.
    view.error = closeness_.error * 2 * largest;
    const double margin = std::max(2 * view.error, 3 * closeness_.tie);
    const double bound = view.distance + 2 * target.reach + margin;
    for (const auto& [light, distance] : seen_) {
        if (distance <= bound) {
            stack_.push_back(light);
        }
    }
    view.lights.end = stack_.size();
    if (view.is_lit && view.lights.end - view.lights.first > kMany) {
        drop_beaten(part, target, margin, view);
    }
    return view;
}

void NearLights::drop_beaten(const FacePart& part, const LitFaces::Target& target, double margin,
                             View& view) {
    const auto lights = std::span(stack_).subspan(view.lights.first);
    const CornerFunctions functions(lit_, part, target, lights);
    functions_.clear();
    std::array<const CornerFunction*, 4> lowest{}; // At the corners, and in sum.
    const auto value_of = [](const CornerFunction& function, std::size_t k) {
        const CornerValues& at = function.values;
        return k < 3 ? at[k] : at[0] + at[1] + at[2];
    };
    functions_.reserve(lights.size());
    for (const std::uint32_t light : lights) {
        const CornerFunction& function = functions_.emplace_back(functions.of(light));
        for (std::size_t k = 0; k < 4 && function.lit == CornerFunction::kAllLit; ++k) {
            if (lowest[k] == nullptr || value_of(function, k) < value_of(*lowest[k], k)) {
                lowest[k] = &function;
            }
        }
    }
    const double beyond = functions.difference(view.distance + target.reach, margin);
    std::size_t kept = view.lights.first;
    for (std::size_t i = 0; i < functions_.size(); ++i) {
        const bool is_beaten = std::ranges::any_of(lowest, [&](const CornerFunction* other) {
            return other != nullptr && functions_[i].is_beaten_by(*other, beyond);
        });
        if (!is_beaten) {
            stack_[kept++] = lights[i];
        }
    }
    stack_.resize(kept);
    view.lights.end = kept;
}

NearLights::Nearest NearLights::nearest_at(const LitFaces::Target& point,
                                           std::span<const std::uint32_t> lights) const {
    Nearest nearest{~0u, std::numeric_limits<double>::infinity()};
    for (const std::uint32_t light : lights) {
        const auto [distance, outside] = lit_.sight(light, point);
        nearest.distance = outside == 0 ? std::min(nearest.distance, distance) : nearest.distance;
    }
    for (const std::uint32_t light : lights) {
        const auto [distance, outside] = lit_.sight(light, point);
        if (outside == 0 && distance <= nearest.distance + closeness_.tie) {
            nearest.sample = std::min(nearest.sample, sample_of(light));
        }
    }
    return nearest;
}

bool NearLights::is_single(Range lights) const {
    const auto own = at(lights);
    return std::ranges::all_of(
        own, [&](std::uint32_t light) { return sample_of(light) == sample_of(own.front()); });
}

} // namespace geodisk
