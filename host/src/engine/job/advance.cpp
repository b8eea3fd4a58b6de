// Next step of a job, chosen by what the device reports.
#include <algorithm>
#include <string>

#include <geodisk/sampler.hpp>

#include "constants.h"
#include "engine/job/plan.hpp"
#include "engine/job/sampler_impl.hpp"
#include "records.h"
#include "support/guard.hpp"
#include "support/try.hpp"

namespace geodisk {
namespace {

/// Room for half as many samples again, and a batch.
Result<std::uint32_t> larger_capacity(const gpu::ControlRec& control, std::uint32_t slots,
                                      const DeviceReport& report) {
    const std::uint64_t most = report.limits.max_storage_buffer_range / sizeof(gpu::SampleRec);
    const std::uint64_t least = min_sample_capacity(control, slots);
    const std::uint64_t capacity = std::min(least + control.accepted / 2, std::max(most, least));
    if (capacity > most) {
        return Error{Status::job_too_large,
                     "the " + std::to_string(control.accepted) + " samples so far take " +
                         std::to_string(capacity * sizeof(gpu::SampleRec)) + " bytes, but " +
                         report.name + " binds at most " +
                         std::to_string(report.limits.max_storage_buffer_range) +
                         "; raise the minimum distance, or ask for fewer samples"};
    }
    return static_cast<std::uint32_t>(capacity);
}

/// Overflows that no memory helps against.
Result<Done> check_overflow(const gpu::ControlRec& control, std::uint32_t capacity) {
    if ((control.overflow & gpu::kOverflowCandidates) != 0) {
        return Error{Status::internal, "a stage has " + std::to_string(control.drawn) +
                                           " candidates, and there is room for " +
                                           std::to_string(capacity)};
    }
    if ((control.overflow & gpu::kOverflowEndless) != 0) {
        const std::uint32_t face = control.endless_face - 1;
        return Error{
            Status::mesh_rejected,
            "the geodesic disk of a candidate on face " + std::to_string(face) +
                " could not be computed: it holds too many edges of more than two faces, or too "
                "many "
                "triangles far smaller than the minimum distance; coarsen the mesh there or lower "
                "the distance",
            face};
    }
    return Done{};
}

/// Candidates to expect from which on there are some: none have the probability e^-60.
constexpr double kSurelySome = 60;

} // namespace

const char* to_string(Next next) noexcept {
    constexpr const char* kNames[] = {"begin",       "go_on",          "finish",
                                      "larger_pool", "larger_samples", "",
                                      "complete",    "count",          "paused"};
    return kNames[static_cast<std::size_t>(next)];
}

std::uint32_t Job::Impl::stages_left(const gpu::ControlRec& control) const {
    if (control.accepted >= constants.stop_count) {
        return 0;
    }
    return std::min(plan.stages,
                    stages.left(push.first_stage + push.stages, thrown + darts(control)));
}

double Job::Impl::decided(const gpu::ControlRec& control) const {
    const double part = chunk_end > 0 ? static_cast<double>(control.first_order) / chunk_end : 0;
    return static_cast<double>(thrown) + part * static_cast<double>(darts(control));
}

std::uint64_t Job::Impl::candidates(const gpu::ControlRec& control) const {
    if (control.accepted < constants.stop_count) {
        return thrown + darts(control);
    }
    if (control.settled >= constants.stop_count) {
        return thrown;
    }
    return is_stop_counted ? thrown + control.below : 0;
}

void Job::Impl::find_cut(const gpu::ControlRec& control) {
    const std::uint64_t wanted = stages.still_wanted(thrown);
    if (cut) {
        cut->note(control.below);
    } else if (control.drawn > wanted) {
        cut.emplace(chunk_end, control.drawn, static_cast<std::uint32_t>(wanted));
    }
    is_count_due = cut && !cut->is_found();
    if (!is_count_due) {
        awaits_cut = false;
        chunk_end = cut ? cut->end() : chunk_end;
        apply_end();
    }
}

Result<Advice> Job::Impl::advance(const gpu::ControlRec& control, std::uint64_t pool_bytes,
                                  LastResort last) {
    // A new seed has the generation of the one before until it begins.
    const bool is_told =
        !is_begin_due && control.generation == generation && control.abi == gpu::kAbi;
    ready = is_told ? std::max(ready, control.ready) : ready;
    Advice advice{Next::go_on, plan, push.sample_capacity, ready};
    const auto next = [&advice](Next step) {
        advice.next = step;
        return advice;
    };
    if (is_begin_due && begun.is_at_start() && waits_for(push.first_stage)) {
        return next(Next::paused);
    }
    if (is_begin_due || !begun.is_at_start()) {
        return next(Next::begin);
    }
    if (!finished.is_at_start()) {
        return next(Next::finish);
    }
    if (!counted.is_at_start()) {
        return next(Next::count);
    }
    if (control.generation != generation || control.abi == 0) {
        return advice; // Not there yet.
    }
    if (control.abi != gpu::kAbi) {
        return Error{Status::internal, "the control record is not one of this library's"};
    }
    GEODISK_TRY(check_overflow(control, constants.capacity));
    if ((control.overflow & gpu::kOverflowSamples) != 0) {
        const auto capacity = larger_capacity(control, plan.slots, sampler->report);
        GEODISK_TRY(capacity);
        advice.sample_capacity = *capacity;
        return next(Next::larger_samples);
    }
    if (control.overflow != 0) {
        // As many slots as the job was made with, if the pool may be as large as that takes.
        RunPlan before = plan;
        before.slots = max_slots;
        before.lanes = max_lanes;
        const std::uint64_t most = pool_bytes != 0 ? pool_bytes : workspace[gpu::kBindPool].size;
        auto grown = grown_plan(before, control.overflow, most, sampler->report, last);
        GEODISK_TRY(grown);
        advice.plan = *grown;
        return next(Next::larger_pool);
    }
    if (awaits_cut && !is_count_due) {
        find_cut(control);
    }
    if (awaits_cut) {
        return next(Next::count);
    }
    const bool is_enough = control.accepted >= constants.stop_count;
    const bool is_over = is_enough || control.drawn == 0; // Whatever the end of the orders.
    if (control.done == 0 || (!is_over && control.first_order < push.end_order)) {
        return advice;
    }
    if (control.drawn == 0 && push.first_stage == 0 &&
        stages.expected(0) * push.stages > kSurelySome) {
        return Error{Status::invalid_argument,
                     "no candidate was drawn: the buffers hold no mesh; upload what "
                     "Sampler::write_upload gives before the first commands of the job"};
    }
    if (control.ready < std::min(control.accepted, constants.stop_count)) {
        return next(Next::finish);
    }
    if (!is_over && push.end_order < chunk_end) {
        return next(Next::paused);
    }
    if (const std::uint32_t count = stages_left(control); count > 0) {
        const std::uint32_t first = push.first_stage + push.stages;
        if (waits_for(first)) {
            return next(Next::paused);
        }
        thrown += darts(control);
        begin_stages(first, count);
        return next(Next::begin);
    }
    advice.candidates = candidates(control);
    is_count_due = is_enough && control.settled < constants.stop_count && !is_stop_counted;
    return next(Next::complete);
}

Result<Advice> Job::advance(const gpu::ControlRec& control, std::uint64_t pool_bytes) noexcept {
    return guarded([&] { return impl_->advance(control, pool_bytes); });
}

} // namespace geodisk
