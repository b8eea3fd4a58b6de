// Several requests whose runs share jobs. In each turn every request that is not done yet has one
// run.
#include <algorithm>
#include <deque>
#include <string>
#include <utility>

#include <geodisk/request.hpp>

#include "engine/domain/domain_impl.hpp"
#include "engine/request/on_mesh.hpp"
#include "support/guard.hpp"
#include "support/invalid.hpp"
#include "support/try.hpp"

namespace geodisk {
namespace {

/// Bounds of a job of several surfaces, unless a single one has more: every device binds as much. A
/// job of more is no faster, also on a wide device.
constexpr std::size_t kJobFaces = std::size_t{1} << 18;
constexpr double kJobRecords = 0x1p21;

std::optional<Sharing> sharing_of(const RequestStep& step) {
    return Domain::Impl::of(step.domain).sharing();
}

/// Candidates of a step, existing samples and points to avoid.
double records_of(const RequestStep& step) {
    return step.domain.stages().candidates() +
           static_cast<double>(step.params.existing.size() + step.params.avoid.size());
}

/// Divides a set among the surfaces that it is on.
std::vector<SampleSet> split(SampleSet all, std::span<const std::uint32_t> first_faces,
                             std::span<const RequestStep* const> steps) {
    std::vector<SampleSet> sets(steps.size());
    for (std::size_t i = 0; i < sets.size(); ++i) {
        sets[i].report = all.report;
        sets[i].existing = steps[i]->params.existing.size();
    }
    for (Sample& sample : all.samples) {
        const auto next = std::ranges::upper_bound(first_faces, sample.face);
        const auto surface = static_cast<std::size_t>(next - first_faces.begin()) - 1;
        sample.face -= first_faces[surface];
        sets[surface].samples.push_back(sample);
    }
    return sets;
}

} // namespace

struct RequestRuns::Impl {
    explicit Impl(std::vector<RequestRun> of) : runs(std::move(of)) {}

    /// Makes the next job, if any run is left.
    Result<Done> begin_job();
    /// Moves the runs that can share a job with the first of `job` there.
    void add_others();
    Result<Done> take(SampleSet set);

    const RequestStep& step(std::size_t i) const { return *runs[i].step(); }

    std::vector<RequestRun> runs;
    std::deque<std::size_t> turn;   ///< Runs whose step of this turn is still to come.
    std::vector<std::size_t> job;   ///< Runs of the job in progress; empty if all is done.
    std::optional<Domain> surfaces; ///< Surfaces of a job that has several.
};

Result<Done> RequestRuns::Impl::begin_job() {
    job.clear();
    surfaces.reset();
    if (turn.empty()) {
        for (std::size_t i = 0; i < runs.size(); ++i) {
            if (runs[i].step() != nullptr) {
                turn.push_back(i);
            }
        }
    }
    if (turn.empty()) {
        return Done{};
    }
    job.push_back(turn.front());
    turn.pop_front();
    if (!step(job[0]).may_share) {
        return Done{};
    }
    add_others();
    if (job.size() == 1) {
        return Done{};
    }
    std::vector<SurfacePart> parts;
    for (const std::size_t i : job) {
        parts.push_back({step(i).surface, step(i).params, 1});
    }
    auto made = Domain::surfaces(parts);
    GEODISK_TRY(made);
    surfaces = std::move(*made);
    return Done{};
}

void RequestRuns::Impl::add_others() {
    const auto sharing = sharing_of(step(job[0]));
    std::size_t faces = step(job[0]).surface->face_count();
    double records = records_of(step(job[0]));
    std::deque<std::size_t> left;
    for (const std::size_t i : turn) {
        const bool fits = step(i).may_share && sharing_of(step(i)) == sharing &&
                          faces + step(i).surface->face_count() <= kJobFaces &&
                          records + records_of(step(i)) <= kJobRecords;
        if (!fits) {
            left.push_back(i);
            continue;
        }
        faces += step(i).surface->face_count();
        records += records_of(step(i));
        job.push_back(i);
    }
    turn = std::move(left);
}

Result<Done> RequestRuns::Impl::take(SampleSet set) {
    std::vector<SampleSet> sets;
    if (surfaces) {
        std::vector<const RequestStep*> steps;
        for (const std::size_t i : job) {
            steps.push_back(runs[i].step());
        }
        sets = split(std::move(set), surfaces->first_faces(), steps);
    } else {
        sets.push_back(std::move(set));
    }
    for (std::size_t k = 0; k < job.size(); ++k) {
        if (const auto taken = runs[job[k]].take(std::move(sets[k])); !taken) {
            return on_mesh(job[k], runs.size(), taken.error());
        }
    }
    return begin_job();
}

RequestRuns::RequestRuns(std::unique_ptr<Impl> impl) noexcept : impl_(std::move(impl)) {}
RequestRuns::RequestRuns(RequestRuns&&) noexcept = default;
RequestRuns& RequestRuns::operator=(RequestRuns&&) noexcept = default;
RequestRuns::~RequestRuns() = default;

Result<RequestRuns> RequestRuns::create(std::span<const MeshRequest> requests) noexcept {
    return guarded([&]() -> Result<RequestRuns> {
        std::vector<RequestRun> runs;
        for (std::size_t i = 0; i < requests.size(); ++i) {
            const auto& [mesh, request] = requests[i];
            auto run = mesh != nullptr ? RequestRun::create(*mesh, request)
                                       : Result<RequestRun>(invalid("there is no mesh"));
            if (!run) {
                return on_mesh(i, requests.size(), run.error());
            }
            runs.push_back(std::move(*run));
        }
        return begin(std::move(runs));
    });
}

Result<RequestRuns> RequestRuns::create(const BoxRequest& request) noexcept {
    return guarded([&]() -> Result<RequestRuns> {
        auto run = RequestRun::create(request);
        GEODISK_TRY(run);
        std::vector<RequestRun> runs;
        runs.push_back(std::move(*run));
        return begin(std::move(runs));
    });
}

Result<RequestRuns> RequestRuns::begin(std::vector<RequestRun> runs) {
    auto impl = std::make_unique<Impl>(std::move(runs));
    GEODISK_TRY(impl->begin_job());
    return RequestRuns(std::move(impl));
}

const Domain* RequestRuns::job() const noexcept {
    const Impl& runs = *impl_;
    return runs.surfaces      ? &*runs.surfaces
           : runs.job.empty() ? nullptr
                              : &runs.step(runs.job[0]).domain;
}

Result<Done> RequestRuns::take(SampleSet set) noexcept {
    return guarded([&]() -> Result<Done> {
        if (impl_->job.empty()) {
            return invalid("the requests have no job to take samples of");
        }
        auto taken = impl_->take(std::move(set));
        if (!taken) {
            impl_->job.clear();
            impl_->surfaces.reset();
        }
        return taken;
    });
}

Error RequestRuns::named(Error error) const noexcept {
    const auto made = guarded([&]() -> Result<Done> {
        const bool is_of_mesh = impl_->job.size() == 1 && error.status != Status::cancelled &&
                                error.status != Status::device_lost;
        return is_of_mesh ? on_mesh(impl_->job[0], impl_->runs.size(), std::move(error)) : error;
    });
    return made.error();
}

Result<std::vector<RequestedSet>> RequestRuns::finish() && noexcept {
    return guarded([&]() -> Result<std::vector<RequestedSet>> {
        std::vector<RequestedSet> found;
        for (RequestRun& run : impl_->runs) {
            found.push_back(std::move(run).finish());
        }
        return found;
    });
}

} // namespace geodisk
