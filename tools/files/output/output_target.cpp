#include "files/output/output_target.hpp"

#include <cerrno>
#include <system_error>

#include "program/failure.hpp"

#ifdef _WIN32
#include <io.h>
#else
#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>
#endif

namespace geodisk::tools {
namespace {

#ifdef _WIN32
bool is_write_protected(const std::filesystem::path& path) {
    return _waccess(path.c_str(), 2) != 0;
}
std::optional<FileRights> rights_of(const std::filesystem::path& /*path*/) {
    return FileRights{};
}
bool is_open_to_write(int descriptor) {
    return _get_osfhandle(descriptor) != -1;
}
#else
bool is_write_protected(const std::filesystem::path& path) {
    return access(path.c_str(), W_OK) != 0;
}
std::optional<FileRights> rights_of(const std::filesystem::path& path) {
    struct stat status {};
    if (stat(path.c_str(), &status) != 0) {
        return std::nullopt;
    }
    return FileRights{status.st_mode & 07777, status.st_uid, status.st_gid};
}
bool is_open_to_write(int descriptor) {
    const int flags = fcntl(descriptor, F_GETFL);
    return flags != -1 && (flags & O_ACCMODE) != O_RDONLY;
}
#endif

void check_stream(const Path& path, const StreamPath& stream) {
    if (stream.descriptor >= 0 ? !is_open_to_write(stream.descriptor) : is_write_protected(path)) {
        fail_to_write(path, "is not open for writing");
    }
}

} // namespace

OutputTarget output_target(const Path& path) {
    if (const auto stream = output_stream(path)) {
        check_stream(path, *stream);
        return {path, {}, stream};
    }
    const auto end = followed(path);
    if (!end) {
        fail_to_write(path, "is a broken symbolic link");
    }
    OutputTarget target{*end, {}, {}};
    std::error_code ignored;
    const std::filesystem::file_status status = std::filesystem::status(target.path, ignored);
    if (std::filesystem::is_directory(status)) {
        fail_to_write(path, "is a folder");
    }
    if (!std::filesystem::exists(status)) {
        return target;
    }
    if (!std::filesystem::is_regular_file(status)) {
        fail_to_write(path, "is not a regular file");
    }
    if (is_write_protected(target.path)) {
        fail_to_write(path, "is write-protected");
    }
    if (std::filesystem::hard_link_count(target.path, ignored) > 1) {
        fail_to_write(path, "has another name (a hard link), which would keep the old content; "
                            "remove it first");
    }
    target.replaced = rights_of(target.path);
    return target;
}

#ifdef _WIN32
int take_rights(std::FILE* /*file*/, const FileRights& /*rights*/) {
    return 0;
}
#else
int take_rights(std::FILE* file, const FileRights& rights) {
    struct stat status {};
    if (fstat(fileno(file), &status) != 0) {
        return errno;
    }
    // Before the mode: a change of owner takes some of its bits away.
    if ((status.st_uid != rights.owner || status.st_gid != rights.group) &&
        fchown(fileno(file), rights.owner, rights.group) != 0) {
        return errno;
    }
    return fchmod(fileno(file), rights.mode) == 0 ? 0 : errno;
}
#endif

void fail_to_write(const Path& path, const std::string& reason) {
    fail_output((path == "-" ? "standard output" : path.string()) + ": cannot write: " + reason);
}

} // namespace geodisk::tools
