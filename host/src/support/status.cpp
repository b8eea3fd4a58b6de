#include <cstdio>
#include <cstdlib>

#include <geodisk/export.hpp>
#include <geodisk/status.hpp>

namespace geodisk {

GEODISK_API const char* to_string(Status status) noexcept {
    switch (status) {
    case Status::ok:
        return "ok";
    case Status::invalid_argument:
        return "invalid_argument";
    case Status::mesh_rejected:
        return "mesh_rejected";
    case Status::device_lacks:
        return "device_lacks";
    case Status::no_device:
        return "no_device";
    case Status::workspace_too_small:
        return "workspace_too_small";
    case Status::out_of_host_memory:
        return "out_of_host_memory";
    case Status::out_of_device_memory:
        return "out_of_device_memory";
    case Status::device_lost:
        return "device_lost";
    case Status::cancelled:
        return "cancelled";
    case Status::busy:
        return "busy";
    case Status::job_too_large:
        return "job_too_large";
    case Status::internal:
        return "internal";
    }
    return "unknown"; // A value outside the enumeration, for example of a newer library.
}

GEODISK_API void end_misuse(const Error* error) noexcept {
    if (error != nullptr) {
        std::fprintf(stderr, "geodisk: Result::value() of an error: %s\n", error->message.c_str());
    } else {
        std::fputs("geodisk: Result::error() of a value\n", stderr);
    }
    std::abort();
}

} // namespace geodisk
