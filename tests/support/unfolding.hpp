// Geodesic distances by unfolding alone, for meshes of any dimension: independent of the library
// and of the reference, and without any pruning, so for small reaches only.
#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <utility>
#include <vector>

#include "support/meshes.hpp"

namespace geodisk::test {

class Unfolding {
  public:
    explicit Unfolding(const TestMesh& mesh);

    /// The distance to each target that is not farther than `reach`; infinity for the others.
    std::vector<double> distances(const Point& source, std::span<const Point> targets,
                                  double reach) const;

  private:
    struct Plane {
        double x, y;
    };
    struct Window;
    class Search;

    double length(std::uint32_t a, std::uint32_t b) const;
    /// Where c lies in the face beyond the edge from a at A to b at B, B to the left of A as seen
    /// from the origin.
    Plane beyond(std::uint32_t a, Plane at_a, std::uint32_t b, Plane at_b, std::uint32_t c) const;

    const TestMesh& mesh_;
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::vector<std::uint32_t>> faces_;
    std::vector<std::vector<std::uint32_t>> fans_; ///< Faces of each vertex.
};

} // namespace geodisk::test
