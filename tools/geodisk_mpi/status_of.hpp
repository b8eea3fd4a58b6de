// Errors of the program as errors that processes tell each other of.
#pragma once

#include <new>
#include <type_traits>

#include <geodisk/status.hpp>

#include "program/failure.hpp"

namespace geodisk::tools {

/// Returns the error that the first process turns into the same exit status, as far as there is
/// one.
inline Error error_of(const UserError& error) {
    const auto status_of = [](ExitCode code) {
        switch (code) {
        case ExitCode::usage:
            return Status::invalid_argument;
        case ExitCode::bad_input:
            return Status::mesh_rejected;
        case ExitCode::no_device:
            return Status::no_device;
        case ExitCode::out_of_memory:
            return Status::out_of_device_memory;
        default:
            return static_cast<int>(code) > 128 ? Status::cancelled : Status::internal;
        }
    };
    return Error{status_of(error.code()), error.what()};
}

/// Returns what `body` returns, or the error that it throws.
template <class Body>
std::invoke_result_t<Body> caught(const Body& body) {
    try {
        return body();
    } catch (const UserError& error) {
        return error_of(error);
    } catch (const std::bad_alloc&) {
        return Error{Status::out_of_host_memory, "out of memory"};
    }
}

} // namespace geodisk::tools
