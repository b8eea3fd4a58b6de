// The points of a surface that are nearest to given ones.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "geometry/mesh.hpp"

namespace geodisk::tools {

/// A point of a surface.
struct SurfacePoint {
    std::uint32_t face = 0;
    std::array<double, 3> weights{}; ///< Weights of the corners; they sum to 1.
    double distance = 0;             ///< From the point that was asked for.
};

/// A point or a difference of points, in up to as many dimensions as meshes have.
using Vector = std::array<double, kMaxCoordinates>;

/// Returns the weights of the point of a triangle that is nearest to a point. `ab`, `ac` and `to`
/// lead from the first corner to the others and to the point. They sum to 1 up to rounding.
std::array<double, 3> nearest_weights(const Vector& ab, const Vector& ac, const Vector& to);

/// A tree of boxes over the faces of a mesh that take part, in any dimension. The mesh must outlive
/// it and have at least one such face.
class NearestFace {
  public:
    explicit NearestFace(const MeshFile& mesh);

    /// Returns the nearest point of the surface; of several, that of the lowest face. `point` has
    /// as many coordinates as the mesh.
    SurfacePoint find(std::span<const double> point) const;

    /// Returns the diagonal of the box around all faces.
    double diagonal() const;

  private:
    struct Node {
        Vector low, high;
        std::uint32_t begin, end; ///< In faces_, of a leaf.
        std::uint32_t right;      ///< The left child is the next node; 0 for a leaf.
    };

    Vector vertex(std::uint32_t face, std::size_t corner) const;
    std::uint32_t build(std::uint32_t begin, std::uint32_t end);
    double distance2_to(const Node& node, const Vector& point) const;
    void look_at(std::uint32_t face, const Vector& point, SurfacePoint& best) const;

    const MeshFile& mesh_;
    double scale_ = 1; ///< Scale of coordinates here, so that no square leaves the range of double.
    std::vector<std::uint32_t> faces_;
    std::vector<Node> nodes_;
};

} // namespace geodisk::tools
