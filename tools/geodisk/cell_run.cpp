#include "geodisk/cell_run.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include <geodisk/nearest.hpp>
#include <geodisk/neighbours.hpp>

#include "program/batches.hpp"
#include "program/failure.hpp"
#include "program/interrupt.hpp"

namespace geodisk::tools {
namespace {

// A record, and its number in its face.
constexpr std::uint64_t kBytesPerRecord = 40;
/// Longest edge of the triangles that cells are cut from, in units of the root of a cell's area.
constexpr double kLongestInCell = 0.5;
/// Points whose samples a thread finds at a time.
constexpr std::size_t kPointsPerBatch = 4096;

} // namespace

std::uint64_t max_records(std::uint64_t bytes) {
    const std::uint64_t most = CellParams().max_records;
    return bytes == 0 ? most : std::min(most, bytes / kBytesPerRecord);
}

void check_cells(const Error& error, std::uint64_t bytes) {
    if (bytes != 0 && error.status == Status::job_too_large) {
        throw UserError(ExitCode::out_of_memory, error.message + ", or give more with --memory");
    }
    check_run(error, bytes != 0);
}

CellResult run_cells(std::span<const SampleRow> rows, bool has_dual, const MeshInput& mesh,
                     RunDevice& device, std::uint64_t bytes, ProgressLine& progress) {
    CellResult result;
    result.done = device.begin_search(progress);
    progress.begin_stage("finding cells");
    for (const SampleRow& row : rows) {
        result.points.insert(result.points.end(), row.position, row.position + mesh.dimension());
    }
    CellParams params;
    params.has_dual = has_dual;
    params.max_records = max_records(bytes);
    params.face_mask = mesh.face_mask;
    auto found = find_cells(device.runner(), mesh.prepared, samples_of(rows), params,
                            search_progress(progress, "samples"));
    progress.clear();
    check_interrupted();
    if (!found) {
        check_cells(found.error(), bytes);
    }
    result.cells = take(std::move(found));
    if (mesh.dimension() > 0) {
        result.angles = triangle_angles(result.points, mesh.dimension(), result.cells.triangles);
    }
    result.done.run = result.cells.report;
    return result;
}

NearestSamples find_nearest(std::span<const SampleRow> rows, const MeshInput& mesh,
                            RunDevice& device, std::uint64_t bytes, ProgressLine& progress) {
    progress.begin_stage("finding cells");
    auto found = NearestSamples::create(device.runner(), mesh.prepared, samples_of(rows),
                                        max_records(bytes), search_progress(progress, "samples"));
    progress.clear();
    check_interrupted();
    if (!found) {
        check_cells(found.error(), bytes);
    }
    return take(std::move(found));
}

std::vector<std::uint32_t> samples_at_vertices(const NearestSamples& nearest,
                                               const MeshInput& mesh) {
    const std::size_t count = mesh.prepared.vertex_count();
    const VertexPoints vertices = take(vertex_points(mesh.prepared, mesh.file.joined));
    const std::vector<NearestSample> found = take(nearest.of(vertices.points));
    std::vector<NearestSample> own(mesh.file.file_vertices(count));
    for (std::size_t i = 0; i < found.size(); ++i) { // Of a vertex on a wall, all sides count.
        NearestSample& at = own[mesh.file.file_vertex(vertices.vertices[i], count)];
        const bool is_nearer = at.sample == NearestSample::kNone || found[i].distance < at.distance;
        at = is_nearer ? found[i] : at;
    }
    std::vector<std::uint32_t> samples(own.size());
    std::ranges::transform(own, samples.begin(), &NearestSample::sample);
    return samples;
}

CutCells cut_along_cells(const NearestSamples& nearest, std::size_t samples, const MeshInput& mesh,
                         ProgressLine& progress) {
    progress.begin_stage("cutting cells");
    const double cell = mesh.prepared.statistics().area / static_cast<double>(samples);
    CutCells cells = cut_cells(
        mesh.file, mesh.face_mask, kLongestInCell * std::sqrt(cell),
        [&](std::span<const Sample> points) {
            std::vector<std::uint32_t> found(points.size());
            const auto find = [&](std::size_t, std::size_t begin, std::size_t end) {
                const auto own = take(nearest.of(points.subspan(begin, end - begin)));
                std::ranges::transform(own, found.begin() + static_cast<std::ptrdiff_t>(begin),
                                       &NearestSample::sample);
            };
            in_batches(
                points.size(), kPointsPerBatch, [&] { return find; },
                [](double) { check_interrupted(); });
            return found;
        });
    progress.clear();
    return cells;
}

SampleField area_field(const SurfaceCells& cells) {
    return {kAreaColumn, {kAreaColumn}, false, false, cells.areas};
}

DualMesh dual_mesh(const CellResult& result, const MeshInput& mesh,
                   std::span<const SampleField> fields) {
    return {result.points, mesh.dimension(), result.cells.edges, result.cells.triangles, fields};
}

} // namespace geodisk::tools
