#include "engine/box_source.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <string>
#include <utility>

#include "bindings.h"

namespace geodisk {
namespace {

// As in plan.cpp; some iterations of a dispatch are before the trips.
constexpr std::uint32_t kLlvmpipeTrips =
    (65535 - 64 - gpu::kListPerDispatch) / gpu::kIterationsPerGridTrip;
constexpr std::uint32_t kDefaultTrips = 1024;
constexpr double kMostPasses = 32;

std::uint32_t most_trips(const DeviceReport& report) {
    return report.driver_id == VK_DRIVER_ID_MESA_LLVMPIPE ? kLlvmpipeTrips : kDefaultTrips;
}

/// Volume of the unit ball in R^n.
double ball_volume(double n) {
    constexpr double kPi = 3.14159265358979323846;
    return std::pow(kPi, n / 2) / std::tgamma(n / 2 + 1);
}

/// Trips of grid_detect for one disk, about.
double trips_per_disk(double n, double candidates_in_disk) {
    // Rows of cells along the first axis that a ball of two cells' radius meets, by measurement.
    const double rows = ball_volume(n - 1) * std::pow(2.5, n - 1);
    const double per_row = 2.5 * candidates_in_disk / rows;
    return rows * (0.4 + std::ceil(per_row / gpu::kScanPerGridTrip));
}

double candidates_in_disk(const BoxParams& box) {
    return ball_volume(static_cast<double>(box.extents.size())) *
           density_in_box(box.extents.size()) * box.pool_ratio;
}

/// As many candidates as one binding and the memory hold, their points and cells too.
std::uint64_t most_at_once(const BoxSource::Crowd& crowd, std::uint32_t slots, VkDeviceSize memory,
                           const DeviceReport& report) {
    const std::uint64_t words = report.limits.max_storage_buffer_range / 4;
    const std::uint64_t bound = std::min((words - std::uint64_t{slots} * crowd.words_per_point) /
                                             (crowd.words_per_point + 1),
                                         std::bit_floor(words - 1) / kHeadsPerCandidate);
    return std::min(memory / crowd.bytes_per_candidate(), bound);
}

} // namespace

std::uint64_t BoxSource::Crowd::bytes_per_candidate() const {
    return (3 + words_per_point + 2 * kHeadsPerCandidate) * 4;
}

BoxSource::BoxSource(const Sampler::Impl& sampler, const BoxParams& box, VkDeviceSize memory)
    : BoxSource(sampler, box, memory,
                {static_cast<std::uint32_t>(box.extents.size()), candidates_in_disk(box), kBoxGuard,
                 draw_axes(box), stages_of(box), samples_per_volume(box), 0}) {}

BoxSource::BoxSource(const Sampler::Impl& sampler, BoxParams box, VkDeviceSize memory,
                     const Crowd& crowd)
    : sampler_(sampler), box_(std::move(box)), crowd_(crowd),
      slots_(wanted_slots(crowd.stages.samples, sampler.tuning.batches, sampler.report)),
      stages_at_once_(
          stages_at_once(crowd.stages, most_at_once(crowd, slots_, memory, sampler.report))),
      grid_(box_, crowd.lattice, capacity_for(crowd.stages, stages_at_once_), crowd.guard) {}

Result<RunPlan> BoxSource::plan(std::uint64_t pool_bytes) const {
    const auto n = static_cast<double>(box_.extents.size());
    RunPlan plan;
    plan.pool_block = sampler_.tuning.pool_block;
    plan.stages = stages_at_once_;
    plan.slots = slots_;
    // Slots need no lanes here; the least that plans may have.
    plan.lanes = 1;
    plan.window_capacity = 2;
    plan.table_capacity = 1;
    const double drawn =
        crowd_.stages.throws != 0 ? capacity(plan) : plan.stages * crowd_.stages.expected(0);
    const double in_disk = crowd_.in_disk * drawn / crowd_.stages.pool();
    plan.list_capacity = std::max(4u, pow2_at_least(in_disk + 6 * std::sqrt(in_disk) + 8));
    plan.step_budget = most_trips(sampler_.report);
    plan.sample_capacity =
        wanted_sample_capacity(crowd_.stages.samples, crowd_.stop_count, slots_, sampler_.report);
    plan.idle_capacity = wanted_idle_capacity(plan.slots, capacity(plan));
    plan.detect_passes = static_cast<std::uint32_t>(
        std::clamp(std::ceil(trips_per_disk(n, in_disk) / plan.step_budget), 1.0, kMostPasses));
    return fitted(plan, pool_bytes, sampler_.report.limits);
}

Result<WorkspaceNeeds> BoxSource::needs(const RunPlan& plan) const {
    const std::uint64_t most = capacity(plan);
    WorkspaceNeeds needs = needs_of_run(most, drawn_by() * plan.stages, grid_.heads, plan);
    needs.bytes[gpu::kBindAxes] = box_.extents.size() * sizeof(gpu::AxisRec);
    needs.bytes[gpu::kBindPoints] =
        ((crowd_.words_per_point + 1) * most + crowd_.words_per_point * plan.slots) * 4;
    const std::string what = "for " + std::to_string(most) + " candidates of " +
                             std::to_string(box_.extents.size()) + " coordinates";
    if (auto checked = check_needs(needs, what, sampler_.report); !checked) {
        return checked.error();
    }
    return needs;
}

gpu::Push BoxSource::push() const {
    gpu::Push push{};
    push.stop_count = crowd_.stop_count != 0 ? crowd_.stop_count : kMostCandidates;
    push.cells = grid_.heads;
    push.seed_low = static_cast<std::uint32_t>(box_.seed);
    push.seed_high = static_cast<std::uint32_t>(box_.seed >> 32);
    push.limit = grid_.limit2;
    push.faces = static_cast<std::uint32_t>(drawn_by());
    return push;
}

Result<Job> BoxSource::make_job(const RunPlan& plan, const Workspace& workspace) const {
    gpu::Push all = push();
    all.capacity = capacity(plan);
    return Job::Impl::open(
        sampler_, plan, workspace, all,
        {crowd_.stages, crowd_.samples_per_measure, most_trips(sampler_.report)});
}

Result<std::vector<std::byte>> BoxSource::bytes(BufferRole role) const {
    std::vector<std::byte> bytes;
    if (static_cast<std::uint32_t>(role) == gpu::kBindAxes) {
        bytes.resize(box_.extents.size() * sizeof(gpu::AxisRec));
        std::memcpy(bytes.data(), grid_.axes.data(), bytes.size());
    }
    return bytes;
}

} // namespace geodisk
