#include "files/open_file.hpp"

#ifdef _WIN32
#include <fcntl.h>
#include <io.h>
#include <sys/stat.h>
#endif

namespace geodisk::tools {

#ifdef _WIN32
// Wide names, as paths have them there: others depend on the code page. The C runtime of old knows
// no mode "x".
std::FILE* open_to_read(const std::filesystem::path& path) {
    return _wfopen(path.c_str(), L"rb");
}

std::FILE* create_new(const std::filesystem::path& path) {
    const int descriptor =
        _wopen(path.c_str(), _O_CREAT | _O_EXCL | _O_WRONLY | _O_BINARY, _S_IREAD | _S_IWRITE);
    if (descriptor < 0) {
        return nullptr;
    }
    std::FILE* const file = _fdopen(descriptor, "wb");
    if (file == nullptr) {
        _close(descriptor);
    }
    return file;
}
#else
std::FILE* open_to_read(const std::filesystem::path& path) {
    return std::fopen(path.c_str(), "rb");
}

std::FILE* create_new(const std::filesystem::path& path) {
    return std::fopen(path.c_str(), "wbx"); // x: never through a file already there
}
#endif

} // namespace geodisk::tools
