#include <utility>

#include "geodisk/weld.hpp"
#include "mesh/checks.hpp"
#include "mesh/joined_vertices.hpp"
#include "mesh/seams.hpp"
#include "support/guard.hpp"
#include "support/try.hpp"

namespace geodisk {

Result<WeldedMesh> join_seams(const MeshView& mesh) noexcept {
    return guarded([&]() -> Result<WeldedMesh> {
        GEODISK_TRY(check_mesh(mesh));
        VertexSets sets(mesh.vertex_count());
        WeldedMesh result = with_joined(mesh, sets);
        std::uint64_t joined_edges = 0;
        // Repeat if triangles vanished: their neighbours may have new borders.
        for (std::uint64_t vanished = ~std::uint64_t{0}; vanished != result.degenerate_faces;) {
            vanished = result.degenerate_faces;
            const MeshView joined{mesh.positions, result.triangles, mesh.dimension};
            const auto edges = coinciding_edges(joined, border_edges(joined));
            if (edges.empty()) {
                break;
            }
            for (std::size_t i = 1; i < edges.size(); ++i) {
                if (edges[i].places == edges[i - 1].places) {
                    sets.join(edges[i].from, edges[i - 1].from);
                    sets.join(edges[i].to, edges[i - 1].to);
                }
            }
            joined_edges += edges.size();
            result = with_joined(mesh, sets);
        }
        result.joined_edges = joined_edges;
        return result;
    });
}

} // namespace geodisk
