// A sampling job whose buffers the test can read after every step. Built on the same Sampler calls
// that an embedding engine makes.
#pragma once

#include <algorithm>
#include <array>
#include <cstring>
#include <functional>
#include <optional>
#include <span>
#include <stdexcept>
#include <vector>

#include <geodisk/context.hpp>
#include <geodisk/sampler.hpp>

#include "engine/job/sampler_impl.hpp"
#include "engine/run/submitter.hpp"
#include "records.h"
#include "vk/buffer.hpp"

namespace geodisk::test {

/// The device of all tests in this process; throws when there is none.
Context& shared_context();

/// The value, or an exception with the error's message.
template <class T>
T expect(Result<T> result) {
    if (!result) {
        throw std::runtime_error(result.error().message);
    }
    return std::move(*result);
}

class DeviceRun {
  public:
    /// Fields of `plan` that are not zero replace those of Sampler::plan_run.
    DeviceRun(const Domain& domain, const RunPlan& plan = {}, const SamplerOptions& options = {},
              const Context& context = shared_context());
    DeviceRun(const PreparedMesh& mesh, const SampleParams& params, const RunPlan& plan = {},
              const SamplerOptions& options = {}, const Context& context = shared_context())
        : DeviceRun(expect(Domain::surface(mesh, params)), plan, options, context) {}
    DeviceRun(const BoxParams& box, const RunPlan& plan, const SamplerOptions& options = {},
              const Context& context = shared_context())
        : DeviceRun(expect(Domain::box(box)), plan, options, context) {}

    /// Begins any stages, which Job::advance() does in their order.
    void set_stages(std::uint32_t first, std::uint32_t count) {
        Job::Impl::of(*job_).begin_stages(first, count);
    }
    /// Within the pool there is.
    void set_plan(const RunPlan& plan) { expect(job_->set_plan(plan)); }
    /// At most so many dispatches; whether those were the last.
    bool begin(std::uint32_t dispatches = kAllDispatches);
    bool finish(std::uint32_t dispatches = kAllDispatches);
    bool count(std::uint32_t dispatches = kAllDispatches);
    void rounds(std::uint32_t count);
    /// Goes on after an overflow, within the pool there is.
    void grow();
    /// Room for so many, and what there is copied.
    void enlarge_samples(std::uint32_t capacity);
    void rewind();
    /// Does what comes next, a round at a time; false if nothing does by itself: the run is
    /// complete or paused.
    bool follow(const Advice& advice);
    /// Follows the job's advice for as long. Returns the last.
    Advice follow_all();

    gpu::ControlRec control() const { return read<gpu::ControlRec>(BufferRole::control, 1)[0]; }
    const RunPlan& plan() const { return job_->plan(); }
    Job& job() { return *job_; }
    const gpu::Push& push() const { return Job::Impl::of(*job_).push; }
    const gpu::JobRec& constants() const { return Job::Impl::of(*job_).constants; }
    const Sampler& sampler() const { return sampler_; }

    /// The first `count` records of a buffer, after `skip` bytes.
    template <class Record>
    std::vector<Record> read(BufferRole role, std::size_t count, std::size_t skip = 0) const {
        std::vector<Record> records(count);
        if (count > 0) {
            std::memcpy(records.data(),
                        buffers_[static_cast<std::size_t>(role)].bytes().data() + skip,
                        count * sizeof(Record));
        }
        return records;
    }

    /// Writes to the start of a buffer.
    template <class Record>
    void write(BufferRole role, std::span<const Record> records) {
        const auto bytes = std::as_bytes(records);
        std::copy(bytes.begin(), bytes.end(),
                  buffers_[static_cast<std::size_t>(role)].bytes().begin());
    }

    /// Dispatches recorded so far.
    std::uint64_t dispatches() const { return Job::Impl::of(*job_).dispatches; }

    /// Records, submits and waits.
    void submit(const std::function<void(VkCommandBuffer)>& record);
    /// Makes a buffer of a caller, which the host may read and write.
    DeviceBuffer make_buffer(VkDeviceSize bytes) const {
        return expect(
            DeviceBuffer::create(device_, vk_, memory_, bytes, kWorkspaceUsage, MemoryKind::host));
    }

  private:
    DeviceRefs device_;
    DeviceTable vk_;
    Sampler sampler_;
    std::optional<Submitter> submitter_;
    VkPhysicalDeviceMemoryProperties memory_{};
    std::array<DeviceBuffer, kBufferRoles> buffers_;
    std::optional<Job> job_;
};

/// `plan` with slices and lists of a few entries, which overflow.
RunPlan tightened(RunPlan plan);

/// Selects the next batch, or lists those that come next, and goes on until it is decided; false if
/// no candidate is left. Requires that nothing overflows.
bool decide_batch(DeviceRun& run);

enum class PlaceState : std::uint8_t { idle, active, decided };

/// Returns the states of the first candidates by place, so many.
std::vector<PlaceState> states_of(const DeviceRun& run, std::size_t count);

/// Returns how many candidates have another state on the device than in `states`, which are by
/// rank.
std::uint32_t wrong_states(const DeviceRun& run, const std::vector<std::uint8_t>& states,
                           const std::vector<std::uint32_t>& by_place);

/// Rank of a sample of earlier stages.
inline constexpr std::uint32_t kNoRank = 0xffffffff;

/// The ranks of the conflicts above `rank` that slot `index` lists, ascending; `by_place` has the
/// ranks of all places.
std::vector<std::uint32_t> listed(const DeviceRun& run, std::size_t index, std::uint32_t rank,
                                  const std::vector<std::uint32_t>& by_place);

/// All slots as they were left.
std::vector<gpu::SlotRec> slots_of(const DeviceRun& run);

} // namespace geodisk::test
