#include "picture/flat_box.hpp"

#include <algorithm>
#include <cmath>

#include "program/failure.hpp"

namespace geodisk::tools::picture {
namespace {

/// Lower left and upper right half of each cell of a grid, row by row. Corners are numbered by
/// `vertex(column, row)`.
template <class Vertex>
std::vector<std::uint32_t> grid_triangles(std::uint32_t cells, const Vertex& vertex) {
    std::vector<std::uint32_t> triangles;
    for (std::uint32_t row = 0; row < cells; ++row) {
        for (std::uint32_t column = 0; column < cells; ++column) {
            const std::uint32_t a = vertex(column, row), b = vertex(column + 1, row);
            const std::uint32_t c = vertex(column, row + 1), d = vertex(column + 1, row + 1);
            triangles.insert(triangles.end(), {a, b, c, d, c, b});
        }
    }
    return triangles;
}

PreparedMesh prepare(const BoxParams& box, std::uint32_t cells, std::span<const double> positions,
                     std::span<const std::uint32_t> triangles) {
    if (!box.is_periodic) {
        return take(PreparedMesh::prepare({positions, triangles, 2}));
    }
    // Corners on opposite sides are one, so that lengths alone make the surface.
    const std::vector<std::uint32_t> joined =
        grid_triangles(cells, [cells](std::uint32_t column, std::uint32_t row) {
            return (row % cells) * cells + column % cells;
        });
    const double width = box.extents[0] / cells, height = box.extents[1] / cells;
    std::vector<double> lengths;
    for (std::size_t triangle = 0; 3 * triangle < joined.size(); ++triangle) {
        lengths.insert(lengths.end(), {width, std::hypot(width, height), height});
    }
    return take(PreparedMesh::prepare({joined, lengths, cells * cells}));
}

} // namespace

FlatBox::FlatBox(const BoxParams& box)
    : width_(box.extents[0]), height_(box.extents[1]), positions_([&] {
          std::vector<double> positions;
          for (std::uint32_t row = 0; row <= kCells; ++row) {
              for (std::uint32_t column = 0; column <= kCells; ++column) {
                  positions.push_back(column * width_ / kCells);
                  positions.push_back(row * height_ / kCells);
              }
          }
          return positions;
      }()),
      triangles_(
          grid_triangles(kCells, [](std::uint32_t column,
                                    std::uint32_t row) { return row * (kCells + 1) + column; })),
      mesh_(prepare(box, kCells, positions_, triangles_)) {}

SurfaceDisk FlatBox::disk(double x, double y, double radius) const {
    const auto cell_of = [](double at) {
        return static_cast<std::uint32_t>(std::clamp(std::floor(at), 0.0, kCells - 1.0));
    };
    const double u = x / width_ * kCells, v = y / height_ * kCells;
    const std::uint32_t column = cell_of(u), row = cell_of(v);
    const double right = std::clamp(u - column, 0.0, 1.0), up = std::clamp(v - row, 0.0, 1.0);
    const std::uint32_t face = 2 * (row * kCells + column);
    if (right + up <= 1) {
        return {face, right, up, radius};
    }
    return {face + 1, 1 - right, 1 - up, radius}; // From the upper right corner.
}

} // namespace geodisk::tools::picture
