#include "geodisk/inputs/wall_input.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <utility>

#include <geodisk/features.hpp>
#include <geodisk/mesh.hpp>
#include <geodisk/walls.hpp>

#include "files/meshes/sidecar_files.hpp"
#include "geodisk/inputs/mask_input.hpp"
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

    void operator()(const MaskRule& rule) {
        const std::size_t before = wall_count();
        take_faces(faces_of(rule, mesh_));
        if (wall_count() == before) {
            fail_input(path_, "has no face that --walls " + rule.name + " takes");
        }
    }

    void operator()(const CreaseWalls& creases) {
        if (mesh_.positions.empty()) {
            fail_usage("--walls creases needs the coordinates of the mesh, and it has edge lengths "
                       "alone");
        }
        const MeshView view{mesh_.positions, mesh_.triangles, mesh_.dimension, true};
        const PreparedMesh prepared = take(PreparedMesh::prepare(view), path_);
        const Features features = take(Features::find(view, prepared, creases.degrees));
        for (const std::uint32_t edge : features.edges()) {
            const std::uint32_t other = around_half_edge(prepared.half_edges()[edge].around);
            if (other != edge) { // Else it is a border.
                edges_.push_back({mesh_.triangles[edge], mesh_.triangles[next_in_face(edge)]});
            }
        }
        if (edges_.empty()) {
            fail_input(path_, "has no creases for --walls");
        }
    }

    void operator()(const EdgeWalls& walls) {
        const auto name = [&](std::uint32_t vertex) { return mesh_.names.vertex_number(vertex); };
        for (const NamedEdge& edge : read_edges(walls.file, mesh_.names.first_vertex)) {
            const auto& [a, b] = edge.vertices;
            const Edge ends{joined(a), joined(b)};
            if (!is_edge(ends)) {
                fail_input(walls.file, "line " + std::to_string(edge.line) +
                                           ": no face has an edge " + name(a) + "-" + name(b));
            }
            edges_.push_back(ends);
        }
    }

    Walls walls() const { return {faces_, edges_}; }
    std::size_t wall_count() const {
        return static_cast<std::size_t>(std::ranges::count(faces_, 1));
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

    bool is_edge(const Edge& ends) {
        if (known_.empty()) {
            for (std::size_t t = 0; t < mesh_.triangle_count(); ++t) {
                const std::uint32_t* const corners = &mesh_.triangles[3 * t];
                for (std::size_t k = 0; mesh_.takes_part(t) && k < 3; ++k) {
                    known_.push_back(ordered(corners[k], corners[(k + 1) % 3]));
                }
            }
            std::ranges::sort(known_);
        }
        return std::ranges::binary_search(known_, ordered(ends[0], ends[1]));
    }

    static Edge ordered(std::uint32_t a, std::uint32_t b) {
        return {std::min(a, b), std::max(a, b)};
    }

    const std::string& path_;
    const MeshFile& mesh_;
    std::vector<std::uint8_t> faces_;
    std::vector<Edge> edges_;
    std::vector<Edge> known_; ///< Edges of the mesh, sorted.
};

/// Returns the number of vertices of a mesh, also of one without coordinates.
std::uint32_t vertices_in(const MeshFile& mesh) {
    return static_cast<std::uint32_t>(
        mesh.positions.empty() ? std::size_t{1} + *std::ranges::max_element(mesh.triangles)
                               : mesh.positions.size() / mesh.dimension);
}

} // namespace

void cut_walls(const std::string& path, const std::vector<WallRule>& walls, MeshFile& mesh) {
    FoundWalls found(path, mesh);
    for (const WallRule& wall : walls) {
        std::visit(found, wall);
    }
    const std::uint32_t vertices = vertices_in(mesh);
    CutMesh cut = take(geodisk::cut(mesh.triangles, vertices, found.walls()), path);
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
    bool has_face = false;
    for (std::size_t t = 0; t < mesh.triangle_count() && !has_face; ++t) {
        has_face = mesh.takes_part(t);
    }
    if (!has_face) {
        fail_input(path, "has no face that is not a wall, by --walls");
    }
}

} // namespace geodisk::tools
