#include "ranged_sample.hpp"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <geodisk/job_frame.hpp>

#include "files/input_file.hpp"
#include "files/meshes/value_fields.hpp"
#include "files/samples/row_format.hpp"
#include "files/samples/sample_format.hpp"
#include "geodisk/inputs/mesh_input.hpp"
#include "geodisk/outputs/outputs.hpp"
#include "geodisk/reports/sample_report.hpp"
#include "geodisk/sample_run.hpp"
#include "program/failure.hpp"
#include "program/safe_text.hpp"
#include "program/stopwatch.hpp"
#include "session.hpp"

namespace geodisk::tools {
namespace {

/// Thrown for a job that needs the whole surface.
struct TakesWhole {
    std::string why;
};

/// Returns true for radii and a mask that each process takes from its range of the file.
bool has_ranged_fields(const SampleJob& job) {
    const auto density = job.density.source();
    return (!density || density->kind == DensitySource::Kind::attribute) && job.mask.only.empty() &&
           std::ranges::none_of(job.mask.mask_rules(), [](const MaskRule& rule) {
               return rule.is_map || value_file(rule.name);
           });
}

/// Returns true for a job that needs no more of a mesh than its faces and properties, and a file
/// that may be read in ranges.
bool takes_ranges(const SampleJob& job) {
    const bool is_plain = job.mesh.additions().empty() && job.out.record.entries().empty() &&
                          job.mesh.texture.empty() && !job.constraints.is_given();
    const bool has_more = job.features || job.method.has_levels || job.method.is_farthest ||
                          !job.picture.empty() || !job.columns.empty() ||
                          (!job.out.output.empty() && facts_of(job.out.target().format).is_scene());
    return is_plain && !has_more && has_ranged_fields(job) &&
           lower_extension(job.mesh.mesh) == ".ply";
}

/// Returns true for what nobody can read, of which reading the whole tells.
bool is_unreadable(const Path& path) {
    std::error_code error;
    const std::filesystem::file_status status = std::filesystem::status(path, error);
    return !std::filesystem::exists(status) || std::filesystem::is_directory(status) ||
           (std::filesystem::is_regular_file(status) && !std::ifstream(path));
}

/// Returns a mesh of the statistics of all, whose file has no faces yet.
MeshInput outline_of(const SharedSurface& surface, const SampleJob& job, double load_seconds) {
    const RangedStatistics& statistics = surface.statistics();
    MeshInput mesh{{}, surface.outline(), std::nullopt, {}, 1, {}, load_seconds, 0};
    mesh.known = {statistics.effective_area, statistics.borders, statistics.masked_faces,
                  statistics.digest};
    if (const RadiusField* const radii = surface.radii()) {
        mesh.radii = *radii;
        mesh.distance_part = job.density.is_density() ? radii->min_factor() : 1;
    }
    mesh.file.positions.assign(3, 0); // There are coordinates.
    mesh.path = job.mesh.mesh;
    mesh.additions = with_entries(job.density.added_to(job.mesh.additions()), job.mask);
    const auto warn = [&](const char* kind, std::uint64_t count, const char* one,
                          const char* many) {
        add_warning(mesh.warnings, kind, count, "", one, many);
    };
    warn("unused_vertices", statistics.unused_vertices, "vertex is in no face",
         "vertices are in no face");
    warn_of_repeated_vertices(mesh.warnings, statistics.mesh.repeated_index_faces, "");
    warn("zero_area_faces", statistics.mesh.zero_area_faces,
         "triangle without area kept: paths may lead through it",
         "triangles without area kept: paths may lead through them");
    warn("nonmanifold_edges", statistics.mesh.nonmanifold_edges,
         "edge joins three or more faces; distances count paths across all of them",
         "edges join three or more faces; distances count paths across all of them");
    warn("inconsistent_orientation", statistics.turned_edges,
         "edge has faces turned over against each other; distances do not depend on that",
         "edges have faces turned over against each other; distances do not depend on that");
    if (statistics.mesh.components > 1) {
        warn("components", statistics.mesh.components, "",
             "components: no path leads from one to another");
    }
    for (MeshWarning& warning : mesh.warnings) {
        warning.file = mesh.path;
    }
    if (auto warning = job.density.warning()) {
        mesh.warnings.push_back(std::move(*warning));
    }
    return mesh;
}

/// A triangle that the frame of a job fits, for kernels to be compiled for.
struct StandIn {
    PreparedMesh mesh;
    std::optional<RadiusField> radii;
    SampleParams params;

    StandIn(const SharedSurface& surface, const SampleJob& job, const SampleParams& of_all)
        : params(of_all) {
        const double edge =
            std::min(of_all.min_distance, surface.statistics().mesh.longest_edge) / 2;
        const std::vector<double> positions{0, 0, 0, edge, 0, 0, 0, edge, 0};
        const std::vector<std::uint32_t> triangles{0, 1, 2};
        mesh = take(PreparedMesh::prepare(MeshView{positions, triangles, 3}));
        if (surface.radii() != nullptr) {
            const std::vector<double> ones{1, 1, 1};
            radii = take(job.density.is_density() ? RadiusField::from_density(mesh, ones)
                                                  : RadiusField::prepare(mesh, ones));
            params.radii = &*radii;
        }
    }
};

/// Returns the frame if the distance that a file tells, `part` times that of the job, has another.
std::optional<JobFrame> frame_to_tell(const SharedSurface& surface, const SampleParams& params,
                                      double part) {
    SampleParams told = params;
    told.min_distance = params.min_distance * part / part;
    const JobFrame frame = take(surface.frame(params));
    const auto plain = surface.frame(told);
    return plain && decide_alike(frame, *plain) ? std::nullopt : std::optional(frame);
}

SampleResult sample_ranged(const SampleJob& job, MeshInput& mesh, Session& session,
                           ProgressLine& progress) {
    const SharedSurface& surface = *session.ranges();
    SampleParams params = params_on(mesh, job);
    std::optional<StandIn> triangle;
    std::optional<TakesWhole> needs;
    const auto step_at = [&](double min_distance) -> Result<RequestStep> {
        params.min_distance = min_distance;
        const auto frame = surface.frame(params);
        if (!frame) {
            if (frame.error().status == Status::mesh_rejected) {
                needs = TakesWhole{frame.error().message};
            }
            return frame.error();
        }
        triangle.emplace(surface, job, params);
        auto domain = Domain::surface(triangle->mesh, triangle->params, *frame);
        if (!domain) {
            return domain.error();
        }
        RequestStep step{std::move(*domain), params, &mesh.prepared};
        step.expected =
            job.method.expected(expected_count(mesh.effective_area(params), min_distance));
        return step;
    };
    auto request = RequestRun::create(step_at, params.min_distance, job.wanted_count.samples,
                                      job.wanted_count.is_exact);
    if (needs) {
        throw TakesWhole(*needs);
    }
    RequestRun begun = take(std::move(request));
    RunDevice device = device_for(job);
    device.sample_by(&session);
    auto [found, done] = [&] {
        try {
            return device.run(std::move(begun), progress);
        } catch (const UserError&) {
            if (needs) { // The search for a count came to a distance that takes the whole.
                throw TakesWhole(*needs);
            }
            throw;
        }
    }();
    const SampleSet& set = found.set;
    params.min_distance = done.min_distance;
    job.method.check_count(set.samples.size(), params.min_distance * mesh.distance_part,
                           done.run.candidates);
    SampleResult result;
    if (!job.min_distance) {
        result.frame = frame_to_tell(surface, params, mesh.distance_part);
    }
    result.params = params;
    result.done = std::move(done);
    const bool divides = RowFormat::is_one(job.out.target().format);
    RangedRows& rows =
        session.call<make_ranged_rows>(RowsCall{set.samples, params.min_distance, divides});
    if (divides) {
        result.all = AllRows{rows.count, rows.digest, rows.radii};
    } else {
        result.rows = std::move(rows.own);
    }
    result.classes.resize(result.rows.size());
    result.features.resize(result.rows.size());
    result.warnings = run_warnings(job, mesh, result);
    return result;
}

/// Tells why the first process reads the whole, unless it is to be quiet.
void print_note(const SampleJob& job, const std::string& why) {
    if (!job.out.quiet) {
        std::cerr << "geodisk_mpi: note: process 0 reads all of " << one_line(job.mesh.mesh) << ": "
                  << one_line(why) << '\n';
    }
}

} // namespace

bool sample_ranges_to_files(const SampleOptions& options, std::uint32_t parts, Session& session) {
    check_output_or_dry_run(options.out);
    const SampleJob job = parse_job(options);
    const std::string& path = job.mesh.mesh;
    if (!takes_ranges(job) || is_unreadable(path)) {
        return false;
    }
    check_outputs(job.out, "the samples", files_read(job));
    ProgressLine progress(job.out.quiet);
    progress.begin_stage("reading the mesh");
    const Stopwatch watch;
    const auto why = session.call<read_ranges>(ReadCall{job, parts});
    progress.clear();
    if (why) {
        print_note(job, *why);
        return false;
    }
    MeshInput mesh = outline_of(*session.ranges(), job, watch.seconds());
    check_target(job, mesh);
    try {
        const SampleResult result = sample_ranged(job, mesh, session, progress);
        print_warnings(mesh.warnings);
        print_warnings(result.warnings);
        progress.clear();
        print_precision_note(job.out, result.rows, mesh.dimension());
        const SampleReport report(job, mesh, result);
        write_outputs(job.out, "the samples", progress, report, [&](AtomicFile& file) {
            if (result.all) {
                const SampleTarget target = job.out.target();
                const SampleHeader header = report.header();
                session.call<write_ranged_rows>(WriteCall{file, target, header});
            } else {
                write_sample_file(file, job, mesh, result, report);
            }
        });
    } catch (const TakesWhole& needs) {
        session.call<forget_ranges>(Done{});
        print_note(job, needs.why);
        return false;
    }
    return true;
}

} // namespace geodisk::tools
