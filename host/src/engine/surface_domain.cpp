#include "engine/surface_domain.hpp"

#include <algorithm>
#include <cmath>
#include <memory>

#include "bindings.h"
#include "constants.h"
#include "engine/device_mesh.hpp"
#include "engine/plan.hpp"
#include "engine/stages.hpp"
#include "support/guard.hpp"

namespace geodisk {
namespace {

// llvmpipe ends all loops of a shader after so many iterations per SIMD group, silently.
constexpr std::uint32_t kLlvmpipeIterations = 65535;
// Elsewhere the budget keeps a dispatch well under the watchdogs.
constexpr std::uint32_t kDefaultSteps = 128;
// Conflicts to provide for, per candidate that a full surface has for each sample.
constexpr double kListPerCrowd = 8;
constexpr double kLeastList = 8;
// Disks from so many faces on take vertex events by distance. The rule must not look at the device:
// with the order of work the longest window chain may change, and with it the guard.
constexpr double kHeapFaces = 1u << 14;

} // namespace

Result<Domain> Domain::surface(const PreparedMesh& mesh, const SampleParams& params) noexcept {
    return guarded([&]() -> Result<Domain> {
        if (auto checked = pool_size(mesh, params); !checked) {
            return checked.error();
        }
        const auto cells = count_cells(mesh, params);
        if (!cells) {
            return cells.error();
        }
        return Domain(std::make_unique<SurfaceDomain>(mesh, params, *cells));
    });
}

SurfaceDomain::SurfaceDomain(const PreparedMesh& mesh, const SampleParams& params,
                             std::uint32_t cells)
    : mesh_(mesh), params_(params), cells_(cells),
      full_(std::max(2.0, expected_count(effective_area(mesh, params), params.min_distance))) {
    kernels.domain = DomainKind::surface;
    kernels.adaptive = params.radii != nullptr;
    kernels.event_heap = faces_per_disk() >= kHeapFaces;
    stages = stages_of(mesh, params);
    samples_per_measure = samples_per_area();
    samples = samples_to_expect(full_, params.throws, params.stop_count);
    stop_count = params.stop_count;
    seed = params.seed;
    units = mesh.face_count();
    error = ErrorModel(mesh, params);
    bytes_per_candidate = 16;
}

std::uint64_t SurfaceDomain::most_candidates(const DeviceLimits& limits, std::uint32_t) const {
    return limits.max_storage_buffer_range / 4;
}

void SurfaceDomain::plan_disks(RunPlan& plan, std::uint32_t candidates,
                               const DeviceReport& report) const {
    const double faces = faces_per_disk();
    const bool cpu = report.type == VK_PHYSICAL_DEVICE_TYPE_CPU;
    // A CPU runs as many lanes as it has; a GPU is to have one for every slot.
    plan.lanes = cpu ? std::min(plan.slots, cpu_lanes(report)) : plan.slots;
    // Some disks are much larger than most; a CPU's few lanes can all be ready for them.
    plan.window_capacity = pow2_at_least((cpu ? 128 : 32) + 2 * faces);
    plan.table_capacity = pow2_at_least((cpu ? 48 : 16) + 4 * faces);
    plan.list_capacity = pow2_at_least(std::max(kLeastList, kListPerCrowd * candidates / full_));
    plan.error_bound = first_error(mesh_, params_);
}

double SurfaceDomain::disk_steps(const RunPlan&, std::uint32_t) const {
    // By measurement.
    const double faces = faces_per_disk();
    return (12 + 2.5 * faces + 0.3 * faces * std::sqrt(faces)) / gpu::kTripsPerStep;
}

double SurfaceDomain::detect_passes(const RunPlan& plan, std::uint32_t candidates) const {
    const double disks = std::ceil(static_cast<double>(plan.slots) / plan.lanes);
    return disks * disk_steps(plan, candidates) / plan.step_budget + 2;
}

std::uint32_t SurfaceDomain::most_steps(const DeviceReport& report,
                                        const KernelVariant& variant) const {
    if (report.driver_id != VK_DRIVER_ID_MESA_LLVMPIPE) {
        return kDefaultSteps;
    }
    return kLlvmpipeIterations /
           (gpu::kIterationsPerStep + (variant.event_heap ? gpu::kHeapIterationsPerStep : 0));
}

std::uint64_t SurfaceDomain::cells(std::uint32_t, double) const {
    return cells_;
}

void SurfaceDomain::add_needs(WorkspaceNeeds& needs, std::uint32_t candidates,
                              const RunPlan&) const {
    for (const BufferRole role : {BufferRole::faces, BufferRole::fans, BufferRole::keys}) {
        needs.bytes[static_cast<std::size_t>(role)] = upload_size(role);
    }
    needs.bytes[gpu::kBindWeights] = std::uint64_t{candidates} * 4;
}

std::string SurfaceDomain::beside_candidates() const {
    return " and " + std::to_string(mesh_.face_count()) + " faces";
}

void SurfaceDomain::set_push(gpu::Push& push, const RunPlan& plan) const {
    const Tolerances tolerances = error.tolerances(plan.error_bound);
    push.limit = tolerances.limit;
    push.margin = tolerances.margin;
    push.slack = tolerances.slack;
    push.has_keys = params_.face_keys.empty() ? 0 : 1;
    push.all_single = cells_ == 0 ? 1 : 0;
    push.vertices = mesh_.vertex_count();
    push.splits_once = mesh_.statistics().nonmanifold_edges == 0 ? 1 : 0;
}

std::size_t SurfaceDomain::upload_size(BufferRole role) const {
    switch (role) {
    case BufferRole::faces:
        return face_bytes(mesh_);
    case BufferRole::fans:
        return fan_bytes(mesh_, kernels.adaptive);
    case BufferRole::keys:
        return key_bytes(params_);
    default:
        return 0;
    }
}

Result<Done> SurfaceDomain::write_upload(const RunPlan&, BufferRole role,
                                         std::span<std::byte> out) const {
    switch (role) {
    case BufferRole::faces:
        write_faces(mesh_, params_, cells_ == 0, out);
        return Done{};
    case BufferRole::fans:
        return write_fans(mesh_, params_, out);
    default:
        write_keys(params_, out);
        return Done{};
    }
}

} // namespace geodisk
