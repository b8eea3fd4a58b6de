// ThreadOptions: the threads that a call may use on the host.
// Stable.
#pragma once

#include <cstddef>
#include <cstdint>

namespace geodisk {

/// Threads that a call may use. No result depends on them.
struct ThreadOptions {
    /// Maximum of threads, at least 1, including the calling thread. Uses no more than the machine
    /// has.
    std::uint32_t max_threads = 16;

    /// Runs the work on the caller's own threads, if set; geodisk then starts none. Is called on
    /// the calling thread. Must call `work(context, block)` for each block below `blocks`, on any
    /// threads and in any order, and return when all these calls have returned. Must not throw.
    /// Blocks that it leaves out run on the calling thread afterwards.
    void (*parallel_for)(void* user, std::size_t blocks,
                         void (*work)(void* context, std::size_t block), void* context) = nullptr;
    void* user = nullptr; ///< Passed to `parallel_for`.
};

} // namespace geodisk
