#include <geodisk/neighbours.hpp>

#include "engine/domain/existing.hpp"
#include "engine/neighbours/check_query.hpp"
#include "engine/neighbours/joined_vertices.hpp"
#include "engine/neighbours/search_nearest.hpp"
#include "engine/neighbours/search_within.hpp"
#include "support/guard.hpp"
#include "support/try.hpp"

namespace geodisk {

namespace {

/// Runs a checked query.
Task<Result<Neighbours>> search(Runner::Impl& runner, const PreparedMesh& mesh,
                                NeighbourQuery query) {
    auto searched = query.nearest == 0 ? search_within(runner, mesh, query)
                                       : search_nearest(runner, mesh, query);
    auto found = co_await searched;
    if (found && lists_joined(query)) {
        name_joined(query.joined, *found);
    }
    co_return found;
}

std::uint32_t count_of(const NeighbourQuery& query) {
    return static_cast<std::uint32_t>(query.sources.size());
}

} // namespace

Result<Neighbours> find_neighbours(Runner& runner, const PreparedMesh& mesh,
                                   const NeighbourQuery& query,
                                   const ProgressCallback& progress) noexcept {
    return guarded([&]() -> Result<Neighbours> {
        GEODISK_TRY(check_query(mesh, query));
        Runner::Impl& impl = Runner::Impl::of(runner);
        return impl.complete(search(impl, mesh, with_joined(mesh, query)), count_of(query),
                             progress);
    });
}

Result<Done> start_neighbours(Runner& runner, const PreparedMesh& mesh, const NeighbourQuery& query,
                              const ProgressCallback& progress) noexcept {
    return guarded([&]() -> Result<Done> {
        GEODISK_TRY(check_query(mesh, query));
        Runner::Impl& impl = Runner::Impl::of(runner);
        return impl.begin(search(impl, mesh, with_joined(mesh, query)), count_of(query), progress);
    });
}

Result<std::optional<Neighbours>> poll_neighbours(Runner& runner,
                                                  std::chrono::milliseconds patience) noexcept {
    return Runner::Impl::of(runner).poll<Neighbours>(patience);
}

Result<VertexPoints> vertex_points(const PreparedMesh& mesh,
                                   std::span<const std::uint32_t> given) noexcept {
    return guarded([&]() -> Result<VertexPoints> {
        const auto joined = given.empty() ? mesh.joined_vertices() : given;
        GEODISK_TRY(check_joined(mesh, joined));
        VertexPoints found;
        for (std::uint32_t v = 0; v < mesh.vertex_count(); ++v) {
            const VertexFan& fan = mesh.fans()[joined.empty() ? v : joined[v]];
            for (const std::uint32_t h :
                 mesh.corners().subspan(fan.first_corner, fan.corner_count)) {
                Sample point{h / 3, {0, 0, 0}};
                point.weights[h % 3] = 1;
                if (fault_of(point, mesh).empty()) {
                    found.points.push_back(point);
                    found.vertices.push_back(v);
                    break;
                }
            }
        }
        return found;
    });
}

} // namespace geodisk
