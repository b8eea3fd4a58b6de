// Divides work on a large array among threads.
#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <exception>
#include <new>
#include <thread>
#include <vector>

#include <geodisk/threads.hpp>

namespace geodisk {

/// Elements per block: several milliseconds of work, much more than the start of a thread.
inline constexpr std::size_t kBlock = 32768;

constexpr std::size_t block_count(std::size_t count) {
    return (count + kBlock - 1) / kBlock;
}

/// Calls `work(begin, end)` once for each block of [0, count), on as many threads as the options
/// and the machine allow, including the calling one. Returns when all blocks are done. The blocks
/// do not depend on the threads. The calling thread does the blocks that no other thread does.
/// `work` must not throw.
template <class Work>
void for_blocks(const ThreadOptions& options, std::size_t count, const Work& work) {
    const std::size_t blocks = block_count(count);
    std::vector<std::atomic_flag> taken(blocks);
    auto take = [&](std::size_t block) noexcept {
        if (block < blocks && !taken[block].test_and_set()) {
            work(block * kBlock, std::min((block + 1) * kBlock, count));
        }
    };
    const auto take_rest = [&]() noexcept {
        for (std::size_t block = 0; block < blocks; ++block) {
            take(block);
        }
    };
    std::vector<std::jthread> threads;
    if (options.parallel_for != nullptr && blocks > 1) {
        options.parallel_for(
            options.user, blocks,
            [](void* context, std::size_t block) {
                (*static_cast<decltype(take)*>(context))(block);
            },
            &take);
    } else if (options.parallel_for == nullptr) {
        const std::size_t most = std::min({blocks, std::size_t{options.max_threads},
                                           std::size_t{std::thread::hardware_concurrency()}});
        try {
            while (threads.size() + 1 < most) {
                threads.emplace_back(take_rest);
            }
        } catch (const std::exception&) {
            // Continue with the threads that could be started.
        }
    }
    take_rest();
}

/// Calls `work(part)` once for each of so many parts, on threads as for_blocks(). `work` may throw
/// only std::bad_alloc, which is thrown again once all parts have returned.
template <class Work>
void for_parts(const ThreadOptions& options, std::size_t parts, const Work& work) {
    std::atomic<bool> is_short_of_memory = false;
    for_blocks(options, parts * kBlock, [&](std::size_t begin, std::size_t) {
        try {
            work(begin / kBlock);
        } catch (const std::bad_alloc&) {
            is_short_of_memory = true;
        }
    });
    if (is_short_of_memory) {
        throw std::bad_alloc();
    }
}

} // namespace geodisk
