#include "threads_exchange.hpp"

#include <thread>
#include <vector>

namespace geodisk::test {

void run_threads(std::uint32_t count, const std::function<void(Exchange&)>& work) {
    const auto messages = LocalExchange::create(count);
    std::vector<std::jthread> threads;
    for (std::uint32_t rank = 0; rank < count; ++rank) {
        threads.emplace_back([&, rank] {
            ThreadsExchange exchange(*messages[rank]);
            work(exchange);
        });
    }
}

} // namespace geodisk::test
