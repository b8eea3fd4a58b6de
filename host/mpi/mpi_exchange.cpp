#include "mpi_exchange.hpp"

#include <algorithm>
#include <chrono>
#include <thread>
#include <utility>

namespace geodisk {
namespace {

constexpr std::size_t kChunk = std::size_t{1} << 30;
constexpr int kTag = 1;
constexpr std::chrono::microseconds kShortestNap{20};
constexpr std::chrono::microseconds kLongestNap{2000};

} // namespace

Result<std::unique_ptr<MpiExchange>> MpiExchange::create(MPI_Comm communicator, GoesOn goes_on) {
    MPI_Comm own = MPI_COMM_NULL;
    if (MPI_Comm_dup(communicator, &own) != MPI_SUCCESS) {
        return Error{Status::internal, "MPI cannot duplicate the communicator"};
    }
    return std::unique_ptr<MpiExchange>(new MpiExchange(own, std::move(goes_on)));
}

MpiExchange::MpiExchange(MPI_Comm own, GoesOn goes_on) : own_(own), goes_on_(std::move(goes_on)) {
    int rank = 0, size = 1;
    MPI_Comm_rank(own_, &rank);
    MPI_Comm_size(own_, &size);
    rank_ = static_cast<std::uint32_t>(rank);
    size_ = static_cast<std::uint32_t>(size);
}

MpiExchange::~MpiExchange() {
    if (!is_broken_) { // Else others might never free it.
        MPI_Comm_free(&own_);
    }
}

Result<Done> MpiExchange::wait_until(const std::function<bool()>& is_done) {
    auto nap = kShortestNap;
    while (!is_done()) {
        if (goes_on_ && !goes_on_()) {
            is_broken_ = true;
            return Error{Status::cancelled, "stopped while waiting for other processes"};
        }
        std::this_thread::sleep_for(nap);
        nap = std::min(2 * nap, kLongestNap);
    }
    return Done{};
}

void MpiExchange::send(const Bytes& message, std::uint32_t other,
                       std::vector<MPI_Request>& requests) const {
    // The last chunk is the one that is not full.
    for (std::size_t first = 0; first <= message.size(); first += kChunk) {
        const std::size_t count = std::min(kChunk, message.size() - first);
        MPI_Isend(message.data() + first, static_cast<int>(count), MPI_BYTE,
                  static_cast<int>(other), kTag, own_, &requests.emplace_back());
    }
}

bool MpiExchange::receive_chunk(std::uint32_t other, Bytes& message) const {
    int has_come = 0;
    MPI_Message handle;
    MPI_Status status;
    MPI_Improbe(static_cast<int>(other), kTag, own_, &has_come, &handle, &status);
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
    for (std::size_t i = 0; i < others.size(); ++i) {
        send(messages[i], others[i], requests);
    }
    std::vector<Bytes> received(others.size());
    std::vector<bool> is_complete(others.size());
    const auto all_here = [&] {
        bool all = true;
        for (std::size_t i = 0; i < others.size(); ++i) {
            is_complete[i] = is_complete[i] || receive_chunk(others[i], received[i]);
            all = all && is_complete[i];
        }
        int sent = 0;
        MPI_Testall(static_cast<int>(requests.size()), requests.data(), &sent, MPI_STATUSES_IGNORE);
        return all && sent != 0;
    };
    if (auto waited = wait_until(all_here); !waited) {
        return waited.error();
    }
    return received;
}

Result<std::uint64_t> MpiExchange::sum(std::uint64_t value) {
    std::uint64_t all = 0;
    MPI_Request request;
    MPI_Iallreduce(&value, &all, 1, MPI_UINT64_T, MPI_SUM, own_, &request);
    const auto is_done = [&] {
        int flag = 0;
        MPI_Test(&request, &flag, MPI_STATUS_IGNORE);
        return flag != 0;
    };
    if (auto waited = wait_until(is_done); !waited) {
        return waited.error();
    }
    return all;
}

} // namespace geodisk
