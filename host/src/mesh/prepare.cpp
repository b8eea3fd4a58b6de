#include "geodisk/mesh.hpp"
#include "geodisk/weld.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <utility>
#include <vector>

#include "mesh/checks.hpp"
#include "mesh/connect.hpp"
#include "mesh/face_frames.hpp"
#include "mesh/seams.hpp"
#include "support/blocks.hpp"
#include "support/guard.hpp"
#include "support/try.hpp"

namespace geodisk {
namespace {

/// Returns the length that areas are compared with: for coordinates, the diagonal of the bounding
/// box.
Result<double> measure_extent(const MeshView& mesh, std::span<const HalfEdge>,
                              std::span<const VertexFan> fans, MeshStatistics& statistics) {
    std::array<double, kMaxDimensions> low;
    std::array<double, kMaxDimensions> high;
    low.fill(HUGE_VAL);
    high.fill(-HUGE_VAL);
    for (std::uint32_t v = 0; v < fans.size(); ++v) {
        if (fans[v].corner_count > 0) {
            for (std::uint32_t axis = 0; axis < mesh.dimension; ++axis) {
                const double x = mesh.coordinate(v, axis);
                low[axis] = std::min(low[axis], x);
                high[axis] = std::max(high[axis], x);
            }
        }
    }
    double sum = 0;
    for (std::uint32_t axis = 0; axis < mesh.dimension; ++axis) {
        sum += (high[axis] - low[axis]) * (high[axis] - low[axis]);
    }
    statistics.diagonal = std::sqrt(sum);
    return statistics.diagonal;
}

/// For edge lengths, which may contradict each other, the longest edge.
Result<double> measure_extent(const LengthMeshView&, std::span<const HalfEdge> half_edges,
                              std::span<const VertexFan>, MeshStatistics& statistics) {
    GEODISK_TRY(check_agreement(half_edges));
    return statistics.longest_edge;
}

std::uint64_t seams_of(const MeshView& mesh, std::span<const HalfEdge> half_edges,
                       std::span<const std::uint32_t> borders) {
    std::vector<EdgeEnds> ends;
    ends.reserve(borders.size());
    for (const std::uint32_t h : borders) {
        ends.push_back({half_edges[h].origin, half_edges[next_in_face(h)].origin});
    }
    return coinciding_edges(mesh, ends).size();
}

std::uint64_t seams_of(const LengthMeshView&, std::span<const HalfEdge>,
                       std::span<const std::uint32_t>) {
    return 0; // There are no positions.
}

/// Returns true if two faces have the same corners.
bool has_copies(const ThreadOptions& threads, std::span<const HalfEdge> half_edges) {
    std::atomic<bool> found = false;
    for_blocks(threads, half_edges.size() / 3, [&](std::size_t begin, std::size_t end) {
        for (auto h = static_cast<std::uint32_t>(3 * begin); h < 3 * end; h += 3) {
            const std::uint32_t apex = half_edges[h + 2].origin;
            for (std::uint32_t g = around_half_edge(half_edges[h].around); g != h;
                 g = around_half_edge(half_edges[g].around)) {
                if (half_edges[previous_in_face(g)].origin == apex) {
                    found = true;
                    return;
                }
            }
        }
    });
    return found;
}

/// Returns true if join_seams() joins edges of a mesh with these half-edges.
bool has_seams(const ThreadOptions& threads, const MeshView& mesh,
               std::span<const HalfEdge> half_edges, const MeshStatistics& statistics) {
    // A border edge of a face and its copies is no boundary edge.
    return statistics.coinciding_border_edges > 0 ||
           (has_copies(threads, half_edges) &&
            !coinciding_edges(mesh, border_edges(mesh, half_edges)).empty());
}

std::size_t vertices_of(const MeshView& mesh) {
    return mesh.vertex_count();
}

std::size_t vertices_of(const LengthMeshView& mesh) {
    return mesh.vertex_count;
}

} // namespace

std::uint64_t PreparedMesh::next_identity() noexcept {
    static std::atomic<std::uint64_t> next{0};
    return ++next;
}

template <class View>
Result<PreparedMesh> PreparedMesh::prepare_any(const View& mesh, const ThreadOptions& threads) {
    GEODISK_TRY(check_threads(threads));
    GEODISK_TRY(check_mesh(mesh));
    PreparedMesh result;
    MeshStatistics& statistics = result.statistics_;
    UninitializedVector<Link> links;
    place_faces(threads, mesh, result.half_edges_, links, statistics);
    result.fans_.resize(vertices_of(mesh));
    const auto borders = connect(threads, mesh.triangles, links, result.half_edges_, result.fans_,
                                 result.corners_, statistics);
    statistics.coinciding_border_edges = seams_of(mesh, result.half_edges_, borders);
    const auto extent = measure_extent(mesh, result.half_edges_, result.fans_, statistics);
    GEODISK_TRY(extent);
    GEODISK_TRY(check_area(statistics.area, *extent));
    return result;
}

Result<PreparedMesh> PreparedMesh::prepare(const MeshView& mesh,
                                           const ThreadOptions& threads) noexcept {
    return guarded([&]() -> Result<PreparedMesh> {
        auto result = prepare_any(mesh, threads);
        if (!result || mesh.keep_seams ||
            !has_seams(threads, mesh, result->half_edges_, result->statistics_)) {
            return result;
        }
        auto welded = join_seams(mesh);
        GEODISK_TRY(welded);
        result = prepare_any(MeshView{mesh.positions, welded->triangles, mesh.dimension}, threads);
        if (result) {
            result->joined_vertices_ = std::move(welded->vertices);
            result->joined_edges_ = welded->joined_edges;
        }
        return result;
    });
}

Result<PreparedMesh> PreparedMesh::prepare(const LengthMeshView& mesh,
                                           const ThreadOptions& threads) noexcept {
    return guarded([&] { return prepare_any(mesh, threads); });
}

} // namespace geodisk
