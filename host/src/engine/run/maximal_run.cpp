#include "engine/run/maximal_run.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "engine/domain/surface_domain.hpp"
#include "engine/maximal/gaps.hpp"
#include "engine/maximal/lit_faces.hpp"
#include "engine/run/division.hpp"
#include "engine/run/first_parts.hpp"
#include "engine/run/mesh_parts.hpp"
#include "engine/run/run.hpp"
#include "support/try.hpp"

namespace geodisk {
namespace {

// Reach of a cell of the first round, in distances; and the factor from each round to the next.
constexpr double kFirstGoal = 0x1p-4;
constexpr double kGoalFactor = 0.25;
// Fewer cells are split in two steps, so that threads can share the work.
constexpr std::size_t kFewCells = 8192;
constexpr double kCoarseGoal = 1;
// Below it all cells are split as far as possible.
constexpr double kMinGoal = 0x1p-40;
// Maximum of darts of a round, per sample so far and in all rounds.
constexpr double kDartsPerSample = 16;
constexpr double kMinDarts = 0x1p16;
constexpr double kMaxDarts = 0x1p24;
// Maximum of records of lights read at once, and room for more than expected.
constexpr double kMaxRecords = 0x1p21;
constexpr double kSpareRecords = 1.5;
constexpr std::uint32_t kMinRecords = 4096;

/// Points whose disks light faces: samples, and points to avoid.
struct LightPoints {
    std::vector<Sample> samples;
    std::vector<KeepOut> avoid;
};

/// Returns the points in the faces of a part, by the numbers that it gives them.
LightPoints points_on(const MeshParts& parts, std::uint32_t part, const LightPoints& of) {
    LightPoints own;
    std::ranges::copy_if(of.samples, std::back_inserter(own.samples),
                         [&](const Sample& sample) { return parts.has(part, sample.face); });
    std::ranges::copy_if(of.avoid, std::back_inserter(own.avoid), [&](const KeepOut& avoided) {
        return parts.has(part, avoided.center.face);
    });
    return own;
}

class MaximalRun {
  public:
    MaximalRun(Runner::Impl& runner, const MaximalJob& job)
        : runner_(runner), job_(job), parts_(*job.mesh, job.frame),
          lit_(*job.mesh, job.params, job.frame,
               double{ErrorModel(job.frame).tolerances(job.frame.error_bound).slack}),
          gaps_(lit_, *job.mesh, job.params, runner.options.threads) {}
    MaximalRun(const MaximalRun&) = delete;
    MaximalRun& operator=(const MaximalRun&) = delete;

    Task<Result<SampleSet>> go();

  private:
    Task<Result<SampleSet>> run_pool();
    /// Lights faces by these points, on the whole or by parts of it.
    Task<Result<Done>> light(const LightPoints& points);
    Task<Result<Done>> light_in_parts(const LightPoints& points);
    /// Does so with the parameters of a mesh, which is that of the part unless it is null.
    Task<Result<Done>> light_on(const PreparedMesh& mesh, SampleParams params,
                                const LightPoints& points, const NearPart* near);
    /// Throws the darts of a round. Returns the samples of those that are accepted.
    Task<Result<std::vector<Sample>>> fill(std::uint32_t round, double goal);
    /// Refines the gaps with the lights from this one on.
    void refine(double goal, std::size_t first);
    void report_gaps();

    Runner::Impl& runner_;
    const MaximalJob& job_;
    MeshParts parts_;
    LitFaces lit_;
    Gaps gaps_;
    SampleSet set_;
    double records_per_disk_ = 0;
};

Task<Result<SampleSet>> MaximalRun::run_pool() {
    SampleParams params = job_.params;
    params.existing = job_.existing;
    params.avoid = job_.avoid;
    const auto domain = SurfaceDomain::plain(*job_.mesh, params, job_.frame);
    GEODISK_CO_TRY(domain);
    co_return co_await run_or_divide(runner_, *domain);
}

Task<Result<Done>> MaximalRun::light(const LightPoints& points) {
    for (;;) {
        auto lit = parts_.count() == 0 ? light_on(*job_.mesh, job_.params, points, nullptr)
                                       : light_in_parts(points);
        const auto done = co_await lit;
        if (done || !parts_.divide(done.error())) {
            co_return done; // What is lit twice is as if lit once.
        }
    }
}

Task<Result<Done>> MaximalRun::light_in_parts(const LightPoints& points) {
    for (std::uint32_t part = 0; part < parts_.count(); ++part) {
        LightPoints own = points_on(parts_, part, points);
        const double reach =
            reach_with(own.samples.empty() ? 0 : job_.params.min_distance, own.avoid);
        if (reach == 0) {
            continue;
        }
        const auto near = parts_.near(part, reach);
        GEODISK_CO_TRY(near);
        for (Sample& sample : own.samples) {
            sample.face = near->local.of(sample.face);
        }
        for (KeepOut& avoided : own.avoid) {
            avoided.center.face = near->local.of(avoided.center.face);
        }
        SampleParams params = job_.params;
        std::optional<RadiusField> radii;
        if (params.radii != nullptr) {
            params.radii = &radii.emplace(params.radii->on_part(*near->mesh, near->faces));
        }
        params.face_mask = {}; // Nothing is drawn.
        params.face_keys = {};
        GEODISK_CO_TRY(co_await light_on(*near->mesh, params, own, &*near));
    }
    co_return Done{};
}

Task<Result<Done>> MaximalRun::light_on(const PreparedMesh& mesh, SampleParams params,
                                        const LightPoints& points, const NearPart* near) {
    const double most = std::min(kMaxRecords, runner_.record_bytes() / sizeof(gpu::LitRec));
    std::span<const Sample> samples = points.samples;
    std::span<const KeepOut> avoid = points.avoid;
    while (!samples.empty() || !avoid.empty()) {
        const auto disks =
            std::max<std::size_t>(1, static_cast<std::size_t>(most / records_per_disk_));
        params.avoid = avoid.first(std::min(avoid.size(), disks));
        params.existing = samples.first(std::min(samples.size(), disks - params.avoid.size()));
        const auto settled = static_cast<double>(params.avoid.size() + params.existing.size());
        const double expected = records_per_disk_ * settled + kMinRecords;
        const auto domain = SurfaceDomain::recording(mesh, params, job_.frame, Ending::light, {},
                                                     static_cast<std::uint32_t>(expected));
        GEODISK_CO_TRY(domain);
        DiskRecords lit;
        auto set = co_await run_job(runner_, *domain, &lit);
        if (!set) {
            parts_.note_failed(runner_, *domain,
                               reach_with(job_.params.min_distance, params.avoid));
            co_return set.error();
        }
        set->report.candidates = 0; // None is drawn, and how many runs it takes depends on memory.
        set_.report.add(set->report);
        if (lit.wanted > lit.lights.size()) {
            records_per_disk_ = std::max(lit.wanted / settled, records_per_disk_) * kSpareRecords;
            continue; // Again, with room for all.
        }
        for (gpu::LitRec& record : lit.lights) {
            if (near != nullptr) {
                record.place = near->half_edge(record.place >> 1) << 1 | (record.place & 1);
            }
        }
        lit_.add(lit.lights);
        samples = samples.subspan(params.existing.size());
        avoid = avoid.subspan(params.avoid.size());
    }
    co_return Done{};
}

Task<Result<std::vector<Sample>>> MaximalRun::fill(std::uint32_t round, double goal) {
    const double most = std::clamp(kDartsPerSample * static_cast<double>(set_.samples.size()),
                                   kMinDarts, kMaxDarts);
    const std::vector<ListedCandidate> darts = gaps_.darts(round, goal, most);
    if (darts.empty()) {
        co_return std::vector<Sample>();
    }
    ++set_.report.maximal.rounds;
    set_.report.maximal.darts += darts.size();
    const auto domain = SurfaceDomain::listed(*job_.mesh, job_.params, job_.frame, darts, true);
    GEODISK_CO_TRY(domain);
    auto filled = co_await run_or_divide(runner_, *domain);
    GEODISK_CO_TRY(filled);
    set_.report.add(filled->report);
    co_return std::move(filled->samples);
}

void MaximalRun::refine(double goal, std::size_t first) {
    const double start = runner_.now();
    lit_.sort_from(first);
    gaps_.refine(goal);
    set_.report.seconds.sample += runner_.now() - start;
}

void MaximalRun::report_gaps() {
    MaximalReport& report = set_.report.maximal;
    report.cells = gaps_.tested();
    report.certified = gaps_.empty();
    report.largest_gap = job_.params.min_distance * (1 + 2 * set_.report.guard) +
                         job_.frame.unit * gaps_.largest_excess();
}

Task<Result<SampleSet>> MaximalRun::go() {
    auto first = co_await run_pool();
    GEODISK_CO_TRY(first);
    set_ = std::move(*first);
    const RunReport& report = set_.report;
    records_per_disk_ =
        kSpareRecords * (static_cast<double>(report.windows) / std::max(report.disks, 1u) + 8);
    const LightPoints all{set_.samples, job_.avoid};
    GEODISK_CO_TRY(co_await light(all));
    double goal = kFirstGoal;
    if (gaps_.size() < kFewCells) {
        refine(kCoarseGoal, 0);
        refine(goal, lit_.size());
    } else {
        refine(goal, 0);
    }
    for (std::uint32_t round = 1; !gaps_.empty(); ++round) {
        auto samples = co_await fill(round, goal);
        GEODISK_CO_TRY(samples);
        if (samples->empty() && gaps_.are_smallest()) {
            break;
        }
        const std::size_t before = lit_.size();
        const LightPoints more{*samples, {}};
        GEODISK_CO_TRY(co_await light(more));
        set_.samples.insert(set_.samples.end(), samples->begin(), samples->end());
        goal = std::max(goal * kGoalFactor, kMinGoal);
        refine(goal, before);
    }
    report_gaps();
    co_return std::move(set_);
}

} // namespace

Task<Result<SampleSet>> run_maximal(Runner::Impl& runner, const MaximalJob& job) {
    MaximalRun run(runner, job);
    co_return co_await run.go();
}

} // namespace geodisk
