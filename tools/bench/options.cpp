#include "bench/options.hpp"

#include <memory>
#include <utility>

#include "files/tuning_file.hpp"
#include "program/arguments.hpp"
#include "program/failure.hpp"
#include "program/human_text.hpp"
#include "program/program.hpp"

namespace geodisk::bench {
namespace {

using tools::add_option;

/// As given: counts like 1e5 are read later.
struct RawOptions {
    Options options;
    std::vector<std::string> counts{"1000", "10000", "100000"};
    std::vector<std::string> scaling_counts{"100",   "300",    "1000",   "3000",   "10000",
                                            "30000", "100000", "300000", "1000000"};
    std::string scaling_samples = "10000";
    std::string scaling_faces = "1000000";
    bool has_counts = false, has_sweep = false;
};

std::vector<double> parse_counts(const std::string& option, const std::vector<std::string>& texts) {
    std::vector<double> counts;
    counts.reserve(texts.size());
    for (const std::string& text : texts) {
        counts.push_back(tools::parse_count(option, text));
    }
    return counts;
}

Options checked(const RawOptions& raw) {
    Options options = raw.options;
    options.runner.sampler.count_trips = options.runner.time_stages;
    if (options.scaling && raw.has_counts) {
        tools::fail_usage("--count and --scaling contradict each other; a sweep "
                          "takes its counts from --scaling-counts");
    }
    if (!options.scaling && raw.has_sweep) {
        tools::fail_usage("options that begin with --scaling- need --scaling as well");
    }
    if (options.tune && (options.scaling || !options.json.empty() || !options.csv.empty())) {
        tools::fail_usage(
            "--tune measures nothing else and contradicts --scaling, --json and --csv");
    }
    if (!options.scaling && !options.plot.empty()) {
        tools::fail_usage("--plot draws sweeps, so it needs --scaling");
    }
    if (options.copies != 0 &&
        (options.tune || options.scaling || !options.json.empty() || !options.csv.empty())) {
        tools::fail_usage("--copies measures nothing else and contradicts --tune, --scaling, "
                          "--json and --csv");
    }
    options.counts = options.scaling ? parse_counts("--scaling-counts", raw.scaling_counts)
                                     : parse_counts("--count", raw.counts);
    options.face_sweep_count = tools::parse_count("--scaling-samples", raw.scaling_samples);
    options.most_faces =
        static_cast<std::uint64_t>(tools::parse_count("--scaling-faces", raw.scaling_faces));
    return options;
}

void add_scaling(CLI::App& app, RawOptions& raw) {
    const char* const group = "Scaling";
    app.add_flag("--scaling", raw.options.scaling,
                 "Vary samples, then triangles, on each mesh, and fit\n"
                 "the exponents of time by least squares")
        ->group(group);
    add_option(app, "--scaling-counts", raw.scaling_counts, "N,...",
               "Sample counts of the first sweep", group)
        ->delimiter(',')
        ->capture_default_str();
    add_option(app, "--scaling-samples", raw.scaling_samples, "N",
               "Sample count of the second sweep, which cuts each\n"
               "triangle into 1, 4, 9, ... of the same surface",
               group)
        ->capture_default_str();
    add_option(app, "--scaling-faces", raw.scaling_faces, "F", "Most triangles of the second sweep",
               group)
        ->capture_default_str();
    add_option(app, "--plot", raw.options.plot, "PREFIX",
               "Draw the sweeps: PREFIX-time-n.svg,\n"
               "PREFIX-time-faces.svg and PREFIX-memory-n.svg",
               group);
}

Reads reads_from(const std::string& name) {
    if (const auto reads = tools::reads_named(name)) {
        return *reads;
    }
    throw CLI::ValidationError("--reads", "\"" + name + "\" is not auto, storage or texels");
}

void add_tuning(CLI::App& app, RunnerOptions& runner, bool& tune) {
    constexpr const char* kGroup = "Tuning, does not change the samples";
    const auto add = [&app](const char* name, std::uint32_t& value, const char* what) {
        add_option(app, name, value, "K", what, kGroup);
    };
    app.add_flag("--tune", tune,
                 "Find out what suits the device and keep it for\n"
                 "geodisk sample and later runs")
        ->group(kGroup);
    add("--slots", runner.plan.slots, "Candidates active at a time");
    add("--lanes", runner.plan.lanes, "Invocations that share the work on them");
    add("--passes", runner.plan.detect_passes, "Dispatches of detect per round");
    add("--steps", runner.plan.step_budget, "Steps of detect per dispatch");
    Tuning& tuning = runner.sampler.tuning;
    add("--batches", tuning.batches, "Batches to aim at, N/T");
    add("--local-size", tuning.local_size, "Invocations per work group, a power of two");
    add("--slot-local-size", tuning.slot_local_size, "The same for kernels per slot and lane");
    add("--pool-block", tuning.pool_block, "Lanes whose memory alternates, a power of two");
    app.add_option_function<std::string>(
           "--reads", [&tuning](const std::string& name) { tuning.reads = reads_from(name); },
           "Through which buffers: auto, storage or texels")
        ->type_name("KIND")
        ->group(kGroup);
}

} // namespace

void add_options(CLI::App& app, void (*run)(const Options&)) {
    const auto raw = std::make_shared<RawOptions>();
    Options& options = raw->options;
    add_option(app, "MESH", options.meshes, "", "Meshes: *.obj, *.ply or builtin:NAME[:RESOLUTION]")
        ->required();
    add_option(app, "-n,--count", raw->counts, "N,...", "Sample counts to aim at")
        ->delimiter(',')
        ->capture_default_str();
    add_option(app, "--repeats", options.repeats, "K", "Runs to take the median of, 1 to 1000")
        ->check(CLI::Range(1, 1000).description(""))
        ->capture_default_str();
    add_option(app, "--warm-ups", options.warm_ups, "K", "Runs before those, 0 to 1000")
        ->check(CLI::Range(0, 1000).description(""))
        ->capture_default_str();
    add_option(app, "--copies", options.copies, "K",
               "Time K copies of each mesh instead: sampled one by one,\n"
               "as one job and as one mesh; counts are those of a copy")
        ->check(CLI::Range(1, 100000).description(""));
    add_option(app, "--device", options.device, "NAME|INDEX",
               "Device by name, index or UUID (geodisk info)");
    app.add_flag("--stages", options.runner.time_stages,
                 "Time each stage on the device and count how long lanes wait\n"
                 "for others; takes a little time itself");
    add_option(app, "--json", options.json, "FILE", "Write rows, fits and circumstances as JSON");
    add_option(app, "--csv", options.csv, "FILE", "Write rows and circumstances as CSV");
    add_scaling(app, *raw);
    add_tuning(app, options.runner, options.tune);
    app.callback([&app, raw, run] {
        raw->has_counts = app.count("--count") > 0;
        raw->has_sweep = app.count("--scaling-counts") + app.count("--scaling-samples") +
                             app.count("--scaling-faces") >
                         0;
        run(checked(*raw));
    });
}

} // namespace geodisk::bench
