// From the library's errors to the command's exit statuses.
#pragma once

#include <string>
#include <utility>

#include <geodisk/status.hpp>

#include "common/user_error.hpp"

namespace geodisk::tools {

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
