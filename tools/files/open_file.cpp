#include "files/open_file.hpp"

#include <cerrno>

#include <fcntl.h>
#ifdef _WIN32
#include <io.h>
#else
#include <sys/stat.h>
#include <unistd.h>
#endif

namespace geodisk::tools {

#ifdef _WIN32
std::FILE* open_to_read(const std::filesystem::path& path) {
    return _wfopen(path.c_str(), L"rb"); // Wide names: others depend on the code page.
}

std::FILE* open_stream_to_read(const std::filesystem::path& path, const StreamPath& stream) {
    if (stream.descriptor < 0) {
        return open_to_read(path);
    }
    const int copy = _dup(stream.descriptor);
    if (copy >= 0) {
        _setmode(copy, _O_BINARY);
    }
    return copy < 0 ? nullptr : _fdopen(copy, "rb");
}
#else
std::FILE* open_to_read(const std::filesystem::path& path) {
    return std::fopen(path.c_str(), "rb");
}

std::FILE* open_stream_to_read(const std::filesystem::path& path, const StreamPath& stream) {
    const int descriptor = stream.descriptor >= 0
                               ? fcntl(stream.descriptor, F_DUPFD_CLOEXEC, 0)
                               : open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NOCTTY);
    if (descriptor < 0) {
        return nullptr;
    }
    struct stat status {};
    const bool is_device = fstat(descriptor, &status) == 0 && S_ISCHR(status.st_mode);
    if (is_device && isatty(descriptor) == 0) {
        close(descriptor);
        errno = ENODEV;
        return nullptr;
    }
    return fdopen(descriptor, "rb");
}
#endif

} // namespace geodisk::tools
