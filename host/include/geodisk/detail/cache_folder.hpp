// Where the user's cached files are.
#pragma once

#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <string>

namespace geodisk::detail {

/// Returns the folder that an environment variable names, or an empty path. Relative paths are
/// ignored (XDG Base Directory Specification).
inline std::filesystem::path folder_of_variable(const char* variable) {
#ifdef _WIN32
    const std::wstring wide(variable, variable + std::strlen(variable));
    const wchar_t* const value = _wgetenv(wide.c_str());
#else
    const char* const value = std::getenv(variable);
#endif
    std::filesystem::path folder;
    if (value != nullptr) {
        folder = value;
    }
    return folder.is_absolute() ? folder : std::filesystem::path();
}

/// Returns geodisk's folder in the user's cache folder, or an empty path if the environment names
/// none. The folder may not exist. May throw std::bad_alloc.
inline std::filesystem::path cache_folder() {
#if defined(_WIN32)
    const std::filesystem::path folder = folder_of_variable("LOCALAPPDATA");
#else
    std::filesystem::path folder;
#if defined(__APPLE__)
    const char* const below_home = "Library/Caches";
#else
    const char* const below_home = ".cache";
    folder = folder_of_variable("XDG_CACHE_HOME");
#endif
    if (folder.empty()) {
        if (const auto home = folder_of_variable("HOME"); !home.empty()) {
            folder = home / below_home;
        }
    }
#endif
    return folder.empty() ? folder : folder / "geodisk";
}

} // namespace geodisk::detail
