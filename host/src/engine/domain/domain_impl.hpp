// Domain::Impl: what planning, recording and running need to know of a domain.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <geodisk/checkpoint.hpp>
#include <geodisk/domain.hpp>
#include <geodisk/job_frame.hpp>
#include <geodisk/mesh.hpp>
#include <geodisk/params.hpp>
#include <geodisk/sampler.hpp>

#include "engine/domain/tolerances.hpp"
#include "engine/domain/upload_parts.hpp"
#include "engine/kernels/kernel_table.hpp"
#include "push.h"
#include "samples.h"

namespace geodisk {

/// Input of a maximal set.
struct MaximalJob {
    const PreparedMesh* mesh;
    SampleParams params; ///< Parameters of the first samples, without the samples and points below.
    JobFrame frame;
    std::vector<Sample> existing;
    std::vector<KeepOut> avoid;
};

/// Settings that decide the samples, besides their surface, and the size of disks. Surfaces with
/// equal settings may share a job. No surface then gets other samples than alone, or waits for the
/// disks of others.
struct Sharing {
    float limit, slack; ///< Limit and slack of the tolerances.
    bool radii_vary, nearest_first, splits_once, straight_faces; ///< Flags of the frame.
    int disk_size; ///< Logarithm of the faces of a disk, in steps of a factor of 4.

    friend bool operator==(const Sharing&, const Sharing&) = default;
};

/// A job of one surface that may be divided into parts.
struct WholeJob {
    const PreparedMesh* mesh;
    SampleParams params;
    JobFrame frame;
    std::vector<ListedCandidate> list{}; ///< Empty if candidates are drawn.
};

/// Members are computed once from the job. Each kind of domain has its own file.
struct Domain::Impl {
    KernelVariant kernels;
    Stages stages;
    double largest_radius = 0;              ///< Largest radius of one surface, in its units.
    std::vector<std::uint32_t> first_faces; ///< First face of each surface, and one past the last.
    std::vector<std::uint64_t> meshes;      ///< PreparedMesh::identity() of each mesh.
    double samples_per_measure = 0;         ///< Expected samples per unit of area or volume.
    double samples = 0; ///< Expected samples, limited by the stop count and the number of darts.
    std::uint32_t stop_count = 0; ///< Stop count, or 0.
    std::uint64_t seed = 0;
    /// Points to avoid, then existing samples, to upload as the first samples.
    std::vector<gpu::SampleRec> settled;
    std::uint32_t avoided = 0; ///< Number of them that are points to avoid.
    std::uint32_t classes = 0; ///< Number of classes; 0 if samples have none.
    bool has_shares = false;   ///< Classes have SampleParams::class_shares.
    ErrorModel error;          ///< Bound on the error of distances.
    /// Set if the samples of this domain, made with its parameters, are only the first ones of a
    /// maximal set.
    std::optional<MaximalJob> maximal;
    std::optional<WholeJob> whole; ///< Set if the job may be divided.
    /// Number of units that candidates are drawn by: faces, or cells of a box.
    std::uint64_t units = 0;
    /// Device memory per candidate, approximately.
    std::uint64_t bytes_per_candidate = 0;
    std::uint32_t dimension = 0; ///< Dimension of a box.
    /// True if each slot has its own invocation to compute its disk, whatever RunPlan::lanes.
    bool has_lane_per_slot = false;

    Impl() = default;
    Impl(const Impl&) = delete;
    Impl& operator=(const Impl&) = delete;
    virtual ~Impl() = default;

    static const Impl& of(const Domain& domain) { return *domain.impl_; }
    static Domain wrap(std::unique_ptr<const Impl> impl) { return Domain(std::move(impl)); }

    /// Returns the maximum of candidates that one binding holds, with this many slots.
    virtual std::uint64_t max_candidates(const DeviceLimits& limits, std::uint32_t slots) const = 0;
    /// Sets what disks need in a plan with slots, if this many candidates are drawn at once:
    /// disks_by unless it is `lanes`, lanes, window_capacity, table_capacity, list_capacity and
    /// error_bound.
    virtual void plan_disks(RunPlan& plan, std::uint32_t candidates,
                            const DeviceReport& report) const = 0;
    /// Returns the steps of a disk, if this many candidates are drawn at once.
    virtual double disk_steps(const RunPlan& plan, std::uint32_t candidates) const = 0;
    /// Returns the expected steps of the disks of all samples; 0 if unknown.
    virtual double all_steps(const RunPlan&) const { return 0; }
    /// Returns the dispatches of detect that should complete most batches.
    virtual double detect_passes(const RunPlan& plan, std::uint32_t candidates) const = 0;
    /// Returns the words of the table of cells minus two; 0 if the starts of units serve as the
    /// table.
    virtual std::uint64_t cells(std::uint32_t candidates, double error_bound) const = 0;
    /// Adds the bytes of the buffers that only this domain has, for this many candidates.
    virtual void add_needs(WorkspaceNeeds& needs, std::uint32_t candidates,
                           const RunPlan& plan) const = 0;
    /// Returns what takes memory besides candidates, for messages: " and 12 faces".
    virtual std::string beside_candidates() const = 0;
    /// Returns the name of a buffer as the domain uses it.
    virtual const char* name_of(BufferRole role) const { return to_string(role); }
    /// Sets the constants that depend on neither the plan nor the stages.
    virtual void set_constants(gpu::JobRec& job, const RunPlan& plan) const = 0;
    /// Returns the bytes to upload to a buffer; 0 for others.
    virtual std::size_t upload_size(BufferRole role) const = 0;
    /// Returns how many of them, from the first on, depend on `meshes` alone.
    virtual std::size_t mesh_bytes(BufferRole) const { return 0; }
    /// Returns what to upload to a buffer. One part ends at mesh_bytes(). The domain must outlive
    /// it.
    virtual Result<UploadParts> upload_parts(const RunPlan& plan, BufferRole role) const = 0;
    virtual double guard_for(double error_bound) const = 0;
    /// Returns what jobs of several surfaces go by, of a single surface that may share one.
    virtual std::optional<Sharing> sharing() const { return std::nullopt; }
    virtual void coordinates(const gpu::SampleRec&, std::span<double>) const {}
};

} // namespace geodisk
