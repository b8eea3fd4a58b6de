#include "bench/measure.hpp"

#include <algorithm>
#include <ctime>
#include <utility>
#include <vector>

#include "bench/statistics.hpp"
#include "kernels/pool.hpp"
#include "lib/frame.hpp"
#include "program/failure.hpp"
#include "program/human_text.hpp"
#include "program/interrupt.hpp"
#include "program/stopwatch.hpp"
#include "throw_darts.hpp"

namespace geodisk::bench {
namespace {

using tools::ExitCode;
using tools::UserError;

/// Time in which a GPU that was idle comes to its full clock.
constexpr double kWarmUpSeconds = 0.1;

/// A job with the tolerances that the device used.
struct ReferenceJob {
    const PreparedMesh& mesh;
    SampleParams params;
    ref::Tolerances tolerances;
};

template <class Real>
struct ReferenceRun {
    double seconds;
    std::vector<ref::FacePoint<Real>> samples; ///< In dart-throwing order.
};

/// From the candidates to the set, as the `sample` stage of the device.
template <class Real>
ReferenceRun<Real> run_reference(const ref::Surface<Real>& surface, const ReferenceJob& job) {
    tools::check_interrupted();
    const tools::Stopwatch watch;
    const ref::Pool<Real> pool = ref::draw_pool(surface, job.params);
    ReferenceRun<Real> run{};
    for (const std::uint32_t rank : ref::throw_darts(surface, pool, job.tolerances).ranks) {
        run.samples.push_back(pool.candidate(rank));
    }
    run.seconds = watch.seconds();
    return run;
}

/// Processor time that `work` takes, in seconds.
template <class Work>
double cpu_seconds_of(const Work& work) {
    const std::clock_t start = std::clock();
    work();
    return static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
}

bool is_same(const Sample& sample, const ref::FacePoint<float>& point) {
    return sample.face == point.face && sample.weights[1] == point.weight1 &&
           sample.weights[2] == point.weight2;
}

void check_equal(const std::vector<Sample>& samples,
                 const std::vector<ref::FacePoint<float>>& expected, const std::string& what) {
    std::size_t place = 0;
    while (place < samples.size() && place < expected.size() &&
           is_same(samples[place], expected[place])) {
        ++place;
    }
    if (place < samples.size() || place < expected.size()) {
        throw UserError(ExitCode::internal,
                        what + ": device and reference differ at sample " + tools::grouped(place));
    }
}

} // namespace

SampleParams params_for(const BenchMesh& mesh, double count, std::uint64_t seed) {
    SampleParams params;
    params.min_distance = distance_for_count(mesh.prepared.statistics().area, count);
    params.seed = seed;
    return params;
}

std::string case_text(const BenchMesh& mesh, double count) {
    return mesh.name + ", " + tools::grouped(static_cast<std::uint64_t>(count)) + " samples";
}

SampleSet run_device(Runner& runner, const PreparedMesh& mesh, const SampleParams& params,
                     const std::string& what) {
    auto result = runner.sample_and_wait(mesh, params,
                                         [](const Progress&) { return !tools::is_interrupted(); });
    tools::check_interrupted();
    return tools::take(std::move(result), what);
}

BenchMesh prepare_mesh(const std::string& name, const tools::MeshFile& mesh, int repeats) {
    BenchMesh result;
    result.name = name;
    std::vector<double> seconds;
    for (int i = 0; i < repeats; ++i) {
        tools::check_interrupted();
        result.prepared = PreparedMesh(); // The memory of two at once is not part of the question.
        const tools::Stopwatch watch;
        result.prepared = tools::take(
            PreparedMesh::prepare({mesh.positions, mesh.triangles, mesh.dimension}), name);
        seconds.push_back(watch.seconds());
    }
    result.prepare_seconds = median(seconds);
    return result;
}

Measurement measure(Runner& runner, const BenchMesh& mesh, double count, std::uint64_t seed,
                    const Repetition& repetition) {
    const std::string what = case_text(mesh, count);
    const MeshStatistics& statistics = mesh.prepared.statistics();
    const SampleParams params = params_for(mesh, count, seed);

    SampleSet set = run_device(runner, mesh.prepared, params, what);
    const ReferenceJob job{
        mesh.prepared, params,
        ref::frame_of(mesh.prepared, params).tolerances(set.report.plan.error_bound)};
    check_equal(set.samples, run_reference(ref::Surface<float>(mesh.prepared, params), job).samples,
                what);

    const ref::Surface<double> surface(mesh.prepared, params);
    std::vector<double> upload, device, readback, reference, device_cpu, reference_cpu;
    const tools::Stopwatch warm_up;
    for (int i = 0; i < repetition.warm_ups || warm_up.seconds() < kWarmUpSeconds; ++i) {
        run_device(runner, mesh.prepared, params, what);
    }
    for (int i = 0; i < repetition.repeats; ++i) {
        device_cpu.push_back(
            cpu_seconds_of([&] { set = run_device(runner, mesh.prepared, params, what); }));
        upload.push_back(set.report.seconds.upload);
        device.push_back(set.report.seconds.sample);
        readback.push_back(set.report.seconds.readback);
    }
    for (int i = -repetition.warm_ups; i < repetition.repeats; ++i) {
        double seconds = 0;
        const double cpu = cpu_seconds_of([&] { seconds = run_reference(surface, job).seconds; });
        if (i >= 0) {
            reference.push_back(seconds);
            reference_cpu.push_back(cpu);
        }
    }
    Measurement row;
    row.mesh = mesh.name;
    row.triangles = statistics.triangles;
    row.wanted = count;
    row.min_distance = params.min_distance;
    row.samples = set.samples.size();
    row.seconds.prepare = mesh.prepare_seconds;
    row.seconds.upload = median(upload);
    row.seconds.device = median(device);
    row.seconds.readback = median(readback);
    row.seconds.reference = median(reference);
    row.cpu_seconds.device = *std::min_element(device_cpu.begin(), device_cpu.end());
    row.cpu_seconds.reference = *std::min_element(reference_cpu.begin(), reference_cpu.end());
    row.run = set.report;
    return row;
}

} // namespace geodisk::bench
