// A box as the loop of a run needs it.
#pragma once

#include <geodisk/box.hpp>

#include "engine/box_grid.hpp"
#include "engine/plan.hpp"
#include "engine/run_source.hpp"
#include "engine/sampler_impl.hpp"

namespace geodisk {

class BoxSource : public RunSource {
  public:
    /// Candidates that lie in the box somehow: points of so many words, of which a disk holds about
    /// `in_disk`. Conflicts are tested against 1 + `guard` distances.
    struct Crowd {
        std::uint32_t words_per_point;
        double in_disk;
        double guard;
        DrawAxes lattice; ///< Of the coordinates.
        Stages stages;
        double samples_per_measure; ///< Expected, by volume or area.
        std::uint32_t stop_count;   ///< As RunSource::stop_count().

        /// Of device memory, at most.
        std::uint64_t bytes_per_candidate() const;
    };

    /// The candidates of a chunk may take `memory` bytes; the sampler, made for boxes of its
    /// dimension, must outlive the source.
    BoxSource(const Sampler::Impl& sampler, const BoxParams& box, VkDeviceSize memory);

    const Stages& stages() const override { return crowd_.stages; }
    std::uint64_t bytes_per_candidate() const override { return crowd_.bytes_per_candidate(); }
    std::uint32_t stop_count() const override { return crowd_.stop_count; }
    Result<RunPlan> plan(std::uint64_t pool_bytes) const override;
    Result<WorkspaceNeeds> needs(const RunPlan& plan) const override;
    Result<Job> make_job(const RunPlan& plan, const Workspace& workspace) const override;
    Result<std::vector<std::byte>> bytes(BufferRole role) const override;
    double guard(const RunPlan&) const override { return crowd_.guard; }

  protected:
    BoxSource(const Sampler::Impl& sampler, BoxParams box, VkDeviceSize memory, const Crowd& crowd);
    virtual gpu::Push push() const;
    /// What candidates are drawn by.
    virtual std::uint64_t drawn_by() const { return grid_.draw_cells; }
    std::uint32_t capacity(const RunPlan& plan) const {
        return capacity_for(crowd_.stages, plan.stages);
    }

    const Sampler::Impl& sampler_;
    BoxParams box_;

  private:
    Crowd crowd_;
    std::uint32_t slots_;
    std::uint32_t stages_at_once_; ///< As many as the device takes.
    BoxGrid grid_;                 ///< For their candidates.
};

} // namespace geodisk
