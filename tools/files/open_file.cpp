#include "files/open_file.hpp"

#include <cerrno>

#include <fcntl.h>
#ifdef _WIN32
#include <io.h>
#else
#include <sys/stat.h>
#include <unistd.h>
#endif

#include "files/descriptor.hpp"

namespace geodisk::tools {

#ifdef _WIN32
std::FILE* open_to_read(const std::filesystem::path& path) {
    return _wfopen(path.c_str(), L"rb"); // Wide names: others depend on the code page.
}

std::FILE* open_stream_to_read(const std::filesystem::path& path, const StreamPath& stream) {
    if (stream.descriptor < 0) {
        return open_to_read(path);
    }
    const int copy = copy_descriptor(stream.descriptor);
    return copy < 0 ? nullptr : _fdopen(copy, "rb");
}
#else
std::FILE* open_to_read(const std::filesystem::path& path) {
    return std::fopen(path.c_str(), "rb");
}

std::FILE* open_stream_to_read(const std::filesystem::path& path, const StreamPath& stream) {
    const int descriptor = stream.descriptor >= 0
                               ? copy_descriptor(stream.descriptor)
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
