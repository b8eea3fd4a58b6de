// A drawn surface as a page carries it.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "picture/scene.hpp"
#include "report/page_array.hpp"

namespace geodisk::tools::report {

/// The corners of `scene`, whose faces have the vertices `triangles`, three each. Corners of one
/// vertex with one normal are one point:
///   positions  three per point, of [-1, 1]
///   normals    two per point, the normal n / (|nx| + |ny| + |nz|) without its third coordinate,
///              and folded outwards where that is negative: 0 to 65534 for -1 to 1; 65535 twice for
///              none
///   corners    the point of each corner, three per face
std::vector<PageArray> surface_arrays(const picture::Scene& scene,
                                      std::span<const std::uint32_t> triangles);

} // namespace geodisk::tools::report
