// Neighbours: which points of a surface are near which, and how far it is along the surface.
// Experimental.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include <geodisk/export.hpp>
#include <geodisk/mesh.hpp>
#include <geodisk/runner.hpp>
#include <geodisk/sample.hpp>
#include <geodisk/status.hpp>

namespace geodisk {

/// Where to look for the neighbours of a source.
enum class NeighbourKind : std::uint32_t {
    vertices, ///< The vertices of the mesh, by their index.
    points,   ///< NeighbourQuery::points, by their index.
    sources,  ///< The other sources, by their index.
};

/// Which neighbours to find. Everything it refers to must outlive the call. Lengths are in mesh
/// units.
struct NeighbourQuery {
    /// Points of faces, at least one. Weights are rounded to multiples of 2^-24. For vertices see
    /// vertex_points().
    std::span<const Sample> sources{};
    /// Maximum distance of a neighbour along the surface. Positive and finite; 0 with `nearest`
    /// searches as far as needed.
    double within = 0;
    /// Distance of each source, in place of `within`; empty if `within` holds for all.
    std::span<const double> radii{};
    NeighbourKind kind = NeighbourKind::vertices;
    std::span<const Sample> points{}; ///< At least one if `kind` asks for them, up to 2^28.
    /// WeldedMesh::vertices if the caller joined vertices; empty for
    /// PreparedMesh::joined_vertices(). The lists have all vertices of a place, but with `nearest`
    /// only the lowest one.
    std::span<const std::uint32_t> joined{};
    /// Maximum number of neighbours per source, the nearest ones; 0 for all. Vertices that are
    /// joined count once. Ties go to the lower index.
    std::uint32_t nearest = 0;
    /// Maximum number of pairs in all. The call fails as soon as it expects more.
    std::uint64_t max_pairs = std::uint64_t{1} << 30;

    /// Returns false if the search goes as far as needed.
    bool has_distances() const { return within != 0 || nearest == 0 || !radii.empty(); }
};

/// The neighbours of each source, one source after the other (CSR). Eight bytes per pair.
struct Neighbours {
    /// Where the neighbours of each source begin, and one past the last.
    std::vector<std::uint64_t> offsets;
    /// Index of each neighbour: ascending for each source, or with NeighbourQuery::nearest by
    /// distance.
    std::vector<std::uint32_t> indices;
    /// Geodesic distance of each neighbour, in mesh units. A vertex or point at the source itself
    /// has 0; a source is not its own neighbour.
    std::vector<float> distances;
    /// Bound on the error of the distances, in mesh units. Neighbours within this error of the
    /// limit may be missing or extra.
    double error = 0;
    RunReport report;
};

/// Finds the neighbours of all sources: the exact geodesic disk of each. The result is the same on
/// every device and for any memory size. RunnerOptions limit the memory it takes at a time. A mesh
/// that the device cannot hold is searched in parts, if these are large beside the distances.
/// Progress counts sources as candidates; returns `cancelled` if it asks to stop.
///
/// Errors: `invalid_argument` for no source; for a source or point, naming it, in a face that does
/// not exist or repeats a vertex or with weights that are negative or do not sum to 1; for a
/// distance that is not positive and finite; for another number of radii; for an edge longer than
/// 4,000 times the largest distance. `job_too_large` for more than `max_pairs`, naming how many to
/// expect. Others as Runner::sample_and_wait().
GEODISK_API Result<Neighbours> find_neighbours(Runner& runner, const PreparedMesh& mesh,
                                               const NeighbourQuery& query,
                                               const ProgressCallback& progress = {}) noexcept;

// Without waiting, as Runner::start() and Runner::poll() sample. Runner::fence(), progress() and
// cancel() serve both. A runner has one run in progress at a time, whatever its kind.

/// Begins a search. Runner, mesh and all that the query refers to must outlive it; the query itself
/// is copied. Errors: `invalid_argument` if a run is in progress; those of an invalid query; all
/// others come from poll_neighbours().
GEODISK_API Result<Done> start_neighbours(Runner& runner, const PreparedMesh& mesh,
                                          const NeighbourQuery& query,
                                          const ProgressCallback& progress = {}) noexcept;

/// Waits for the latest submission of a search, at most for `patience`. Once it has ended, takes
/// what it found and submits the next one. Returns the neighbours when the search is complete, else
/// nothing. Errors: `invalid_argument` if no search is in progress; otherwise as find_neighbours(),
/// and the search has then ended.
GEODISK_API Result<std::optional<Neighbours>>
poll_neighbours(Runner& runner, std::chrono::milliseconds patience = {}) noexcept;

/// Vertices as points of a surface.
struct VertexPoints {
    std::vector<Sample> points;
    std::vector<std::uint32_t> vertices; ///< Index of the vertex at each point.
};

/// Returns each vertex as a point of one of its faces, in the order of their indices. Leaves out
/// vertices without a face of three different vertices. `joined` is WeldedMesh::vertices: vertices
/// that are joined have the same point. Empty for PreparedMesh::joined_vertices().
GEODISK_API Result<VertexPoints> vertex_points(const PreparedMesh& mesh,
                                               std::span<const std::uint32_t> joined = {}) noexcept;

} // namespace geodisk
