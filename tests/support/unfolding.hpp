// Geodesic distances by unfolding alone, for meshes of any dimension, flat triangles and edges of
// many faces: independent of the library and of the reference. Follows every sequence of faces, so
// it is for small reaches or small meshes only.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <span>
#include <utility>
#include <vector>

#include "support/meshes.hpp"

namespace geodisk::test {

/// Computes in extended precision. A straight line that passes a vertex on the wrong side by less
/// than 2^-52 of the longest edge counts as a path, so none is lost by rounding. That makes
/// distances too short by a few times as much at most.
class Unfolding {
  public:
    explicit Unfolding(const TestMesh& mesh);

    /// The distance to each target that is not farther than `reach`; infinity for the others.
    std::vector<double> distances(const Point& source, std::span<const Point> targets,
                                  double reach) const;

  private:
    using Number = long double;
    struct Plane {
        Number x, y;
    };
    struct Window;
    class Search;
    /// A face as seen from one of its edges: how far the third corner lies along the edge, from its
    /// start and back from its end, and off it.
    struct Side {
        Number length, along, back, off;
    };

    /// Returns true unless the face names a vertex twice.
    bool takes_part(std::uint32_t face) const;
    std::uint32_t corner(std::uint32_t face, std::uint32_t k) const {
        return mesh_.triangles[std::size_t{3} * face + k % 3];
    }
    Number coordinate(std::uint32_t v, std::size_t axis) const {
        return mesh_.positions[std::size_t{v} * mesh_.dimension + axis];
    }
    Side side_of(std::uint32_t face, std::uint32_t k) const;

    const TestMesh& mesh_;
    std::vector<Side> sides_; ///< Number 3 * face + corner, of the edge that begins there.
    Number beside_ = 0;       ///< By how much a line may pass a vertex on the wrong side.
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::vector<std::uint32_t>> faces_;
    std::vector<std::vector<std::uint32_t>> fans_; ///< Faces of each vertex.
};

} // namespace geodisk::test
