#include "engine/run/division.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "bindings.h"
#include "support/try.hpp"

namespace geodisk {
namespace {

// Bytes of all buffers of a run, per byte of the mesh and the candidates.
constexpr double kAllBuffers = 3;
// The weights of a candidate.
constexpr double kCandidateBytes = 8;
// Candidates of a stage, beyond which the host would need too much memory.
constexpr double kMostCandidates = 0x1p27;
// Least side of a part, per side with its margins: with less, most work would be done twice or
// more.
constexpr double kLeastSide = 0.4;
constexpr std::uint32_t kMaxAttempts = 3;

bool is_too_large(const Error& error) {
    return error.status == Status::job_too_large || error.status == Status::out_of_device_memory;
}

/// Returns the part of a surface, or less, that the device holds; 1 if the mesh is not too large.
double held_part(const Runner::Impl& runner, const Domain::Impl& of) {
    const auto bound = static_cast<double>(runner.engine().report.limits.max_storage_buffer_range);
    const auto allowed = static_cast<double>(runner.options.device_bytes);
    const auto held = [&](double largest, double all) {
        const double part = std::min(1.0, bound / largest);
        return allowed > 0 ? std::min(part, allowed / (kAllBuffers * all)) : part;
    };
    const auto faces = static_cast<double>(of.upload_size(BufferRole::faces));
    const auto fans = static_cast<double>(of.upload_size(BufferRole::fans));
    const double candidates = kCandidateBytes * of.stages.expected_at_once(1);
    const double of_mesh = held(std::max(faces, fans), faces + fans);
    return of_mesh < 1 ? std::min(of_mesh, held(candidates, faces + fans + candidates)) : 1;
}

/// Returns the number of parts that the device holds with what lies around them, about; 0 if it
/// holds none, or if the mesh is not too large.
std::uint32_t first_parts(const Runner::Impl& runner, const Domain::Impl& of) {
    if (of.stages.expected_at_once(1) > kMostCandidates) {
        return 0;
    }
    const WholeJob& job = *of.whole;
    double reach = job.params.min_distance;
    for (const KeepOut& avoided : job.params.avoid) {
        reach = std::max(reach, avoided.radius);
    }
    // A part is about a square, with a margin of two reaches on each side.
    const double margins = 4 * reach / std::sqrt(job.mesh->statistics().area);
    const double part = held_part(runner, of);
    const double side = std::sqrt(part) - margins;
    const bool is_worth_it = part < 1 && side > kLeastSide * std::sqrt(part);
    const double parts = std::max(2.0, std::ceil(1 / (side * side)));
    return is_worth_it && parts <= job.mesh->face_count() ? static_cast<std::uint32_t>(parts) : 0;
}

} // namespace

Result<std::unique_ptr<Division>> Division::begin(const Runner::Impl& runner, const Domain& domain,
                                                  const ProgressCallback& progress,
                                                  const Error& error) {
    const Domain::Impl& of = Domain::Impl::of(domain);
    const std::uint32_t parts = of.whole && is_too_large(error) ? first_parts(runner, of) : 0;
    if (parts == 0) {
        return std::unique_ptr<Division>();
    }
    auto own = Runner::create(runner.shared_sampler, runner.submitter->queue(), runner.options);
    GEODISK_TRY(own);
    std::unique_ptr<Division> division(
        new Division(std::move(*own), *of.whole, progress, runner.progress.candidates));
    division->expected_ = static_cast<std::uint32_t>(of.samples);
    division->parts_ = parts;
    division->run_ = std::make_unique<DividedRun>(division->runner_, *division->job_.mesh,
                                                  division->job_.params, division->parts_);
    return division;
}

bool Division::divides_more(const Error& error) {
    ++attempts_;
    parts_ *= 2;
    return is_too_large(error) && goes_on_ && attempts_ < kMaxAttempts &&
           parts_ <= job_.mesh->face_count();
}

Result<std::optional<SampleSet>> Division::poll(std::chrono::milliseconds patience) {
    auto polled = run_->poll(patience);
    if (!polled && divides_more(polled.error())) {
        run_.reset();
        run_ = std::make_unique<DividedRun>(runner_, *job_.mesh, job_.params, parts_);
        return std::optional<SampleSet>();
    }
    if (polled && !*polled && goes_on_ && on_progress_ && !on_progress_(progress())) {
        goes_on_ = false;
        run_->cancel();
    }
    return polled;
}

Progress Division::progress() {
    Progress all = run_->progress();
    all.candidates = candidates_;
    all.decided = std::min(all.decided, candidates_);
    all.accepted = std::min(all.accepted, expected_);
    return all;
}

} // namespace geodisk
