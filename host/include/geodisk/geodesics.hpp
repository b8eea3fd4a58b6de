// Geodesic distances from sources to all vertices of a mesh, and shortest paths: on the CPU, in
// double precision, without a device.
// Experimental.
#pragma once

#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include <geodisk/export.hpp>
#include <geodisk/mesh.hpp>
#include <geodisk/runner.hpp>
#include <geodisk/sample.hpp>
#include <geodisk/status.hpp>
#include <geodisk/threads.hpp>

namespace geodisk {

/// From where to measure. Everything it refers to must outlive the call. Lengths are in mesh units.
struct DistanceQuery {
    /// Points of faces, at least one. For vertices see vertex_points().
    std::span<const Sample> sources{};
    /// Points to measure to; empty for all vertices.
    std::span<const Sample> targets{};
    /// Measures from each source on its own, instead of from the nearest one.
    bool each = false;
    /// Largest distance to measure; farther targets get infinity. Positive, or infinity for all.
    double within = std::numeric_limits<double>::infinity();
    /// WeldedMesh::vertices if the caller joined vertices; empty for
    /// PreparedMesh::joined_vertices(). Vertices that are joined have the same distance.
    std::span<const std::uint32_t> joined{};
};

/// Distances of the targets, which are vertices or points, along the surface.
struct GeodesicDistances {
    static constexpr std::uint32_t kNone = ~std::uint32_t{0};

    /// Distance of each target to the nearest source; with DistanceQuery::each, those of all
    /// targets to the first source, then to the second, and so on. Infinity where no path leads,
    /// and for vertices without a face.
    std::vector<double> distances;
    /// Index of the nearest source of each target, or kNone; of several equally near ones, any.
    /// Empty with DistanceQuery::each.
    std::vector<std::uint32_t> nearest;
};

/// Computes the exact distances along the surface, which only the rounding of double precision
/// limits: about 1e-12 of the longest. (A Sample places a point in a face by single precision.)
/// Windows of straight paths cross the faces nearest first, and windows of one edge are trimmed
/// against each other (Mitchell, Mount and Papadimitriou 1987; Xin and Wang 2009). Takes time by
/// the number of windows: 10 to 25 per face on scans, and with the square root of the faces on
/// smooth convex surfaces. Each source is computed by one thread. The result does not depend on
/// them.
///
/// Progress counts vertices as candidates, and with DistanceQuery::each sources. It may be called
/// by any of the threads, by one at a time; returns `cancelled` if it asks to stop.
///
/// Errors: `invalid_argument` for no source; for a source or target, naming it, in a face that does
/// not exist or repeats a vertex or with weights that are negative or do not sum to 1; for a limit
/// that is not positive; `mesh_rejected` for a mesh with so many edges of more than two faces that
/// windows become too many; `out_of_host_memory`.
GEODISK_API Result<GeodesicDistances>
geodesic_distances(const PreparedMesh& mesh, const DistanceQuery& query,
                   const ThreadOptions& threads = {},
                   const ProgressCallback& progress = {}) noexcept;

/// Finds the radius of the geodesic disk around each source that holds an area, in square mesh
/// units; if the part of the mesh is smaller, a radius that covers it. Exact distances are taken
/// at vertices, and between them in faces where the disk has few, and are linear in between: areas
/// err by about 1 in 1,000. Takes the time of two searches as far as the disk and the longest edge
/// reach, or more if the surface is folded. Each source is computed by one thread.
///
/// Progress counts sources as candidates. It may be called by any of the threads, by one at a time;
/// returns `cancelled` if it asks to stop.
///
/// Errors: `invalid_argument` for an area that is not positive and finite; for a source, naming it,
/// as geodesic_distances(); `mesh_rejected` as there; `out_of_host_memory`.
GEODISK_API Result<std::vector<double>> disk_radii(const PreparedMesh& mesh,
                                                   std::span<const Sample> sources, double area,
                                                   const ThreadOptions& threads = {},
                                                   const ProgressCallback& progress = {}) noexcept;

/// A point of a path.
struct PathPoint {
    std::uint32_t face;
    double weights[3]; ///< Weights of the face's corners; they sum to 1.
};

/// A shortest path along the surface.
struct GeodesicPath {
    double length = 0; ///< In mesh units.
    /// Its two ends, and between them where it crosses an edge or bends at a vertex. It runs
    /// straight from each to the next, within one face.
    std::vector<PathPoint> points;
};

/// Finds a shortest path between two points; of several, any. Exact as geodesic_distances(), whose
/// windows it follows back. Takes 8 bytes per window until the nearer end is reached.
///
/// Errors: as there; `invalid_argument` also if no path leads from one end to the other.
GEODISK_API Result<GeodesicPath> geodesic_path(const PreparedMesh& mesh, const Sample& from,
                                               const Sample& to) noexcept;

} // namespace geodisk
