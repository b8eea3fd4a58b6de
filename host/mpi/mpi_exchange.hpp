// Messages among processes by MPI.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <span>
#include <vector>

#include <mpi.h>

#include <geodisk/exchange.hpp>

namespace geodisk {

/// An exchange on a duplicate of a communicator. It sleeps while it waits, so that processes that
/// share cores do not keep each other from their work.
class MpiExchange : public Exchange {
  public:
    /// Is asked while it waits. Returns false to stop with Status::cancelled.
    using GoesOn = std::function<bool()>;

    /// All processes of the communicator make so many, each for a thread of its own. Several need
    /// MPI_THREAD_SERIALIZED.
    static Result<std::vector<std::unique_ptr<MpiExchange>>>
    create_lanes(MPI_Comm communicator, std::uint32_t lanes, const GoesOn& goes_on);

    ~MpiExchange() override;

    std::uint32_t rank() const override { return process_ * lanes_ + lane_; }
    std::uint32_t size() const override { return processes_ * lanes_; }
    std::uint32_t process_of(std::uint32_t rank) const override { return rank / lanes_; }
    bool takes_turns() const override { return lanes_ > 1; }
    std::unique_lock<std::mutex> turn() override;
    Result<std::vector<Bytes>> swap(std::span<const std::uint32_t> others,
                                    std::span<const Bytes> messages) override;
    Result<std::vector<std::uint64_t>> sums(std::vector<std::uint64_t> values) override;

  private:
    struct Channel; ///< What the lanes of a process share.

    MpiExchange(std::shared_ptr<Channel> channel, GoesOn goes_on, std::uint32_t lane,
                std::uint32_t lanes);
    /// Sends in chunks that MPI can count.
    void send(const Bytes& message, std::uint32_t other, std::vector<MPI_Request>& requests) const;
    /// Appends a chunk if one has come from there. Returns true if it was the last.
    bool receive_chunk(std::uint32_t other, Bytes& message) const;
    /// Calls `is_done` until it returns true, as the only lane that calls MPI.
    Result<Done> wait_until(const std::function<bool()>& is_done);

    std::shared_ptr<Channel> channel_;
    GoesOn goes_on_;
    std::uint32_t process_ = 0, processes_ = 1, lane_ = 0, lanes_ = 1;
};

} // namespace geodisk
