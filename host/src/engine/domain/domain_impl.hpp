// What a domain tells of itself to those who plan, record and run.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include <geodisk/domain.hpp>
#include <geodisk/sampler.hpp>

#include "engine/domain/tolerances.hpp"
#include "engine/kernels/kernel_table.hpp"
#include "push.h"

namespace geodisk {

/// Its members follow from the job, so they are derived once. Each domain is in a file of its own.
struct Domain::Impl {
    KernelVariant kernels;
    Stages stages;
    double largest_radius = 0;              ///< Of one surface, in its units.
    std::vector<std::uint32_t> first_faces; ///< Of the surfaces, and one past the last.
    std::vector<std::uint64_t> meshes;      ///< PreparedMesh::identity() of each.
    double samples_per_measure = 0;         ///< Expected, per unit of area or volume.
    double samples = 0;           ///< To reckon with: not more than are asked for, or thrown.
    std::uint32_t stop_count = 0; ///< 0 for none.
    std::uint64_t seed = 0;
    ErrorModel error; ///< Of distances.
    /// What candidates are drawn by: faces, or cells of a box.
    std::uint64_t units = 0;
    /// Of device memory, about.
    std::uint64_t bytes_per_candidate = 0;
    std::uint32_t dimension = 0; ///< Of a box.
    /// Whether the disk of each slot is computed by an invocation of its own, whatever
    /// RunPlan::lanes.
    bool has_lane_per_slot = false;

    Impl() = default;
    Impl(const Impl&) = delete;
    Impl& operator=(const Impl&) = delete;
    virtual ~Impl() = default;

    static const Impl& of(const Domain& domain) { return *domain.impl_; }
    static Domain wrap(std::unique_ptr<const Impl> impl) { return Domain(std::move(impl)); }

    /// As many candidates as one binding holds, with so many slots.
    virtual std::uint64_t most_candidates(const DeviceLimits& limits,
                                          std::uint32_t slots) const = 0;
    /// Sets what disks ask of a plan with slots, for so many candidates at once: lanes,
    /// window_capacity, table_capacity, list_capacity and error_bound.
    virtual void plan_disks(RunPlan& plan, std::uint32_t candidates,
                            const DeviceReport& report) const = 0;
    /// Steps that a disk takes, where so many candidates are drawn at once.
    virtual double disk_steps(const RunPlan& plan, std::uint32_t candidates) const = 0;
    /// Steps that the disks of the samples are expected to take; 0 where that is not known.
    virtual double all_steps() const { return 0; }
    /// Dispatches of detect in which a batch should be done, most of all batches.
    virtual double detect_passes(const RunPlan& plan, std::uint32_t candidates) const = 0;
    /// Most steps that one dispatch of detect may safely take.
    virtual std::uint32_t most_steps(const DeviceReport& report,
                                     const KernelVariant& variant) const = 0;
    /// Words of the table of cells but two; 0 where it is that of the units' starts.
    virtual std::uint64_t cells(std::uint32_t candidates, double error_bound) const = 0;
    /// Bytes of the buffers that the domain alone has, for so many candidates.
    virtual void add_needs(WorkspaceNeeds& needs, std::uint32_t candidates,
                           const RunPlan& plan) const = 0;
    /// What takes room besides candidates, for messages: " and 12 faces".
    virtual std::string beside_candidates() const = 0;
    /// Of a buffer, as the domain uses it.
    virtual const char* name_of(BufferRole role) const { return to_string(role); }
    /// The fields of the push block that neither the plan nor the stages tell.
    virtual void set_push(gpu::Push& push, const RunPlan& plan) const = 0;
    /// Bytes of a buffer that is uploaded, 0 for others.
    virtual std::size_t upload_size(BufferRole role) const = 0;
    /// The first of them, which follow from `meshes` alone.
    virtual std::size_t mesh_bytes(BufferRole) const { return 0; }
    /// Those from a byte on: the first, or the one behind mesh_bytes().
    virtual Result<Done> write_upload(const RunPlan& plan, BufferRole role, std::size_t from,
                                      std::span<std::byte> out) const = 0;
    virtual double guard_for(double error_bound) const = 0;
    virtual void coordinates(const gpu::SampleRec&, std::span<double>) const {}
};

} // namespace geodisk
