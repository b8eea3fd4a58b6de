#include "mpi_exchange.hpp"

#include <algorithm>
#include <chrono>
#include <mutex>
#include <thread>
#include <utility>

#include "support/try.hpp"

namespace geodisk {
namespace {

constexpr std::size_t kChunk = std::size_t{1} << 30;
constexpr int kTag = 1;
constexpr std::chrono::microseconds kShortestNap{20};
constexpr std::chrono::microseconds kLongestNap{2000};
constexpr std::uint32_t kLanesAwake = 8; ///< With more lanes, all nap longer.

} // namespace

struct MpiExchange::Channel {
    explicit Channel(MPI_Comm duplicate) : own(duplicate) {}
    ~Channel() {
        if (!is_broken) { // Else others might never free it.
            MPI_Comm_free(&own);
        }
    }

    MPI_Comm own;
    std::mutex calls; ///< Guards calls of MPI, and all below.
    std::mutex turns;
    bool is_broken = false; ///< A lane stopped while others went on.
    // Of the sums that lanes add up to, one after another.
    std::vector<std::uint64_t> added, summed;
    std::uint32_t lanes_added = 0;
    std::uint64_t times = 0; ///< How often sums were complete.
};

Result<std::vector<std::unique_ptr<MpiExchange>>>
MpiExchange::create_lanes(MPI_Comm communicator, std::uint32_t lanes, const GoesOn& goes_on) {
    MPI_Comm own = MPI_COMM_NULL;
    if (MPI_Comm_dup(communicator, &own) != MPI_SUCCESS) {
        return Error{Status::internal, "MPI cannot duplicate the communicator"};
    }
    const auto channel = std::make_shared<Channel>(own);
    std::vector<std::unique_ptr<MpiExchange>> all;
    for (std::uint32_t lane = 0; lane < lanes; ++lane) {
        all.push_back(std::unique_ptr<MpiExchange>(new MpiExchange(channel, goes_on, lane, lanes)));
    }
    return all;
}

MpiExchange::MpiExchange(std::shared_ptr<Channel> channel, GoesOn goes_on, std::uint32_t lane,
                         std::uint32_t lanes)
    : channel_(std::move(channel)), goes_on_(std::move(goes_on)), lane_(lane), lanes_(lanes) {
    int rank = 0, size = 1;
    MPI_Comm_rank(channel_->own, &rank);
    MPI_Comm_size(channel_->own, &size);
    process_ = static_cast<std::uint32_t>(rank);
    processes_ = static_cast<std::uint32_t>(size);
}

MpiExchange::~MpiExchange() = default;

std::unique_lock<std::mutex> MpiExchange::turn() {
    return takes_turns() ? std::unique_lock(channel_->turns) : std::unique_lock<std::mutex>();
}

Result<Done> MpiExchange::wait_until(const std::function<bool()>& is_done) {
    auto nap = kShortestNap;
    const auto longest = kLongestNap * std::max(1u, lanes_ / kLanesAwake);
    for (;;) {
        {
            const std::scoped_lock lock(channel_->calls);
            if (is_done()) {
                return Done{};
            }
        }
        if (goes_on_ && !goes_on_()) {
            const std::scoped_lock lock(channel_->calls);
            channel_->is_broken = true;
            return Error{Status::cancelled, "stopped while waiting for other processes"};
        }
        std::this_thread::sleep_for(nap);
        nap = std::min(2 * nap, longest);
    }
}

void MpiExchange::send(const Bytes& message, std::uint32_t other,
                       std::vector<MPI_Request>& requests) const {
    const int tag = kTag + static_cast<int>(lane_ * lanes_ + other % lanes_);
    // The last chunk is the one that is not full.
    for (std::size_t first = 0; first <= message.size(); first += kChunk) {
        const std::size_t count = std::min(kChunk, message.size() - first);
        MPI_Isend(message.data() + first, static_cast<int>(count), MPI_BYTE,
                  static_cast<int>(process_of(other)), tag, channel_->own,
                  &requests.emplace_back());
    }
}

bool MpiExchange::receive_chunk(std::uint32_t other, Bytes& message) const {
    const int tag = kTag + static_cast<int>(other % lanes_ * lanes_ + lane_);
    int has_come = 0;
    MPI_Message handle;
    MPI_Status status;
    MPI_Improbe(static_cast<int>(process_of(other)), tag, channel_->own, &has_come, &handle,
                &status);
    if (has_come == 0) {
        return false;
    }
    int count = 0;
    MPI_Get_count(&status, MPI_BYTE, &count);
    const std::size_t before = message.size();
    message.resize(before + static_cast<std::size_t>(count));
    MPI_Mrecv(message.data() + before, count, MPI_BYTE, &handle, &status);
    return static_cast<std::size_t>(count) < kChunk;
}

Result<std::vector<Bytes>> MpiExchange::swap(std::span<const std::uint32_t> others,
                                             std::span<const Bytes> messages) {
    std::vector<MPI_Request> requests;
    {
        const std::scoped_lock lock(channel_->calls);
        for (std::size_t i = 0; i < others.size(); ++i) {
            send(messages[i], others[i], requests);
        }
    }
    std::vector<Bytes> received(others.size());
    std::size_t complete = 0;
    const auto all_here = [&] {
        // Where one is missing, to ask for those behind it would only take time.
        while (complete < others.size() && receive_chunk(others[complete], received[complete])) {
            ++complete;
        }
        const bool all = complete == others.size();
        int sent = 0;
        MPI_Testall(static_cast<int>(requests.size()), requests.data(), &sent, MPI_STATUSES_IGNORE);
        return all && sent != 0;
    };
    GEODISK_TRY(wait_until(all_here));
    return received;
}

Result<std::vector<std::uint64_t>> MpiExchange::sums(std::vector<std::uint64_t> values) {
    Channel& channel = *channel_;
    std::vector<std::uint64_t> own, all;
    std::uint64_t before = 0;
    bool is_last = false;
    MPI_Request request = MPI_REQUEST_NULL;
    {
        const std::scoped_lock lock(channel.calls);
        before = channel.times;
        channel.added.resize(values.size());
        for (std::size_t i = 0; i < values.size(); ++i) {
            channel.added[i] += values[i];
        }
        is_last = ++channel.lanes_added == lanes_;
        if (is_last) { // It asks the other processes.
            own = std::exchange(channel.added, {});
            channel.lanes_added = 0;
            all.resize(own.size());
            MPI_Iallreduce(own.data(), all.data(), static_cast<int>(own.size()), MPI_UINT64_T,
                           MPI_SUM, channel.own, &request);
        }
    }
    const auto is_done = [&] {
        int flag = 0;
        if (is_last) {
            MPI_Test(&request, &flag, MPI_STATUS_IGNORE);
            if (flag != 0) {
                channel.summed = std::move(all);
                ++channel.times;
            }
        }
        return channel.times != before;
    };
    GEODISK_TRY(wait_until(is_done));
    const std::scoped_lock lock(channel.calls);
    return channel.summed;
}

} // namespace geodisk
