// A large array worked on by several threads.
#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <exception>
#include <thread>
#include <vector>

namespace geodisk {

/// Elements of a block: some milliseconds of work, beside which starting a thread is nothing.
inline constexpr std::size_t kBlock = 32768;
inline constexpr std::size_t kMostThreads = 16;

constexpr std::size_t block_count(std::size_t count) {
    return (count + kBlock - 1) / kBlock;
}

/// Calls `work(begin, end)` once for each block of [0, count), on as many threads as the machine
/// has, the calling one included, and returns when all is done. Which blocks there are does not
/// depend on the threads, and where none can be started the calling one does it all. `work` must
/// not throw.
template <class Work>
void for_blocks(std::size_t count, const Work& work) {
    const std::size_t blocks = block_count(count);
    std::atomic<std::size_t> next{0};
    const auto take_blocks = [&]() noexcept {
        for (std::size_t block = next++; block < blocks; block = next++) {
            work(block * kBlock, std::min((block + 1) * kBlock, count));
        }
    };
    std::vector<std::jthread> threads;
    const std::size_t most =
        std::min({blocks, kMostThreads, std::size_t{std::thread::hardware_concurrency()}});
    try {
        while (threads.size() + 1 < most) {
            threads.emplace_back(take_blocks);
        }
    } catch (const std::exception&) {
        // Those that could be started do.
    }
    take_blocks();
}

} // namespace geodisk
