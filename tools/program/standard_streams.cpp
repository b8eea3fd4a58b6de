#include "program/standard_streams.hpp"

#ifndef _WIN32
#include <cerrno>
#include <initializer_list>

#include <fcntl.h>
#include <unistd.h>
#endif

namespace geodisk::tools {

void occupy_closed_streams() {
#ifndef _WIN32
    // In this order, since open() takes the lowest number that is free.
    for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
        if (fcntl(stream, F_GETFD) == -1 && errno == EBADF) {
            [[maybe_unused]] const int opened =
                open("/dev/null", stream == STDERR_FILENO ? O_WRONLY : O_RDONLY);
        }
    }
#endif
}

} // namespace geodisk::tools
