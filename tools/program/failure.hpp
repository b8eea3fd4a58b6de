// The one exception of the command line tools: a message for the user and the exit status to end
// with. The library never throws; only tools do, and only this.
#pragma once

#include <stdexcept>
#include <string>
#include <utility>

#include <geodisk/status.hpp>

#include "program/path.hpp"

namespace geodisk::tools {

/// Documented exit statuses of the `geodisk` command.
enum class ExitCode : int {
    success = 0,
    violation = 1,     ///< `verify` found samples that are not as they should be.
    some_failed = 1,   ///< Meshes of a `batch`, while others are done.
    usage = 2,         ///< Unknown option, contradictory or impossible parameters.
    bad_input = 3,     ///< A mesh or sample file is missing, unreadable or malformed.
    bad_output = 4,    ///< An output file cannot be written.
    no_device = 5,     ///< No Vulkan device that can run geodisk.
    out_of_memory = 6, ///< The work does not fit the host's or the device's memory.
    internal = 7,      ///< The device was lost, an invariant of geodisk broke, or a driver crashed.
    // And 128 + signal.
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

/// Throws UserError(usage).
[[noreturn]] void fail_usage(const std::string& message);

/// Throws UserError(bad_input) with "PATH: MESSAGE"; "-" is called standard input.
[[noreturn]] void fail_input(const Path& path, const std::string& message);

/// Throws UserError(bad_output).
[[noreturn]] void fail_output(const std::string& message);

/// The exit status for an error of the library. `cancelled` is not among them: only the command
/// knows which signal it was.
ExitCode exit_code_of(Status status);

/// The value, or UserError with "PREFIX: MESSAGE" (just the message for an empty prefix).
template <class T>
T take(Result<T>&& result, const std::string& prefix = {}) {
    if (!result) {
        const Error& error = result.error();
        throw UserError(exit_code_of(error.status),
                        prefix.empty() ? error.message : prefix + ": " + error.message);
    }
    return std::move(result).value();
}

} // namespace geodisk::tools
