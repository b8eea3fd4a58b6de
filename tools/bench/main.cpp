// The command `geodisk_bench`: the sampler beside the sequential reference, on the same meshes in
// the same run. It compares their sets before it times anything.
#include <filesystem>
#include <iostream>
#include <vector>

#include "program/command.hpp"

#include <geodisk/context.hpp>
#include <geodisk/runner.hpp>
#include <geodisk/version.hpp>

#include "bench/circumstances.hpp"
#include "bench/copies.hpp"
#include "bench/options.hpp"
#include "bench/outputs.hpp"
#include "bench/sweep.hpp"
#include "bench/table.hpp"
#include "bench/tune.hpp"
#include "files/tuning_file.hpp"
#include "files/vulkan_environment.hpp"
#include "program/failure.hpp"
#include "program/program.hpp"

namespace {

using namespace geodisk;

constexpr const char* kFooter =
    R"(Times are wall time in seconds: prepare is the host's work on a mesh; upload, device and
readback are those of a run; reference is the same work as device, done sequentially in double
precision on one core. Both start from the candidates' numbers and end with the finished set.

Examples:
  geodisk_bench builtin:showpiece bunny.ply
  geodisk_bench builtin:cube -n 1e4,1e5 --repeats 9 --json bench.json
  geodisk_bench builtin:showpiece -n 1e4,1e5 --tune
  geodisk_bench builtin:torus-knot:6 -n 50 --copies 300
  geodisk_bench builtin:showpiece --scaling --json scaling.json

Exit status:
  0    success
  2    wrong usage: an unknown option, a value out of range, options that contradict
  3    a mesh is missing, unreadable or malformed
  4    an output cannot be written
  5    no Vulkan device that can run geodisk
  6    the work does not fit into the memory of the host or the device
  7    device and reference differ, the device was lost, or an error inside geodisk or the driver
  130  interrupted (SIGINT)
  143  terminated (SIGTERM)
Whenever the status is not 0, no output file is written or replaced.)";

void tune(const Context& context, const bench::Options& options,
          const std::vector<bench::NamedMesh>& meshes) {
    const std::filesystem::path path = tools::writable_tuning_path(context.report());
    const Runner start =
        tools::take(Runner::create(context.device(), context.queue(), options.runner));
    bench::print_tune_heading(bench::find_circumstances(start.sampler(), options));
    const Tuning best =
        bench::find_tuning(context, options, meshes, start.sampler().tuning(), bench::print_trial);
    tools::store_tuning(path, context.report(), best);
    bench::print_tuning(best, path.string());
}

void measure(const Context& context, bench::Options options,
             const std::vector<bench::NamedMesh>& meshes) {
    if (const auto kept = tools::load_tuning(context.report())) {
        options.runner.sampler.tuning = overridden(*kept, options.runner.sampler.tuning);
    }
    Runner runner = tools::take(Runner::create(context.device(), context.queue(), options.runner));
    const bench::Circumstances circumstances = bench::find_circumstances(runner.sampler(), options);
    if (options.copies != 0) {
        bench::print_copies_heading(circumstances);
        bench::run_copies(runner, options, meshes, bench::print_copies);
        return;
    }
    bench::print_heading(circumstances);
    const std::vector<bench::Series> series =
        bench::run_all(runner, options, meshes, {bench::print_row, bench::print_growth});
    bench::write_outputs(options, circumstances, series);
}

void run(const bench::Options& options) {
    bench::check_outputs(options);
    const std::vector<bench::NamedMesh> meshes = bench::read_meshes(options.meshes);
    const Context context =
        tools::take_device(Context::create({options.device, /* validation */ false, {}}));
    if (options.tune) {
        tune(context, options, meshes);
    } else {
        measure(context, options, meshes);
    }
    if (!std::cout) {
        tools::fail_output("the table cannot be written to standard output");
    }
}

void set_up(tools::Command app) {
    app.has_version("geodisk_bench " GEODISK_VERSION_STRING);
    app.has_footer(kFooter);
    bench::add_options(app, run);
}

} // namespace

int main(int argc, char** argv) {
    return tools::run_program(
        "geodisk_bench",
        "Measure the sampler and a sequential reference that returns the same samples", set_up,
        argc, argv);
}
