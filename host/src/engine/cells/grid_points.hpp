// GridPoints: the points of a grid that all faces of a mesh share.
#pragma once

#include <array>
#include <compare>
#include <cstdint>
#include <vector>

#include <geodisk/mesh.hpp>
#include <geodisk/sample.hpp>

#include "engine/maximal/gap_cell.hpp"

namespace geodisk {

/// A point of the grid, the same for all faces that have it.
struct GridPoint {
    enum class Kind : std::uint32_t { vertex, edge, face };
    Kind kind;
    std::uint32_t element;     ///< Vertex, half-edge or face.
    std::uint32_t column, row; ///< Steps; `row` is 0 but in a face.
    auto operator<=>(const GridPoint&) const = default;
};

/// A place of a face.
struct FacePlace {
    std::uint32_t face;
    FaceWeights weights;
};

/// A grid that splits each edge into 2^level steps. Points on edges and vertices are looked at from
/// one of their faces, so that all agree about them.
class GridPoints {
  public:
    /// The mesh must outlive it.
    GridPoints(const PreparedMesh& mesh, std::uint32_t level)
        : mesh_(mesh), level_(level), steps_(std::uint32_t{1} << level) {}

    std::uint32_t level() const { return level_; }
    /// Returns the corners of a cell that is split so often.
    std::array<GridPoint, 3> corners(const GapCell& cell) const;
    /// Returns where to look at a point. It has a face with area if the point is on one.
    FacePlace place(const GridPoint& point) const;

    /// Returns the point of a face with these weights of its second and third corner, in steps.
    GridPoint point(std::uint32_t face, std::uint32_t column, std::uint32_t row) const;
    /// Returns the point of the grid of 2^24 steps that a point of the surface is rounded to.
    GridPoint point(const Sample& sample) const;

  private:
    GridPoint on_edge(std::uint32_t half_edge, std::uint32_t steps) const;

    const PreparedMesh& mesh_;
    std::uint32_t level_, steps_;
};

} // namespace geodisk
