#include "engine/box_source.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <string>
#include <utility>

#include "bindings.h"
#include "engine/plan.hpp"

namespace geodisk {
namespace {

// As in plan.cpp; some iterations of a dispatch are before the trips.
constexpr std::uint32_t kLlvmpipeTrips = (65535 - 64) / gpu::kIterationsPerGridTrip;
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

} // namespace

BoxSource::BoxSource(const Sampler::Impl& sampler, const BoxParams& box, std::uint32_t candidates)
    : BoxSource(sampler, box, candidates, candidates_in_disk(box), kBoxGuard) {}

BoxSource::BoxSource(const Sampler::Impl& sampler, BoxParams box, std::uint32_t candidates,
                     double in_disk, double guard)
    : sampler_(sampler), box_(std::move(box)), candidates_(candidates), in_disk_(in_disk),
      guard_(guard), grid_(box_, candidates, guard) {}

Result<RunPlan> BoxSource::plan(std::uint64_t pool_bytes) const {
    const double disks = candidates_ / box_.pool_ratio;
    const auto n = static_cast<double>(box_.extents.size());
    RunPlan plan;
    plan.pool_block = sampler_.tuning.pool_block;
    plan.chunk = candidates_; // Of one piece.
    plan.slots = wanted_slots(disks, sampler_.tuning.batches, sampler_.report);
    // Slots need no lanes here; the least that plans may have.
    plan.lanes = 1;
    plan.window_capacity = 2;
    plan.table_capacity = 1;
    plan.list_capacity = std::max(4u, pow2_at_least(in_disk_ + 6 * std::sqrt(in_disk_) + 8));
    plan.step_budget = most_trips(sampler_.report);
    plan.sample_capacity =
        static_cast<std::uint32_t>(std::min<double>(candidates_, std::ceil(1.5 * disks) + 64));
    plan.detect_passes = static_cast<std::uint32_t>(
        std::clamp(std::ceil(trips_per_disk(n, in_disk_) / plan.step_budget), 1.0, kMostPasses));
    return fitted(plan, pool_bytes, sampler_.report.limits);
}

Result<WorkspaceNeeds> BoxSource::needs(const RunPlan& plan) const {
    if (plan.chunk < candidates_) {
        return Error{Status::device_lacks,
                     "candidates in space are worked on in one piece, and of these " +
                         std::to_string(candidates_) + " the memory of " + sampler_.report.name +
                         " holds " + std::to_string(plan.chunk) +
                         "; raise the minimum distance or lower the pool ratio"};
    }
    WorkspaceNeeds needs = needs_of_run(candidates_, grid_.heads, plan);
    needs.bytes[gpu::kBindAxes] = box_.extents.size() * sizeof(gpu::AxisRec);
    needs.bytes[gpu::kBindPoints] = std::uint64_t{candidates_} * box_.extents.size() * 4;
    const std::string what = "for " + std::to_string(candidates_) + " candidates of " +
                             std::to_string(box_.extents.size()) + " coordinates";
    if (auto checked = check_needs(needs, what, sampler_.report); !checked) {
        return checked.error();
    }
    return needs;
}

gpu::Push BoxSource::push() const {
    gpu::Push push{};
    push.candidates = candidates_;
    push.stop_count = kMostCandidates;
    push.cells = grid_.heads;
    push.seed_low = static_cast<std::uint32_t>(box_.seed);
    push.seed_high = static_cast<std::uint32_t>(box_.seed >> 32);
    push.limit = grid_.limit2;
    return push;
}

Result<Job> BoxSource::make_job(const RunPlan& plan, const Workspace& workspace) const {
    return Job::Impl::open(sampler_, plan, workspace, push(), most_trips(sampler_.report));
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
