#include "owned/driver_files.hpp"

#include <cstdlib>
#include <filesystem>
#include <string_view>
#include <system_error>

namespace geodisk {
namespace {

#ifdef _WIN32
constexpr char kSeparator = ';';
#else
constexpr char kSeparator = ':';
#endif

bool exists(std::string_view path) {
    std::error_code ignored;
    return std::filesystem::exists(std::filesystem::path(path), ignored);
}

/// The first path of a list that leads nowhere, or "".
std::string_view first_missing(std::string_view paths) {
    while (!paths.empty()) {
        const std::string_view path = paths.substr(0, paths.find(kSeparator));
        if (!path.empty() && !exists(path)) {
            return path;
        }
        paths.remove_prefix(path.size() == paths.size() ? paths.size() : path.size() + 1);
    }
    return {};
}

} // namespace

std::string driver_files_problem() {
    // The loader takes the first one that is set.
    for (const char* const name : {"VK_DRIVER_FILES", "VK_ICD_FILENAMES"}) {
        const char* const value = std::getenv(name);
        if (value == nullptr || *value == '\0') {
            continue;
        }
        const std::string_view missing = first_missing(value);
        if (!missing.empty()) {
            return std::string(name) + " names the driver file " + std::string(missing) +
                   ", which does not exist; correct the variable, or unset it";
        }
        return std::string(name) + " allows only " + value +
               ", which holds no driver that works; correct the variable, or unset it";
    }
    return {};
}

} // namespace geodisk
