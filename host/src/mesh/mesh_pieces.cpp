#include "mesh/mesh_pieces.hpp"

#include "mesh/connect.hpp"
#include "mesh/face_frames.hpp"

namespace geodisk {
namespace {

/// Defines `member(Tag, mesh)` for a member of PreparedMesh, with the access of a friend that its
/// header need not name.
template <class Tag, class Type, Type PreparedMesh::*Member>
struct Access {
    friend Type& member(Tag, PreparedMesh& mesh) { return mesh.*Member; }
};

struct Edges {
    friend UninitializedVector<HalfEdge>& member(Edges, PreparedMesh&);
};
struct Fans {
    friend std::vector<VertexFan>& member(Fans, PreparedMesh&);
};
struct Corners {
    friend std::vector<std::uint32_t>& member(Corners, PreparedMesh&);
};
struct Statistics {
    friend MeshStatistics& member(Statistics, PreparedMesh&);
};
template struct Access<Edges, UninitializedVector<HalfEdge>, &PreparedMesh::half_edges_>;
template struct Access<Fans, std::vector<VertexFan>, &PreparedMesh::fans_>;
template struct Access<Corners, std::vector<std::uint32_t>, &PreparedMesh::corners_>;
template struct Access<Statistics, MeshStatistics, &PreparedMesh::statistics_>;

} // namespace

PreparedMesh MeshPieces::outline(const MeshStatistics& whole) {
    PreparedMesh mesh;
    member(Statistics(), mesh) = whole;
    return mesh;
}

PreparedMesh MeshPieces::piece(const MeshView& faces, const MeshStatistics& whole) {
    PreparedMesh mesh;
    auto& half_edges = member(Edges(), mesh);
    auto& fans = member(Fans(), mesh);
    MeshStatistics& statistics = member(Statistics(), mesh);
    UninitializedVector<Link> links;
    const ThreadOptions threads;
    place_faces(threads, faces, half_edges, links, statistics);
    fans.resize(faces.vertex_count());
    connect(threads, faces.triangles, links, half_edges, fans, member(Corners(), mesh), statistics);
    statistics.diagonal = whole.diagonal;
    return mesh;
}

} // namespace geodisk
