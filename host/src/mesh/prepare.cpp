#include "geodisk/mesh.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <new>
#include <string>
#include <vector>

#include "mesh/alias_table.hpp"
#include "mesh/connectivity.hpp"
#include "mesh/face_frames.hpp"
#include "mesh/vertex_fans.hpp"
#include "support/prefetch.hpp"

namespace geodisk {
namespace {

// Half-edge indices carry two flag bits in places, faces two in their cell word.
constexpr std::uint64_t kMaxFaces = (std::uint64_t{1} << 30) / 3;
// Beyond it squared lengths could leave the range of double.
constexpr double kLargestCoordinate = 1e100;
constexpr double kSmallestDiagonal = 1e-100;
constexpr std::uint32_t kMostDimensions = 8;

Error rejected(std::string message, std::uint64_t element = kNoElement) {
    return Error{Status::mesh_rejected, std::move(message), element};
}

const double* vertex(const MeshView& mesh, std::uint32_t v) {
    return mesh.positions.data() + std::size_t{v} * mesh.dimension;
}

Result<Done> check_shape(const MeshView& mesh) {
    if (mesh.dimension < 2 || mesh.dimension > kMostDimensions) {
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

/// Whether every index and every coordinate will do, those of unused vertices included.
bool all_elements_fit(const MeshView& mesh) {
    bool fit = true;
    for (const double x : mesh.positions) {
        fit &= std::abs(x) <= kLargestCoordinate; // False also for what is not a number.
    }
    std::uint32_t largest = 0;
    for (const std::uint32_t v : mesh.triangles) {
        largest = std::max(largest, v);
    }
    return fit && largest < mesh.positions.size() / mesh.dimension;
}

Result<Done> check_vertex(const MeshView& mesh, std::uint32_t v) {
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
    return Done{};
}

Result<Done> check_elements(const MeshView& mesh) {
    if (all_elements_fit(mesh)) {
        return Done{}; // In memory order: several times as fast as face by face.
    }
    const std::uint64_t vertices = mesh.positions.size() / mesh.dimension;
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
        const std::uint32_t v = mesh.triangles[i];
        if (v >= vertices) {
            return rejected("face " + std::to_string(i / 3) + " names vertex " + std::to_string(v) +
                                ", but there are only " + std::to_string(vertices),
                            i / 3);
        }
        if (auto checked = check_vertex(mesh, v); !checked) {
            return checked;
        }
    }
    return Done{};
}

/// Fills what a face alone does not determine: `around` and `fan_angles` of the half-edges, the
/// fans and the lists of corners.
void connect(const MeshView& mesh, std::vector<Link>& links, std::span<HalfEdge> half_edges,
             std::vector<VertexFan>& fans, std::vector<std::uint32_t>& corners,
             MeshStatistics& statistics) {
    list_corners(mesh.triangles, fans, corners);
    EdgeLinker linker(links, static_cast<std::uint32_t>(fans.size()));
    FanBuilder builder(links);
    constexpr std::size_t kAhead = 32; // Corners, of some six vertices.
    for (std::uint32_t v = 0; v < fans.size(); ++v) {
        VertexFan& fan = fans[v];
        if (fan.corner_count > 0) {
            ++statistics.vertices;
            const std::span own(corners.data() + fan.first_corner, fan.corner_count);
            const std::size_t ahead = fan.first_corner + kAhead;
            for (std::size_t i = ahead; i < std::min(ahead + own.size(), corners.size()); ++i) {
                const std::uint32_t first = corners[i] - corners[i] % 3;
                prefetch(&links[first]);
                prefetch(&links[first + 2]); // A face's links may lie in two cache lines.
            }
            linker.link_at(v, own);
            builder.build(v, own, fan); // While the links are in the cache.
        }
    }
    linker.count(statistics);
    for (std::size_t h = 0; h < half_edges.size(); ++h) {
        half_edges[h].around = links[h].around;
        half_edges[h].fan_angles = links[h].angle;
    }
}

void measure_box(const MeshView& mesh, std::span<const VertexFan> fans,
                 MeshStatistics& statistics) {
    std::array<double, kMostDimensions> low;
    std::array<double, kMostDimensions> high;
    low.fill(HUGE_VAL);
    high.fill(-HUGE_VAL);
    for (std::uint32_t v = 0; v < fans.size(); ++v) {
        if (fans[v].corner_count > 0) {
            for (std::uint32_t axis = 0; axis < mesh.dimension; ++axis) {
                low[axis] = std::min(low[axis], vertex(mesh, v)[axis]);
                high[axis] = std::max(high[axis], vertex(mesh, v)[axis]);
            }
        }
    }
    double sum = 0;
    for (std::uint32_t axis = 0; axis < mesh.dimension; ++axis) {
        sum += (high[axis] - low[axis]) * (high[axis] - low[axis]);
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
    statistics.triangles = mesh.triangles.size() / 3;
    std::vector<Link> links;
    const std::vector<double> areas = place_faces(mesh, result.half_edges_, links, statistics);
    result.fans_.resize(mesh.positions.size() / mesh.dimension);
    connect(mesh, links, result.half_edges_, result.fans_, result.corners_, statistics);
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
