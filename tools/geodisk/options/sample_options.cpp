#include "geodisk/options/sample_options.hpp"

#include <utility>

#include "program/failure.hpp"
#include "program/human_text.hpp"
#include "program/program.hpp"

namespace geodisk::tools {
namespace {

bool throws_darts(const SampleOptions& options) {
    return options.method == "pdts";
}

void check_method(const SampleOptions& options) {
    if (options.method != "psdp" && options.method != "pdts") {
        fail_usage("--method: " + in_quotes(options.method) + " is neither psdp nor pdts");
    }
    if (throws_darts(options) && options.has_pool_ratio) {
        fail_usage("--pool-ratio is for --method psdp; with pdts, --throws "
                   "tells how many darts to throw");
    }
    if (!throws_darts(options) && !options.throws.empty()) {
        fail_usage("--throws is for --method pdts; with psdp, --pool-ratio "
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
        if (!value->empty() && !(throws_darts(options) && value == &options.count)) {
            given += given.empty() ? name : std::string(" and ") + name;
            ++count;
        }
    }
    if (count == 0) {
        fail_usage(throws_darts(options)
                       ? "no distance given; with --method pdts give one of --min-distance "
                         "and --radius"
                       : "no distance given; give one of --min-distance, --radius and "
                         "--count");
    }
    if (count > 1) {
        fail_usage(given + " contradict each other; give just one of them");
    }
}

/// A count that candidates, whose index has 32 bits, can reach.
std::uint32_t parse_candidates(const std::string& option, const std::string& text) {
    const double value = parse_count(option, text);
    if (value > kMostCandidates) {
        fail_usage(option + ": " + in_quotes(text) + " is more than the " +
                   grouped(kMostCandidates) + " that are possible");
    }
    return static_cast<std::uint32_t>(value);
}

/// When darts stop.
void parse_stop(const SampleOptions& options, SampleParams& params) {
    if (options.count.empty() && options.throws.empty()) {
        fail_usage("nothing to stop at; with --method pdts give --count, "
                   "--throws or both");
    }
    if (!options.count.empty()) {
        params.stop_count = parse_candidates("--count", options.count);
    }
    if (!options.throws.empty()) {
        params.throws = parse_candidates("--throws", options.throws);
    }
}

/// Straight lines need the space that lengths and lifts do without.
void check_metric(const SampleOptions& options) {
    if (options.metric != "geodesic" && options.metric != "euclidean" &&
        options.metric != "approximate") {
        fail_usage("--metric: " + in_quotes(options.metric) +
                   " is none of geodesic, euclidean and approximate");
    }
    if (options.metric != "geodesic" && options.density.is_given()) {
        fail_usage("--metric " + options.metric +
                   " takes no radii that vary, so none of the "
                   "--density options");
    }
    if (options.metric != "geodesic" && !options.mesh.additions().empty()) {
        fail_usage("--metric " + options.metric +
                   " goes by the coordinates of the mesh file, so it "
                   "takes no --" +
                   options.mesh.additions().front().first);
    }
}

} // namespace

HeaderEntries SampleJob::additions() const {
    HeaderEntries all = mesh.additions();
    for (const auto& addition : density.additions()) {
        all.push_back(addition);
    }
    return all;
}

SampleJob parse_job(const SampleOptions& options) {
    check_method(options);
    check_one_distance(options);
    SampleJob job;
    job.mesh = options.mesh;
    job.density = options.density;
    job.out = options.out;
    job.run = options.run;
    job.metric = options.metric;
    job.throws_darts = throws_darts(options);
    job.counts_calls = options.count_calls;
    if (job.throws_darts) {
        parse_stop(options, job.params);
    }
    if (!options.min_distance.empty()) {
        job.min_distance = parse_length("--min-distance", options.min_distance);
    } else if (!options.radius.empty()) {
        job.min_distance = parse_length("--radius", options.radius);
        job.min_distance->value *= 2;
    } else {
        job.wanted_count = parse_count("--count", options.count);
    }
    job.params.seed = options.run.parsed_seed();
    job.params.pool_ratio = parse_ratio("--pool-ratio", options.pool_ratio, 1, 10000);
    job.runner.pool_bytes = options.run.pool_bytes();
    job.runner.sampler.count_calls = options.count_calls;
    check_metric(options);
    return job;
}

void add_sample_options(CLI::App& command, SampleOptions& options) {
    add_mesh_argument(command, options.mesh, "Mesh to sample");
    add_output_argument(command, options.out);

    const char* const distance = "Distance, give one";
    add_option(command, "-d,--min-distance", options.min_distance, "D",
               "Least distance along the surface, in mesh units,\n"
               "or with % of the bounding-box diagonal",
               distance);
    add_option(command, "-r,--radius", options.radius, "R",
               "Half the least distance; where radii vary, the largest", distance);
    add_option(command, "-n,--count", options.count, "N",
               "Choose the distance that should give about N samples;\n"
               "with --method pdts, stop at exactly N",
               distance);

    add_mesh_options(command, options.mesh);
    add_density_options(command, options.density);

    add_option(command, "--metric", options.metric, "NAME",
               "geodesic: exact, along the surface. For comparison alone,\n"
               "euclidean: straight through space; approximate: a closed\n"
               "form by normals (Bowers et al. 2010)")
        ->capture_default_str();
    const char* const method = "Method";
    add_option(command, "--method", options.method, "NAME",
               "psdp: from a pool of candidates; pdts: throw darts until\n"
               "there are --count samples or --throws darts were thrown",
               method)
        ->capture_default_str();
    add_option(command, "--throws", options.throws, "K",
               "Most darts of pdts, up to 4294967295; fewer samples than\n"
               "--count are then no error. If not given, 1000 for each\n"
               "sample that the surface has room for",
               method);
    add_option(command, "--pool-ratio", options.pool_ratio, "Q",
               "Candidates of psdp per expected sample, 1 to 10000; more\n"
               "leave fewer gaps",
               method)
        ->capture_default_str();

    add_run_options(command, options.run);
    add_output_options(command, options.out);
    command.add_flag("--count-calls", options.count_calls,
                     "Count how often the paper's CheckStatus would call itself;\n"
                     "takes a little time, does not change the samples");
}

} // namespace geodisk::tools
