// Talk: records that processes send each other in the midst of work.
#pragma once

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <span>
#include <type_traits>
#include <utility>
#include <vector>

#include <geodisk/exchange.hpp>
#include <geodisk/status.hpp>

namespace geodisk {

/// Ends work of all processes by an error, which caught() returns.
struct Stopped {
    Error error;
};

/// Records for each process, or from each.
template <class Record>
using ByProcess = std::vector<std::vector<Record>>;

/// An exchange of records. All processes make the same calls. Errors are thrown as Stopped.
class Talk {
  public:
    explicit Talk(Exchange& exchange) : exchange_(exchange) {}

    Exchange& exchange() const { return exchange_; }
    std::uint32_t rank() const { return exchange_.rank(); }
    std::uint32_t size() const { return exchange_.size(); }

    /// Sends its records to each process, and returns those from each.
    template <class Record>
    ByProcess<Record> all_to_all(ByProcess<Record> records) {
        std::vector<Bytes> messages(size());
        for (std::uint32_t other = 0; other < size(); ++other) {
            messages[other] = bytes_of(std::span<const Record>(records[other]));
            records[other] = {};
        }
        std::vector<Bytes> received = value(exchange_.all_to_all(std::move(messages)));
        for (std::uint32_t other = 0; other < size(); ++other) {
            records[other] = records_of<Record>(received[other]);
            received[other] = {};
        }
        return records;
    }

    /// Returns what each process gives.
    template <class Record>
    std::vector<Record> all(const Record& own) {
        return value(exchange_.all_gather(own));
    }

    std::uint64_t sum(std::uint64_t own) { return value(exchange_.sum(own)); }
    std::vector<std::uint64_t> sums(std::vector<std::uint64_t> own) {
        return value(exchange_.sums(std::move(own)));
    }

    /// Hands a value from each process to the next one: returns what the one before gives, by
    /// `next(before)`, from the first one's `start` on. The last one's goes nowhere.
    template <class Record, class Next>
    Record chain(Record start, const Next& next) {
        Record before = start;
        if (rank() > 0) {
            before = swap_with(rank() - 1, Bytes(sizeof before), before);
        }
        const Record own = next(before);
        if (rank() + 1 < size()) {
            Bytes message(sizeof own);
            std::memcpy(message.data(), &own, sizeof own);
            swap_with(rank() + 1, std::move(message), own);
        }
        return own;
    }

    /// Stops all processes if one has an error: not null.
    void check(const Error* error) {
        if (auto well = exchange_.check_all(error); !well) {
            throw Stopped{well.error()};
        }
    }

  private:
    template <class T>
    static T value(Result<T> result) {
        if (!result) {
            throw Stopped{result.error()};
        }
        return std::move(*result);
    }
    template <class Record>
    Record swap_with(std::uint32_t other, Bytes message, Record otherwise) {
        const auto received = value(exchange_.swap(std::span(&other, 1), std::span(&message, 1)));
        const auto records = records_of<Record>(received.front());
        return records.empty() ? otherwise : records.front();
    }

    Exchange& exchange_;
};

/// Adds up the values of all processes one by one, as a single process adds them.
inline double sum_in_order(Talk& talk, std::span<const double> values) {
    const double up_to_own = talk.chain(0.0, [&](double sum) {
        for (const double value : values) {
            sum += value;
        }
        return sum;
    });
    return talk.all(up_to_own).back();
}

/// Returns what `work` returns, or the error that stopped it.
template <class Work>
std::invoke_result_t<Work> caught(const Work& work) {
    try {
        return work();
    } catch (const Stopped& stopped) {
        return stopped.error;
    }
}

/// Records are sent in so many turns of which none takes much memory beside all. `bytes` are those
/// of the process that has most.
inline std::uint64_t turns_for(std::uint64_t bytes) {
    constexpr std::uint64_t kShare = 16;
    const std::uint64_t at_once =
        std::clamp(bytes / kShare, std::uint64_t{1} << 20, std::uint64_t{1} << 26);
    return bytes / at_once + 1;
}

} // namespace geodisk
