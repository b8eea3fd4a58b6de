#include "bench/options.hpp"

#include <algorithm>
#include <memory>

#include "files/tuning_file.hpp"
#include "program/arguments.hpp"
#include "program/command.hpp"
#include "program/failure.hpp"
#include "program/human_text.hpp"

namespace geodisk::bench {
namespace {

using tools::Command;
using tools::Option;

/// As given: counts like 1e5 are read later.
struct RawOptions {
    Options options;
    std::vector<std::string> counts{"1000", "10000", "100000"};
    std::vector<std::string> scaling_counts{"100",   "300",    "1000",   "3000",   "10000",
                                            "30000", "100000", "300000", "1000000"};
    std::string seed = "1";
    std::string scaling_samples = "10000";
    std::string scaling_faces = "1000000";
    Option counts_option;
    std::vector<Option> sweep_options;
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
    if (options.scaling && raw.counts_option.is_given()) {
        tools::fail_usage("--count and --scaling contradict each other; a sweep "
                          "takes its counts from --scaling-counts");
    }
    if (!options.scaling && std::any_of(raw.sweep_options.begin(), raw.sweep_options.end(),
                                        [](Option option) { return option.is_given(); })) {
        tools::fail_usage("options that begin with --scaling- need --scaling");
    }
    if (options.tune && (options.scaling || !options.json.empty() || !options.csv.empty())) {
        tools::fail_usage(
            "--tune measures nothing else and contradicts --scaling, --json and --csv");
    }
    if (options.copies != 0 &&
        (options.tune || options.scaling || !options.json.empty() || !options.csv.empty())) {
        tools::fail_usage("--copies measures nothing else and contradicts --tune, --scaling, "
                          "--json and --csv");
    }
    options.counts = options.scaling ? parse_counts("--scaling-counts", raw.scaling_counts)
                                     : parse_counts("--count", raw.counts);
    options.seed = tools::parse_seed("--seed", raw.seed);
    options.face_sweep_count = tools::parse_count("--scaling-samples", raw.scaling_samples);
    options.max_faces =
        static_cast<std::uint64_t>(tools::parse_count("--scaling-faces", raw.scaling_faces));
    return options;
}

void add_scaling(Command app, RawOptions& raw) {
    const char* const group = "Scaling";
    app.add_flag("--scaling", raw.options.scaling,
                 "Vary samples, then triangles, on each mesh, and fit\n"
                 "the exponents of time by least squares",
                 group);
    raw.sweep_options.push_back(app.add_option("--scaling-counts", raw.scaling_counts, "N,...",
                                               "Sample counts of the first sweep", group)
                                    .takes_commas()
                                    .shows_default());
    raw.sweep_options.push_back(app.add_option("--scaling-samples", raw.scaling_samples, "N",
                                               "Sample count of the second sweep, which cuts each\n"
                                               "triangle into 1, 4, 9, ... of the same surface",
                                               group)
                                    .shows_default());
    raw.sweep_options.push_back(app.add_option("--scaling-faces", raw.scaling_faces, "F",
                                               "Maximum of triangles in the second sweep", group)
                                    .shows_default());
}

Reads reads_from(const std::string& name) {
    if (const auto reads = tools::reads_named(name)) {
        return *reads;
    }
    tools::fail_usage("--reads: \"" + name + "\" is not auto, storage or texels");
}

DisksBy disks_by_from(const std::string& name) {
    if (name != "lanes" && name != "groups") {
        tools::fail_usage("--disks-by: \"" + name + "\" is not lanes or groups");
    }
    return name == "lanes" ? DisksBy::lanes : DisksBy::groups;
}

void add_tuning(Command app, RunnerOptions& runner, bool& tune) {
    constexpr const char* kGroup = "Tuning, does not change the samples";
    const auto add = [&app](const char* name, std::uint32_t& value, const char* what) {
        app.add_option(name, value, "K", what, kGroup);
    };
    app.add_flag("--tune", tune,
                 "Find the best tuning of the device and save it for\n"
                 "geodisk sample and later runs; settings given stay",
                 kGroup);
    add("--slots", runner.plan.slots, "Candidates active at a time");
    add("--lanes", runner.plan.lanes, "Invocations that compute their disks, or groups of them");
    app.add_reader(
        "--disks-by",
        [&runner](const std::string& name) { runner.plan.disks_by = disks_by_from(name); }, "WHO",
        "Who computes a disk: lanes, each its own, or groups of them", kGroup);
    add("--passes", runner.plan.detect_passes, "Dispatches of detect per round");
    add("--steps", runner.plan.step_budget, "Steps of detect per dispatch");
    Tuning& tuning = runner.sampler.tuning;
    add("--batches", tuning.batches, "Target number of batches, N/T");
    add("--local-size", tuning.local_size, "Invocations per work group, a power of two");
    add("--slot-local-size", tuning.slot_local_size,
        "Invocations per work group of kernels over slots and lanes");
    add("--group-lanes", tuning.group_lanes,
        "Invocations that compute a disk together, a power of two");
    add("--pool-block", tuning.pool_block, "Lanes whose rows alternate in memory, a power of two");
    app.add_reader(
        "--reads", [&tuning](const std::string& name) { tuning.reads = reads_from(name); }, "KIND",
        "Buffers to read through: auto, storage or texels", kGroup);
}

} // namespace

void add_options(Command app, void (*run)(const Options&)) {
    const auto raw = std::make_shared<RawOptions>();
    Options& options = raw->options;
    app.add_option("MESH", options.meshes, "", "Meshes: *.obj, *.ply or builtin:NAME[:RESOLUTION]")
        .required();
    raw->counts_option = app.add_option("-n,--count", raw->counts, "N,...", "Target sample counts")
                             .takes_commas()
                             .shows_default();
    app.add_option("--repeats", options.repeats, "K", "Runs to take the median of, 1 to 1000")
        .takes_range(1, 1000)
        .shows_default();
    app.add_option("--warm-ups", options.warm_ups, "K", "Runs before those, 0 to 1000")
        .takes_range(0, 1000)
        .shows_default();
    app.add_option("--seed", raw->seed, "S",
                   "64-bit seed: sets differ by a few percent in the work that\n"
                   "they take, so compare versions by the mean over several")
        .shows_default();
    app.add_option("--copies", options.copies, "K",
                   "Time K copies of each mesh instead: sampled one by one,\n"
                   "as one job and as one mesh; counts are those of a copy")
        .takes_range(1, 100000);
    app.add_option("--device", options.device, "NAME|INDEX",
                   "Device by name, index or UUID (geodisk info)");
    app.add_flag("--stages", options.runner.time_stages,
                 "Time each stage on the device and count how long lanes wait\n"
                 "for others; takes a little time itself");
    app.add_option("--json", options.json, "FILE", "Write rows, fits and circumstances as JSON");
    app.add_option("--csv", options.csv, "FILE", "Write rows and circumstances as CSV");
    add_scaling(app, *raw);
    add_tuning(app, options.runner, options.tune);
    app.calls([raw, run] { run(checked(*raw)); });
}

} // namespace geodisk::bench
