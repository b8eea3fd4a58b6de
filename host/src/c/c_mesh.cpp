#include "c/c_mesh.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <limits>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include <geodisk/walls.hpp>
#include <geodisk/weld.hpp>

#include "c/c_call.hpp"
#include "support/number_text.hpp"
#include "support/try.hpp"

namespace geodisk::c {
namespace {

template <class Number>
bool is_aligned(const void* data, std::size_t stride) noexcept {
    return reinterpret_cast<std::uintptr_t>(data) % alignof(Number) == 0 &&
           stride % alignof(Number) == 0;
}

template <class Number>
Result<PositionView> position_view(const geodisk_mesh_params& params, std::uint32_t dimension) {
    const std::size_t stride =
        params.position_stride != 0 ? params.position_stride : dimension * sizeof(Number);
    if (!is_aligned<Number>(params.positions, stride)) {
        return wrong("params->positions are not aligned as their type asks");
    }
    return PositionView(static_cast<const Number*>(params.positions), params.vertex_count, stride);
}

Result<PositionView> positions_of(const geodisk_mesh_params& params, std::uint32_t dimension) {
    switch (params.position_type) {
    case GEODISK_FLOAT64:
        return position_view<double>(params, dimension);
    case GEODISK_FLOAT32:
        return position_view<float>(params, dimension);
    default:
        return wrong("params->position_type is neither GEODISK_FLOAT64 nor GEODISK_FLOAT32");
    }
}

/// Views the indices of a geodisk_mesh_params or geodisk_walls.
template <class Number, class Params>
Result<IndexView> index_view(const Params& params) {
    const std::size_t stride = params.index_stride != 0 ? params.index_stride : sizeof(Number);
    if (!is_aligned<Number>(params.indices, stride)) {
        return wrong("indices are not aligned as their type asks");
    }
    if (params.face_count > SIZE_MAX / 3) {
        return wrong("face_count is too large");
    }
    return IndexView(static_cast<const Number*>(params.indices), 3 * params.face_count, stride);
}

template <class Params>
Result<IndexView> indices_of(const Params& params) {
    if (params.indices == nullptr) {
        return wrong("indices is NULL");
    }
    switch (params.index_type) {
    case 0:
    case GEODISK_UINT32:
        return index_view<std::uint32_t>(params);
    case GEODISK_UINT16:
        return index_view<std::uint16_t>(params);
    default:
        return wrong("index_type is neither GEODISK_UINT32 nor GEODISK_UINT16");
    }
}

Result<Mesh> make_by_lengths(const geodisk_mesh_params& params, const IndexView& indices,
                             const ThreadOptions& threads) {
    if (params.weld != 0) {
        return wrong("params->weld needs positions");
    }
    if (params.vertex_count > UINT32_MAX) {
        return wrong("params->vertex_count is too large");
    }
    auto prepared = PreparedMesh::prepare(
        LengthMeshView{indices, std::span(params.edge_lengths, 3 * params.face_count),
                       static_cast<std::uint32_t>(params.vertex_count)},
        threads);
    GEODISK_TRY(prepared);
    return Mesh{std::move(*prepared)};
}

Result<Mesh> make_by_positions(const geodisk_mesh_params& params, const IndexView& indices,
                               const ThreadOptions& threads) {
    if (params.weld != 0 && params.keep_seams != 0) {
        return wrong("params->weld and params->keep_seams contradict each other");
    }
    const std::uint32_t dimension = params.dimension != 0 ? params.dimension : 3;
    const auto positions = positions_of(params, dimension);
    GEODISK_TRY(positions);
    MeshView view{*positions, indices, dimension, true};
    std::optional<WeldedMesh> welded;
    if (params.keep_seams == 0) {
        auto result = params.weld != 0 ? weld(view, params.weld_distance) : join_seams(view);
        GEODISK_TRY(result);
        welded = std::move(*result);
        view.triangles = welded->triangles;
    }
    auto prepared = PreparedMesh::prepare(view, threads);
    GEODISK_TRY(prepared);
    Mesh mesh{std::move(*prepared), dimension};
    mesh.positions.reserve(params.vertex_count * dimension);
    for (std::size_t vertex = 0; vertex < params.vertex_count; ++vertex) {
        for (std::uint32_t axis = 0; axis < dimension; ++axis) {
            mesh.positions.push_back(view.coordinate(vertex, axis));
        }
    }
    if (welded) {
        mesh.merged_vertices = welded->merged_vertices;
        mesh.joined_edges = welded->joined_edges;
        mesh.triangles = std::move(welded->triangles);
        if (mesh.merged_vertices > 0) {
            mesh.joined = std::move(welded->vertices);
        }
    } else {
        mesh.triangles.reserve(indices.size());
        for (std::size_t i = 0; i < indices.size(); ++i) {
            mesh.triangles.push_back(indices[i]);
        }
    }
    return mesh;
}

Result<Mesh> make_mesh(const geodisk_mesh_params& params) {
    if ((params.positions == nullptr) == (params.edge_lengths == nullptr)) {
        return wrong("one of params->positions and params->edge_lengths must be given");
    }
    const auto indices = indices_of(params);
    GEODISK_TRY(indices);
    ThreadOptions threads;
    if (params.max_threads != 0) {
        threads.max_threads = params.max_threads;
    }
    return params.positions != nullptr ? make_by_positions(params, *indices, threads)
                                       : make_by_lengths(params, *indices, threads);
}

Result<CutMesh> cut_along(const geodisk_walls& walls) {
    const auto indices = indices_of(walls);
    GEODISK_TRY(indices);
    if (walls.vertex_count > UINT32_MAX) {
        return wrong("vertex_count is too large");
    }
    if (walls.edges == nullptr && walls.edge_count > 0) {
        return wrong("walls->edges is NULL");
    }
    std::vector<std::array<std::uint32_t, 2>> edges(walls.edge_count);
    for (std::size_t i = 0; i < edges.size(); ++i) {
        edges[i] = {walls.edges[2 * i], walls.edges[2 * i + 1]};
    }
    const std::size_t faces = walls.faces != nullptr ? walls.face_count : 0;
    return cut(*indices, static_cast<std::uint32_t>(walls.vertex_count),
               {std::span(walls.faces, faces), edges});
}

/// Reads one value per vertex; `name` is for errors.
Result<std::vector<double>> values_of(const void* values, geodisk_type type, std::size_t count,
                                      const std::string& name) {
    if (values == nullptr) {
        return wrong(name + " is NULL");
    }
    if (type == GEODISK_FLOAT64 && is_aligned<double>(values, 0)) {
        const auto* const first = static_cast<const double*>(values);
        return std::vector<double>(first, first + count);
    }
    if (type == GEODISK_FLOAT32 && is_aligned<float>(values, 0)) {
        const auto* const first = static_cast<const float*>(values);
        return std::vector<double>(first, first + count);
    }
    return wrong(name + " are not aligned GEODISK_FLOAT64 or GEODISK_FLOAT32");
}

/// Returns the mean of the values of joined vertices; values must be from `least` to `most`.
Result<std::vector<double>> values_on(const Mesh& mesh, const std::vector<double>& given,
                                      double least, double most) {
    if (mesh.joined.empty()) {
        return given;
    }
    for (std::size_t v = 0; v < given.size(); ++v) {
        if (mesh.joined[v] != v && !(given[v] >= least && given[v] <= most)) {
            return Error{Status::invalid_argument,
                         most > 1 ? "the density of vertex " + std::to_string(v) + " is " +
                                        exact_text(given[v]) + ", not 0 or positive, and finite"
                                  : "the radius factor of vertex " + std::to_string(v) + " is " +
                                        exact_text(given[v]) + ", not from 0.001 to 1",
                         v};
        }
    }
    return means_of_joined(mesh.joined, given);
}

/// Makes radii from a density or from factors.
geodisk_status create_radii(bool is_density, const geodisk_mesh* mesh, const void* values,
                            geodisk_type type, size_t count, geodisk_radii** radii,
                            geodisk_error* error) {
    return answer(error, [&]() -> Result<Done> {
        if (mesh == nullptr || radii == nullptr) {
            return wrong("mesh or radii is NULL");
        }
        const PreparedMesh& prepared = mesh->shared->prepared;
        const std::string name = is_density ? "densities" : "factors";
        if (count != prepared.vertex_count()) { // Check the count before reading the values.
            return wrong("there are " + std::to_string(count) + " " + name + " for " +
                         std::to_string(prepared.vertex_count()) + " vertices");
        }
        const auto given = values_of(values, type, count, name);
        GEODISK_TRY(given);
        const auto used =
            is_density ? values_on(*mesh->shared, *given, 0, std::numeric_limits<double>::max())
                       : values_on(*mesh->shared, *given, RadiusField::kMinFactor, 1);
        GEODISK_TRY(used);
        auto field = is_density ? RadiusField::from_density(prepared, *used)
                                : RadiusField::prepare(prepared, *used);
        GEODISK_TRY(field);
        *radii = new geodisk_radii{
            std::make_shared<const Radii>(Radii{std::move(*field), prepared.identity()})};
        return Done{};
    });
}

} // namespace
} // namespace geodisk::c

using namespace geodisk;
using namespace geodisk::c;

extern "C" {

geodisk_status geodisk_mesh_create(const geodisk_mesh_params* params, geodisk_mesh** mesh,
                                   geodisk_error* error) {
    return answer(error, [&]() -> Result<Done> {
        if (mesh == nullptr) {
            return wrong("mesh is NULL");
        }
        const auto given = taken(params, "params");
        GEODISK_TRY(given);
        auto made = make_mesh(*given);
        GEODISK_TRY(made);
        *mesh = new geodisk_mesh{std::make_shared<const Mesh>(std::move(*made))};
        return Done{};
    });
}

geodisk_status geodisk_mesh_save(const geodisk_mesh* mesh, void* bytes, size_t capacity,
                                 size_t* size, geodisk_error* error) {
    return answer(error, [&]() -> Result<Done> {
        if (mesh == nullptr || size == nullptr) {
            return wrong("mesh or size is NULL");
        }
        const auto saved = mesh->shared->prepared.save();
        GEODISK_TRY(saved);
        *size = saved->size();
        if (bytes != nullptr && capacity >= saved->size()) {
            std::memcpy(bytes, saved->data(), saved->size());
        }
        return Done{};
    });
}

geodisk_status geodisk_mesh_load(const void* bytes, size_t size, geodisk_mesh** mesh,
                                 geodisk_error* error) {
    return answer(error, [&]() -> Result<Done> {
        if (mesh == nullptr || bytes == nullptr) {
            return wrong("bytes or mesh is NULL");
        }
        auto loaded = PreparedMesh::load(std::span(static_cast<const std::byte*>(bytes), size));
        GEODISK_TRY(loaded);
        *mesh = new geodisk_mesh{std::make_shared<const Mesh>(Mesh{std::move(*loaded)})};
        return Done{};
    });
}

geodisk_status geodisk_mesh_describe(const geodisk_mesh* mesh, geodisk_mesh_info* info,
                                     geodisk_error* error) {
    return answer(error, [&]() -> Result<Done> {
        if (mesh == nullptr) {
            return wrong("mesh is NULL");
        }
        const MeshStatistics& found = mesh->shared->prepared.statistics();
        geodisk_mesh_info value{};
        value.dimension = mesh->shared->dimension;
        value.vertices = found.vertices;
        value.faces = found.triangles;
        value.components = found.components;
        value.boundary_edges = found.boundary_edges;
        value.coinciding_border_edges = found.coinciding_border_edges;
        value.nonmanifold_edges = found.nonmanifold_edges;
        value.repeated_index_faces = found.repeated_index_faces;
        value.zero_area_faces = found.zero_area_faces;
        value.merged_vertices = mesh->shared->merged_vertices;
        value.area = found.area;
        value.diagonal = found.diagonal;
        value.longest_edge = found.longest_edge;
        value.joined_edges = mesh->shared->joined_edges;
        return give(info, "info", value);
    });
}

void geodisk_mesh_release(geodisk_mesh* mesh) {
    delete mesh;
}

geodisk_status geodisk_cut(const geodisk_walls* walls, uint32_t* indices, uint32_t* copied,
                           size_t capacity, size_t* count, geodisk_error* error) {
    return answer(error, [&]() -> Result<Done> {
        if (indices == nullptr || count == nullptr) {
            return wrong("indices or count is NULL");
        }
        const auto given = taken(walls, "walls");
        GEODISK_TRY(given);
        auto made = cut_along(*given);
        GEODISK_TRY(made);
        std::ranges::copy(made->triangles, indices);
        *count = made->copied.size();
        if (copied != nullptr && capacity >= made->copied.size()) {
            std::ranges::copy(made->copied, copied);
        }
        return Done{};
    });
}

geodisk_status geodisk_radii_create(const geodisk_mesh* mesh, const void* factors,
                                    geodisk_type type, size_t count, geodisk_radii** radii,
                                    geodisk_error* error) {
    return create_radii(false, mesh, factors, type, count, radii, error);
}

geodisk_status geodisk_density_create(const geodisk_mesh* mesh, const void* density,
                                      geodisk_type type, size_t count, geodisk_radii** radii,
                                      geodisk_error* error) {
    return create_radii(true, mesh, density, type, count, radii, error);
}

double geodisk_radii_min_factor(const geodisk_radii* radii) {
    return radii == nullptr ? 1 : radii->shared->field.min_factor();
}

void geodisk_radii_release(geodisk_radii* radii) {
    delete radii;
}

} // extern "C"
