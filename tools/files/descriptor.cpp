#include "files/descriptor.hpp"

#include <cerrno>

#include <fcntl.h>
#ifdef _WIN32
#include <io.h>
#include <share.h>
#include <sys/stat.h>
#else
#include <sys/file.h>
#include <unistd.h>
#endif

namespace geodisk::tools {

#ifdef _WIN32
int copy_descriptor(int descriptor) {
    const int copy = _dup(descriptor);
    if (copy >= 0) {
        _setmode(copy, _O_BINARY);
    }
    return copy;
}

// Opens a file so that other processes cannot write or remove it.
int open_alone(const std::filesystem::path& path, int flags) {
    int descriptor = -1;
    const int error = _wsopen_s(&descriptor, path.c_str(), flags | _O_BINARY | _O_NOINHERIT,
                                _SH_DENYWR, _S_IREAD | _S_IWRITE);
    if (error == 0) {
        return descriptor;
    }
    errno = error == EACCES && std::filesystem::exists(path) ? EWOULDBLOCK : error;
    return -1;
}
#else
int copy_descriptor(int descriptor) {
    return fcntl(descriptor, F_DUPFD_CLOEXEC, 0);
}

int open_alone(const std::filesystem::path& path, int flags) {
    const int descriptor = open(path.c_str(), flags | O_CLOEXEC, 0666);
    if (descriptor >= 0 && flock(descriptor, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK) {
        close(descriptor);
        errno = EWOULDBLOCK;
        return -1;
    }
    return descriptor;
}
#endif

} // namespace geodisk::tools
