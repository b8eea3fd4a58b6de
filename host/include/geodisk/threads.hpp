// Who does the work of a call that can be divided.
#pragma once

#include <cstddef>
#include <cstdint>

namespace geodisk {

/// The threads that a call may use. No result depends on them.
struct ThreadOptions {
    /// At least 1, the calling thread included. The machine may have fewer.
    std::uint32_t most_threads = 16;

    /// Where given, no thread is started. It is called instead, from the calling thread, must call
    /// `work(context, block)` for each block below `blocks`, on any threads and in any order, and
    /// return when these calls have. It must not throw. Blocks it leaves out are done after it.
    void (*parallel_for)(void* user, std::size_t blocks,
                         void (*work)(void* context, std::size_t block), void* context) = nullptr;
    void* user = nullptr; ///< Handed to `parallel_for`.
};

} // namespace geodisk
