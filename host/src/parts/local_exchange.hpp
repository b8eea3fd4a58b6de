// Messages among the parts of one process, each a thread of its own.
#pragma once

#include <array>
#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include <geodisk/exchange.hpp>

namespace geodisk {

/// One part of a process that has them all. Two at a time have a turn, so that one has work for the
/// host while the other one uses the device.
class LocalExchange : public Exchange {
  public:
    /// Returns an exchange for each of so many parts.
    static std::vector<std::unique_ptr<LocalExchange>> create(std::uint32_t parts);

    std::uint32_t rank() const override { return rank_; }
    std::uint32_t size() const override { return size_; }
    std::uint32_t process_of(std::uint32_t) const override { return 0; }
    bool takes_turns() const override { return true; }
    std::unique_lock<std::mutex> turn() override {
        return std::unique_lock(hall_->turns[rank_ % kAtOnce]);
    }
    std::unique_lock<std::mutex> device() override { return std::unique_lock(hall_->device); }
    Result<std::vector<Bytes>> swap(std::span<const std::uint32_t> others,
                                    std::span<const Bytes> messages) override;
    Result<std::vector<std::uint64_t>> sums(std::vector<std::uint64_t> values) override;

    /// Ends the calls of all parts with this error, unless another one came first: for a part that
    /// failed without the others.
    void give_up(const Error& error);

  private:
    static constexpr std::size_t kAtOnce = 2;

    /// State that the parts share.
    struct Hall {
        std::array<std::mutex, kAtOnce> turns;
        std::mutex device;
        std::mutex mutex; ///< Guards all below.
        std::condition_variable changed;
        std::optional<Error> failure;
        /// Messages under way, by sender and receiver.
        std::map<std::pair<std::uint32_t, std::uint32_t>, std::deque<Bytes>> messages;
        // The sums, one after another, to which all parts add.
        std::vector<std::uint64_t> added, summed;
        std::uint32_t parts_added = 0;
        std::uint64_t times = 0; ///< How often sums were complete.
    };

    LocalExchange(std::shared_ptr<Hall> hall, std::uint32_t rank, std::uint32_t size)
        : hall_(std::move(hall)), rank_(rank), size_(size) {}

    std::shared_ptr<Hall> hall_;
    std::uint32_t rank_, size_;
};

} // namespace geodisk
