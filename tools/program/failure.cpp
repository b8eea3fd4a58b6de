#include "program/failure.hpp"

namespace geodisk::tools {

void fail_usage(const std::string& message) {
    throw UserError(ExitCode::usage, message);
}

void fail_input(const Path& path, const std::string& message) {
    throw UserError(ExitCode::bad_input,
                    (path == "-" ? "standard input" : path.string()) + ": " + message);
}

void fail_output(const std::string& message) {
    throw UserError(ExitCode::bad_output, message);
}

ExitCode exit_code_of(Status status) {
    switch (status) {
    case Status::invalid_argument:
        return ExitCode::usage;
    case Status::mesh_rejected:
        return ExitCode::bad_input;
    case Status::no_device:
    case Status::device_lacks:
        return ExitCode::no_device;
    case Status::out_of_host_memory:
    case Status::out_of_device_memory:
    case Status::workspace_too_small:
    case Status::job_too_large:
        return ExitCode::out_of_memory;
    default:
        return ExitCode::internal;
    }
}

} // namespace geodisk::tools
