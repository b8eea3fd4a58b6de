#include "geodisk/sample_run.hpp"

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include <geodisk/domain.hpp>

#include "files/block_writer.hpp"
#include "files/part_columns.hpp"
#include "geodisk/checks/run_warnings.hpp"
#include "program/failure.hpp"

namespace geodisk::tools {
namespace {

void check_space(const SampleJob& job, const MeshInput& mesh) {
    if (!job.is_geodesic() && mesh.dimension() != 3) {
        fail_usage("--metric " + metric_name(job.metric) +
                   " needs three coordinates per vertex; the mesh has " +
                   (mesh.dimension() == 0 ? "none" : std::to_string(mesh.dimension())));
    }
}

SampleParams params_on(const MeshInput& mesh, const SampleJob& job) {
    SampleParams params = job.params;
    params.radii = mesh.radii ? &*mesh.radii : nullptr;
    const double area = effective_area(mesh.prepared, params);
    params.min_distance =
        job.min_distance
            ? distance_on_mesh(*job.min_distance, mesh.prepared.statistics()) / mesh.distance_part
            : distance_for_count(mesh.prepared, params.radii, job.wanted_count);
    params.throws = job.method.throws_for(expected_count(area, params.min_distance));
    return params;
}

Domain domain_of(const SampleJob& job, const MeshInput& mesh, const SampleParams& params) {
    if (job.is_geodesic()) {
        return take(Domain::surface(mesh.prepared, params));
    }
    const MeshView view{mesh.file.positions, mesh.file.triangles, mesh.file.dimension};
    return take(Domain::surface_in_space(view, mesh.prepared, params, *job.metric));
}

std::vector<SampleRow> to_rows(const MeshInput& mesh, double min_distance,
                               const std::vector<Sample>& samples) {
    std::vector<SampleRow> rows(samples.size());
    for_rows(rows.size(), [&](std::size_t i) {
        const Sample& sample = samples[i];
        SampleRow& row = rows[i];
        row.face = sample.face;
        std::copy_n(sample.weights, 3, row.bary);
        mesh.place(row);
        row.radius = mesh.radius(sample.face, sample.weights, min_distance);
    });
    return rows;
}

} // namespace

std::vector<NamedFile> files_read(const SampleJob& job) {
    std::vector<NamedFile> read;
    job.mesh.add_files(read, "the mesh");
    job.density.add_files(read, "the density");
    return read;
}

RunDevice device_for(const SampleJob& job) {
    return RunDevice(job.run.device, job.runner, !job.picture.empty());
}

SampleResult sample_mesh(const SampleJob& job, const MeshInput& mesh, RunDevice& device,
                         ProgressLine& progress) {
    check_space(job, mesh);
    check_parts(job.mesh.mesh, mesh.file, job.columns);
    SampleParams params = params_on(mesh, job);
    const auto task_at = [&](double min_distance) {
        params.min_distance = min_distance;
        const double room = expected_count(effective_area(mesh.prepared, params), min_distance);
        return Task{domain_of(job, mesh, params), job.method.expected(room)};
    };
    auto [set, done] = device.run(task_at, params.min_distance, job.wanted_count, progress);
    params.min_distance = done.min_distance;
    job.method.check_count(set.samples.size(), params.min_distance * mesh.distance_part,
                           done.run.candidates);
    SampleResult result{
        params, std::move(done), to_rows(mesh, params.min_distance, set.samples), {}, {}, {}};
    if (mesh.prepared.statistics().components > 1) {
        std::vector<std::uint32_t> faces;
        for (const SampleRow& row : result.rows) {
            faces.push_back(row.face);
        }
        result.bare = parts_without(mesh.prepared, faces);
    }
    result.warnings = run_warnings(job, mesh, result);
    return result;
}

void write_sample_file(AtomicFile& file, const SampleJob& job, const MeshInput& mesh,
                       const SampleResult& result, const SampleReport& report) {
    write_samples(file, job.out.target(), report.header(), result.rows, mesh.dimension(),
                  part_columns(mesh.file, job.columns, result.rows));
}

DryRun try_sampling(const SampleJob& job, const MeshInput& mesh, RunDevice& device,
                    ProgressLine& progress) {
    check_space(job, mesh);
    check_parts(job.mesh.mesh, mesh.file, job.columns);
    const SampleParams params = params_on(mesh, job);
    const double room = expected_count(effective_area(mesh.prepared, params), params.min_distance);
    return dry_run_on_device(device, {domain_of(job, mesh, params), job.method.expected(room)},
                             params.min_distance, params.seed, progress);
}

} // namespace geodisk::tools
