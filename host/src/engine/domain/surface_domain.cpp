#include "engine/domain/surface_domain.hpp"

#include <algorithm>
#include <cmath>
#include <memory>

#include "bindings.h"
#include "constants.h"
#include "engine/capacity.hpp"
#include "engine/domain/alike_surfaces.hpp"
#include "engine/domain/check_frame.hpp"
#include "engine/domain/classes.hpp"
#include "engine/domain/device_mesh.hpp"
#include "engine/domain/existing.hpp"
#include "engine/domain/face_mask.hpp"
#include "engine/domain/stages.hpp"
#include "mesh/edge_paths.hpp"
#include "records.h"
#include "support/guard.hpp"
#include "support/invalid.hpp"
#include "support/number_text.hpp"
#include "support/try.hpp"

namespace geodisk {
namespace {

// Faces per disk from which on work groups compute disks, by device. On a CPU a disk at a time
// keeps a thread busy, where lanes need one for each SIMD group of disks. But a group takes so much
// longer for a disk, less for very large ones, whose lanes wait for each other (measured on
// lavapipe).
constexpr double kGroupFaces = 64;
constexpr double kCpuGroupFaces = 512;
constexpr double kGroupCost = 2.4;
constexpr double kVeryLarge = 8192;
constexpr double kVeryLargeCost = 0.9;
// Conflicts to provide for, per candidate that a full surface has for each sample.
constexpr double kListPerCrowd = 8;
constexpr double kMinList = 8;

// Existing samples per sample that a full surface holds, from which on their disks overlap so much
// that bounds pay.
constexpr double kCrowdedExisting = 4;
// Paths end at vertices that are this much farther than their bound, in units of the frame: more
// than rounding does to distances. Bounds are not above the most, far beyond any disk.
constexpr double kBoundMargin = 0.002;
constexpr double kMaxBound = 1e30;

// Faces of a disk up to which all disks are alike for a job of several surfaces.
constexpr double kSmallDisk = 32;

// Limits for several surfaces together, as for one.
constexpr std::uint64_t kMaxHalfEdges = std::uint64_t{1} << 30;
constexpr std::uint64_t kMaxVertices = gpu::kVertexMask;

/// Windows and corners of a disk that covers so many faces, by measurement.
double trips_over(double faces) {
    return 12 + 2.5 * faces + 0.3 * faces * std::sqrt(faces);
}

/// Steps of a disk that covers so many faces; those of a group are about its rounds.
double steps_over(double faces, const RunPlan& plan) {
    return plan.disks_by == DisksBy::groups ? gpu::kGroupStepCost * (4 + 1.4 * std::sqrt(faces))
                                            : trips_over(faces) / gpu::kTripsPerStep;
}

/// Returns true if work groups are to compute the disks, given the slots.
// SwiftShader does not end compiling that kernel, in tens of gigabytes.
bool suits_groups(double faces, std::uint32_t slots, const DeviceReport& report) {
    if (report.driver_id == VK_DRIVER_ID_GOOGLE_SWIFTSHADER) {
        return false;
    }
    if (report.type != VK_PHYSICAL_DEVICE_TYPE_CPU) {
        return faces >= kGroupFaces;
    }
    const std::uint32_t threads = cpu_threads();
    const std::uint32_t per_thread = cpu_lanes(report) / threads;
    const std::uint32_t busy = std::min((slots + per_thread - 1) / per_thread, threads);
    const double cost = faces < kVeryLarge ? kGroupCost : kVeryLargeCost;
    return faces >= kCpuGroupFaces && std::min(slots, threads) > cost * busy;
}

/// The stages of all: each has those of its own.
Stages stages_of(PlacedSurfaces surfaces) {
    if (surfaces.size() == 1) {
        return surfaces[0].stages;
    }
    Stages all;
    double pool = 0;
    for (const PlacedSurface& surface : surfaces) {
        const Stages& own = surface.stages;
        all.samples += own.samples;
        pool += own.pool();
        all.max_stages = std::max(all.max_stages, own.pool_stages());
        all.max_expected += own.expected(0);
    }
    all.ratio = pool / all.samples;
    for (const AlikeSurfaces& alike : alike_surfaces(surfaces)) {
        all.max_variance += alike.deviation * alike.deviation;
        all.max_alike = std::max(all.max_alike, static_cast<std::uint32_t>(alike.surfaces.size()));
    }
    return all;
}

Result<Domain> wrapped(Result<std::unique_ptr<const Domain::Impl>> made) {
    return made ? Result<Domain>(Domain::Impl::wrap(std::move(*made)))
                : Result<Domain>(made.error());
}

Error in_part(std::size_t part, Error error) {
    error.message = "surface " + std::to_string(part) + ": " + error.message;
    return error;
}

/// A part, with the distance in units of its mesh.
Result<PlacedSurface> place(const SurfacePart& part) {
    if (part.mesh == nullptr) {
        return invalid("there is no mesh");
    }
    if (!(part.scale > 0) || !std::isfinite(part.scale)) {
        return invalid("the scale must be a positive finite number, not " + exact_text(part.scale));
    }
    SampleParams params = part.params;
    params.min_distance /= part.scale;
    const auto frame = frame_of(*part.mesh, params);
    GEODISK_TRY(frame);
    if (params.darts != 0 || params.stop_count != 0) {
        return invalid("of several surfaces, darts and samples are not counted");
    }
    if (!params.class_factors.empty()) {
        return invalid("samples on several surfaces have no classes");
    }
    if (params.maximal) {
        return invalid("a maximal set is of one surface; sample each alone");
    }
    PlacedSurface surface = placed(*part.mesh, params, *frame);
    surface.scale = part.scale;
    return surface;
}

bool can_divide(const SampleParams& params) {
    return params.class_shares.empty() && !params.maximal;
}

} // namespace

PlacedSurface placed(const PreparedMesh& mesh, const SampleParams& params, const JobFrame& frame) {
    return {&mesh, params, frame, stages_in(frame, mesh, params), 0, 0, 0, 1};
}

Result<Domain> Domain::surface(const PreparedMesh& mesh, const SampleParams& params) noexcept {
    return guarded([&]() -> Result<Domain> {
        const auto frame = frame_of(mesh, params);
        GEODISK_TRY(frame);
        PlacedSurface surface = placed(mesh, params, *frame);
        surface.may_divide = can_divide(params);
        return wrapped(SurfaceDomain::make({surface}));
    });
}

Result<Domain> Domain::surface(const PreparedMesh& mesh, const SampleParams& params,
                               const JobFrame& frame) noexcept {
    return guarded([&]() -> Result<Domain> {
        GEODISK_TRY(check_params(mesh, params));
        GEODISK_TRY(check_job(frame, params));
        PlacedSurface surface = placed(mesh, params, frame);
        surface.may_divide = can_divide(params);
        GEODISK_TRY(check_candidates(mesh, params, surface.stages));
        GEODISK_TRY(check_frame(frame, mesh, params));
        return wrapped(SurfaceDomain::make({surface}));
    });
}

Result<Domain> Domain::surfaces(std::span<const SurfacePart> parts) noexcept {
    return guarded([&]() -> Result<Domain> {
        if (parts.empty()) {
            return invalid("there are no surfaces");
        }
        std::vector<PlacedSurface> surfaces;
        std::uint64_t half_edges = 0, vertices = 0, corners = 0;
        double candidates = 0;
        for (const SurfacePart& part : parts) {
            auto next = place(part);
            if (next && (next->params.radii != nullptr) != (parts[0].params.radii != nullptr)) {
                next = invalid("some surfaces have radii that vary, others have not");
            }
            if (!next) {
                return in_part(surfaces.size(), next.error());
            }
            next->first_face = static_cast<std::uint32_t>(half_edges / 3);
            next->first_vertex = static_cast<std::uint32_t>(vertices);
            next->first_corner = static_cast<std::uint32_t>(corners);
            half_edges += part.mesh->half_edges().size();
            vertices += part.mesh->vertex_count();
            corners += part.mesh->corners().size();
            candidates += next->stages.candidates();
            if (half_edges > kMaxHalfEdges || vertices > kMaxVertices ||
                candidates > kMaxCandidates) {
                return in_part(surfaces.size(),
                               invalid("with those before it is too large for one job, which may "
                                       "have 2^30 half-edges, 2^30 vertices and 2^32 candidates"));
            }
            surfaces.push_back(*next);
        }
        set_lags(surfaces);
        return wrapped(SurfaceDomain::make(std::move(surfaces)));
    });
}

Result<std::unique_ptr<const Domain::Impl>>
SurfaceDomain::make(std::vector<PlacedSurface> surfaces) {
    auto cells = count_cells(surfaces);
    GEODISK_TRY(cells);
    auto made = std::make_unique<SurfaceDomain>(std::move(surfaces), std::move(*cells));
    made->bound_existing();
    return std::unique_ptr<const Impl>(std::move(made));
}

Result<Domain> SurfaceDomain::plain(const PreparedMesh& mesh, const SampleParams& params,
                                    const JobFrame& frame) {
    PlacedSurface surface = placed(mesh, params, frame);
    surface.may_divide = can_divide(params);
    return wrapped(make({surface}));
}

SurfaceDomain::SurfaceDomain(std::vector<PlacedSurface> surfaces, FaceCells cells)
    : surfaces_(std::move(surfaces)), cells_(std::move(cells)) {
    stages = stages_of(surfaces_);
    for (const PlacedSurface& surface : surfaces_) {
        const PreparedMesh& mesh = *surface.mesh;
        const SampleParams& params = surface.params;
        full_ += std::max(2.0, expected_count(effective_area(mesh, params), params.min_distance));
        whole_ += std::max(2.0, expected_count(whole_area(mesh, params), params.min_distance));
        first_error_ = std::max(first_error_, surface.frame.error_bound);
        error.widen(ErrorModel(surface.frame));
        kernels.event_heap |= surface.frame.nearest_first;
        meshes.push_back(mesh.identity());
        first_faces.push_back(surface.first_face);
        add_avoided(surface, settled);
    }
    avoided = static_cast<std::uint32_t>(settled.size());
    for (const PlacedSurface& surface : surfaces_) {
        add_existing(surface.params, surface.first_face, settled);
    }
    first_faces.push_back(face_count(surfaces_));
    kernels.domain = DomainKind::surface;
    kernels.adaptive = has_radii(surfaces_);
    kernels.several = surfaces_.size() > 1;
    kernels.avoids = avoided > 0;
    kernels.classes = !surfaces_[0].params.class_factors.empty();
    classes = kernels.classes ? class_count(surfaces_[0].params) : 0;
    has_shares = !surfaces_[0].params.class_shares.empty();
    kernels.keyed = !kernels.several && !surfaces_[0].params.face_keys.empty();
    kernels.many_rows = cells_.count != 0;
    // Several have none of it, and seeds of their own.
    const SampleParams& params = surfaces_[0].params;
    samples_per_measure = samples_per_area() * class_density(params);
    if (params.maximal) {
        maximal = MaximalJob{surfaces_[0].mesh,
                             params,
                             surfaces_[0].frame,
                             {params.existing.begin(), params.existing.end()},
                             {params.avoid.begin(), params.avoid.end()}};
        maximal->params.maximal = false;
        maximal->params.existing = {};
        maximal->params.avoid = {};
    }
    if (surfaces_[0].may_divide) {
        whole = WholeJob{surfaces_[0].mesh, params, surfaces_[0].frame, {}};
    }
    samples = samples_to_expect(full_, params.darts, params.stop_count);
    stop_count = params.stop_count;
    seed = kernels.several ? 0 : params.seed;
    units = face_count(surfaces_);
    largest_radius = params.min_distance / 2;
    bytes_per_candidate = 16;
}

void SurfaceDomain::set_bounds(std::span<const double> bounds) {
    const double unit = surfaces_[0].frame.unit;
    bounds_.assign((bounds.size() + 3) / 4 * 4, 0); // Whole rows.
    std::ranges::transform(bounds, bounds_.begin(), [unit](double bound) {
        return static_cast<float>(std::min(bound / unit + kBoundMargin, kMaxBound));
    });
    kernels.bounded = true;
}

void SurfaceDomain::bound_existing() {
    const std::span<const Sample> given = surfaces_[0].params.existing;
    // With radii or distances that differ, a sample that is farther may reject what a nearer one
    // does not.
    if (kernels.several || kernels.adaptive || kernels.classes || maximal ||
        static_cast<double>(given.size()) < kCrowdedExisting * whole_) {
        return;
    }
    EdgePaths paths(*surfaces_[0].mesh);
    for (const Sample& sample : given) {
        paths.begin_at(sample, 0);
    }
    set_bounds(paths.lengths());
}

std::uint64_t SurfaceDomain::max_candidates(const DeviceLimits& limits, std::uint32_t) const {
    return limits.max_storage_buffer_range / (2 * sizeof(std::uint32_t)); // Two weights each.
}

void SurfaceDomain::plan_disks(RunPlan& plan, std::uint32_t candidates,
                               const DeviceReport& report) const {
    const double faces = faces_per_disk();
    const bool cpu = report.type == VK_PHYSICAL_DEVICE_TYPE_CPU;
    const bool may_group =
        plan.disks_by != DisksBy::lanes && !kernels.records() && !kernels.bounded;
    if (may_group && suits_groups(faces, plan.slots, report)) {
        plan.disks_by = DisksBy::groups;
        plan.pool_block = 1;
        // More than it has threads would be disks in vain.
        plan.slots = cpu ? std::min(plan.slots, std::max(kMinSlots, cpu_threads())) : plan.slots;
        plan.lanes = cpu ? std::min(plan.slots, cpu_threads()) : plan.slots;
        plan.window_capacity = pow2_at_least(128 + 4 * faces);
    } else {
        plan.disks_by = DisksBy::lanes;
        // A CPU runs as many lanes as it has; a GPU is to have one for every slot.
        plan.lanes = cpu ? std::min(plan.slots, cpu_lanes(report)) : plan.slots;
        // Some disks are much larger than most; a CPU's few lanes can all be ready for them.
        plan.window_capacity = pow2_at_least((cpu ? 128 : 32) + 2 * faces);
    }
    plan.table_capacity = pow2_at_least((cpu ? 48 : 16) + 4 * faces);
    const double crowd = class_crowding(surfaces_[0].params) * candidates / full_;
    plan.list_capacity = pow2_at_least(std::max(kMinList, kListPerCrowd * crowd));
    plan.error_bound = first_error_;
}

std::optional<Sharing> SurfaceDomain::sharing() const {
    if (surfaces_.size() != 1) {
        return std::nullopt;
    }
    const JobFrame& frame = surfaces_[0].frame;
    const Tolerances tolerances = error.tolerances(first_error_);
    const double faces = std::max(1.0, faces_per_disk() / kSmallDisk);
    return Sharing{tolerances.limit,
                   tolerances.slack,
                   frame.radii_vary,
                   frame.nearest_first,
                   frame.splits_once,
                   frame.straight_faces,
                   static_cast<int>(std::ceil(std::log2(faces) / 2))};
}

double SurfaceDomain::disk_steps(const RunPlan& plan, std::uint32_t) const {
    return steps_over(faces_per_disk(), plan);
}

double SurfaceDomain::all_steps(const RunPlan& plan) const {
    if (!kernels.adaptive) {
        return samples * steps_over(faces_per_disk(), plan);
    }
    double steps = 0;
    for (const PlacedSurface& surface : surfaces_) {
        const PreparedMesh& mesh = *surface.mesh;
        const double room = expected_count(1, surface.params.min_distance);
        const double largest = 2.0 * mesh.face_count() / (room * mesh.statistics().area);
        for (std::uint32_t face = 0; face < mesh.face_count(); ++face) {
            const double faces = largest / surface.params.radii->densities()[face];
            steps += expected_in_face(mesh, surface.params, face, room) *
                     steps_over(std::min<double>(faces, mesh.face_count()), plan);
        }
    }
    return steps * samples / full_;
}

double SurfaceDomain::detect_passes(const RunPlan& plan, std::uint32_t candidates) const {
    const double disks = std::ceil(static_cast<double>(plan.slots) / plan.lanes);
    const double each = plan.disks_by == DisksBy::groups ? gpu::kGroupStepCost : 1;
    return disks * disk_steps(plan, candidates) / each / plan.step_budget + 2;
}

std::uint64_t SurfaceDomain::cells(std::uint32_t, double) const {
    return cells_.count;
}

void SurfaceDomain::add_needs(WorkspaceNeeds& needs, std::uint32_t candidates,
                              const RunPlan&) const {
    for (const BufferRole role : {BufferRole::faces, BufferRole::fans}) {
        needs.bytes[static_cast<std::size_t>(role)] = upload_size(role);
    }
    needs.bytes[gpu::kBindWeights] =
        kernels.records() ? record_bytes_ : std::uint64_t{candidates} * 8;
}

std::string SurfaceDomain::beside_candidates() const {
    return " and " + std::to_string(units) + " faces";
}

void SurfaceDomain::set_constants(gpu::JobRec& job, const RunPlan& plan) const {
    const Tolerances tolerances = error.tolerances(plan.error_bound);
    job.limit = tolerances.limit;
    job.margin = tolerances.margin;
    job.slack = tolerances.slack;
    job.base_error = static_cast<float>(error.error_of(0));
    const auto has_keys = [](const PlacedSurface& s) { return !s.params.face_keys.empty(); };
    job.has_keys = std::all_of(surfaces_.begin(), surfaces_.end(), has_keys) ? 1 : 0;
    job.first_key_row = static_cast<std::uint32_t>(
        (fan_bytes(surfaces_) + radii_bytes(surfaces_) + std::span(bounds_).size_bytes()) /
        kRowBytes);
    job.first_mask_row =
        mask_bytes(surfaces_) == 0
            ? 0
            : job.first_key_row + static_cast<std::uint32_t>(key_bytes(surfaces_) / kRowBytes);
    job.first_class_row =
        job.first_key_row +
        static_cast<std::uint32_t>((key_bytes(surfaces_) + mask_bytes(surfaces_)) / kRowBytes);
    job.max_lag = std::ranges::max(surfaces_, {}, &PlacedSurface::lag).lag;
    job.vertices = vertex_count(surfaces_);
    job.path_rules = gpu::kRuleSplitsOnce | gpu::kRuleStraightFaces;
    for (const PlacedSurface& surface : surfaces_) {
        job.path_rules &= (surface.frame.splits_once ? ~0u : ~gpu::kRuleSplitsOnce) &
                          (surface.frame.straight_faces ? ~0u : ~gpu::kRuleStraightFaces);
    }
    job.path_rules |= kernels.bounded ? gpu::kRuleBounded : 0;
}

std::size_t SurfaceDomain::upload_size(BufferRole role) const {
    switch (role) {
    case BufferRole::faces:
        return half_edge_bytes(surfaces_) + length_bytes(surfaces_);
    case BufferRole::fans:
        return fan_bytes(surfaces_) + radii_bytes(surfaces_) + std::span(bounds_).size_bytes() +
               key_bytes(surfaces_) + mask_bytes(surfaces_) + class_bytes(surfaces_[0].params);
    case BufferRole::samples:
        return settled.size() * sizeof settled[0];
    default:
        return listed_words(role).size_bytes();
    }
}

std::span<const std::uint32_t> SurfaceDomain::listed_words(BufferRole role) const {
    switch (role) {
    case BufferRole::starts:
        return listed_.starts;
    case BufferRole::cells:
        return listed_.cells;
    case BufferRole::weights:
        return listed_.weights;
    case BufferRole::orders:
        return listed_.orders;
    default:
        return {};
    }
}

std::size_t SurfaceDomain::mesh_bytes(BufferRole role) const {
    switch (role) {
    case BufferRole::faces:
        return half_edge_bytes(surfaces_);
    case BufferRole::fans:
        return fan_bytes(surfaces_);
    default:
        return 0;
    }
}

Result<UploadParts> SurfaceDomain::upload_parts(const RunPlan&, BufferRole role) const {
    UploadParts parts;
    if (role == BufferRole::faces) {
        add_half_edges(surfaces_, parts);
        add_lengths(surfaces_, cells_, parts);
    } else if (role == BufferRole::fans) {
        add_fans(surfaces_, parts);
        if (has_radii(surfaces_)) {
            GEODISK_TRY(add_radii(surfaces_, parts));
        }
        if (!bounds_.empty()) {
            parts.push_back(upload_part(std::span(bounds_)));
        }
        add_keys(surfaces_, parts);
        add_mask(surfaces_, parts);
        add_classes(surfaces_[0].params, parts);
    } else if (role == BufferRole::samples) {
        parts.push_back(upload_part(std::span(settled)));
    } else {
        parts.push_back(upload_part(listed_words(role)));
    }
    return parts;
}

} // namespace geodisk
