// Work that is divided among the cores of the machine, batch by batch.
#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <exception>
#include <functional>
#include <mutex>
#include <system_error>
#include <thread>
#include <vector>

namespace geodisk::tools {

/// Called now and then with the part that is done. It may throw, which ends the work.
using PartDone = std::function<void(double part)>;

/// Returns how many batches of up to `size` there are.
constexpr std::size_t batch_count(std::size_t count, std::size_t size) {
    return (count + size - 1) / size;
}

/// Each thread makes a worker of its own by `make_worker()`, whose `worker(batch, begin, end)` is
/// called for batches of [0, count), each of which one worker gets. `tell` is called on the calling
/// thread, the last time when all is done. Then it returns, or rethrows what was thrown first.
template <class MakeWorker>
void in_batches(std::size_t count, std::size_t size, const MakeWorker& make_worker,
                const PartDone& tell) {
    const std::size_t batches = batch_count(count, size);
    std::atomic<std::size_t> next{0}, done{0};
    std::mutex mutex;
    std::exception_ptr error;
    const auto work = [&](const PartDone& told) noexcept {
        try {
            auto worker = make_worker();
            for (std::size_t batch; (batch = next++) < batches;) {
                worker(batch, batch * size, std::min(count, (batch + 1) * size));
                ++done;
                if (told) {
                    told(static_cast<double>(done) / static_cast<double>(batches));
                }
            }
        } catch (...) {
            const std::scoped_lock lock(mutex);
            error = error ? error : std::current_exception();
            next = batches;
        }
    };
    {
        std::vector<std::jthread> others;
        const std::size_t most =
            std::min<std::size_t>(batches, std::max(1u, std::thread::hardware_concurrency()));
        try {
            while (others.size() + 1 < most) {
                others.emplace_back([&work] { work(PartDone()); });
            }
        } catch (const std::system_error&) {
            // Continue with the threads that could be started.
        }
        work(tell);
    }
    if (error) {
        std::rethrow_exception(error);
    }
    if (tell) {
        tell(1);
    }
}

} // namespace geodisk::tools
