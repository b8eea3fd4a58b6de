#include "files/file_identity.hpp"

#include <system_error>

#include "files/input_file.hpp"
#include "files/name_case.hpp"
#include "files/stream_path.hpp"

#ifdef _WIN32
#define WIN32_LEAN_AND_MEAN
#include <windows.h>
#else
#include <sys/stat.h>
#endif

namespace geodisk::tools {
namespace {

#ifdef _WIN32
std::string number_of(const std::filesystem::path& path) {
    const HANDLE file =
        CreateFileW(path.c_str(), 0, FILE_SHARE_READ | FILE_SHARE_WRITE | FILE_SHARE_DELETE,
                    nullptr, OPEN_EXISTING, FILE_FLAG_BACKUP_SEMANTICS, nullptr);
    BY_HANDLE_FILE_INFORMATION facts{};
    const bool is_known = file != INVALID_HANDLE_VALUE &&
                          GetFileInformationByHandle(file, &facts) != 0 &&
                          (facts.nFileIndexHigh != 0 || facts.nFileIndexLow != 0);
    if (file != INVALID_HANDLE_VALUE) {
        CloseHandle(file);
    }
    return is_known ? std::to_string(facts.dwVolumeSerialNumber) + ':' +
                          std::to_string(facts.nFileIndexHigh) + ':' +
                          std::to_string(facts.nFileIndexLow)
                    : "";
}

std::string identity_of_stream(const std::filesystem::path& /*path*/, const StreamPath& stream) {
    return stream.descriptor < 0 ? "" : "stream " + std::to_string(stream.descriptor);
}
#else
std::string number_of(const struct stat& status) {
    return std::to_string(status.st_dev) + ':' + std::to_string(status.st_ino);
}

/// Returns what the file system knows the file by, or "" where there is none.
std::string number_of(const std::filesystem::path& path) {
    struct stat status {};
    return stat(path.c_str(), &status) == 0 ? number_of(status) : "";
}

std::string identity_of_stream(const std::filesystem::path& path, const StreamPath& stream) {
    struct stat status {};
    const bool is_open = stream.descriptor >= 0;
    const int found = is_open ? fstat(stream.descriptor, &status) : stat(path.c_str(), &status);
    if (found == 0 && (S_ISREG(status.st_mode) || S_ISFIFO(status.st_mode))) {
        return number_of(status);
    }
    return is_open ? "stream " + std::to_string(stream.descriptor) : "";
}
#endif

/// Returns the identity of a file that does not exist: the folder that does, and the names below
/// it.
std::string identity_in_folder(const std::filesystem::path& path) {
    std::error_code ignored;
    std::filesystem::path folder = std::filesystem::absolute(path, ignored).lexically_normal();
    std::filesystem::path name;
    std::string number;
    while (number.empty() && folder.has_relative_path()) {
        name = name.empty() ? folder.filename() : folder.filename() / name;
        folder = folder.parent_path();
        number = number_of(folder);
    }
    const std::u8string text = name.generic_u8string();
    const std::string below(text.begin(), text.end());
    return number + '/' + (ignores_case(folder) ? lower_case(below) : below);
}

} // namespace

std::string file_identity(const Path& path, int standard) {
    if (const auto stream = find_stream(path, standard)) {
        return identity_of_stream(path, *stream);
    }
    if (std::string number = number_of(path); !number.empty()) {
        return number;
    }
    return identity_in_folder(followed(path).value_or(path));
}

} // namespace geodisk::tools
