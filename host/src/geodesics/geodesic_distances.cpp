#include <geodisk/geodesics.hpp>

#include <algorithm>
#include <atomic>
#include <iterator>
#include <string>
#include <vector>

#include "engine/neighbours/check_query.hpp"
#include "geodesics/wavefront.hpp"
#include "mesh/checks.hpp"
#include "support/blocks.hpp"
#include "support/guard.hpp"
#include "support/invalid.hpp"
#include "support/number_text.hpp"
#include "support/shared_run.hpp"
#include "support/try.hpp"

namespace geodisk {
namespace {

using geodesics::Wavefront;

Result<Done> check(const PreparedMesh& mesh, const DistanceQuery& query) {
    if (query.sources.empty()) {
        return invalid("there is no source");
    }
    if (!(query.within > 0)) {
        return invalid("the limit of distances is " + number_text(query.within) +
                       ", which is not positive");
    }
    GEODISK_TRY(check_joined(mesh, query.joined));
    GEODISK_TRY(check_points(mesh, "source", query.sources));
    return check_points(mesh, "target", query.targets);
}

/// Writes the distance of each target or vertex to `row`, and its source, where that is asked for.
void copy_paths(const Wavefront& front, std::span<const std::uint32_t> joined,
                std::span<double> row, std::span<std::uint32_t> sources) {
    const auto paths = front.targets().empty() ? front.vertices() : front.targets();
    for (std::size_t i = 0; i < row.size(); ++i) {
        const geodesics::Arrival& path = paths[joined.empty() ? i : joined[i]];
        row[i] = path.distance;
        if (!sources.empty()) {
            sources[i] = path.source;
        }
    }
}

} // namespace

Result<GeodesicDistances> geodesic_distances(const PreparedMesh& mesh, const DistanceQuery& query,
                                             const ThreadOptions& threads,
                                             const ProgressCallback& progress) noexcept {
    return guarded([&]() -> Result<GeodesicDistances> {
        GEODISK_TRY(check_threads(threads));
        GEODISK_TRY(check(mesh, query));
        std::span<const std::uint32_t> joined; // Of vertices.
        if (query.targets.empty()) {
            joined = query.joined.empty() ? mesh.joined_vertices() : query.joined;
        }
        const std::size_t width =
            query.targets.empty() ? mesh.vertex_count() : query.targets.size();
        const auto count = static_cast<std::uint32_t>(query.sources.size());
        std::vector<PathPoint> sources, targets;
        std::ranges::transform(query.sources, std::back_inserter(sources), geodesics::precise);
        std::ranges::transform(query.targets, std::back_inserter(targets), geodesics::precise);
        SharedRun run(progress);
        GeodesicDistances result;
        if (query.each) {
            result.distances.resize(width * count);
            std::atomic<std::uint32_t> done = 0;
            for_parts(threads, count, [&](std::size_t row) {
                if (!run.goes_on()) {
                    return;
                }
                Wavefront front(mesh, query.within);
                front.aim_at(targets);
                front.add(sources[row], 0);
                if (run.check(front.spread([&](std::uint32_t) { return run.tell(done, count); }))) {
                    copy_paths(front, joined,
                               std::span(result.distances).subspan(row * width, width), {});
                    ++done;
                }
            });
        } else {
            result.distances.resize(width);
            result.nearest.resize(width);
            Wavefront front(mesh, query.within);
            front.aim_at(targets);
            for (std::uint32_t i = 0; i < count; ++i) {
                front.add(sources[i], i);
            }
            run.check(front.spread(
                [&](std::uint32_t reached) { return run.tell(reached, mesh.vertex_count()); }));
            copy_paths(front, joined, result.distances, result.nearest);
        }
        GEODISK_TRY(run.result());
        return result;
    });
}

} // namespace geodisk
