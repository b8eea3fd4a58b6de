#include "files/output/stream_writer.hpp"

#include <algorithm>
#include <cerrno>
#include <cstddef>
#include <iostream>

#include <fcntl.h>
#ifdef _WIN32
#include <io.h>
#else
#include <poll.h>
#include <unistd.h>
#endif

#include "files/descriptor.hpp"

namespace geodisk::tools {
namespace {

#ifdef _WIN32
int open_stream(const std::filesystem::path& path) {
    return _wopen(path.c_str(), _O_WRONLY | _O_BINARY | _O_NOINHERIT);
}
std::ptrdiff_t write_some(int descriptor, std::string_view bytes) {
    constexpr std::size_t kMax = 1 << 20; // Less than an int.
    return _write(descriptor, bytes.data(), static_cast<unsigned>(std::min(bytes.size(), kMax)));
}
int close_stream(int descriptor) {
    return _close(descriptor);
}
#else
int open_stream(const std::filesystem::path& path) {
    return open(path.c_str(), O_WRONLY | O_APPEND | O_CLOEXEC | O_NOCTTY);
}
/// Waits where the other end asked not to be waited for.
std::ptrdiff_t write_some(int descriptor, std::string_view bytes) {
    for (;;) {
        const ssize_t count = ::write(descriptor, bytes.data(), bytes.size());
        if (count >= 0 || (errno != EAGAIN && errno != EWOULDBLOCK && errno != EINTR)) {
            return count;
        }
        pollfd ready{descriptor, POLLOUT, 0};
        poll(&ready, 1, -1);
    }
}
int close_stream(int descriptor) {
    return close(descriptor);
}
#endif

int write_all(int descriptor, std::string_view bytes) {
    while (!bytes.empty()) {
        const std::ptrdiff_t count = write_some(descriptor, bytes);
        if (count < 0) {
            return errno;
        }
        bytes.remove_prefix(static_cast<std::size_t>(count));
    }
    return 0;
}

} // namespace

int write_stream(const std::filesystem::path& path, const StreamPath& stream,
                 std::string_view bytes) {
    std::cout.flush();
    std::cerr.flush();
    const int descriptor =
        stream.descriptor >= 0 ? copy_descriptor(stream.descriptor) : open_stream(path);
    if (descriptor < 0) {
        return errno;
    }
    const int error = write_all(descriptor, bytes);
    const int closed = close_stream(descriptor) == 0 ? 0 : errno;
    return error != 0 ? error : closed;
}

} // namespace geodisk::tools
