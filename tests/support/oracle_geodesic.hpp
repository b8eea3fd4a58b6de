// An independent exact geodesic distance: CGAL's Surface_mesh_shortest_path.
#pragma once

#include <memory>
#include <vector>

#include "support/meshes.hpp"

namespace geodisk::test {

/// Distances on one mesh. Takes only what CGAL takes: consistently oriented faces with area, at
/// most two to an edge and one fan to a vertex.
class GeodesicOracle {
  public:
    /// Throws std::runtime_error for a mesh that CGAL cannot take.
    explicit GeodesicOracle(const TestMesh& mesh);
    ~GeodesicOracle();

    /// From `source` to each of `targets` in mesh units; infinite where there is no path.
    std::vector<double> distances(const Point& source, const std::vector<Point>& targets);

    /// Builds the whole sequence tree of `a`: ask `distances` for many targets of one source.
    double distance(const Point& a, const Point& b) { return distances(a, {b}).front(); }

  private:
    struct State;
    std::unique_ptr<State> state_;
};

} // namespace geodisk::test
