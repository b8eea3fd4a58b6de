#include "threads_exchange.hpp"

#include <cstring>
#include <thread>
#include <vector>

namespace geodisk::test {

void Mailbox::post(std::uint32_t from, std::uint32_t to, Bytes message) {
    const std::scoped_lock lock(mutex_);
    messages_[{from, to}].push_back(std::move(message));
    arrived_.notify_all();
}

Bytes Mailbox::fetch(std::uint32_t from, std::uint32_t to) {
    std::unique_lock lock(mutex_);
    auto& queue = messages_[{from, to}];
    arrived_.wait(lock, [&] { return !queue.empty(); });
    Bytes message = std::move(queue.front());
    queue.pop_front();
    return message;
}

Result<std::vector<Bytes>> ThreadsExchange::swap(std::span<const std::uint32_t> others,
                                                 std::span<const Bytes> messages) {
    for (std::size_t i = 0; i < others.size(); ++i) {
        mailbox_.post(rank_, others[i], messages[i]);
    }
    std::vector<Bytes> received;
    for (const std::uint32_t other : others) {
        received.push_back(mailbox_.fetch(other, rank_));
    }
    return received;
}

Result<std::vector<std::uint64_t>> ThreadsExchange::sums(std::vector<std::uint64_t> values) {
    std::vector<std::uint32_t> others;
    for (std::uint32_t other = 0; other < size_; ++other) {
        if (other != rank_) {
            others.push_back(other);
        }
    }
    const auto bytes = std::as_bytes(std::span(values));
    const auto received =
        swap(others, std::vector<Bytes>(others.size(), Bytes(bytes.begin(), bytes.end())));
    for (const Bytes& message : *received) {
        for (std::size_t i = 0; i < values.size(); ++i) {
            std::uint64_t value = 0;
            std::memcpy(&value, &message[i * sizeof value], sizeof value);
            values[i] += value;
        }
    }
    return values;
}

void run_threads(std::uint32_t count, const std::function<void(Exchange&)>& work) {
    Mailbox mailbox;
    std::vector<std::jthread> threads;
    for (std::uint32_t rank = 0; rank < count; ++rank) {
        threads.emplace_back([&, rank] {
            ThreadsExchange exchange(mailbox, rank, count);
            work(exchange);
        });
    }
}

} // namespace geodisk::test
