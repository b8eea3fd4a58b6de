// Points and vectors in space and in the plane: GLM's, zero when not given a value. The only place
// of the tools that includes GLM, so that its configuration is the same everywhere.
#pragma once

#define GLM_FORCE_CTOR_INIT
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

namespace geodisk::tools {

using Vec2 = glm::dvec2;
using Vec3 = glm::dvec3;
using glm::cross;
using glm::dot;
using glm::length;

inline Vec3 normalized(Vec3 a) {
    return glm::normalize(a);
}

} // namespace geodisk::tools
