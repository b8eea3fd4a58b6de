// Messages among processes by MPI.
#pragma once

#include <functional>
#include <memory>

#include <mpi.h>

#include "parts/exchange.hpp"

namespace geodisk {

/// An exchange on a duplicate of a communicator. It sleeps while it waits, so that processes that
/// share cores do not keep each other from their work.
class MpiExchange : public Exchange {
  public:
    /// Is asked while it waits. Returns false to stop with Status::cancelled.
    using GoesOn = std::function<bool()>;

    /// All processes of the communicator make one.
    static Result<std::unique_ptr<MpiExchange>> create(MPI_Comm communicator, GoesOn goes_on);
    ~MpiExchange() override;

    std::uint32_t rank() const override { return rank_; }
    std::uint32_t size() const override { return size_; }
    Result<std::vector<Bytes>> swap(std::span<const std::uint32_t> others,
                                    std::span<const Bytes> messages) override;
    Result<std::uint64_t> sum(std::uint64_t value) override;

  private:
    MpiExchange(MPI_Comm own, GoesOn goes_on);
    /// Sends in chunks that MPI can count.
    void send(const Bytes& message, std::uint32_t other, std::vector<MPI_Request>& requests) const;
    /// Appends a chunk if one has come from there. Returns true if it was the last.
    bool receive_chunk(std::uint32_t other, Bytes& message) const;
    /// Calls `is_done` until it returns true.
    Result<Done> wait_until(const std::function<bool()>& is_done);

    MPI_Comm own_;
    GoesOn goes_on_;
    std::uint32_t rank_ = 0, size_ = 1;
    bool is_broken_ = false; ///< It stopped while others went on.
};

} // namespace geodisk
