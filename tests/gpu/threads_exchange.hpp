// Threads of one process in place of processes, which sample a surface in parts.
#pragma once

#include <cstdint>
#include <functional>

#include "parts/local_exchange.hpp"

namespace geodisk::test {

/// One of several threads, each of which stands for a process.
class ThreadsExchange : public Exchange {
  public:
    explicit ThreadsExchange(LocalExchange& messages) : messages_(messages) {}

    std::uint32_t rank() const override { return messages_.rank(); }
    std::uint32_t size() const override { return messages_.size(); }
    Result<std::vector<Bytes>> swap(std::span<const std::uint32_t> others,
                                    std::span<const Bytes> messages) override {
        return messages_.swap(others, messages);
    }
    Result<std::vector<std::uint64_t>> sums(std::vector<std::uint64_t> values) override {
        return messages_.sums(std::move(values));
    }

  private:
    LocalExchange& messages_;
};

/// Runs `work` on so many threads, each with its exchange, and waits for all.
void run_threads(std::uint32_t count, const std::function<void(Exchange&)>& work);

} // namespace geodisk::test
