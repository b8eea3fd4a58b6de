#include "geodisk/inputs/wall_input.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <map>
#include <utility>

#include <geodisk/mesh.hpp>
#include <geodisk/walls.hpp>

#include "files/meshes/sidecar_files.hpp"
#include "geodisk/inputs/mask_input.hpp"
#include "geometry/crease_edges.hpp"
#include "program/failure.hpp"
#include "program/human_text.hpp"

namespace geodisk::tools {
namespace {

using Edge = std::array<std::uint32_t, 2>;

/// The walls of a mesh, as rules name them one after the other.
class FoundWalls {
  public:
    FoundWalls(const std::string& path, const MeshFile& mesh) : path_(path), mesh_(mesh) {}

    void operator()(const OnlyRule& part) { take_faces(faces_of(part, path_, mesh_)); }

    void operator()(const MaskRule& rule) { take_faces(faces_of(rule, path_, mesh_)); }

    void operator()(const CreaseWalls& creases) {
        if (mesh_.positions.empty()) {
            fail_usage("--walls creases needs the coordinates of the mesh, and it has edge lengths "
                       "alone");
        }
        const MeshView view{mesh_.positions, mesh_.triangles, mesh_.dimension, true};
        const PreparedMesh prepared = take(PreparedMesh::prepare(view), path_);
        const std::vector<std::uint32_t> found = crease_edges(view, prepared, creases.degrees);
        if (found.empty()) {
            fail_input(path_, "has no creases for --walls");
        }
        for (const std::uint32_t edge : found) {
            edges_.push_back({mesh_.triangles[edge], mesh_.triangles[next_in_face(edge)]});
        }
    }

    void operator()(const EdgeWalls& walls) {
        for (const NamedEdge& edge : read_edges(walls.file, mesh_.names.first_vertex)) {
            const auto& [a, b] = edge.vertices;
            edges_.push_back({joined(a), joined(b)});
            named_.emplace(edges_.size() - 1, std::pair(walls.file, edge));
        }
    }

    /// Cuts the mesh, which has so many vertices.
    CutMesh cut(std::uint32_t vertices) const {
        auto made = geodisk::cut(mesh_.triangles, vertices, {faces_, edges_});
        const bool is_edge = !made && made.error().status == Status::invalid_argument;
        const auto found = is_edge ? named_.find(made.error().element) : named_.end();
        if (found != named_.end()) {
            const auto& [file, edge] = found->second;
            fail_input(file, "line " + std::to_string(edge.line) + ": no face has an edge " +
                                 mesh_.names.vertex_number(edge.vertices[0]) + "-" +
                                 mesh_.names.vertex_number(edge.vertices[1]));
        }
        return take(std::move(made), path_);
    }

  private:
    void take_faces(const std::vector<std::uint8_t>& chosen) {
        faces_.resize(chosen.size(), 0);
        for (std::size_t t = 0; t < chosen.size(); ++t) {
            faces_[t] = chosen[t] != 0 && mesh_.takes_part(t) ? 1 : faces_[t];
        }
    }

    std::uint32_t joined(std::uint32_t vertex) const {
        return vertex < mesh_.joined.size() ? mesh_.joined[vertex] : vertex;
    }

    const std::string& path_;
    const MeshFile& mesh_;
    std::vector<std::uint8_t> faces_;
    std::vector<Edge> edges_;
    /// Edges of files, by their places in edges_, with the files.
    std::map<std::uint64_t, std::pair<std::string, NamedEdge>> named_;
};

} // namespace

void cut_walls(const std::string& path, const std::vector<WallRule>& walls, MeshFile& mesh) {
    FoundWalls found(path, mesh);
    for (const WallRule& wall : walls) {
        std::visit(found, wall);
    }
    const auto vertices = static_cast<std::uint32_t>(mesh.vertex_count());
    CutMesh cut = found.cut(vertices);
    if (mesh.file_triangles.empty()) {
        mesh.file_triangles = mesh.triangles;
    }
    mesh.triangles = std::move(cut.triangles);
    mesh.copied = std::move(cut.copied);
    for (std::size_t i = 0; i < mesh.copied.size(); ++i) {
        for (std::size_t axis = 0; axis < mesh.dimension && !mesh.positions.empty(); ++axis) {
            mesh.positions.push_back(
                mesh.positions[std::size_t{mesh.copied[i]} * mesh.dimension + axis]);
        }
        if (!mesh.joined.empty()) {
            mesh.joined.push_back(vertices + static_cast<std::uint32_t>(i));
        }
    }
}

} // namespace geodisk::tools
