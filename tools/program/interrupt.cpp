#include "program/interrupt.hpp"

#include <atomic>
#include <csignal>
#include <cstring>

#include "program/failure.hpp"
#include "program/temporary_files.hpp"

#ifndef _WIN32
#include <sys/time.h>
#include <unistd.h>
#endif

namespace geodisk::tools {
namespace {

// All that a signal handler may touch.
std::atomic<int> received_signal = 0;
std::atomic<int> uninterrupted = 0; ///< Number of threads that must not be ended.
static_assert(std::atomic<int>::is_always_lock_free);
std::atomic<const char*> interrupted_program = nullptr; ///< Null until handlers are installed.

thread_local const volatile std::int32_t* stop_flag = nullptr;

const char* what_happened(int signal) {
    switch (signal) {
    case SIGINT:
        return "interrupted";
#ifndef _WIN32
    case SIGHUP:
        return "hung up";
    case SIGQUIT:
        return "quit";
#endif
    default:
        return "terminated";
    }
}

#ifdef _WIN32
extern "C" void on_signal(int signal) {
    received_signal = signal;
    std::signal(signal, SIG_DFL); // Whoever asks twice need not wait for the end of a stage.
}
#else
/// Half a second, as the memory of a large job takes time to give back as well.
constexpr itimerval kTimeToStop{{0, 0}, {0, 500000}};

void write_error(const char* text) {
    // Nothing can be done where it fails.
    [[maybe_unused]] const ssize_t written = write(STDERR_FILENO, text, std::strlen(text));
}

/// As the error of check_interrupted() would end the program, but at once.
[[noreturn]] void end_now() {
    remove_noted_temporaries();
    if (isatty(STDERR_FILENO) == 1) { // There may be a line of progress.
        write_error("\r                                        "
                    "                                       \r");
    }
    write_error(interrupted_program);
    write_error(": ");
    write_error(what_happened(received_signal));
    write_error("\n");
    _exit(128 + received_signal);
}

extern "C" void on_signal(int signal) {
    const bool is_first = received_signal == 0;
    if (signal != SIGALRM) {
        received_signal = signal;
    }
    if (is_first || uninterrupted != 0) {
        setitimer(ITIMER_REAL, &kTimeToStop, nullptr); // A system call and nothing more.
    } else {
        end_now();
    }
}
#endif

} // namespace

void install_signal_handlers(const char* program) {
    interrupted_program = program;
#ifdef _WIN32
    std::signal(SIGINT, on_signal);
    std::signal(SIGTERM, on_signal);
#else
    struct sigaction handled {};
    handled.sa_handler = on_signal;
    handled.sa_flags = SA_RESTART;
    sigaction(SIGALRM, &handled, nullptr);
    for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGQUIT}) {
        struct sigaction before {};
        if (sigaction(signal, nullptr, &before) == 0 && before.sa_handler != SIG_IGN) {
            sigaction(signal, &handled, nullptr);
        }
    }
    std::signal(SIGPIPE, SIG_IGN);
    std::signal(SIGXFSZ, SIG_IGN);
#endif
}

bool handle_signal(int signal) {
    if (interrupted_program == nullptr) {
        return false;
    }
    on_signal(signal);
    return true;
}

bool is_interrupted() {
    return received_signal != 0 || (stop_flag != nullptr && *stop_flag != 0);
}

void check_interrupted() {
    if (is_interrupted()) {
        const int signal = received_signal != 0 ? received_signal.load() : SIGINT;
        throw UserError(ExitCode{128 + signal}, what_happened(signal));
    }
}

StopFlag::StopFlag(const volatile std::int32_t* stop) {
    stop_flag = stop;
}

StopFlag::~StopFlag() {
    stop_flag = nullptr;
}

Uninterrupted::Uninterrupted() {
    ++uninterrupted;
}

Uninterrupted::~Uninterrupted() {
    --uninterrupted;
}

} // namespace geodisk::tools
