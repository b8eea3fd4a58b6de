#include "geodisk/cell_run.hpp"

#include <algorithm>
#include <utility>

#include <geodisk/nearest.hpp>

#include "geodisk/inputs/source_points.hpp"
#include "program/failure.hpp"
#include "program/interrupt.hpp"

namespace geodisk::tools {
namespace {

// A record, and its number in its face.
constexpr std::uint64_t kBytesPerRecord = 40;

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

std::vector<std::uint32_t> nearest_of_vertices(std::span<const SampleRow> rows,
                                               const MeshInput& mesh, RunDevice& device,
                                               std::uint64_t bytes, ProgressLine& progress) {
    progress.begin_stage("finding labels");
    auto disks = NearestSamples::create(device.runner(), mesh.prepared, samples_of(rows),
                                        max_records(bytes), search_progress(progress, "samples"));
    progress.clear();
    check_interrupted();
    if (!disks) {
        check_cells(disks.error(), bytes);
    }
    const NearestSamples nearest = take(std::move(disks));
    const NumberedPoints vertices = vertices_of(mesh, {});
    const std::vector<NearestSample> found = take(nearest.of(vertices.points));
    std::vector<std::uint32_t> samples(mesh.prepared.vertex_count(), NearestSample::kNone);
    for (std::size_t i = 0; i < found.size(); ++i) {
        samples[vertices.numbers[i]] = found[i].sample;
    }
    return samples;
}

SampleField area_field(const SurfaceCells& cells) {
    return {kAreaColumn, {kAreaColumn}, false, false, cells.areas};
}

DualMesh dual_mesh(const CellResult& result, const MeshInput& mesh,
                   std::span<const SampleField> fields) {
    return {result.points, mesh.dimension(), result.cells.edges, result.cells.triangles, fields};
}

} // namespace geodisk::tools
