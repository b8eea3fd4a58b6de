#include "termination.hpp"

#ifndef _WIN32
#include <csignal>
#include <thread>

#include "program/interrupt.hpp"
#endif

namespace geodisk::tools {

#ifdef _WIN32
void receive_termination() {}
#else
namespace {

/// Ends the process as SIGTERM does where nothing handles it.
void end_by_default(const sigset_t& termination) {
    std::signal(SIGTERM, SIG_DFL);
    pthread_sigmask(SIG_UNBLOCK, &termination, nullptr);
    std::raise(SIGTERM);
}

} // namespace

void receive_termination() {
    struct sigaction before {};
    const bool is_ignored =
        sigaction(SIGTERM, nullptr, &before) == 0 && before.sa_handler == SIG_IGN;
    sigset_t termination;
    sigemptyset(&termination);
    sigaddset(&termination, SIGTERM);
    pthread_sigmask(SIG_BLOCK, &termination, nullptr);
    if (is_ignored) {
        return;
    }
    std::thread([termination] {
        for (int signal = 0;;) {
            if (sigwait(&termination, &signal) == 0 && !handle_signal(signal)) {
                end_by_default(termination);
            }
        }
    }).detach();
}
#endif

} // namespace geodisk::tools
