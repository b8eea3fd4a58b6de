// A box of two dimensions as a surface: a flat rectangle, or a flat torus where its sides are
// periodic.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <geodisk/box.hpp>
#include <geodisk/mesh.hpp>

#include "geometry/surface_disk.hpp"

namespace geodisk::tools::picture {

class FlatBox {
  public:
    /// `box` has two dimensions. Throws UserError.
    explicit FlatBox(const BoxParams& box);

    const PreparedMesh& mesh() const { return mesh_; }
    /// Two coordinates per corner of the grid, and the triangles of the mesh as they are drawn.
    std::span<const double> positions() const { return positions_; }
    std::span<const std::uint32_t> triangles() const { return triangles_; }

    /// The disk of a point of the box.
    SurfaceDisk disk(double x, double y, double radius) const;

  private:
    /// Along each side: the fewest for which no two triangles of a torus have the same corners.
    static constexpr std::uint32_t kCells = 3;

    double width_, height_;
    std::vector<double> positions_;
    std::vector<std::uint32_t> triangles_;
    PreparedMesh mesh_;
};

} // namespace geodisk::tools::picture
