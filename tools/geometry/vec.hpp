// Points and vectors: GLM's, zero when not given a value.
#pragma once

#include <cstddef>
#include <span>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

namespace geodisk::tools {

using Vec2 = glm::dvec2;
using Vec3 = glm::dvec3;
using Vec4 = glm::dvec4;

/// Vertex `vertex` of `positions`, which hold x y z each.
inline Vec3 point_at(std::span<const double> positions, std::size_t vertex) {
    return {positions[3 * vertex], positions[3 * vertex + 1], positions[3 * vertex + 2]};
}

/// The largest absolute value of a coordinate.
inline double largest_coordinate(const Vec3& v) {
    const Vec3 size = glm::abs(v);
    return glm::max(glm::max(size.x, size.y), size.z);
}

} // namespace geodisk::tools
