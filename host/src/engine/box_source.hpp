// A box as the loop of a run needs it.
#pragma once

#include <geodisk/box.hpp>

#include "engine/box_grid.hpp"
#include "engine/runner_impl.hpp"

namespace geodisk {

class BoxSource : public RunSource {
  public:
    /// `candidates` is pool_size() of the box; the sampler, made for boxes of its dimension, must
    /// outlive the source.
    BoxSource(const Sampler::Impl& sampler, const BoxParams& box, std::uint32_t candidates);

    std::uint32_t candidates() const override { return candidates_; }
    double room() const override { return candidates_ / box_.pool_ratio; }
    Result<RunPlan> plan(std::uint64_t pool_bytes) const override;
    Result<WorkspaceNeeds> needs(const RunPlan& plan) const override;
    Result<Job> make_job(const RunPlan& plan, const Workspace& workspace) const override;
    Result<std::vector<std::byte>> bytes(BufferRole role) const override;
    double guard(const RunPlan&) const override { return guard_; }

  protected:
    /// The same where a disk holds about `in_disk` candidates, which lie in the box somehow, and
    /// conflicts are tested against 1 + `guard` distances.
    BoxSource(const Sampler::Impl& sampler, BoxParams box, std::uint32_t candidates, double in_disk,
              double guard);
    virtual gpu::Push push() const;

    const Sampler::Impl& sampler_;
    BoxParams box_;
    std::uint32_t candidates_;

  private:
    double in_disk_;
    double guard_;
    BoxGrid grid_;
};

} // namespace geodisk
