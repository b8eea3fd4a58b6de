#include "parts/local_exchange.hpp"

namespace geodisk {

std::vector<std::unique_ptr<LocalExchange>> LocalExchange::create(std::uint32_t parts) {
    const auto hall = std::make_shared<Hall>();
    std::vector<std::unique_ptr<LocalExchange>> all;
    for (std::uint32_t rank = 0; rank < parts; ++rank) {
        all.push_back(std::unique_ptr<LocalExchange>(new LocalExchange(hall, rank, parts)));
    }
    return all;
}

Result<std::vector<Bytes>> LocalExchange::swap(std::span<const std::uint32_t> others,
                                               std::span<const Bytes> messages) {
    std::unique_lock lock(hall_->mutex);
    for (std::size_t i = 0; i < others.size(); ++i) {
        hall_->messages[{rank_, others[i]}].push_back(messages[i]);
    }
    hall_->changed.notify_all();
    std::vector<Bytes> received;
    for (const std::uint32_t other : others) {
        std::deque<Bytes>& box = hall_->messages[{other, rank_}];
        hall_->changed.wait(lock, [&] { return hall_->failure || !box.empty(); });
        if (hall_->failure) {
            return *hall_->failure;
        }
        received.push_back(std::move(box.front()));
        box.pop_front();
    }
    return received;
}

Result<std::vector<std::uint64_t>> LocalExchange::sums(std::vector<std::uint64_t> values) {
    std::unique_lock lock(hall_->mutex);
    Hall& hall = *hall_;
    const std::uint64_t before = hall.times;
    hall.added.resize(values.size());
    for (std::size_t i = 0; i < values.size(); ++i) {
        hall.added[i] += values[i];
    }
    if (++hall.parts_added == size_) {
        hall.summed = std::exchange(hall.added, {});
        hall.parts_added = 0;
        ++hall.times;
        hall.changed.notify_all();
    }
    // No further sum is complete before this part has added to it.
    hall.changed.wait(lock, [&] { return hall.failure || hall.times != before; });
    return hall.failure ? Result<std::vector<std::uint64_t>>(*hall.failure) : hall.summed;
}

void LocalExchange::give_up(const Error& error) {
    const std::scoped_lock lock(hall_->mutex);
    if (!hall_->failure) {
        hall_->failure = error;
    }
    hall_->changed.notify_all();
}

} // namespace geodisk
