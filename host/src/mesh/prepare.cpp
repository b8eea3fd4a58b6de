#include "geodisk/mesh.hpp"

#include <cmath>
#include <new>
#include <string>

#include "mesh/alias_table.hpp"
#include "mesh/connectivity.hpp"
#include "mesh/vertex_fans.hpp"

namespace geodisk {
namespace {

// Half-edge indices carry two flag bits in places, faces two in their cell word.
constexpr std::uint64_t kMaxFaces = (std::uint64_t{1} << 30) / 3;
// Beyond it squared lengths could leave the range of double.
constexpr double kLargestCoordinate = 1e100;
constexpr double kSmallestDiagonal = 1e-100;

Error rejected(std::string message, std::uint64_t element = kNoElement) {
    return Error{Status::mesh_rejected, std::move(message), element};
}

const double* vertex(const MeshView& mesh, std::uint32_t v) {
    return mesh.positions.data() + std::size_t{v} * mesh.dimension;
}

bool repeats_vertex(std::span<const std::uint32_t> face) {
    return face[0] == face[1] || face[1] == face[2] || face[2] == face[0];
}

Result<Done> check_shape(const MeshView& mesh) {
    if (mesh.dimension < 2 || mesh.dimension > 8) {
        return Error{Status::invalid_argument, "the dimension must be 2 to 8"};
    }
    if (mesh.positions.size() % mesh.dimension != 0 || mesh.triangles.size() % 3 != 0) {
        return Error{Status::invalid_argument,
                     "positions must hold whole vertices and triangles whole faces"};
    }
    if (mesh.triangles.empty()) {
        return rejected("the mesh has no faces");
    }
    if (mesh.triangles.size() / 3 > kMaxFaces ||
        mesh.positions.size() / mesh.dimension >= (std::uint64_t{1} << 31)) {
        return rejected("the mesh is too large: at most 357,913,941 faces can be indexed");
    }
    return Done{};
}

Result<Done> check_elements(const MeshView& mesh) {
    const std::uint64_t vertices = mesh.positions.size() / mesh.dimension;
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
        const std::uint32_t v = mesh.triangles[i];
        if (v >= vertices) {
            return rejected("face " + std::to_string(i / 3) + " names vertex " + std::to_string(v) +
                                ", but there are only " + std::to_string(vertices),
                            i / 3);
        }
        for (std::uint32_t axis = 0; axis < mesh.dimension; ++axis) {
            const double x = vertex(mesh, v)[axis];
            if (!std::isfinite(x)) {
                return rejected("vertex " + std::to_string(v) + " is not finite", v);
            }
            if (std::abs(x) > kLargestCoordinate) {
                return rejected("vertex " + std::to_string(v) + " is beyond 1e100; rescale the mesh",
                                v);
            }
        }
    }
    return Done{};
}

double distance(const MeshView& mesh, std::uint32_t a, std::uint32_t b) {
    double sum = 0;
    for (std::uint32_t axis = 0; axis < mesh.dimension; ++axis) {
        const double d = vertex(mesh, b)[axis] - vertex(mesh, a)[axis];
        sum += d * d;
    }
    return std::sqrt(sum);
}

/// The apex of a face in the frame of its edge from a to b. Rejection keeps the height of a needle,
/// where Heron's formula would lose it.
void place_apex(const MeshView& mesh, std::uint32_t a, std::uint32_t b, std::uint32_t c,
                HalfEdge& edge) {
    if (edge.length == 0) {
        edge.apex_x = 0;
        edge.apex_y = distance(mesh, a, c);
        return;
    }
    double dot = 0;
    for (std::uint32_t axis = 0; axis < mesh.dimension; ++axis) {
        dot += (vertex(mesh, c)[axis] - vertex(mesh, a)[axis]) *
               (vertex(mesh, b)[axis] - vertex(mesh, a)[axis]);
    }
    edge.apex_x = dot / edge.length;
    double height2 = 0;
    for (std::uint32_t axis = 0; axis < mesh.dimension; ++axis) {
        const double along =
            (vertex(mesh, b)[axis] - vertex(mesh, a)[axis]) * (dot / (edge.length * edge.length));
        const double d = vertex(mesh, c)[axis] - vertex(mesh, a)[axis] - along;
        height2 += d * d;
    }
    edge.apex_y = std::sqrt(height2);
}

/// Lengths, apexes and corner angles of one face.
void place_face(const MeshView& mesh, std::span<const std::uint32_t> face, HalfEdge* edges) {
    for (std::uint32_t k = 0; k < 3; ++k) {
        edges[k].origin = face[k];
        edges[k].length = distance(mesh, face[k], face[(k + 1) % 3]);
        place_apex(mesh, face[k], face[(k + 1) % 3], face[(k + 2) % 3], edges[k]);
    }
    for (std::uint32_t k = 0; k < 3; ++k) {
        // Not std::hypot: its last bit differs between C libraries.
        const double left =
            std::sqrt(edges[k].apex_x * edges[k].apex_x + edges[k].apex_y * edges[k].apex_y);
        edges[k].cosine = left > 0 ? edges[k].apex_x / left : 1;
        edges[k].sine = left > 0 ? edges[k].apex_y / left : 0;
    }
}

void measure_box(const MeshView& mesh, std::span<const VertexFan> fans,
                 MeshStatistics& statistics) {
    double sum = 0;
    for (std::uint32_t axis = 0; axis < mesh.dimension; ++axis) {
        double low = HUGE_VAL;
        double high = -HUGE_VAL;
        for (std::uint32_t v = 0; v < fans.size(); ++v) {
            if (fans[v].corner_count > 0) {
                low = std::fmin(low, vertex(mesh, v)[axis]);
                high = std::fmax(high, vertex(mesh, v)[axis]);
            }
        }
        sum += (high - low) * (high - low);
    }
    statistics.diagonal = std::sqrt(sum);
}

} // namespace

Result<PreparedMesh> PreparedMesh::prepare(const MeshView& mesh) noexcept try {
    if (auto shape = check_shape(mesh); !shape) {
        return shape.error();
    }
    if (auto elements = check_elements(mesh); !elements) {
        return elements.error();
    }
    PreparedMesh result;
    MeshStatistics& statistics = result.statistics_;
    const std::size_t faces = mesh.triangles.size() / 3;
    statistics.triangles = faces;
    result.half_edges_.resize(3 * faces);
    std::vector<double> areas(faces);
    for (std::size_t f = 0; f < faces; ++f) {
        const auto face = mesh.triangles.subspan(3 * f, 3);
        HalfEdge* edges = result.half_edges_.data() + 3 * f;
        if (repeats_vertex(face)) {
            // No length either: its sides must neither widen the tolerances nor take cells.
            for (std::uint32_t k = 0; k < 3; ++k) {
                edges[k].origin = face[k];
            }
            ++statistics.repeated_index_faces;
            continue;
        }
        place_face(mesh, face, edges);
        areas[f] = 0.5 * edges[0].length * edges[0].apex_y;
        statistics.area += areas[f];
        statistics.zero_area_faces += areas[f] == 0;
        for (std::uint32_t k = 0; k < 3; ++k) {
            statistics.longest_edge = std::fmax(statistics.longest_edge, edges[k].length);
        }
    }
    link_edges(result.half_edges_, statistics);
    result.fans_.resize(mesh.positions.size() / mesh.dimension);
    build_fans(result.half_edges_, result.fans_, result.corners_, statistics);
    measure_box(mesh, result.fans_, statistics);
    const double flat = 1e-13 * statistics.diagonal * statistics.diagonal;
    if (!(statistics.area > flat) || statistics.diagonal < kSmallestDiagonal) {
        return rejected("no face has area: all are degenerate");
    }
    result.alias_ = build_alias_table(areas, statistics.area);
    return result;
} catch (const std::bad_alloc&) {
    return Error{Status::out_of_host_memory, "not enough memory to prepare the mesh"};
} catch (...) {
    return Error{Status::internal, "unexpected failure while preparing the mesh"};
}

} // namespace geodisk
