// Components: the parts of a mesh that no path joins.
#pragma once

#include <cstdint>

#include <geodisk/detail/vertex_sets.hpp>
#include <geodisk/mesh.hpp>
#include <geodisk/sample.hpp>

namespace geodisk {

class Components {
  public:
    explicit Components(const PreparedMesh& mesh) : mesh_(mesh), sets_(mesh.vertex_count()) {
        const auto edges = mesh.half_edges();
        for (std::size_t h = 0; h < edges.size(); h += 3) {
            sets_.join(edges[h].origin, edges[h + 1].origin);
            sets_.join(edges[h].origin, edges[h + 2].origin);
        }
    }

    /// Returns the lowest vertex of the part with this vertex.
    std::uint32_t of_vertex(std::uint32_t vertex) { return sets_.lowest(vertex); }
    std::uint32_t of(const Sample& point) {
        return of_vertex(mesh_.half_edges()[std::size_t{3} * point.face].origin);
    }

  private:
    const PreparedMesh& mesh_;
    VertexSets sets_;
};

} // namespace geodisk
