#include "bench/measure.hpp"

#include <chrono>
#include <utility>
#include <vector>

#include "kernels/bins.hpp"
#include "kernels/candidates.hpp"
#include "program/failure.hpp"
#include "program/human_text.hpp"
#include "program/interrupt.hpp"
#include "run.hpp"

namespace geodisk::bench {
namespace {

using Clock = std::chrono::steady_clock;
using tools::ExitCode;
using tools::UserError;

constexpr std::uint64_t kSeed = 1;

double seconds_since(Clock::time_point start) {
    return std::chrono::duration<double>(Clock::now() - start).count();
}

/// Candidates and tolerances as the device used them.
struct ReferenceJob {
    std::uint32_t candidates;
    Tolerances tolerances;
};

struct ReferenceRun {
    double seconds;
    std::vector<std::uint32_t> ranks;
};

/// From the candidates to the set, as the `sample` stage of the device.
template <class Real>
ReferenceRun run_reference(const ref::Surface<Real>& surface, const ReferenceJob& job) {
    tools::check_interrupted();
    const auto start = Clock::now();
    const ref::Bins<Real> bins(surface,
                               ref::draw_candidates<Real>(surface.alias, kSeed, job.candidates));
    auto result = ref::throw_darts(surface, bins, job.tolerances);
    return {seconds_since(start), std::move(result.ranks)};
}

void check_equal(const std::vector<Sample>& samples, const std::vector<std::uint32_t>& ranks,
                 const std::string& what) {
    std::size_t place = 0;
    while (place < samples.size() && place < ranks.size() &&
           samples[place].candidate == ranks[place]) {
        ++place;
    }
    if (place < samples.size() || place < ranks.size()) {
        throw UserError(ExitCode::internal,
                        what + ": device and reference differ at sample " + tools::grouped(place));
    }
}

} // namespace

SampleParams params_for(const BenchMesh& mesh, double count) {
    SampleParams params;
    params.min_distance = distance_for_count(mesh.prepared.statistics().area, count);
    params.seed = kSeed;
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
    // The device was found good enough, so what it lacks here is room for this job.
    if (!result && result.error().status == Status::device_lacks) {
        throw UserError(ExitCode::out_of_memory, what + ": " + result.error().message);
    }
    return tools::take(std::move(result), what);
}

BenchMesh prepare_mesh(const std::string& name, const tools::MeshFile& mesh, int repeats) {
    BenchMesh result;
    result.name = name;
    std::vector<double> seconds;
    for (int i = 0; i < repeats; ++i) {
        tools::check_interrupted();
        result.prepared = PreparedMesh(); // The memory of two at once is not part of the question.
        const auto start = Clock::now();
        result.prepared = tools::take(
            PreparedMesh::prepare({mesh.positions, mesh.triangles, mesh.dimension}), name);
        seconds.push_back(seconds_since(start));
    }
    result.prepare_seconds = median(seconds);
    return result;
}

Measurement measure(Runner& runner, const BenchMesh& mesh, double count,
                    const Repetition& repetition) {
    const std::string what = case_text(mesh, count);
    const MeshStatistics& statistics = mesh.prepared.statistics();
    const SampleParams params = params_for(mesh, count);

    SampleSet set = run_device(runner, mesh.prepared, params, what);
    const ReferenceJob job{set.report.candidates, tolerances_for(mesh.prepared, params.min_distance,
                                                                 set.report.plan.chain)};
    check_equal(set.samples,
                run_reference(ref::Surface<float>(mesh.prepared, params.min_distance), job).ranks,
                what);

    const ref::Surface<double> surface(mesh.prepared, params.min_distance);
    std::vector<double> upload;
    std::vector<double> device;
    std::vector<double> readback;
    std::vector<double> reference;
    for (int i = -repetition.warm_ups; i < repetition.repeats; ++i) {
        set = run_device(runner, mesh.prepared, params, what);
        const double reference_seconds = run_reference(surface, job).seconds;
        if (i >= 0) {
            upload.push_back(set.report.seconds.upload);
            device.push_back(set.report.seconds.sample);
            readback.push_back(set.report.seconds.readback);
            reference.push_back(reference_seconds);
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
    row.run = set.report;
    return row;
}

} // namespace geodisk::bench
