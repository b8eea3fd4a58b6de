#include "engine/job/stage_clock.hpp"

#include <utility>

#include "support/try.hpp"
#include "vk/result.hpp"

namespace geodisk {
namespace {

// More than the maximum of rounds of a submission writes.
constexpr std::uint32_t kQueries = 4096;

} // namespace

const char* to_string(Stage stage) noexcept {
    constexpr const char* kNames[kStages] = {"count",  "bin",     "draw",  "select",
                                             "detect", "resolve", "gather"};
    return kNames[static_cast<std::size_t>(stage)];
}

Result<StageClock> StageClock::create(const DeviceRefs& refs, float period,
                                      std::uint32_t valid_bits) {
    const auto table = load_query_table(refs);
    GEODISK_TRY(table);
    StageClock clock;
    clock.refs_ = &refs;
    clock.vk_ = *table;
    clock.seconds_per_tick_ = period * 1e-9;
    clock.mask_ = valid_bits >= 64 ? ~std::uint64_t{0} : (std::uint64_t{1} << valid_bits) - 1;
    VkQueryPoolCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_QUERY_POOL_CREATE_INFO;
    info.queryType = VK_QUERY_TYPE_TIMESTAMP;
    info.queryCount = kQueries;
    const VkResult result = null_unless_success(
        clock.vk_.vkCreateQueryPool(refs.device, &info, refs.host_allocator, &clock.pool_),
        clock.pool_);
    if (result != VK_SUCCESS) {
        return vk_error("vkCreateQueryPool", result);
    }
    return clock;
}

StageClock::StageClock(StageClock&& other) noexcept
    : refs_(other.refs_), vk_(other.vk_), pool_(std::exchange(other.pool_, VK_NULL_HANDLE)),
      seconds_per_tick_(other.seconds_per_tick_), mask_(other.mask_),
      stages_(std::move(other.stages_)), seconds_(other.seconds_) {}

StageClock::~StageClock() {
    if (pool_ != VK_NULL_HANDLE) {
        vk_.vkDestroyQueryPool(refs_->device, pool_, refs_->host_allocator);
    }
}

void StageClock::begin(VkCommandBuffer commands) {
    stages_.clear();
    vk_.vkCmdResetQueryPool(commands, pool_, 0, kQueries);
    vk_.vkCmdWriteTimestamp(commands, VK_PIPELINE_STAGE_BOTTOM_OF_PIPE_BIT, pool_, 0);
}

void StageClock::mark(VkCommandBuffer commands, Stage stage) {
    if (stages_.size() + 1 < kQueries) {
        stages_.push_back(stage);
        vk_.vkCmdWriteTimestamp(commands, VK_PIPELINE_STAGE_BOTTOM_OF_PIPE_BIT, pool_,
                                static_cast<std::uint32_t>(stages_.size()));
    }
}

Result<Done> StageClock::collect() {
    std::vector<std::uint64_t> ticks(stages_.size() + 1);
    const VkResult result = vk_.vkGetQueryPoolResults(
        refs_->device, pool_, 0, static_cast<std::uint32_t>(ticks.size()),
        ticks.size() * sizeof(std::uint64_t), ticks.data(), sizeof(std::uint64_t),
        VK_QUERY_RESULT_64_BIT | VK_QUERY_RESULT_WAIT_BIT);
    if (result != VK_SUCCESS) {
        return vk_error("vkGetQueryPoolResults", result);
    }
    for (std::size_t i = 0; i < stages_.size(); ++i) {
        const std::uint64_t taken = (ticks[i + 1] - ticks[i]) & mask_;
        seconds_[static_cast<std::size_t>(stages_[i])] +=
            static_cast<double>(taken) * seconds_per_tick_;
    }
    return Done{};
}

} // namespace geodisk
