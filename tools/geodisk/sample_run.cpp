#include "geodisk/sample_run.hpp"

#include <algorithm>
#include <cstdint>
#include <iterator>
#include <numeric>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <geodisk/request.hpp>

#include "files/meshes/part_columns.hpp"
#include "files/output/block_writer.hpp"
#include "files/samples/sample_columns.hpp"
#include "geodisk/checks/near_pairs.hpp"
#include "geodisk/inputs/existing_input.hpp"
#include "geodisk/outputs/outputs.hpp"
#include "geodisk/records.hpp"
#include "geodisk/update_run.hpp"
#include "geometry/set_warnings.hpp"
#include "program/failure.hpp"
#include "program/human_text.hpp"

namespace geodisk::tools {
namespace {

/// Refuses what goes by the faces of the file, where samples are drawn on parts of them.
void check_split(const SampleJob& job, const MeshInput& mesh, const RunDevice& device) {
    const char* const what = job.features           ? "--features goes"
                             : job.at_vertices      ? "--at-vertices goes"
                             : !job.from.empty()    ? "--from goes"
                             : device.has_sampler() ? "geodisk_mpi goes"
                                                    : nullptr;
    if (mesh.split && what != nullptr) {
        fail_usage(std::string(what) + " with no image that shows more than the corners of faces; "
                                       "split the faces where it has detail");
    }
}

void check_space(const SampleJob& job, const MeshInput& mesh) {
    if (!job.is_geodesic() && mesh.dimension() != 3) {
        fail_usage("--metric " + metric_name(job.metric) +
                   " needs three coordinates per vertex; the mesh has " +
                   (mesh.dimension() == 0 ? "none" : std::to_string(mesh.dimension())));
    }
    if (job.features && mesh.dimension() == 0) {
        fail_usage("--features needs the coordinates of the mesh, and it has edge lengths alone");
    }
}

void check_on(const MeshInput& mesh, const SampleJob& job, const RunDevice& device) {
    check_space(job, mesh);
    check_split(job, mesh, device);
    check_record(job.out.record, mesh);
    check_parts(mesh.path, mesh.file, job.columns);
}

/// Returns the parameters of a job with existing samples and points to avoid.
SampleParams params_with(const ExistingInput& given, const MeshInput& mesh, const SampleJob& job) {
    SampleParams params = params_on(mesh, job);
    params.existing = given.samples;
    params.existing_classes = given.classes;
    params.avoid = given.avoided;
    params.avoid_classes = given.avoid_classes;
    return params;
}

/// Returns what the job asks for on a mesh, in the frame of another unless it is null. The view
/// must outlive it.
SampleRequest request_of(const SampleJob& job, const MeshInput& mesh, const SampleParams& params,
                         const MeshView& view, const JobFrame* frame = nullptr) {
    SampleRequest request;
    request.params = params;
    request.count = job.wanted_count.samples;
    request.is_exact = job.wanted_count.is_exact;
    request.features = job.features.value_or(0);
    request.at_vertices = job.at_vertices;
    request.class_counts = job.method.class_counts;
    request.order = job.method.has_levels ? SampleOrder::progressive : SampleOrder::dart;
    request.levels = job.method.levels;
    request.metric = job.metric;
    request.view = &view;
    request.frame = frame;
    request.split_from = job.is_geodesic() && mesh.split ? &mesh.prepared : nullptr;
    return request;
}

std::vector<SampleRow> to_rows(const MeshInput& mesh, double min_distance,
                               const std::vector<Sample>& samples) {
    std::vector<SampleRow> rows(samples.size());
    for_rows(rows.size(), [&](std::size_t i) {
        const Sample sample = mesh.in_file(samples[i]);
        SampleRow& row = rows[i];
        row.face = sample.face;
        std::copy_n(sample.weights, 3, row.bary);
        mesh.place(row);
        row.radius = mesh.radius(sample.face, sample.weights, min_distance);
    });
    return rows;
}

/// Reports the existing samples, the first of `result`.
void note_existing(const SampleJob& job, const MeshInput& mesh, SampleResult& result,
                   ProgressLine& progress) {
    const auto rows = std::span(result.rows).first(result.existing);
    std::vector<double> radii;
    for (const SampleRow& row : rows) {
        radii.push_back(mesh.radii ? row.radius : result.params.min_distance / 2);
    }
    PairDistances distances{radii};
    if (job.classes.count > 1) {
        distances = {radii, std::span(result.classes).first(result.existing), job.classes,
                     result.params.min_distance};
    }
    const std::vector<std::uint32_t> all(rows.size(), 1);
    result.among_existing = check_spacing(mesh, rows, distances, all, progress).among_existing;
    const SpacingResult& found = result.among_existing;
    if (found.violations.empty()) {
        return;
    }
    const ClosePair& closest = *found.closest;
    result.warnings.push_back(
        {"existing_too_close", found.violations.size(), "",
         found.pairs_text() +
             " of existing samples closer than the minimum distance; they are kept. The closest "
             "are samples " +
             std::to_string(closest.row_a) + " and " + std::to_string(closest.row_b) + ", at " +
             rounded(closest.distance, 6),
         job.constraints.existing});
}

/// Returns the vertex of the file that each row is at.
std::vector<std::uint32_t> vertices_of(const MeshInput& mesh, std::span<const SampleRow> rows) {
    std::vector<std::uint32_t> vertices(rows.size(), kNoPart);
    for (std::size_t i = 0; i < rows.size(); ++i) {
        const auto* const at = std::ranges::find(rows[i].bary, 1.0f);
        if (at != std::end(rows[i].bary)) {
            const std::size_t corner =
                std::size_t{3} * rows[i].face + static_cast<std::size_t>(at - rows[i].bary);
            vertices[i] =
                mesh.file.file_vertex(mesh.file.triangles[corner], mesh.prepared.vertex_count());
        }
    }
    return vertices;
}

/// The columns that the file has besides those that all have.
std::vector<ExtraColumn> extra_columns(const SampleJob& job, const MeshInput& mesh,
                                       const SampleResult& result) {
    std::vector<ExtraColumn> columns = part_columns(mesh.file, job.columns, result.rows);
    if (result.existing > 0 && takes_column(job.out, kExistingColumn)) {
        ExtraColumn existing{std::string(kExistingColumn),
                             std::vector<std::uint32_t>(result.rows.size())};
        std::fill_n(existing.values.begin(), result.existing, 1);
        columns.push_back(std::move(existing));
    }
    if (job.features && takes_column(job.out, kFeatureColumn)) {
        columns.push_back({std::string(kFeatureColumn), result.features});
    }
    if (job.at_vertices && takes_column(job.out, kVertexColumn)) {
        columns.push_back({std::string(kVertexColumn), vertices_of(mesh, result.rows)});
    }
    if (job.classes.is_given()) {
        columns.push_back({std::string(kClassColumn), result.classes});
    }
    if (result.levels && takes_column(job.out, kLevelColumn)) {
        ExtraColumn level{std::string(kLevelColumn), {}};
        std::uint32_t number = 0;
        for (const std::size_t end : result.done.ends) {
            level.values.resize(end, number++);
        }
        columns.push_back(std::move(level));
    }
    return columns;
}

/// Returns the frame of a pool if the mesh and the distance in the header may not say it.
std::optional<JobFrame> frame_to_tell(const SampleJob& job, const MeshInput& mesh,
                                      const SampleParams& params,
                                      const std::optional<UpdateRun>& update) {
    if (update) {
        return update->frame();
    }
    if (job.is_geodesic() && mesh.split) {
        return take(frame_of(mesh.sampled(), params, mesh.prepared));
    }
    return job.is_geodesic() && mesh.distance_part != 1
               ? std::optional(take(frame_of(mesh.prepared, params)))
               : std::nullopt;
}

/// Puts the samples in farthest-point order, and leaves out those that are not to be kept.
void put_farthest_first(const SampleJob& job, const MeshInput& mesh, RunDevice& device,
                        ProgressLine& progress, SampleResult& result) {
    FarthestParams params{job.method.keep};
    params.existing = static_cast<std::uint32_t>(result.existing);
    const FarthestRun& run =
        result.farthest.emplace(order_farthest(mesh, result.rows, params, device, progress));
    run.apply(result.rows);
    run.apply(result.classes);
    run.apply(result.features);
}

} // namespace

std::vector<MeshWarning> run_warnings(const SampleJob& job, const MeshInput& mesh,
                                      const SampleResult& result, bool lacks_features) {
    std::vector<MeshWarning> warnings =
        set_warnings({.samples = result.count(),
                      .existing = result.existing,
                      .avoids = result.avoided > 0 || result.avoided_length > 0,
                      .min_distance = result.params.min_distance * mesh.distance_part,
                      .wanted_count = job.wanted_count.samples,
                      .cut = result.done.cut,
                      .stop_count = job.method.params.stop_count,
                      .has_darts = job.method.params.darts > 0,
                      .lacks_features = lacks_features ? *job.features : 0,
                      .bare = result.bare});
    for (std::uint32_t number = 0; number < job.classes.count && result.count() > 0; ++number) {
        if (std::ranges::find(result.classes, number) == result.classes.end()) {
            warnings.push_back(
                {"empty_class", 1, "", "class " + std::to_string(number) + " has no sample", ""});
        }
    }
    for (MeshWarning& warning : warnings) {
        warning.file = job.mesh.mesh;
    }
    return warnings;
}

SampleParams params_on(const MeshInput& mesh, const SampleJob& job) {
    SampleParams params = mesh.with_fields(job.params);
    params.class_factors = job.class_factors;
    const double area = mesh.effective_area(params);
    params.min_distance =
        job.min_distance
            ? distance_on_mesh(*job.min_distance, mesh.prepared.statistics()) / mesh.distance_part
            : mesh.distance_for_count(params, job.wanted_count.samples) *
                  job.method.distance_factor();
    params.darts = job.method.darts_for(expected_count(area, params.min_distance));
    return params;
}

std::vector<NamedFile> files_read(const SampleJob& job) {
    std::vector<NamedFile> read;
    job.mesh.add_files(read, "the mesh");
    job.density.add_files(read, "the density");
    job.mask.add_files(read);
    job.constraints.add_files(read);
    add_class_file(job.classes_option, read);
    read.push_back({"the mesh before", job.from, job.mesh.format});
    read.push_back({"the samples before", job.update});
    return read;
}

void check_target(const SampleJob& job, const MeshInput& mesh) {
    check_dimension(job.out.target(), mesh.dimension());
    if (job.classes.is_given()) {
        check_columns(job.out.target(), std::vector{std::string(kClassColumn)});
    }
}

RunDevice device_for(const SampleJob& job) {
    return RunDevice(job.run.device, job.runner, !job.picture.empty());
}

SampleResult sample_mesh(const SampleJob& job, const MeshInput& mesh, RunDevice& device,
                         ProgressLine& progress) {
    check_on(mesh, job, device);
    if (job.method.is_farthest) { // Before any work.
        device.open(progress);
        take(check_farthest_order(device.runner(), mesh.prepared));
    }
    ExistingInput given = load_existing(job, mesh, progress);
    SampleParams params = params_with(given, mesh, job);
    std::optional<UpdateRun> update;
    if (!job.from.empty()) {
        update.emplace(job, mesh, progress);
        params.min_distance = update->min_distance();
    }
    const MeshView view = mesh.sampled_view();
    auto request = RequestRun::create(
        mesh.sampled(), request_of(job, mesh, params, view, update ? &update->frame() : nullptr));
    RequestRun run = take(std::move(request), update ? edit_text(job) : "");
    if (update && update->has_samples()) {
        device.sample_by(&*update);
    }
    auto [found, done] = device.run(std::move(run), progress);
    if (update && update->has_samples()) {
        device.sample_by(nullptr); // It ends with this run.
    }
    const SampleSet& set = found.set;
    params.min_distance = done.min_distance;
    if (set.samples.empty() && !given.avoided.empty()) {
        const bool has_all = !job.constraints.avoid.empty();
        fail_usage(std::string(has_all ? "--avoid" : "--class-avoid") + ": none of " +
                   grouped(done.run.candidates) +
                   " candidates lies outside the radii of the points; lower them");
    }
    job.method.check_count(set.samples.size(), params.min_distance * mesh.distance_part,
                           done.run.candidates);
    job.method.check_classes(set.classes, params.min_distance * mesh.distance_part,
                             done.run.candidates);
    params.existing = {};
    params.existing_classes = {};
    params.avoid = {};
    params.avoid_classes = {};
    SampleResult result;
    result.frame = frame_to_tell(job, mesh, params, update);
    result.params = params;
    result.done = std::move(done);
    result.rows = to_rows(mesh, params.min_distance, set.samples);
    set_normals(job.out.record, mesh, result.rows);
    result.existing = given.samples.size();
    result.features.assign(set.samples.size(), 0);
    std::ranges::transform(found.features, result.features.begin(),
                           [](FeatureKind kind) { return static_cast<std::uint32_t>(kind); });
    result.feature_corners = found.corners;
    result.feature_length = found.feature_length;
    result.classes.assign(set.classes.begin(), set.classes.end());
    result.classes.resize(result.rows.size()); // A single class has no table.
    for (std::size_t i = 0; i < result.rows.size() && job.classes.has_radii(); ++i) {
        result.rows[i].radius = job.classes.radius(result.classes[i], params.min_distance);
    }
    if (found.levels.count > 0) {
        result.levels = found.levels;
    }
    result.avoided = given.points_to_avoid;
    result.avoided_length = given.lines_to_avoid;
    result.scene = scene_frame(job.out, job.mesh, mesh);
    std::vector<std::uint32_t> faces;
    for (const SampleRow& row : result.rows) {
        faces.push_back(mesh.sampled_of(row).face);
    }
    result.bare = parts_without(mesh.sampled(), faces, params.face_mask);
    result.warnings = run_warnings(job, mesh, result, found.lacks_features);
    result.warnings.insert(result.warnings.begin(), given.warnings.begin(), given.warnings.end());
    if (update && update->warning()) {
        result.warnings.push_back(*update->warning());
    }
    if (result.existing > 0) {
        note_existing(job, mesh, result, progress);
    }
    if (job.method.is_farthest) {
        put_farthest_first(job, mesh, device, progress, result);
    }
    return result;
}

void write_sample_file(AtomicFile& file, const SampleJob& job, const MeshInput& mesh,
                       const SampleResult& result, const SampleReport& report) {
    const std::vector<ExtraColumn> numbers = extra_columns(job, mesh, result);
    std::vector<SampleField> fields =
        record_fields(mesh, result.rows, job.params.seed, frame_style(job.out, job.mesh));
    if (result.farthest && takes_column(job.out, kCoverColumn)) {
        std::ranges::copy(result.farthest->columns(), std::back_inserter(fields));
    }
    write_samples(file, target_in(job.out, result.scene), report.header(), result.rows,
                  mesh.dimension(), {numbers, fields});
}

DryRun try_sampling(const SampleJob& job, const MeshInput& mesh, RunDevice& device,
                    ProgressLine& progress) {
    check_on(mesh, job, device);
    const ExistingInput given = load_existing(job, mesh, progress);
    SampleParams params = params_with(given, mesh, job);
    const MeshView view = mesh.sampled_view();
    SampleRequest request = request_of(job, mesh, params, view);
    request.count = 0; // Just the first distance is tried, and the faces at once.
    request.is_exact = false;
    request.features = 0;
    request.order = SampleOrder::dart;
    DryRun run = dry_run_on_device(device, take(RequestRun::create(mesh.sampled(), request)),
                                   params.seed, progress);
    if (const auto& counts = job.method.class_counts; !counts.empty()) {
        run.expected = std::min(run.expected, std::accumulate(counts.begin(), counts.end(), 0.0));
    }
    return run;
}

} // namespace geodisk::tools
