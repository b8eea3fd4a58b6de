#include <algorithm>
#include <memory>
#include <utility>
#include <vector>

#include <geodisk/domain.hpp>

#include "geodisk/commands/commands.hpp"
#include "geodisk/device_run.hpp"
#include "geodisk/inputs/mesh_input.hpp"
#include "geodisk/options/sample_options.hpp"
#include "geodisk/outputs/outputs.hpp"
#include "geodisk/reports/sample_report.hpp"
#include "program/failure.hpp"
#include "program/human_text.hpp"
#include "program/program.hpp"

namespace geodisk::tools {
namespace {

/// Finds out before the work that it would be in vain.
void check_files(const SampleJob& job) {
    std::vector<NamedFile> read;
    job.mesh.add_files(read, "the mesh");
    job.density.add_files(read, "the density");
    check_outputs(job.out, "the samples", read);
}

void check_dimensions(const SampleJob& job, const MeshInput& mesh) {
    check_dimension(job.out.output, mesh.dimension());
    if (!job.is_geodesic() && mesh.dimension() != 3) {
        fail_usage("--metric " + job.metric + " needs three coordinates per vertex; the mesh has " +
                   (mesh.dimension() == 0 ? "none" : std::to_string(mesh.dimension())));
    }
}

SampleParams params_on(const MeshInput& mesh, const SampleJob& job) {
    SampleParams params = job.params;
    params.radii = mesh.radii ? &*mesh.radii : nullptr;
    const double area = effective_area(mesh.prepared, params);
    params.min_distance = job.min_distance
                              ? distance_on_mesh(*job.min_distance, mesh.prepared.statistics())
                              : distance_for_count(mesh.prepared, params.radii, job.wanted_count);
    params.throws = job.method.throws_for(expected_count(area, params.min_distance));
    return params;
}

Domain domain_of(const SampleJob& job, const MeshInput& mesh, const SampleParams& params) {
    if (job.is_geodesic()) {
        return take(Domain::surface(mesh.prepared, params));
    }
    const MeshView view{mesh.file.positions, mesh.file.triangles, mesh.file.dimension};
    return take(Domain::surface_in_space(view, mesh.prepared, params,
                                         job.metric == "euclidean" ? Metric::euclidean
                                                                   : Metric::approximate));
}

std::vector<SampleRow> to_rows(const MeshInput& mesh, double min_distance,
                               const std::vector<Sample>& samples) {
    std::vector<SampleRow> rows;
    rows.reserve(samples.size());
    for (const Sample& sample : samples) {
        SampleRow row;
        row.face = sample.face;
        std::copy_n(sample.weights, 3, row.bary);
        mesh.place(row);
        row.radius = mesh.radius(sample.face, sample.weights, min_distance);
        rows.push_back(row);
    }
    return rows;
}

void run_sample(const SampleOptions& options) {
    const SampleJob job = parse_job(options);
    check_files(job);
    ProgressLine progress(job.out.quiet);
    const MeshInput mesh = load_mesh(job.mesh, progress, job.density);
    check_dimensions(job, mesh);

    SampleParams params = params_on(mesh, job);
    const auto task_at = [&](double min_distance) {
        params.min_distance = min_distance;
        const double room = expected_count(effective_area(mesh.prepared, params), min_distance);
        return Task{domain_of(job, mesh, params), job.method.expected(room)};
    };
    auto [set, done] = run_on_device(job.run, job.runner, task_at, params.min_distance,
                                     job.wanted_count, progress);
    params.min_distance = done.min_distance;
    job.method.check_count(set.samples.size(), params.min_distance, done.run.candidates);
    const SampleResult result{params, std::move(done),
                              to_rows(mesh, params.min_distance, set.samples)};

    const SampleReport report(job, mesh, result);
    write_outputs(job.out, "the samples", progress, report, [&](AtomicFile& file) {
        write_samples(file, job.out.output, report.header(), result.rows, job.out.ascii,
                      mesh.dimension());
    });
}

} // namespace

void add_sample_command(CLI::App& app) {
    CLI::App* command =
        app.add_subcommand("sample", "Put samples on a mesh and write them to a file");
    const auto options = std::make_shared<SampleOptions>();
    add_sample_options(*command, *options);
    command->callback([options] { run_sample(*options); });
}

} // namespace geodisk::tools
