#include "program/interrupt.hpp"

#include <csignal>

#include "program/failure.hpp"

namespace geodisk::tools {
namespace {

volatile std::sig_atomic_t received_signal = 0; // All that a signal handler may write to.

extern "C" void on_signal(int signal) {
    received_signal = signal;
    // Stages without a callback can take long: whoever asks twice need not wait for their end.
    std::signal(signal, SIG_DFL);
}

} // namespace

void install_signal_handlers() {
    std::signal(SIGINT, on_signal);
    std::signal(SIGTERM, on_signal);
#ifdef SIGXFSZ
    std::signal(SIGXFSZ, SIG_IGN);
#endif
}

bool is_interrupted() {
    return received_signal != 0;
}

void check_interrupted() {
    if (received_signal == SIGINT) {
        throw UserError(ExitCode::interrupted, "interrupted");
    }
    if (received_signal != 0) {
        throw UserError(ExitCode::terminated, "terminated");
    }
}

} // namespace geodisk::tools
