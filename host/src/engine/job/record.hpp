// Recording within a budget.
#pragma once

#include <cstdint>

#include "engine/job/sampler_impl.hpp"

namespace geodisk {

/// Work that may still be recorded; counted down.
struct Budget {
    std::uint32_t dispatches = kAllDispatches;
    /// Faces, candidates, samples or words that the dispatches go through.
    std::uint64_t items = ~std::uint64_t{0};
    /// Most of them in a pass that begins in this recording: what an item takes differs between
    /// passes.
    std::uint64_t items_of_new = ~std::uint64_t{0};
    /// True once such a pass was stopped at this bound. Nothing more is recorded then.
    bool is_in_new = false;

    bool is_spent() const { return dispatches == 0 || items == 0 || is_in_new; }
};

/// As Sampler::record_begin, record_count and record_finish.
bool record_begin(VkCommandBuffer commands, Job::Impl& job, Budget& budget);
bool record_count(VkCommandBuffer commands, Job::Impl& job, Budget& budget);
bool record_finish(VkCommandBuffer commands, Job::Impl& job, Budget& budget);

} // namespace geodisk
