// Frames of samples: rotations that place a model at a sample.
#pragma once

#include <array>
#include <cstdint>

#include "geometry/up.hpp"
#include "geometry/vec.hpp"

namespace geodisk::tools {

/// Direction in which frames turn the up axis of a model.
struct FrameStyle {
    Up model = Up::z; ///< Axis of the model that points up.
    Up world = Up::z; ///< Axis of the mesh that points up. Of no effect where `part` is 1.
    double part = 1;  ///< Part of the way from that axis to the normal, in [0, 1].

    /// Returns true if frames depend on the axis of the mesh that points up.
    bool has_world() const { return part < 1; }
};

/// Returns a quaternion x y z w with w >= 0 that turns by `angle` about the up axis of the model,
/// and then that axis to the direction that `style` asks for, the shortest way. A zero `normal`
/// counts as the axis of the world, or of the model where the world has no effect. Half a turn goes
/// about the axis after the one it turns: x after z.
std::array<double, 4> frame_of(const Vec3& normal, double angle, const FrameStyle& style = {});

/// Returns a random angle below 2 pi that follows from the seed, the triangle and the weights of a
/// sample alone, so that other samples do not change it.
double frame_angle(std::uint64_t seed, std::uint32_t face, const float (&weights)[3]);

} // namespace geodisk::tools
