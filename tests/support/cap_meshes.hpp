// Small random meshes with flat triangles: caps, chains of them, caps beside caps and on borders,
// needles, joints in the middle of an edge, edges of three faces.
#pragma once

#include <cstdint>
#include <functional>

#include "support/meshes.hpp"

namespace geodisk::test {

/// Returns a number below its argument, which is at most 256.
using Choose = std::function<std::uint32_t(std::uint32_t)>;

/// Up to 30 faces, in about the unit cube.
TestMesh cap_mesh(const Choose& choose);

/// A point of a face that has three corners at different places; often on an edge or a corner.
Point point_of(const TestMesh& mesh, const Choose& choose);

} // namespace geodisk::test
