// A box as the loop of a run needs it.
#pragma once

#include <geodisk/box.hpp>

#include "engine/box_grid.hpp"
#include "engine/runner_impl.hpp"

namespace geodisk {

class BoxSource : public RunSource {
  public:
    /// Candidates that lie in the box somehow: points of so many words, of which a disk holds about
    /// `in_disk`. Conflicts are tested against 1 + `guard` distances.
    struct Crowd {
        std::uint32_t words_per_point;
        double in_disk;
        double guard;
        std::uint32_t stop_count; ///< As RunSource::stop_count().

        /// Of device memory, at most.
        std::uint64_t bytes_per_candidate() const;
    };

    /// `candidates` is pool_size() of the box, and those of a chunk may take `memory` bytes; the
    /// sampler, made for boxes of its dimension, must outlive the source.
    BoxSource(const Sampler::Impl& sampler, const BoxParams& box, std::uint32_t candidates,
              VkDeviceSize memory);

    std::uint32_t candidates() const override { return candidates_; }
    std::uint64_t bytes_per_candidate() const override { return crowd_.bytes_per_candidate(); }
    std::uint32_t stop_count() const override { return crowd_.stop_count; }
    double room() const final { return candidates_ / box_.pool_ratio; }
    Result<RunPlan> plan(std::uint64_t pool_bytes) const override;
    Result<WorkspaceNeeds> needs(const RunPlan& plan) const override;
    Result<Job> make_job(const RunPlan& plan, const Workspace& workspace) const override;
    Result<std::vector<std::byte>> bytes(BufferRole role) const override;
    double guard(const RunPlan&) const override { return crowd_.guard; }

  protected:
    /// Samples are `candidates` by the pool ratio of the box.
    BoxSource(const Sampler::Impl& sampler, BoxParams box, std::uint32_t candidates,
              VkDeviceSize memory, const Crowd& crowd);
    virtual gpu::Push push() const;

    const Sampler::Impl& sampler_;
    BoxParams box_;
    std::uint32_t candidates_;

  private:
    Crowd crowd_;
    std::uint32_t slots_;
    std::uint32_t chunk_; ///< As many candidates as the device takes at once.
    BoxGrid grid_;        ///< For a chunk.
};

} // namespace geodisk
