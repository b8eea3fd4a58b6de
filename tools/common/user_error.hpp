// The one exception of the command line tools: a message for the user and the exit status to end
// with. The library never throws; only tools do, and only this.
#pragma once

#include <stdexcept>
#include <string>

namespace geodisk::tools {

/// Documented exit statuses of the `geodisk` command.
enum class ExitCode : int {
    success = 0,
    violation = 1,     ///< `verify` found a pair closer than the minimum distance.
    usage = 2,         ///< Unknown option, contradictory or impossible parameters.
    bad_input = 3,     ///< A mesh or sample file is missing, unreadable or malformed.
    bad_output = 4,    ///< An output file cannot be written.
    no_device = 5,     ///< No Vulkan device that can run geodisk.
    out_of_memory = 6, ///< The work does not fit the host's or the device's memory.
    internal = 7,      ///< The device was lost or an invariant of geodisk broke.
    interrupted = 130, ///< SIGINT.
    terminated = 143,  ///< SIGTERM.
};

/// Thrown anywhere below main(); main prints `message` as one line and exits with `code`.
class UserError : public std::runtime_error {
  public:
    UserError(ExitCode code, const std::string& message)
        : std::runtime_error(message), code_(code) {}
    ExitCode code() const noexcept { return code_; }

  private:
    ExitCode code_;
};

} // namespace geodisk::tools
