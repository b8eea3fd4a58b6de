// Stopping cleanly, and soon, on signals that ask for it.
#pragma once

#include <cstdint>

namespace geodisk::tools {

/// From now on SIGINT, SIGTERM, SIGHUP and SIGQUIT set a flag, which check_interrupted() turns into
/// an error. Whoever does not look for half a second, or gets a second signal, is ended by the
/// handler, which removes temporary files and says the same. Signals that were ignored stay so, as
/// nohup wants it. Writing into a closed pipe or past a file size limit becomes an error like a
/// full disk. `program` is named in messages and must stay.
void install_signal_handlers(const char* program);

/// Does what the handlers do with a signal that came by another way. Returns false if they are not
/// installed.
bool handle_signal(int signal);

bool is_interrupted();

/// Throws UserError with the exit status 128 + signal if a signal came.
void check_interrupted();

/// While it lives, work on this thread is also interrupted once a number of the caller is not 0.
class StopFlag {
  public:
    explicit StopFlag(const volatile std::int32_t* stop);
    StopFlag(const StopFlag&) = delete;
    StopFlag& operator=(const StopFlag&) = delete;
    ~StopFlag();
};

/// While it lives, on any thread, no signal ends the program: files appear under their names.
class Uninterrupted {
  public:
    Uninterrupted();
    ~Uninterrupted();
    Uninterrupted(const Uninterrupted&) = delete;
    Uninterrupted& operator=(const Uninterrupted&) = delete;
};

} // namespace geodisk::tools
