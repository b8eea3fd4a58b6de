#include <cstring>
#include <string>
#include <utility>

#include <geodisk/exchange.hpp>

#include "support/try.hpp"

namespace geodisk {
namespace {

constexpr std::uint32_t kRoot = 0;

Bytes to_bytes(const Error* error) {
    if (error == nullptr) {
        return {};
    }
    Bytes bytes(1 + error->message.size(), static_cast<std::byte>(error->status));
    std::memcpy(bytes.data() + 1, error->message.data(), error->message.size());
    return bytes;
}

} // namespace

Exchange::~Exchange() = default;

std::vector<std::uint32_t> Exchange::all_others() const {
    std::vector<std::uint32_t> others;
    for (std::uint32_t other = 0; other < size(); ++other) {
        if (other != rank()) {
            others.push_back(other);
        }
    }
    return others;
}

Result<std::uint64_t> Exchange::sum(std::uint64_t value) {
    const auto all = sums({value});
    return all ? Result<std::uint64_t>(all->front()) : all.error();
}

Result<Bytes> Exchange::broadcast(const Bytes& message) {
    return scatter(rank() == kRoot ? std::vector<Bytes>(size(), message) : std::vector<Bytes>());
}

Result<Bytes> Exchange::scatter(std::vector<Bytes> messages) {
    if (rank() != kRoot) {
        auto received = swap(std::vector{kRoot}, std::vector<Bytes>(1));
        return received ? Result<Bytes>(std::move(received->front())) : received.error();
    }
    Bytes own = std::move(messages.front());
    messages.erase(messages.begin());
    GEODISK_TRY(swap(all_others(), messages));
    return own;
}

Result<std::vector<Bytes>> Exchange::gather(Bytes message) {
    if (rank() != kRoot) {
        auto sent = swap(std::vector{kRoot}, std::vector<Bytes>{std::move(message)});
        return sent ? Result<std::vector<Bytes>>(std::vector<Bytes>()) : sent.error();
    }
    auto received = swap(all_others(), std::vector<Bytes>(size() - 1));
    if (received) {
        received->insert(received->begin(), std::move(message));
    }
    return received;
}

Result<std::vector<Bytes>> Exchange::all_to_all(std::vector<Bytes> messages) {
    const auto here = static_cast<std::ptrdiff_t>(rank());
    Bytes own = std::move(messages[rank()]);
    messages.erase(messages.begin() + here);
    auto received = swap(all_others(), messages);
    if (received) {
        received->insert(received->begin() + here, std::move(own));
    }
    return received;
}

Result<Done> Exchange::check_all(const Error* error) {
    const auto failed = sum(error != nullptr ? 1 : 0);
    GEODISK_TRY(failed);
    return *failed == 0 ? Result<Done>(Done{}) : Result<Done>(first_error(error));
}

Error Exchange::first_error(const Error* error) {
    auto received = swap(all_others(), std::vector<Bytes>(size() - 1, to_bytes(error)));
    GEODISK_TRY(received);
    received->insert(received->begin() + rank(), to_bytes(error));
    for (std::uint32_t process = 0; process < size(); ++process) {
        const Bytes& bytes = (*received)[process];
        if (!bytes.empty()) {
            std::string message(reinterpret_cast<const char*>(bytes.data()) + 1, bytes.size() - 1);
            if (process_of(process) != kRoot) {
                message.insert(0, "process " + std::to_string(process_of(process)) + ": ");
            }
            const auto status = static_cast<Status>(std::to_integer<signed char>(bytes[0]));
            return Error{status, std::move(message)};
        }
    }
    return Error{Status::internal, "a process failed for no reason"};
}

} // namespace geodisk
