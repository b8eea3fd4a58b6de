// Loaded before METIS: the process gets SIGTERM while METIS divides a surface, after
// GEODISK_TERMINATING_MICROSECONDS.
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <thread>

#include <dlfcn.h>
#include <metis.h>
#include <unistd.h>

extern "C" int METIS_PartGraphRecursive(idx_t* count, idx_t* constraints, idx_t* starts,
                                        idx_t* beside, idx_t* weights, idx_t* sizes,
                                        idx_t* edge_weights, idx_t* parts, real_t* shares,
                                        real_t* balance, idx_t* options, idx_t* cut, idx_t* found) {
    const auto next = reinterpret_cast<decltype(&METIS_PartGraphRecursive)>(
        dlsym(RTLD_NEXT, "METIS_PartGraphRecursive"));
    std::thread([] {
        const std::chrono::microseconds wait(
            std::atoi(std::getenv("GEODISK_TERMINATING_MICROSECONDS")));
        std::this_thread::sleep_for(wait);
        kill(getpid(), SIGTERM);
    }).detach();
    // Until the process ends: METIS may be faster than the signal.
    for (;;) {
        const int status = next(count, constraints, starts, beside, weights, sizes, edge_weights,
                                parts, shares, balance, options, cut, found);
        if (status != METIS_OK) {
            return status;
        }
    }
}
