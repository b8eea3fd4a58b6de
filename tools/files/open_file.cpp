#include "files/open_file.hpp"

namespace geodisk::tools {

std::FILE* open_to_read(const std::filesystem::path& path) {
#ifdef _WIN32
    return _wfopen(path.c_str(), L"rb"); // Wide names: others depend on the code page.
#else
    return std::fopen(path.c_str(), "rb");
#endif
}

} // namespace geodisk::tools
