#include "geodisk/neighbour_run.hpp"

#include <algorithm>
#include <map>
#include <numeric>
#include <utility>

#include "program/failure.hpp"
#include "program/human_text.hpp"
#include "program/interrupt.hpp"

namespace geodisk::tools {

void keep_masked(const MeshInput& mesh, NumberedPoints& vertices) {
    const auto place = [&](std::uint32_t vertex) {
        return mesh.file.joined.empty() ? vertex : mesh.file.joined[vertex];
    };
    std::vector<std::uint8_t> is_used(mesh.prepared.vertex_count(), 0);
    for (std::size_t corner = 0; corner < mesh.file.triangles.size(); ++corner) {
        if (mesh.face_mask[corner / 3] != 0) {
            is_used[place(mesh.file.triangles[corner])] = 1;
        }
    }
    NumberedPoints kept;
    for (std::size_t i = 0; i < vertices.points.size(); ++i) {
        if (is_used[place(vertices.numbers[i])] != 0) {
            kept.points.push_back(vertices.points[i]);
            kept.numbers.push_back(vertices.numbers[i]);
        }
    }
    vertices = std::move(kept);
}

namespace {

/// Puts vertices of the file in the place of copies, which walls made: each once in a row, by the
/// nearest of its sides. `has_all` says that rows have all vertices of a place, and ascend.
void fold_copies(const MeshFile& mesh, std::size_t vertices, bool has_all, NeighbourTable& table) {
    if (mesh.copied.empty()) {
        return;
    }
    std::multimap<std::uint32_t, std::uint32_t> joined; // Vertices by the lowest of their place.
    for (std::uint32_t v = 0; has_all && v < mesh.file_vertices(vertices); ++v) {
        if (!mesh.joined.empty() && mesh.joined[v] != v) {
            joined.emplace(mesh.joined[v], v);
        }
    }
    NeighbourTable folded{std::move(table.sources), {0}, {}, {}};
    std::vector<std::pair<std::uint32_t, float>> row;
    const auto add = [&](std::uint32_t vertex, float distance) {
        const auto known = std::ranges::find(row, vertex, &std::pair<std::uint32_t, float>::first);
        if (known == row.end()) {
            row.emplace_back(vertex, distance);
        } else {
            known->second = std::min(known->second, distance);
        }
    };
    for (std::size_t r = 0; r + 1 < table.offsets.size(); ++r) {
        row.clear();
        for (std::uint64_t i = table.offsets[r]; i < table.offsets[r + 1]; ++i) {
            const std::uint32_t vertex = mesh.file_vertex(table.targets[i], vertices);
            add(vertex, table.distances[i]);
            const auto [first, last] = joined.equal_range(vertex);
            for (auto other = first; other != last && vertex != table.targets[i]; ++other) {
                add(other->second, table.distances[i]);
            }
        }
        if (has_all) {
            std::ranges::sort(row);
        }
        for (const auto& [vertex, distance] : row) {
            folded.targets.push_back(vertex);
            folded.distances.push_back(distance);
        }
        folded.offsets.push_back(folded.targets.size());
    }
    table = std::move(folded);
}

} // namespace

NeighbourResult search_neighbours(const NeighbourJob& job, const MeshInput& mesh, RunDevice& device,
                                  bool is_bounded, ProgressLine& progress) {
    DeviceRun done = device.begin_search(progress);
    progress.begin_stage("finding neighbours");
    NeighbourQuery query;
    query.sources = job.sources.points;
    query.within = job.within;
    query.radii = job.radii;
    query.kind = job.kind;
    query.points = job.points;
    query.joined = mesh.file.joined;
    query.nearest = job.nearest;
    query.max_pairs = job.max_pairs == 0 ? query.max_pairs : job.max_pairs;
    auto found =
        find_neighbours(device.runner(), mesh.prepared, query, search_progress(progress, "pairs"));
    progress.clear();
    check_interrupted();
    if (!found) {
        check_run(found.error(), is_bounded);
    }
    Neighbours neighbours = take(std::move(found));
    NeighbourResult result{{job.sources.numbers, std::move(neighbours.offsets),
                            std::move(neighbours.indices), std::move(neighbours.distances)},
                           neighbours.error,
                           std::move(done)};
    result.done.run = neighbours.report;
    NeighbourTable& table = result.table;
    if (table.sources.empty()) {
        table.sources.resize(job.sources.points.size());
        std::iota(table.sources.begin(), table.sources.end(), 0u);
    }
    if (job.kind == NeighbourKind::vertices) {
        fold_copies(mesh.file, mesh.prepared.vertex_count(), job.nearest == 0, table);
    }
    if (job.kind == NeighbourKind::sources && !job.sources.numbers.empty()) {
        for (std::uint32_t& target : table.targets) {
            target = job.sources.numbers[target];
        }
    }
    return result;
}

} // namespace geodisk::tools
