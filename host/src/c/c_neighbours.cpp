#include <algorithm>
#include <chrono>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <geodisk/neighbours.hpp>

#include "c/c_call.hpp"
#include "c/c_mesh.hpp"
#include "c/c_neighbours.hpp"
#include "c/c_sampler.hpp"
#include "support/try.hpp"

/// Immutable.
struct geodisk_neighbours {
    geodisk::Neighbours lists;
    std::vector<std::uint32_t> vertices; ///< Vertex of each source; empty if sources are points.
};

namespace geodisk::c {
namespace {

Result<NeighbourKind> kind_of(geodisk_neighbour_kind kind) {
    switch (kind) {
    case GEODISK_AMONG_VERTICES:
        return NeighbourKind::vertices;
    case GEODISK_AMONG_POINTS:
        return NeighbourKind::points;
    case GEODISK_AMONG_SOURCES:
        return NeighbourKind::sources;
    default:
        return wrong("params->kind is no geodisk_neighbour_kind");
    }
}

} // namespace

std::span<const std::uint32_t> joined_of(const Mesh& mesh, const std::uint32_t* given) {
    return given == nullptr ? std::span<const std::uint32_t>(mesh.joined)
                            : std::span(given, mesh.prepared.vertex_count());
}

Result<NeighbourSources> sources_of(const Mesh& mesh, const geodisk_surface_point* points,
                                    const std::uint32_t* vertices, std::size_t count,
                                    std::span<const std::uint32_t> joined) {
    if (points != nullptr && vertices != nullptr) {
        return wrong("params->sources and params->source_vertices contradict each other");
    }
    if (points != nullptr) {
        return NeighbourSources{samples_of(points, count), {}};
    }
    auto all = vertex_points(mesh.prepared, joined);
    GEODISK_TRY(all);
    if (vertices == nullptr) {
        return NeighbourSources{std::move(all->points), std::move(all->vertices)};
    }
    NeighbourSources sources;
    for (std::size_t i = 0; i < count; ++i) {
        const std::uint32_t vertex = vertices[i];
        const auto at = std::ranges::lower_bound(all->vertices, vertex);
        if (at == all->vertices.end() || *at != vertex) {
            return wrong("source " + std::to_string(i) + " is vertex " + std::to_string(vertex) +
                         ", which no face uses");
        }
        sources.points.push_back(all->points[static_cast<std::size_t>(at - all->vertices.begin())]);
        sources.vertices.push_back(vertex);
    }
    return sources;
}

Result<std::shared_ptr<NeighbourSearch>> search_for(const geodisk_mesh& mesh,
                                                    const geodisk_neighbour_params& params) {
    const auto kind = kind_of(params.kind);
    GEODISK_TRY(kind);
    // Other sources at the place of a source would be its nearest.
    const bool are_places =
        params.kind == GEODISK_AMONG_SOURCES && params.source_vertices == nullptr;
    auto sources = sources_of(
        *mesh.shared, params.sources, params.source_vertices, params.source_count,
        are_places ? std::span<const std::uint32_t>() : joined_of(*mesh.shared, params.joined));
    GEODISK_TRY(sources);
    if (params.points == nullptr && params.point_count != 0) {
        return wrong("params->points is NULL");
    }
    auto search = std::make_shared<NeighbourSearch>();
    search->mesh = mesh.shared;
    search->sources = std::move(*sources);
    search->points = samples_of(params.points, params.point_count);
    const std::size_t count = search->sources.points.size();
    if (params.radii != nullptr) {
        search->radii.assign(params.radii, params.radii + count);
    }
    const auto joined = joined_of(*mesh.shared, params.joined);
    search->joined.assign(joined.begin(), joined.end());
    NeighbourQuery& query = search->query;
    query.sources = search->sources.points;
    query.within = params.within;
    query.radii = search->radii;
    query.kind = *kind;
    query.points = search->points;
    query.joined = search->joined;
    query.nearest = params.nearest;
    query.max_pairs = params.max_pairs == 0 ? query.max_pairs : params.max_pairs;
    return search;
}

namespace {

geodisk_neighbours* handed_over(Neighbours lists, NeighbourSearch& search) {
    return new geodisk_neighbours{std::move(lists), std::move(search.sources.vertices)};
}

} // namespace
} // namespace geodisk::c

using namespace geodisk;
using namespace geodisk::c;

extern "C" {

geodisk_status geodisk_find_neighbours(geodisk_sampler* sampler, const geodisk_mesh* mesh,
                                       const geodisk_neighbour_params* params,
                                       geodisk_progress_fn progress, void* user,
                                       geodisk_neighbours** neighbours, geodisk_error* error) {
    return with_sampler(sampler, error, [&](SamplerState& state) -> Result<Done> {
        if (mesh == nullptr || neighbours == nullptr) {
            return wrong("mesh or neighbours is NULL");
        }
        const auto wanted = taken(params, "params");
        GEODISK_TRY(wanted);
        const auto made = search_for(*mesh, *wanted);
        GEODISK_TRY(made);
        auto lists = search(state, progress, user, [&](const ProgressCallback& heard) {
            return find_neighbours(state.runner, (*made)->mesh->prepared, (*made)->query, heard);
        });
        GEODISK_TRY(lists);
        *neighbours = handed_over(std::move(*lists), **made);
        return Done{};
    });
}

geodisk_status geodisk_start_neighbours(geodisk_sampler* sampler, const geodisk_mesh* mesh,
                                        const geodisk_neighbour_params* params,
                                        geodisk_error* error) {
    return with_sampler(sampler, error, [&](SamplerState& state) -> Result<Done> {
        if (mesh == nullptr) {
            return wrong("mesh is NULL");
        }
        const auto wanted = taken(params, "params");
        GEODISK_TRY(wanted);
        if (state.is_busy()) {
            return run_in_progress();
        }
        const auto made = search_for(*mesh, *wanted);
        GEODISK_TRY(made);
        state.is_cancelled = false;
        auto started = start_neighbours(state.runner, (*made)->mesh->prepared, (*made)->query,
                                        state.callback(nullptr, nullptr));
        if (started) {
            state.searching = *made;
        }
        return started;
    });
}

geodisk_status geodisk_poll_neighbours(geodisk_sampler* sampler, uint32_t milliseconds,
                                       geodisk_neighbours** neighbours, geodisk_error* error) {
    return with_sampler(sampler, error, [&](SamplerState& state) -> Result<Done> {
        if (neighbours == nullptr) {
            return wrong("neighbours is NULL");
        }
        if (!state.searching) {
            return wrong("the sampler has no search for neighbours in progress");
        }
        auto polled = poll_neighbours(state.runner, std::chrono::milliseconds(milliseconds));
        if (polled && !*polled) {
            *neighbours = nullptr;
            return Done{};
        }
        const auto ended = std::exchange(state.searching, nullptr);
        GEODISK_TRY(polled);
        GEODISK_TRY(state.device->check_validation());
        *neighbours = handed_over(std::move(**polled), *ended);
        return Done{};
    });
}

geodisk_status geodisk_neighbours_describe(const geodisk_neighbours* neighbours,
                                           geodisk_neighbour_arrays* arrays, geodisk_error* error) {
    return answer(error, [&]() -> Result<Done> {
        if (neighbours == nullptr) {
            return wrong("neighbours is NULL");
        }
        const Neighbours& lists = neighbours->lists;
        geodisk_neighbour_arrays value{};
        value.source_count = lists.offsets.size() - 1;
        value.pair_count = lists.indices.size();
        value.vertices = neighbours->vertices.empty() ? nullptr : neighbours->vertices.data();
        value.offsets = lists.offsets.data();
        value.indices = lists.indices.data();
        value.distances = lists.distances.data();
        value.error = lists.error;
        return give(arrays, "arrays", value);
    });
}

void geodisk_neighbours_release(geodisk_neighbours* neighbours) {
    delete neighbours;
}

} // extern "C"
