// Threads of one process in place of processes, which sample a surface in parts.
#pragma once

#include <condition_variable>
#include <cstdint>
#include <deque>
#include <functional>
#include <map>
#include <mutex>
#include <utility>

#include <geodisk/exchange.hpp>

namespace geodisk::test {

/// Messages on their way.
class Mailbox {
  public:
    void post(std::uint32_t from, std::uint32_t to, Bytes message);
    Bytes fetch(std::uint32_t from, std::uint32_t to);

  private:
    std::mutex mutex_;
    std::condition_variable arrived_;
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::deque<Bytes>> messages_;
};

/// One of several threads.
class ThreadsExchange : public Exchange {
  public:
    ThreadsExchange(Mailbox& mailbox, std::uint32_t rank, std::uint32_t size)
        : mailbox_(mailbox), rank_(rank), size_(size) {}

    std::uint32_t rank() const override { return rank_; }
    std::uint32_t size() const override { return size_; }
    Result<std::vector<Bytes>> swap(std::span<const std::uint32_t> others,
                                    std::span<const Bytes> messages) override;
    Result<std::vector<std::uint64_t>> sums(std::vector<std::uint64_t> values) override;

  private:
    Mailbox& mailbox_;
    std::uint32_t rank_, size_;
};

/// Runs `work` on so many threads, each with its exchange, and waits for all.
void run_threads(std::uint32_t count, const std::function<void(Exchange&)>& work);

} // namespace geodisk::test
