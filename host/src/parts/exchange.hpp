// Exchange: how the processes that sample one surface talk to each other.
#pragma once

#include <cstddef>
#include <cstdint>
#include <mutex>
#include <span>
#include <vector>

#include <geodisk/export.hpp>
#include <geodisk/status.hpp>

namespace geodisk {

using Bytes = std::vector<std::byte>;

/// Messages among processes, which all make the same calls in the same order. An error ends the
/// work of all.
class GEODISK_API Exchange {
  public:
    Exchange() = default;
    Exchange(const Exchange&) = delete;
    Exchange& operator=(const Exchange&) = delete;
    virtual ~Exchange();

    virtual std::uint32_t rank() const = 0;
    virtual std::uint32_t size() const = 0;

    // A process may stand for several of those counted above, each a thread that decides a part.

    /// Returns the process that one of them belongs to.
    virtual std::uint32_t process_of(std::uint32_t rank) const { return rank; }
    /// Returns true if there are others in this process.
    virtual bool takes_turns() const { return false; }
    /// Returns a lock that only one of this process holds at a time, for work that needs much
    /// memory or the device. Its holder must not wait for others.
    virtual std::unique_lock<std::mutex> turn() { return {}; }

    /// Sends a message to each of some processes, not this one, and returns what each of them sent,
    /// in the same order. Those must name this process too.
    virtual Result<std::vector<Bytes>> swap(std::span<const std::uint32_t> others,
                                            std::span<const Bytes> messages) = 0;
    /// Returns the sum of each value over all processes, which give equally many.
    virtual Result<std::vector<std::uint64_t>> sums(std::vector<std::uint64_t> values) = 0;

    Result<std::uint64_t> sum(std::uint64_t value);

    // All of these take the first process for the root. Its message to itself costs nothing.

    /// Returns this process's own of the messages of the root, one for each process.
    Result<Bytes> scatter(std::vector<Bytes> messages);
    /// Returns the messages of all processes at the root, nothing elsewhere.
    Result<std::vector<Bytes>> gather(Bytes message);
    /// Sends a message to each process, also to this one, and returns what each of them sent.
    Result<std::vector<Bytes>> all_to_all(std::vector<Bytes> messages);
    /// Ends the work of all if that of one failed: returns its error, which names the process.
    /// `error` is null where the work went well.
    Result<Done> check_all(const Error* error);
    /// Returns the error that check_all() returns, where some process is known to have failed.
    Error first_error(const Error* error);

  private:
    std::vector<std::uint32_t> all_others() const;
};

} // namespace geodisk
