// Exchange: messages among the processes that sample one surface, whatever carries them.
// Experimental.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <mutex>
#include <span>
#include <type_traits>
#include <utility>
#include <vector>

#include <geodisk/export.hpp>
#include <geodisk/status.hpp>

namespace geodisk {

/// A message.
using Bytes = std::vector<std::byte>;

/// Returns records as a message. It has no meaning for programs built in another way.
template <class Record>
Bytes bytes_of(std::span<const Record> records) {
    static_assert(std::is_trivially_copyable_v<Record>);
    const auto bytes = std::as_bytes(records);
    return {bytes.begin(), bytes.end()};
}

/// Returns the records that a message consists of.
template <class Record>
std::vector<Record> records_of(std::span<const std::byte> bytes) {
    static_assert(std::is_trivially_copyable_v<Record>);
    std::vector<Record> records(bytes.size() / sizeof(Record));
    if (!records.empty()) {
        std::memcpy(static_cast<void*>(records.data()), bytes.data(),
                    records.size() * sizeof(Record));
    }
    return records;
}

/// Messages among processes, which all make the same calls in the same order. An error ends the
/// work of all. Calls may throw std::bad_alloc, of which other processes do not learn.
class GEODISK_API Exchange {
  public:
    Exchange() = default;
    Exchange(const Exchange&) = delete;
    Exchange& operator=(const Exchange&) = delete;
    virtual ~Exchange();

    /// Returns the number of this process, from 0.
    virtual std::uint32_t rank() const = 0;
    /// Returns how many processes there are.
    virtual std::uint32_t size() const = 0;

    // A process may stand for several of those counted above, each a thread that decides a part.

    /// Returns the process that one of them belongs to.
    virtual std::uint32_t process_of(std::uint32_t rank) const { return rank; }
    /// Returns true if there are others in this process.
    virtual bool takes_turns() const { return false; }
    /// Returns a lock that few of this process hold at a time, for work that needs much memory. Its
    /// holder must not wait for others.
    virtual std::unique_lock<std::mutex> turn() { return {}; }
    /// Returns a lock that only one of this process holds at a time, for work on the device.
    virtual std::unique_lock<std::mutex> device() { return {}; }

    /// Sends a message to each of some processes, not this one, and returns what each of them sent,
    /// in the same order. Those must name this process too.
    virtual Result<std::vector<Bytes>> swap(std::span<const std::uint32_t> others,
                                            std::span<const Bytes> messages) = 0;
    /// Returns the sum of each value over all processes, which give equally many.
    virtual Result<std::vector<std::uint64_t>> sums(std::vector<std::uint64_t> values) = 0;

    /// Returns the sum of a value over all processes.
    Result<std::uint64_t> sum(std::uint64_t value);

    // All of these take the first process for the root. Its message to itself costs nothing.

    /// Returns the message of the root. Those of other processes are ignored.
    Result<Bytes> broadcast(const Bytes& message);
    /// Returns this process's own of the messages of the root, one for each process.
    Result<Bytes> scatter(std::vector<Bytes> messages);
    /// Returns the messages of all processes at the root, nothing elsewhere.
    Result<std::vector<Bytes>> gather(Bytes message);
    /// Returns the records that all processes give, in their order.
    template <class Record>
    Result<std::vector<Record>> all_gather(const Record& own) {
        static_assert(std::is_trivially_copyable_v<Record>);
        // The sum of arrays in which all else is zero.
        constexpr std::size_t kWords = (sizeof own + 7) / 8;
        std::vector<std::uint64_t> words(size() * kWords);
        std::memcpy(&words[rank() * kWords], &own, sizeof own);
        const auto summed = sums(std::move(words));
        if (!summed) {
            return summed.error();
        }
        std::vector<Record> all(size());
        for (std::uint32_t other = 0; other < size(); ++other) {
            std::memcpy(static_cast<void*>(&all[other]), &(*summed)[other * kWords], sizeof own);
        }
        return all;
    }
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

/// Appends values to a message.
class MessageWriter {
  public:
    /// Appends the bytes of a value.
    template <class T>
    void put(const T& value) {
        static_assert(std::is_trivially_copyable_v<T>);
        const auto* const first = reinterpret_cast<const std::byte*>(&value);
        bytes_.insert(bytes_.end(), first, first + sizeof value);
    }
    /// Appends a vector behind its size.
    template <class T>
    void put_all(const std::vector<T>& values) {
        put(std::uint64_t{values.size()});
        const auto more = std::as_bytes(std::span(values));
        bytes_.insert(bytes_.end(), more.begin(), more.end());
    }
    Bytes take() { return std::move(bytes_); }

  private:
    Bytes bytes_;
};

/// Reads values in the same order. A value that is not there makes it incomplete.
class MessageReader {
  public:
    /// Reads from bytes that outlive it.
    explicit MessageReader(std::span<const std::byte> bytes) : bytes_(bytes) {}

    /// Reads a value; one that is not there keeps what it was.
    template <class T>
    void get(T& value) {
        if (take(sizeof value)) {
            std::memcpy(&value, taken_.data(), sizeof value);
        }
    }
    /// Reads a vector behind its size; one that is not there keeps what it was.
    template <class T>
    void get_all(std::vector<T>& values) {
        std::uint64_t size = 0;
        get(size);
        if (size <= bytes_.size() / sizeof(T) && take(size * sizeof(T))) {
            values.resize(size);
            if (size > 0) {
                std::memcpy(values.data(), taken_.data(), size * sizeof(T));
            }
        } else {
            is_complete_ = false;
        }
    }
    /// Returns true if all that was read was there, and nothing else.
    bool is_complete() const { return is_complete_ && bytes_.empty(); }

  private:
    bool take(std::size_t size) {
        is_complete_ = is_complete_ && size <= bytes_.size();
        if (is_complete_) {
            taken_ = bytes_.first(size);
            bytes_ = bytes_.subspan(size);
        }
        return is_complete_;
    }

    std::span<const std::byte> bytes_, taken_;
    bool is_complete_ = true;
};

} // namespace geodisk
