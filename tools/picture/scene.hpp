// Scene that is drawn of a surface: its corners in space, about a unit ball.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

#include "picture_records.h"

namespace geodisk::tools::picture {

struct Scene {
    /// Three to a face. Normals are those of the smooth surface where faces meet at less than
    /// kCrease, else those of the faces; of unit length, or zero for faces without area.
    std::vector<CornerRec> corners;
    /// Maximum by which what is drawn sticks out from the corners.
    double around = 0;
    /// Lengths here per length of the mesh; 0 where they are not in proportion.
    double scale = 0;

    glm::dvec3 corner(std::size_t index) const {
        return {corners[index].x, corners[index].y, corners[index].z};
    }
};

inline constexpr double kCrease = 40; ///< Degrees between normals of faces.

/// A surface whose vertices have `dimension` >= 2 coordinates each. Those with two lie in a plane;
/// of more than three all but three are taken away one by one, from the last, in perspective: as a
/// stereographic projection does, which shows a torus of four dimensions as one in space.
Scene make_scene(std::span<const double> positions, std::uint32_t dimension,
                 std::span<const std::uint32_t> triangles);

} // namespace geodisk::tools::picture
