// A mesh cut along the borders of the cells of samples.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <limits>
#include <span>
#include <vector>

#include <geodisk/sample.hpp>

#include "geometry/mesh.hpp"

namespace geodisk::tools {

/// Returns the index of the sample nearest to each point of the mesh, CutCells::kNone where no path
/// leads to one.
using FindNearest = std::function<std::vector<std::uint32_t>(std::span<const Sample>)>;

/// Triangles that each lie in one cell, and the lines between cells.
struct CutCells {
    static constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

    /// A piece of the border between the cells of two samples, the lower one first.
    struct Border {
        std::array<std::uint32_t, 2> ends; ///< Vertices.
        std::array<std::uint32_t, 2> samples;
    };

    std::uint32_t dimension = 3;
    std::vector<double> positions; ///< Those of the mesh first.
    std::vector<std::array<std::uint32_t, 3>> triangles;
    std::vector<std::uint32_t> samples; ///< Whose cell each triangle is in; kNone for none.
    std::vector<std::uint32_t> faces;   ///< Triangle of the mesh that each one is a part of.
    std::vector<Border> borders;
};

/// Cuts a mesh, which must have coordinates, along the borders of cells. On edges, borders are
/// where both samples are equally near. In faces they are straight from edge to edge, or meet in a
/// point; faces are split until that fits: into triangles of at most `longest`, and where three
/// cells meet to a fraction of it. `mask` has a byte per triangle, 0 to leave it out; empty for
/// all.
CutCells cut_cells(const MeshFile& mesh, std::span<const std::uint8_t> mask, double longest,
                   const FindNearest& nearest);

} // namespace geodisk::tools
