#include "program/crash.hpp"

#ifdef __linux__
#include <algorithm>
#include <array>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>

#include <dlfcn.h>
#include <execinfo.h>
#include <unistd.h>

#include <geodisk/params.hpp>

#include "program/failure.hpp"
#include "program/temporary_files.hpp"
#endif

namespace geodisk::tools {

#ifdef __linux__
namespace {

const char* crashed_program = "";
std::array<const void*, 2> own_bases{}; // Of the program and of the library geodisk.
volatile std::sig_atomic_t is_crashing = 0;
volatile std::sig_atomic_t is_exit_expected = 0;
std::array<char, 1 << 16> signal_stack; // For where the program's own is used up.

template <class Function>
const void* base_of(Function* function) {
    Dl_info info;
    return dladdr(reinterpret_cast<void*>(function), &info) != 0 ? info.dli_fbase : nullptr;
}

const char* base_name(const char* path) {
    const char* const slash = std::strrchr(path, '/');
    return slash != nullptr ? slash + 1 : path;
}

/// Returns true for libraries that everybody calls, and where crashes by bad arguments and abort()
/// show.
bool is_common(const char* library) {
    for (const char* const name : {"libc.so", "libm.so", "libstdc++.so", "libgcc_s.so",
                                   "libpthread.so", "ld-linux", "linux-vdso"}) {
        if (std::strncmp(library, name, std::strlen(name)) == 0) {
            return true;
        }
    }
    return false;
}

/// Place of the innermost call that is not of a common library.
struct Place {
    const char* library = ""; ///< "" for code of none, such as a driver compiles.
    bool is_ours = false;
};

/// `skipped` calls are those of the handler.
Place crash_place(int skipped) {
    std::array<void*, 64> calls;
    const int count = backtrace(calls.data(), static_cast<int>(calls.size()));
    for (int i = skipped; i < count; ++i) {
        Dl_info info;
        if (dladdr(calls[static_cast<std::size_t>(i)], &info) == 0 || info.dli_fname == nullptr) {
            break;
        }
        const char* const library = base_name(info.dli_fname);
        if (!is_common(library)) {
            return {library, info.dli_fbase == own_bases[0] || info.dli_fbase == own_bases[1]};
        }
    }
    return {};
}

[[noreturn]] void end_with(const char* event, const Place& place) {
    remove_noted_temporaries();
    char line[256];
    const int length = std::snprintf(
        line, sizeof line, "%s: %s in %s%s\n", crashed_program, event,
        place.library[0] != '\0' ? place.library : "code that was compiled at run time",
        place.is_ours ? ", a bug of geodisk: please report it"
                      : ", not in geodisk: the Vulkan driver or what it uses; it may lack memory");
    if (length > 0) {
        const std::size_t size = std::min(static_cast<std::size_t>(length), sizeof line - 1);
        [[maybe_unused]] const ssize_t written = write(STDERR_FILENO, line, size);
    }
    _exit(static_cast<int>(ExitCode::internal));
}

extern "C" void on_crash(int signal) {
    if (is_crashing != 0) {
        _exit(static_cast<int>(ExitCode::internal)); // While telling of the crash.
    }
    is_crashing = 1;
    char event[64];
    std::snprintf(event, sizeof event, "crashed (%s)",
                  signal == SIGABRT  ? "SIGABRT"
                  : signal == SIGBUS ? "SIGBUS"
                  : signal == SIGFPE ? "SIGFPE"
                  : signal == SIGILL ? "SIGILL"
                                     : "SIGSEGV");
    end_with(event, crash_place(3)); // Past crash_place(), on_crash() and its caller.
}

void on_exit_call() {
    if (is_exit_expected == 0) {
        end_with("the process was ended", crash_place(2));
    }
}

} // namespace

void install_crash_handlers(const char* program) {
    crashed_program = program;
    own_bases = {base_of(&expect_exit),
                 base_of(static_cast<double (*)(double, double)>(&expected_count))};
    std::array<void*, 1> warm;
    backtrace(warm.data(), 1); // The first call loads a library, which a handler should not.
    stack_t stack{};
    stack.ss_sp = signal_stack.data();
    stack.ss_size = signal_stack.size();
    sigaltstack(&stack, nullptr);
    struct sigaction handled {};
    handled.sa_handler = on_crash;
    handled.sa_flags = SA_ONSTACK | SA_NODEFER;
    for (const int signal : {SIGSEGV, SIGBUS, SIGILL, SIGFPE, SIGABRT}) {
        struct sigaction before {};
        if (sigaction(signal, nullptr, &before) == 0 && before.sa_handler == SIG_DFL) {
            sigaction(signal, &handled, nullptr);
        }
    }
    std::atexit(on_exit_call);
}

void expect_exit() {
    is_exit_expected = 1;
}
#else
void install_crash_handlers(const char* /*program*/) {}
void expect_exit() {}
#endif

} // namespace geodisk::tools
