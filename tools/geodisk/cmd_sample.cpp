#include "geodisk/cmd_sample.hpp"

#include <algorithm>
#include <cmath>
#include <iostream>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <CLI/CLI.hpp>

#include <geodisk/context.hpp>
#include <geodisk/runner.hpp>

#include "common/atomic_file.hpp"
#include "common/number_text.hpp"
#include "common/sample_file.hpp"
#include "common/text.hpp"
#include "common/user_error.hpp"
#include "geodisk/device_run.hpp"
#include "geodisk/mesh_input.hpp"
#include "geodisk/mesh_options.hpp"
#include "geodisk/outputs.hpp"
#include "geodisk/progress.hpp"
#include "geodisk/run_options.hpp"
#include "geodisk/run_outputs.hpp"
#include "geodisk/sample_report.hpp"
#include "program/arguments.hpp"
#include "program/failure.hpp"
#include "program/human_text.hpp"
#include "program/interrupt.hpp"

namespace geodisk::tools {
namespace {

/// Darts for each sample a surface has room for, after which a count counts as out of reach.
constexpr double kDartsPerSample = 1000;

/// As given on the command line.
struct SampleOptions {
    MeshOptions mesh;
    DensityOptions density;
    std::string output;
    std::string min_distance, radius, count, throws;
    std::string method = "psdp", metric = "geodesic", pool_ratio = "20";
    bool has_pool_ratio = false, count_calls = false;
    RunOptions run;

    bool throws_darts() const { return method == "pdts"; }
};

/// The options, checked as far as that is possible without the mesh.
struct SampleRequest {
    std::optional<Length> min_distance;
    double count = 0; ///< When there is no min_distance.
    SampleParams params;
    RunnerOptions runner;

    /// The parameters on a mesh. Where a count alone is to stop the darts, they end at a number
    /// that leaves hardly any gap.
    SampleParams params_on(const MeshInput& mesh) const {
        SampleParams on_mesh = params;
        on_mesh.radii = mesh.radii ? &*mesh.radii : nullptr;
        const double area = effective_area(mesh.prepared, on_mesh);
        on_mesh.min_distance = min_distance
                                   ? distance_on_mesh(*min_distance, mesh.prepared.statistics())
                                   : distance_for_count(area, count);
        if (params.stop_count != 0 && params.throws == 0) {
            const double room = std::max(1.0, expected_count(area, on_mesh.min_distance));
            on_mesh.throws = static_cast<std::uint32_t>(
                std::min<double>(kMostCandidates, std::ceil(kDartsPerSample * room)));
        }
        return on_mesh;
    }
};

void check_method(const SampleOptions& options) {
    if (options.method != "psdp" && options.method != "pdts") {
        throw UserError(ExitCode::usage,
                        "--method: " + in_quotes(options.method) + " is neither psdp nor pdts");
    }
    if (options.throws_darts() && options.has_pool_ratio) {
        throw UserError(ExitCode::usage, "--pool-ratio is for --method psdp; with pdts, --throws "
                                         "tells how many darts to throw");
    }
    if (!options.throws_darts() && !options.throws.empty()) {
        throw UserError(ExitCode::usage, "--throws is for --method pdts; with psdp, --pool-ratio "
                                         "tells how many candidates to draw");
    }
}

void check_one_distance(const SampleOptions& options) {
    std::string given;
    int count = 0;
    for (const auto& [name, value] :
         {std::pair{"--min-distance", &options.min_distance},
          std::pair{"--radius", &options.radius}, std::pair{"--count", &options.count}}) {
        // Darts stop at a count; it tells no distance.
        if (!value->empty() && !(options.throws_darts() && value == &options.count)) {
            given += given.empty() ? name : std::string(" and ") + name;
            ++count;
        }
    }
    if (count == 0) {
        throw UserError(ExitCode::usage,
                        options.throws_darts()
                            ? "no distance given; with --method pdts give one of --min-distance "
                              "and --radius"
                            : "no distance given; give one of --min-distance, --radius and "
                              "--count");
    }
    if (count > 1) {
        throw UserError(ExitCode::usage, given + " contradict each other; give just one of them");
    }
}

/// A count that candidates, whose index has 32 bits, can reach.
std::uint32_t parse_candidates(const std::string& option, const std::string& text) {
    const double value = parse_count(option, text);
    if (value > kMostCandidates) {
        throw UserError(ExitCode::usage, option + ": " + in_quotes(text) + " is more than the " +
                                             grouped(kMostCandidates) + " that are possible");
    }
    return static_cast<std::uint32_t>(value);
}

/// When darts stop.
void parse_stop(const SampleOptions& options, SampleParams& params) {
    if (options.count.empty() && options.throws.empty()) {
        throw UserError(ExitCode::usage, "nothing to stop at; with --method pdts give --count, "
                                         "--throws or both");
    }
    if (!options.count.empty()) {
        params.stop_count = parse_candidates("--count", options.count);
    }
    if (!options.throws.empty()) {
        params.throws = parse_candidates("--throws", options.throws);
    }
}

SampleRequest parse_request(const SampleOptions& options) {
    check_method(options);
    check_one_distance(options);
    SampleRequest request;
    if (options.throws_darts()) {
        parse_stop(options, request.params);
    }
    if (!options.min_distance.empty()) {
        request.min_distance = parse_length("--min-distance", options.min_distance);
    } else if (!options.radius.empty()) {
        request.min_distance = parse_length("--radius", options.radius);
        request.min_distance->value *= 2;
    } else {
        request.count = parse_count("--count", options.count);
    }
    request.params.seed = options.run.parsed_seed();
    request.params.pool_ratio = parse_ratio("--pool-ratio", options.pool_ratio, 1, 10000);
    request.runner.pool_bytes = options.run.pool_bytes();
    return request;
}

/// Straight lines need the space that lengths and lifts do without.
void check_metric(const SampleOptions& options) {
    if (options.metric != "geodesic" && options.metric != "euclidean" &&
        options.metric != "approximate") {
        throw UserError(ExitCode::usage, "--metric: " + in_quotes(options.metric) +
                                             " is none of geodesic, euclidean and approximate");
    }
    if (options.metric != "geodesic" && options.density.is_given()) {
        throw UserError(ExitCode::usage, "--metric " + options.metric +
                                             " takes no radii that vary, so none of the "
                                             "--density options");
    }
    if (options.metric != "geodesic" && !options.mesh.additions().empty()) {
        throw UserError(ExitCode::usage, "--metric " + options.metric +
                                             " goes by the coordinates of the mesh file, so it "
                                             "takes no --" +
                                             options.mesh.additions().front().first);
    }
}

/// Finds out before the work that it would be in vain.
void check_outputs(const SampleOptions& options) {
    std::vector<NamedFile> read;
    for (const std::string& file : options.mesh.files()) {
        read.push_back({"the mesh", file});
    }
    for (const std::string& file : options.density.files()) {
        read.push_back({"the density", file});
    }
    check_distinct({{"the samples", options.output}, {"the report", options.run.json}}, read);
    check_output_path(options.output);
    check_report_path(options.run.json);
}

/// Samples to reckon with, at least one.
double expected_samples(const PreparedMesh& mesh, const SampleParams& params) {
    const double expected =
        std::max(1.0, expected_count(effective_area(mesh, params), params.min_distance));
    return params.stop_count != 0 ? std::min<double>(expected, params.stop_count) : expected;
}

Domain domain_of(const std::string& metric, const MeshInput& mesh, const SampleParams& params) {
    if (metric == "geodesic") {
        return take(Domain::surface(mesh.prepared, params));
    }
    const MeshView view{mesh.file.positions, mesh.file.triangles, mesh.file.dimension};
    return take(
        Domain::surface_in_space(view, mesh.prepared, params,
                                 metric == "euclidean" ? Metric::euclidean : Metric::approximate));
}

std::vector<Sample> sample_on_device(const SampleOptions& options,
                                     const RunnerOptions& runner_options, const MeshInput& mesh,
                                     const Domain& domain, SampleReport& report,
                                     ProgressLine& progress) {
    const Context context =
        open_device(options.run.device, options.run.validate, report.seconds.device, progress);
    report.device = context.report();
    RunnerOptions chosen = runner_options;
    chosen.sampler.count_calls = options.count_calls;
    Runner runner = open_runner(context, chosen, domain, report.seconds.pipelines, progress);
    report.tuning = runner.sampler().tuning();
    progress.begin_stage("sampling");
    const double expected = expected_samples(mesh.prepared, report.params);
    SampleSet set =
        take_run(runner.sample_and_wait(domain, show_progress(progress, expected)), progress);
    check_validation(context);
    report.run = set.report;
    report.samples = set.samples.size();
    report.rho =
        packing_density(effective_area(mesh.prepared, report.params), report.params.min_distance,
                        static_cast<double>(set.samples.size()));
    return std::move(set.samples);
}

/// A count asked for, with no number of darts that would do, must be reached.
void check_count(const SampleRequest& request, const SampleReport& report) {
    if (request.params.throws == 0 && report.samples < request.params.stop_count) {
        throw UserError(ExitCode::usage,
                        "--count: only " + grouped(report.samples) + " of " +
                            grouped(request.params.stop_count) + " samples " +
                            rounded(report.params.min_distance, 6) + " apart found room with " +
                            grouped(report.run.candidates) +
                            " darts; ask for fewer samples, a smaller distance or, with --throws, "
                            "for what there is");
    }
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
    const SampleRequest request = parse_request(options);
    check_metric(options);
    check_outputs(options);
    ProgressLine progress(options.run.quiet);
    const MeshInput mesh = load_mesh(options.mesh, progress, options.density);
    check_dimension(options.output, mesh.dimension());
    if (options.metric != "geodesic" && mesh.dimension() != 3) {
        throw UserError(ExitCode::usage,
                        "--metric " + options.metric +
                            " needs three coordinates per vertex; the mesh has " +
                            (mesh.dimension() == 0 ? "none" : std::to_string(mesh.dimension())));
    }

    SampleReport report;
    report.mesh_path = options.mesh.mesh;
    report.mesh_additions = options.mesh.additions();
    for (const auto& addition : options.density.additions()) {
        report.mesh_additions.push_back(addition);
    }
    report.output_path = options.output;
    report.metric = options.metric;
    report.mesh = mesh.prepared.statistics();
    report.throws_darts = options.throws_darts();
    report.counts_calls = options.count_calls;
    report.params = request.params_on(mesh);
    report.wanted_count = request.count;
    report.seconds.load = mesh.load_seconds;
    report.seconds.prepare = mesh.prepare_seconds;
    // Fails before a device is needed.
    const Domain domain = domain_of(options.metric, mesh, report.params);

    const std::vector<Sample> samples =
        sample_on_device(options, request.runner, mesh, domain, report, progress);
    check_count(request, report);
    const std::vector<SampleRow> rows = to_rows(mesh, report.params.min_distance, samples);
    report.set_radii(rows);
    write_outputs(options.output, options.run, report, progress, [&](AtomicFile& file) {
        write_samples(file, options.output, sample_header(report), rows, options.run.ascii,
                      mesh.dimension());
    });
}

} // namespace

void add_sample_command(CLI::App& app) {
    CLI::App* command =
        app.add_subcommand("sample", "Put samples on a mesh and write them to a file");
    const auto options = std::make_shared<SampleOptions>();
    add_mesh_argument(*command, options->mesh, "Mesh to sample");
    command
        ->add_option("-o,--output", options->output,
                     "File to write: *.ply (binary), *.csv or *.xyz (positions only)")
        ->type_name("OUT")
        ->required();

    const char* const distance = "Distance, give one";
    command
        ->add_option("-d,--min-distance", options->min_distance,
                     "Least distance along the surface, in mesh units,\n"
                     "or with % of the bounding-box diagonal")
        ->type_name("D")
        ->group(distance);
    command
        ->add_option("-r,--radius", options->radius,
                     "Half the least distance; where radii vary, the largest")
        ->type_name("R")
        ->group(distance);
    command
        ->add_option("-n,--count", options->count,
                     "Choose the distance that should give about N samples;\n"
                     "with --method pdts, stop at exactly N")
        ->type_name("N")
        ->group(distance);

    add_mesh_options(*command, options->mesh);
    add_density_options(*command, options->density);

    command
        ->add_option("--metric", options->metric,
                     "geodesic: exact, along the surface. For comparison alone,\n"
                     "euclidean: straight through space; approximate: a closed\n"
                     "form by normals (Bowers et al. 2010)")
        ->type_name("NAME")
        ->capture_default_str();
    const char* const method = "Method";
    command
        ->add_option("--method", options->method,
                     "psdp: from a pool of candidates; pdts: throw darts until\n"
                     "there are --count samples or --throws darts were thrown")
        ->type_name("NAME")
        ->capture_default_str()
        ->group(method);
    command
        ->add_option("--throws", options->throws,
                     "Most darts of pdts, up to 4294967295; fewer samples than\n"
                     "--count are then no error. If not given, 1000 for each\n"
                     "sample that the surface has room for")
        ->type_name("K")
        ->group(method);
    CLI::Option* const pool_ratio =
        command
            ->add_option("--pool-ratio", options->pool_ratio,
                         "Candidates of psdp per expected sample, 1 to 10000; more\n"
                         "leave fewer gaps")
            ->type_name("Q")
            ->capture_default_str()
            ->group(method);

    add_run_options(*command, options->run);
    command->add_flag("--count-calls", options->count_calls,
                      "Count how often the paper's CheckStatus would call itself;\n"
                      "takes a little time, does not change the samples");
    command->callback([options, pool_ratio] {
        options->has_pool_ratio = pool_ratio->count() > 0;
        run_sample(*options);
    });
}

} // namespace geodisk::tools
