#include <algorithm>
#include <iterator>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include <geodisk/geodesics.hpp>
#include <geodisk/outside_faces.hpp>

#include "c/c_call.hpp"
#include "c/c_mesh.hpp"
#include "c/c_neighbours.hpp"
#include "c/c_sampler.hpp"
#include "support/try.hpp"

/// Immutable.
struct geodisk_path {
    double length;
    std::vector<geodisk_path_point> points;
};

namespace geodisk::c {
namespace {

/// Returns one end of a path: the point, or the vertex where it is NULL.
Result<Sample> end_of(const Mesh& mesh, const geodisk_surface_point* point, std::uint32_t vertex) {
    const auto places =
        sources_of(mesh, point, point != nullptr ? nullptr : &vertex, 1, mesh.joined);
    if (!places) {
        return point == nullptr
                   ? wrong("vertex " + std::to_string(vertex) + ", an end, is used by no face")
                   : places.error();
    }
    return places->points.front();
}

ThreadOptions threads_of(const geodisk_distance_params& params) {
    ThreadOptions threads;
    threads.max_threads = params.max_threads != 0 ? params.max_threads : threads.max_threads;
    return threads;
}

/// Returns the sources, which must be given.
Result<NeighbourSources> distance_sources(const Mesh& mesh, const geodisk_distance_params& params) {
    if (params.sources == nullptr && params.source_vertices == nullptr) {
        return wrong("params->sources and params->source_vertices are NULL");
    }
    return sources_of(mesh, params.sources, params.source_vertices, params.source_count,
                      joined_of(mesh, params.joined));
}

Result<Done> find_distances(const Mesh& mesh, const geodisk_distance_params& params,
                            const ProgressCallback& progress, double* distances,
                            std::uint32_t* nearest) {
    if (params.targets == nullptr && params.target_count != 0) {
        return wrong("params->targets is NULL");
    }
    if (params.targets != nullptr && params.target_count == 0) {
        return Done{};
    }
    const auto sources = distance_sources(mesh, params);
    GEODISK_TRY(sources);
    const std::vector<Sample> targets = samples_of(params.targets, params.target_count);
    DistanceQuery query;
    query.sources = sources->points;
    query.targets = targets;
    query.each = params.each != 0;
    query.within = params.within != 0 ? params.within : query.within;
    query.joined = joined_of(mesh, params.joined);
    const auto found = geodesic_distances(mesh.prepared, query, threads_of(params), progress);
    GEODISK_TRY(found);
    std::ranges::copy(found->distances, distances);
    if (nearest != nullptr) {
        std::ranges::copy(found->nearest, nearest);
    }
    return Done{};
}

} // namespace
} // namespace geodisk::c

using namespace geodisk;
using namespace geodisk::c;

extern "C" {

geodisk_status geodisk_geodesic_distances(const geodisk_mesh* mesh,
                                          const geodisk_distance_params* params,
                                          geodisk_progress_fn progress, void* user,
                                          double* distances, uint32_t* nearest,
                                          geodisk_error* error) {
    return answer(error, [&]() -> Result<Done> {
        if (mesh == nullptr || distances == nullptr) {
            return wrong("mesh or distances is NULL");
        }
        const auto wanted = taken(params, "params");
        GEODISK_TRY(wanted);
        return find_distances(*mesh->shared, *wanted, heard_by(progress, user), distances, nearest);
    });
}

geodisk_status geodisk_geodesic_path(const geodisk_mesh* mesh, const geodisk_path_params* params,
                                     geodisk_path** path, geodisk_error* error) {
    return answer(error, [&]() -> Result<Done> {
        if (mesh == nullptr || path == nullptr) {
            return wrong("mesh or path is NULL");
        }
        const auto wanted = taken(params, "params");
        GEODISK_TRY(wanted);
        const auto from = end_of(*mesh->shared, wanted->from, wanted->from_vertex);
        GEODISK_TRY(from);
        const auto to = end_of(*mesh->shared, wanted->to, wanted->to_vertex);
        GEODISK_TRY(to);
        const auto found = geodesic_path(mesh->shared->prepared, *from, *to);
        GEODISK_TRY(found);
        auto made = std::make_unique<geodisk_path>(geodisk_path{found->length, {}});
        std::ranges::transform(
            found->points, std::back_inserter(made->points), [](const PathPoint& p) {
                return geodisk_path_point{p.face, {p.weights[0], p.weights[1], p.weights[2]}};
            });
        *path = made.release();
        return Done{};
    });
}

geodisk_status geodisk_disk_radii(const geodisk_mesh* mesh, const geodisk_distance_params* params,
                                  double area, geodisk_progress_fn progress, void* user,
                                  double* radii, geodisk_error* error) {
    return answer(error, [&]() -> Result<Done> {
        if (mesh == nullptr || radii == nullptr) {
            return wrong("mesh or radii is NULL");
        }
        const auto given = taken(params, "params");
        GEODISK_TRY(given);
        const auto sources = distance_sources(*mesh->shared, *given);
        GEODISK_TRY(sources);
        const auto found = disk_radii(mesh->shared->prepared, sources->points, area,
                                      threads_of(*given), heard_by(progress, user));
        GEODISK_TRY(found);
        std::ranges::copy(*found, radii);
        return Done{};
    });
}

geodisk_status geodisk_outside_faces(const geodisk_mesh* mesh, double share,
                                     geodisk_progress_fn progress, void* user, uint8_t* mask,
                                     geodisk_error* error) {
    return answer(error, [&]() -> Result<Done> {
        if (mesh == nullptr || mask == nullptr) {
            return wrong("mesh or mask is NULL");
        }
        if (mesh->shared->dimension == 0) {
            return wrong("the mesh has no coordinates, so no face is seen");
        }
        const auto seen = outside_faces(mesh->shared->view(), share, {}, heard_by(progress, user));
        GEODISK_TRY(seen);
        std::ranges::copy(*seen, mask);
        return Done{};
    });
}

double geodisk_path_length(const geodisk_path* path) {
    return path != nullptr ? path->length : 0;
}

const geodisk_path_point* geodisk_path_points(const geodisk_path* path, size_t* count) {
    if (count != nullptr) {
        *count = path != nullptr ? path->points.size() : 0;
    }
    return path != nullptr ? path->points.data() : nullptr;
}

void geodisk_path_release(geodisk_path* path) {
    delete path;
}

} // extern "C"
