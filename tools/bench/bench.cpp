// geodisk_bench: the sampler beside the sequential reference, on the same meshes in the same run.
// Verifies that both return the same set before it times anything.
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "common/mesh_file.hpp"
#include "common/user_error.hpp"
#include "kernels/candidates.hpp"
#include "run.hpp"
#include <geodisk/context.hpp>
#include <geodisk/runner.hpp>

namespace {

using namespace geodisk;
using Clock = std::chrono::steady_clock;

double median(std::vector<double> values) {
    std::nth_element(values.begin(), values.begin() + static_cast<long>(values.size() / 2),
                     values.end());
    return values[values.size() / 2];
}

template <class T>
T expect(Result<T> result) {
    if (!result) {
        throw tools::UserError(tools::ExitCode::internal, result.error().message);
    }
    return std::move(*result);
}

struct Timed {
    double seconds;
    std::vector<std::uint32_t> ranks;
};

/// From the candidates to the set, as the sampler's `sample` stage.
template <class Real>
Timed run_reference(const ref::Surface<Real>& surface, const SampleParams& params,
                    std::uint32_t candidates, const Tolerances& tolerances) {
    const auto start = Clock::now();
    const auto points = ref::draw_candidates<Real>(surface.alias, params.seed, candidates);
    const ref::Bins<Real> bins(surface, points);
    auto result = ref::throw_darts(surface, bins, tolerances);
    return {std::chrono::duration<double>(Clock::now() - start).count(), std::move(result.ranks)};
}

void run_case(Runner& runner, const std::string& name, const PreparedMesh& mesh, double count,
              int repeats) {
    SampleParams params;
    params.min_distance = distance_for_count(mesh.statistics().area, count);
    params.seed = 1;
    SampleSet set = expect(runner.sample_and_wait(mesh, params));
    const Tolerances tolerances =
        tolerances_for(mesh, params.min_distance, set.report.plan.chain);
    const ref::Surface<double> surface(mesh, params.min_distance);
    const ref::Surface<float> twin(mesh, params.min_distance);
    const Timed check = run_reference(twin, params, set.report.candidates, tolerances);
    bool equal = check.ranks.size() == set.samples.size();
    for (std::size_t i = 0; equal && i < check.ranks.size(); ++i) {
        equal = check.ranks[i] == set.samples[i].candidate;
    }
    std::vector<double> device;
    std::vector<double> reference;
    for (int i = 0; i < repeats; ++i) {
        set = expect(runner.sample_and_wait(mesh, params));
        device.push_back(set.report.seconds.sample);
        reference.push_back(
            run_reference(surface, params, set.report.candidates, tolerances).seconds);
    }
    const RunReport& r = set.report;
    const double n = static_cast<double>(set.samples.size());
    std::printf("%-16s %8.0f %-5s %9.4f %9.4f %6.2f %9.0f %8.1f %6.3f %6u %5u %4u %6.1f\n",
                name.c_str(), n, equal ? "equal" : "DIFF", median(device), median(reference),
                median(device) / median(reference), n / median(device),
                static_cast<double>(r.windows) / r.disks, r.disks / n, r.iterations,
                r.most_waiting, r.regrown, static_cast<double>(r.device_bytes) / 1048576.0);
    std::fflush(stdout);
    if (!equal) {
        throw tools::UserError(tools::ExitCode::internal, "the sets differ");
    }
}

} // namespace

int main(int argc, char** argv) {
    CLI::App app("Times the sampler beside the sequential reference");
    std::vector<std::string> meshes;
    std::vector<double> counts{1000, 10000, 100000};
    int repeats = 5;
    std::string device;
    RunnerOptions options;
    app.add_option("meshes", meshes, "Mesh files or builtin:NAME")->required();
    app.add_option("-n,--count", counts, "Sample counts to aim at");
    app.add_option("--repeats", repeats, "Runs to take the median of")->check(CLI::Range(1, 1000));
    app.add_option("--device", device, "Device by name, index or UUID");
    app.add_option("--slots", options.plan.slots, "Candidates active at a time");
    app.add_option("--trips", options.plan.trip_budget, "Loop iterations per dispatch");
    app.add_option("--local-size", options.sampler.local_size, "Invocations per work group");
    CLI11_PARSE(app, argc, argv);
    try {
        Context context = expect(Context::create({.device = device, .validation = false, .on_validation_message = {}}));
        Runner runner = expect(Runner::create(context.device(), context.queue(), options));
        std::printf("%s\n%-16s %8s %-5s %9s %9s %6s %9s %8s %6s %6s %5s %4s %6s\n",
                    context.report().name.c_str(), "mesh", "samples", "set", "device s", "ref s",
                    "ratio", "samples/s", "win/disk", "d/smp", "iter", "heap", "grow", "MiB");
        for (const std::string& path : meshes) {
            const tools::MeshFile file = tools::read_mesh(path);
            const PreparedMesh mesh =
                expect(PreparedMesh::prepare({file.positions, file.triangles}));
            for (const double count : counts) {
                run_case(runner, path.substr(path.find_last_of('/') + 1), mesh, count, repeats);
            }
        }
    } catch (const tools::UserError& error) {
        std::fprintf(stderr, "geodisk_bench: %s\n", error.what());
        return static_cast<int>(error.code());
    }
    return 0;
}
