#include "support/oracle_geodesic.hpp"

#include <array>
#include <limits>
#include <stdexcept>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/Surface_mesh_shortest_path.h>

namespace geodisk::test {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Mesh = CGAL::Surface_mesh<Kernel::Point_3>;
using ShortestPaths =
    CGAL::Surface_mesh_shortest_path<CGAL::Surface_mesh_shortest_path_traits<Kernel, Mesh>>;
using Location = ShortestPaths::Face_location;

} // namespace

struct GeodesicOracle::State {
    Mesh mesh;
    std::unique_ptr<ShortestPaths> paths;
    std::vector<std::array<Mesh::Vertex_index, 3>> faces;

    /// CGAL orders a face's weights by its own first half-edge, which need not start at the corner
    /// that came first in the file.
    Location location(const Point& p) const {
        const Mesh::Face_index face(p.face);
        const Mesh::Vertex_index first = mesh.source(mesh.halfedge(face));
        const double weights[3] = {1 - p.weight1 - p.weight2, p.weight1, p.weight2};
        const std::size_t k = faces[p.face][0] == first ? 0 : faces[p.face][1] == first ? 1 : 2;
        return {face, {{weights[k], weights[(k + 1) % 3], weights[(k + 2) % 3]}}};
    }

    /// A point on a vertex is handed over as that vertex: CGAL then starts from its whole fan.
    void set_source(const Point& p) {
        paths->remove_all_source_points();
        const double weights[3] = {1 - p.weight1 - p.weight2, p.weight1, p.weight2};
        for (std::size_t k = 0; k < 3; ++k) {
            if (weights[k] == 1) {
                paths->add_source_point(faces[p.face][k]);
                return;
            }
        }
        paths->add_source_point(location(p));
    }
};

GeodesicOracle::GeodesicOracle(const TestMesh& mesh) : state_(std::make_unique<State>()) {
    for (std::uint32_t v = 0; v < mesh.vertex_count(); ++v) {
        const Vec3 p = mesh.vertex(v);
        state_->mesh.add_vertex({p.x, p.y, p.z});
    }
    for (std::uint32_t f = 0; f < mesh.face_count(); ++f) {
        std::array<Mesh::Vertex_index, 3> corners;
        for (std::uint32_t k = 0; k < 3; ++k) {
            corners[k] = Mesh::Vertex_index(mesh.triangles[std::size_t{3} * f + k]);
        }
        if (!state_->mesh.add_face(corners).is_valid()) {
            throw std::runtime_error("CGAL cannot take face " + std::to_string(f));
        }
        state_->faces.push_back(corners);
    }
    state_->paths = std::make_unique<ShortestPaths>(state_->mesh);
}

GeodesicOracle::~GeodesicOracle() = default;

std::vector<double> GeodesicOracle::distances(const Point& source,
                                              const std::vector<Point>& targets) {
    state_->set_source(source);
    state_->paths->build_sequence_tree();
    std::vector<double> result;
    for (const Point& target : targets) {
        const Location at = state_->location(target);
        const double distance =
            state_->paths->shortest_distance_to_source_points(at.first, at.second).first;
        // CGAL answers -1 where no path leads.
        result.push_back(distance < 0 ? std::numeric_limits<double>::infinity() : distance);
    }
    return result;
}

} // namespace geodisk::test
