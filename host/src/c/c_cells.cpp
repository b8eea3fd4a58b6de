#include <span>
#include <utility>
#include <vector>

#include <geodisk/cells.hpp>

#include "c/c_call.hpp"
#include "c/c_cells.hpp"
#include "c/c_mesh.hpp"
#include "c/c_sampler.hpp"
#include "support/try.hpp"

/// Immutable.
struct geodisk_cells {
    geodisk::SurfaceCells found;
};

namespace geodisk::c {
namespace {

Result<CellParams> params_of(const geodisk_mesh& mesh, const geodisk_cell_params& params) {
    if (params.samples == nullptr && params.sample_count != 0) {
        return wrong("params->samples is NULL");
    }
    CellParams cells;
    cells.has_dual = params.areas_only == 0;
    cells.max_records = params.max_records == 0 ? cells.max_records : params.max_records;
    if (params.face_mask != nullptr) {
        cells.face_mask = {params.face_mask, mesh.shared->prepared.face_count()};
    }
    return cells;
}

} // namespace
} // namespace geodisk::c

using namespace geodisk;
using namespace geodisk::c;

extern "C" {

geodisk_status geodisk_find_cells(geodisk_sampler* sampler, const geodisk_mesh* mesh,
                                  const geodisk_cell_params* params, geodisk_progress_fn progress,
                                  void* user, geodisk_cells** cells, geodisk_error* error) {
    return with_sampler(sampler, error, [&](SamplerState& state) -> Result<Done> {
        if (mesh == nullptr || cells == nullptr) {
            return wrong("mesh or cells is NULL");
        }
        const auto wanted = taken(params, "params");
        GEODISK_TRY(wanted);
        const auto cell_params = params_of(*mesh, *wanted);
        GEODISK_TRY(cell_params);
        auto found = search(state, progress, user, [&](const ProgressCallback& heard) {
            return find_cells(state.runner, mesh->shared->prepared,
                              samples_of(wanted->samples, wanted->sample_count), *cell_params,
                              heard);
        });
        GEODISK_TRY(found);
        *cells = new geodisk_cells{std::move(*found)};
        return Done{};
    });
}

geodisk_status geodisk_cells_describe(const geodisk_cells* cells, geodisk_cell_arrays* arrays,
                                      geodisk_error* error) {
    return answer(error, [&]() -> Result<Done> {
        if (cells == nullptr) {
            return wrong("cells is NULL");
        }
        const SurfaceCells& found = cells->found;
        geodisk_cell_arrays value{};
        value.sample_count = found.areas.size();
        value.edge_count = found.edges.size();
        value.triangle_count = found.triangles.size();
        value.areas = found.areas.data();
        value.edges = found.edges.empty() ? nullptr : found.edges.front().data();
        value.triangles = found.triangles.empty() ? nullptr : found.triangles.front().data();
        value.area_error = found.area_error;
        value.distance_error = found.distance_error;
        value.unreached = found.unreached;
        value.manifold_triangles = found.dual.manifold;
        value.euler = found.dual.euler;
        value.mesh_euler = found.dual.mesh_euler;
        return give(arrays, "arrays", value);
    });
}

void geodisk_cells_release(geodisk_cells* cells) {
    delete cells;
}

geodisk_status geodisk_nearest_create(geodisk_sampler* sampler, const geodisk_mesh* mesh,
                                      const geodisk_cell_params* params,
                                      geodisk_progress_fn progress, void* user,
                                      geodisk_nearest** nearest, geodisk_error* error) {
    return with_sampler(sampler, error, [&](SamplerState& state) -> Result<Done> {
        if (mesh == nullptr || nearest == nullptr) {
            return wrong("mesh or nearest is NULL");
        }
        const auto wanted = taken(params, "params");
        GEODISK_TRY(wanted);
        if (wanted->face_mask != nullptr) {
            return wrong("params->face_mask is for geodisk_find_cells");
        }
        const auto cell_params = params_of(*mesh, *wanted);
        GEODISK_TRY(cell_params);
        auto disks = search(state, progress, user, [&](const ProgressCallback& heard) {
            return NearestSamples::create(state.runner, mesh->shared->prepared,
                                          samples_of(wanted->samples, wanted->sample_count),
                                          cell_params->max_records, heard);
        });
        GEODISK_TRY(disks);
        *nearest = new geodisk_nearest{mesh->shared, std::move(*disks)};
        return Done{};
    });
}

geodisk_status geodisk_nearest_find(const geodisk_nearest* nearest,
                                    const geodisk_surface_point* points, size_t point_count,
                                    uint32_t* samples, float* distances, geodisk_error* error) {
    return answer(error, [&]() -> Result<Done> {
        if (nearest == nullptr) {
            return wrong("nearest is NULL");
        }
        if (point_count != 0 && (points == nullptr || samples == nullptr)) {
            return wrong("points or samples is NULL");
        }
        static_assert(NearestSample::kNone == GEODISK_NO_SAMPLE);
        const auto found = nearest->disks.of(samples_of(points, point_count));
        GEODISK_TRY(found);
        for (std::size_t i = 0; i < point_count; ++i) {
            samples[i] = (*found)[i].sample;
            if (distances != nullptr) {
                distances[i] = (*found)[i].distance;
            }
        }
        return Done{};
    });
}

geodisk_status geodisk_nearest_cells(const geodisk_nearest* nearest, geodisk_progress_fn progress,
                                     void* user, geodisk_cells** cells, geodisk_error* error) {
    return answer(error, [&]() -> Result<Done> {
        if (nearest == nullptr || cells == nullptr) {
            return wrong("nearest or cells is NULL");
        }
        auto found = nearest->disks.cells(heard_by(progress, user));
        GEODISK_TRY(found);
        *cells = new geodisk_cells{std::move(*found)};
        return Done{};
    });
}

double geodisk_nearest_error(const geodisk_nearest* nearest) {
    return nearest == nullptr ? 0 : nearest->disks.error();
}

void geodisk_nearest_release(geodisk_nearest* nearest) {
    delete nearest;
}

} // extern "C"
