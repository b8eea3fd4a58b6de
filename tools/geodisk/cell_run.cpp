#include "geodisk/cell_run.hpp"

#include <utility>

#include "geodisk/search_progress.hpp"
#include "program/failure.hpp"
#include "program/interrupt.hpp"
#include "program/stopwatch.hpp"

namespace geodisk::tools {

CellResult run_cells(std::span<const SampleRow> rows, bool has_dual, const MeshInput& mesh,
                     RunDevice& device, bool is_bounded, ProgressLine& progress) {
    const Stopwatch watch;
    device.open(progress);
    const double open_seconds = watch.seconds();
    progress.begin_stage("finding cells");
    CellResult result;
    std::vector<Sample> samples;
    samples.reserve(rows.size());
    for (const SampleRow& row : rows) {
        samples.push_back(sample_of(row));
        result.points.insert(result.points.end(), row.position, row.position + mesh.dimension());
    }
    CellParams params;
    params.has_dual = has_dual;
    auto found = find_cells(device.runner(), mesh.prepared, samples, params,
                            search_progress(progress, "samples"));
    progress.clear();
    check_interrupted();
    if (!found) {
        check_run(found.error(), is_bounded);
    }
    result.cells = take(std::move(found));
    if (mesh.dimension() > 0) {
        result.angles = triangle_angles(result.points, mesh.dimension(), result.cells.triangles);
    }
    result.done.device = device.context().report();
    result.done.tuning = device.runner().sampler().tuning();
    result.done.run = result.cells.report;
    result.done.open_seconds = open_seconds;
    return result;
}

SampleField area_field(const SurfaceCells& cells) {
    return {"area", {"area"}, false, false, cells.areas};
}

DualMesh dual_mesh(const CellResult& result, const MeshInput& mesh) {
    return {result.points, mesh.dimension(), result.cells.edges, result.cells.triangles};
}

} // namespace geodisk::tools
