#include "mesh/mesh_pieces.hpp"

#include "mesh/connect.hpp"
#include "mesh/face_frames.hpp"

namespace geodisk {

PreparedMesh MeshPieces::outline(const MeshStatistics& whole) {
    PreparedMesh mesh;
    mesh.statistics_ = whole;
    return mesh;
}

PreparedMesh MeshPieces::piece(const MeshView& faces, const MeshStatistics& whole) {
    PreparedMesh mesh;
    UninitializedVector<Link> links;
    const ThreadOptions threads;
    place_faces(threads, faces, mesh.half_edges_, links, mesh.statistics_);
    mesh.fans_.resize(faces.vertex_count());
    connect(threads, faces.triangles, links, mesh.half_edges_, mesh.fans_, mesh.corners_,
            mesh.statistics_);
    mesh.statistics_.diagonal = whole.diagonal;
    return mesh;
}

} // namespace geodisk
