// Domains with straight-line distances whose candidates are in a grid, such as boxes.
#pragma once

#include "engine/domain/box_grid.hpp"
#include "engine/domain/domain_impl.hpp"

namespace geodisk {

/// Candidates with coordinates in a box.
class GridDomain : public Domain::Impl {
  public:
    std::uint64_t max_candidates(const DeviceLimits& limits, std::uint32_t slots) const override;
    void plan_disks(RunPlan& plan, std::uint32_t candidates,
                    const DeviceReport& report) const override;
    double disk_steps(const RunPlan& plan, std::uint32_t candidates) const override;
    double detect_passes(const RunPlan& plan, std::uint32_t candidates) const override;
    std::uint64_t cells(std::uint32_t candidates, double error_bound) const override;
    void add_needs(WorkspaceNeeds& needs, std::uint32_t candidates,
                   const RunPlan& plan) const override;
    const char* name_of(BufferRole role) const override;
    void set_constants(gpu::JobRec& job, const RunPlan& plan) const override;
    std::size_t upload_size(BufferRole role) const override;
    Result<UploadParts> upload_parts(const RunPlan& plan, BufferRole role) const override;
    double guard_for(double error_bound) const override { return error_bound; }

  protected:
    /// Makes a domain whose points have this many words, with coordinates on `lattice`. A disk
    /// holds about `crowd` candidates per candidate and sample of a full domain. The caller sets
    /// the other members of Impl.
    GridDomain(BoxParams box, const DrawAxes& lattice, std::uint32_t words_per_point, double crowd,
               double guard);

    const BoxParams& box() const { return box_; }
    const DrawAxes& lattice() const { return lattice_; }

  private:
    BoxGrid grid(std::uint32_t candidates, double guard) const {
        return BoxGrid(box_, lattice_, candidates, guard);
    }
    /// Returns the number of candidates in a disk, out of `candidates` drawn at once.
    double in_disk(const RunPlan& plan, std::uint32_t candidates) const;

    BoxParams box_;
    DrawAxes lattice_;
    std::uint32_t words_per_point_;
    double crowd_;
    double guard_;
};

/// Makes the domain of a box that pool_size() accepts.
class BoxDomain : public GridDomain {
  public:
    explicit BoxDomain(const BoxParams& box);
    std::string beside_candidates() const override;
    void coordinates(const gpu::SampleRec& sample, std::span<double> point) const override;
};

} // namespace geodisk
