#include "engine/domain/box_domain.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <memory>
#include <utility>

#include "bindings.h"
#include "engine/capacity.hpp"
#include "support/guard.hpp"
#include "support/try.hpp"

namespace geodisk {
namespace {

/// Returns the volume of the unit ball in R^n.
double ball_volume(double n) {
    constexpr double kPi = 3.14159265358979323846;
    return std::pow(kPi, n / 2) / std::tgamma(n / 2 + 1);
}

/// Returns the candidates in a disk per candidate and sample of a full box.
double crowd_of(const BoxParams& box) {
    return ball_volume(static_cast<double>(box.extents.size())) *
           density_in_box(box.extents.size());
}

} // namespace

Result<Domain> Domain::box(const BoxParams& box) noexcept {
    return guarded([&]() -> Result<Domain> {
        GEODISK_TRY(pool_size(box));
        return Domain(std::make_unique<BoxDomain>(box));
    });
}

GridDomain::GridDomain(BoxParams box, const DrawAxes& lattice, std::uint32_t words_per_point,
                       double crowd, double guard)
    : box_(std::move(box)), lattice_(lattice), words_per_point_(words_per_point), crowd_(crowd),
      guard_(guard) {
    error = ErrorModel(guard);
    kernels.dimension = static_cast<std::uint32_t>(box_.extents.size());
    seed = box_.seed;
    bytes_per_candidate = (2 + words_per_point + 2 * kHeadsPerCandidate) * 4 + 1;
    has_lane_per_slot = true;
}

// Points and cells must fit too.
std::uint64_t GridDomain::max_candidates(const DeviceLimits& limits, std::uint32_t slots) const {
    const std::uint64_t words = limits.max_storage_buffer_range / 4;
    return std::min((words - std::uint64_t{slots} * words_per_point_) / (words_per_point_ + 1),
                    std::bit_floor(words - 1) / kHeadsPerCandidate);
}

double GridDomain::in_disk(const RunPlan& plan, std::uint32_t candidates) const {
    const double drawn = stages.is_counted() ? candidates : plan.stages * stages.expected(0);
    return std::min<double>(crowd_ * drawn / stages.samples, candidates);
}

void GridDomain::plan_disks(RunPlan& plan, std::uint32_t candidates, const DeviceReport&) const {
    // Slots need no lanes here; 1 is the minimum of a plan.
    plan.lanes = 1;
    plan.window_capacity = 2;
    plan.table_capacity = 1;
    const double conflicts = in_disk(plan, candidates);
    plan.list_capacity = std::max(4u, pow2_at_least(conflicts + 6 * std::sqrt(conflicts) + 8));
    plan.error_bound = guard_;
}

double GridDomain::disk_steps(const RunPlan& plan, std::uint32_t candidates) const {
    // Number of rows of cells along the first axis that meet a ball with a radius of two cells
    // (measured).
    const double n = kernels.dimension;
    const double rows = ball_volume(n - 1) * std::pow(2.5, n - 1);
    const double per_row = 2.5 * in_disk(plan, candidates) / rows;
    return rows * (0.4 + std::ceil(per_row / gpu::kScanPerGridTrip));
}

double GridDomain::detect_passes(const RunPlan& plan, std::uint32_t candidates) const {
    return std::ceil(disk_steps(plan, candidates) / plan.step_budget);
}

std::uint64_t GridDomain::cells(std::uint32_t candidates, double error_bound) const {
    return grid(candidates, error_bound).heads;
}

void GridDomain::add_needs(WorkspaceNeeds& needs, std::uint32_t candidates,
                           const RunPlan& plan) const {
    needs.bytes[gpu::kBindAxes] = upload_size(BufferRole::axes);
    needs.bytes[gpu::kBindPoints] = ((words_per_point_ + 1) * std::uint64_t{candidates} +
                                     words_per_point_ * std::uint64_t{plan.slots}) *
                                    4;
}

const char* GridDomain::name_of(BufferRole role) const {
    return role == BufferRole::axes     ? "axes"
           : role == BufferRole::points ? "points"
                                        : to_string(role);
}

void GridDomain::set_constants(gpu::JobRec& job, const RunPlan& plan) const {
    job.limit = grid(job.capacity, plan.error_bound).limit2;
}

std::size_t GridDomain::upload_size(BufferRole role) const {
    return role == BufferRole::axes ? box_.extents.size() * sizeof(gpu::AxisRec) : 0;
}

Result<UploadParts> GridDomain::upload_parts(const RunPlan& plan, BufferRole role) const {
    UploadParts parts;
    if (role == BufferRole::axes) {
        const BoxGrid drawn = grid(capacity_for(stages, plan.stages), plan.error_bound);
        parts.push_back({sizeof(gpu::AxisRec), box_.extents.size(),
                         [axes = drawn.axes](std::size_t begin, std::size_t end, std::byte* out) {
                             std::memcpy(out, axes.data() + begin,
                                         (end - begin) * sizeof(gpu::AxisRec));
                         }});
    }
    return parts;
}

BoxDomain::BoxDomain(const BoxParams& box)
    : GridDomain(box, draw_axes(box), static_cast<std::uint32_t>(box.extents.size()), crowd_of(box),
                 kBoxGuard) {
    kernels.domain = DomainKind::box;
    stages = stages_of(box);
    samples_per_measure = samples_per_volume(box);
    samples = samples_to_expect(stages.samples, box.darts, box.stop_count);
    stop_count = box.stop_count;
    dimension = kernels.dimension;
    units = 1;
    for (std::size_t i = 0; i < box.extents.size(); ++i) {
        units *= lattice()[i].cells;
    }
}

std::string BoxDomain::beside_candidates() const {
    return " of " + std::to_string(dimension) + " coordinates";
}

void BoxDomain::coordinates(const gpu::SampleRec& sample, std::span<double> point) const {
    sample_point(seed, lattice(), sample, point);
}

} // namespace geodisk
