// The dual graph of cells, from the places where they meet.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <geodisk/cells.hpp>
#include <geodisk/mesh.hpp>

#include "engine/cells/cell_splitter.hpp"

namespace geodisk {

/// Returns the triangles of a dual graph. Meetings of the same samples in a knot are one place: a
/// triangle if their number is odd, else lines of the grid that leave a thin cell and enter it
/// again.
std::vector<std::array<std::uint32_t, 3>>
dual_triangles(std::vector<Meeting> meetings, std::vector<KnotEnd> ends, std::uint32_t knots);

/// Returns the pairs and the sides of triangles, each once.
std::vector<std::array<std::uint32_t, 2>>
dual_edges(std::vector<std::array<std::uint32_t, 2>> pairs,
           std::span<const std::array<std::uint32_t, 3>> triangles);

/// Tells the shape of the dual graph of `cells`.
DualReport dual_report(const PreparedMesh& mesh, const SurfaceCells& cells);

} // namespace geodisk
