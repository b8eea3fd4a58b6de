#include "geodisk/neighbour_run.hpp"

#include <algorithm>
#include <limits>
#include <numeric>
#include <span>
#include <tuple>
#include <utility>

#include "program/failure.hpp"
#include "program/human_text.hpp"
#include "program/interrupt.hpp"
#include "program/stopwatch.hpp"

namespace geodisk::tools {
namespace {

constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

/// Of each vertex of the file the one that stands for it.
std::uint32_t stands_for(const MeshInput& mesh, std::uint32_t vertex) {
    return mesh.file.joined.empty() ? vertex : mesh.file.joined[vertex];
}

/// The vertices of the file that each one stands for, ascending: those that a face uses.
class Twins {
  public:
    explicit Twins(const MeshInput& mesh) : starts_(mesh.prepared.vertex_count() + 1, 0) {
        std::vector<bool> is_used(mesh.prepared.vertex_count(), false);
        for (const std::uint32_t vertex : mesh.file.corners_in_file()) {
            is_used[vertex] = true;
        }
        for (std::uint32_t v = 0; v < is_used.size(); ++v) {
            starts_[stands_for(mesh, v) + 1] += is_used[v];
        }
        std::partial_sum(starts_.begin(), starts_.end(), starts_.begin());
        all_.resize(starts_.back());
        std::vector<std::size_t> next(starts_.begin(), starts_.end() - 1);
        for (std::uint32_t v = 0; v < is_used.size(); ++v) {
            if (is_used[v]) {
                all_[next[stands_for(mesh, v)]++] = v;
            }
        }
    }

    std::span<const std::uint32_t> of(std::uint32_t vertex) const {
        return std::span(all_).subspan(starts_[vertex], starts_[vertex + 1] - starts_[vertex]);
    }

  private:
    std::vector<std::size_t> starts_;
    std::vector<std::uint32_t> all_;
};

/// Puts all vertices of the file in place of those that stand for them.
void name_all_twins(const MeshInput& mesh, std::uint32_t nearest, NeighbourTable& table) {
    const Twins twins(mesh);
    NeighbourTable named{std::move(table.sources), {0}, {}, {}};
    std::vector<std::pair<std::uint32_t, float>> row;
    for (std::size_t i = 0; i + 1 < table.offsets.size(); ++i) {
        row.clear();
        for (std::size_t at = table.offsets[i]; at < table.offsets[i + 1]; ++at) {
            for (const std::uint32_t twin : twins.of(table.targets[at])) {
                row.emplace_back(twin, table.distances[at]);
            }
        }
        std::ranges::sort(row, {}, [nearest](const auto& pair) {
            return std::tuple(nearest == 0 ? 0.0f : pair.second, pair.first);
        });
        row.resize(nearest == 0 ? row.size() : std::min<std::size_t>(row.size(), nearest));
        for (const auto& [target, distance] : row) {
            named.targets.push_back(target);
            named.distances.push_back(distance);
        }
        named.offsets.push_back(named.targets.size());
    }
    table = std::move(named);
}

ProgressCallback show_progress(ProgressLine& progress) {
    return [&progress](const Progress& state) {
        progress.update(static_cast<double>(state.decided) / state.candidates,
                        grouped(state.accepted) + " pairs");
        return !is_interrupted();
    };
}

} // namespace

NumberedPoints vertices_of(const MeshInput& mesh, const std::vector<std::uint32_t>& wanted) {
    std::vector<std::uint32_t> vertices;
    const std::vector<Sample> points = take(vertex_points(mesh.prepared, &vertices));
    std::vector<std::uint32_t> index(mesh.prepared.vertex_count(), kNone);
    for (std::uint32_t i = 0; i < vertices.size(); ++i) {
        index[vertices[i]] = i;
    }
    NumberedPoints found;
    const auto add = [&](std::uint32_t vertex) {
        found.points.push_back(points[index[stands_for(mesh, vertex)]]);
        found.numbers.push_back(vertex);
    };
    for (const std::uint32_t vertex : wanted) {
        if (vertex >= index.size()) {
            fail_usage("--vertices: there is no vertex " + std::to_string(vertex) +
                       ", since the mesh has " + grouped(index.size()) + ", counted from 0");
        }
        if (index[stands_for(mesh, vertex)] == kNone) {
            fail_usage("--vertices: no face uses vertex " + std::to_string(vertex));
        }
        add(vertex);
    }
    if (wanted.empty()) {
        std::vector<bool> is_used(index.size(), false);
        for (const std::uint32_t vertex : mesh.file.corners_in_file()) {
            is_used[vertex] = true;
        }
        for (std::uint32_t v = 0; v < index.size(); ++v) {
            if (is_used[v] && index[stands_for(mesh, v)] != kNone) {
                add(v);
            }
        }
    }
    return found;
}

NeighbourResult search_neighbours(const NeighbourJob& job, const MeshInput& mesh,
                                  RunDevice& device, bool is_bounded, ProgressLine& progress) {
    const Stopwatch watch;
    device.open(progress);
    const double open_seconds = watch.seconds();
    progress.begin_stage("finding neighbours");
    NeighbourQuery query;
    query.sources = job.sources.points;
    query.within = job.within;
    query.radii = job.radii;
    query.kind = job.kind;
    query.points = job.points;
    query.nearest = job.nearest;
    query.most_pairs = job.most_pairs == 0 ? query.most_pairs : job.most_pairs;
    auto found =
        find_neighbours(device.runner(), mesh.prepared, query, show_progress(progress));
    progress.clear();
    check_interrupted();
    if (!found) {
        check_run(found.error(), is_bounded);
    }
    Neighbours neighbours = take(std::move(found));
    NeighbourResult result{{job.sources.numbers, std::move(neighbours.offsets),
                            std::move(neighbours.indices), std::move(neighbours.distances)},
                           neighbours.error,
                           {}};
    result.done.device = device.context().report();
    result.done.tuning = device.runner().sampler().tuning();
    result.done.run = neighbours.report;
    result.done.open_seconds = open_seconds;
    NeighbourTable& table = result.table;
    if (table.sources.empty()) {
        table.sources.resize(job.sources.points.size());
        std::iota(table.sources.begin(), table.sources.end(), 0u);
    }
    if (job.kind == NeighbourKind::vertices && !mesh.file.joined.empty()) {
        name_all_twins(mesh, job.nearest, table);
    }
    if (job.kind == NeighbourKind::sources && !job.sources.numbers.empty()) {
        for (std::uint32_t& target : table.targets) {
            target = job.sources.numbers[target];
        }
    }
    return result;
}

} // namespace geodisk::tools
