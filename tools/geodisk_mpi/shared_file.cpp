#include "shared_file.hpp"

#include <cerrno>
#include <system_error>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

namespace geodisk::tools {
namespace {

Error reason() {
    return Error{Status::internal, std::generic_category().message(errno)};
}

} // namespace

SharedFile::SharedFile(const std::filesystem::path& path, std::uint64_t size)
    : descriptor_(path.empty() ? -1 : ::open(path.c_str(), O_WRONLY | O_CLOEXEC)) {
    struct stat status {};
    if (is_open() && (fstat(descriptor_, &status) != 0 || !S_ISREG(status.st_mode) ||
                      static_cast<std::uint64_t>(status.st_size) != size)) {
        close(descriptor_);
        descriptor_ = -1;
    }
}

SharedFile::~SharedFile() {
    if (is_open()) {
        close(descriptor_);
    }
}

Result<Done> SharedFile::write(std::uint64_t offset, std::string_view bytes) const {
    while (!bytes.empty()) {
        const ssize_t written =
            pwrite(descriptor_, bytes.data(), bytes.size(), static_cast<off_t>(offset));
        if (written < 0 && errno != EINTR) {
            return reason();
        }
        if (written > 0) {
            bytes.remove_prefix(static_cast<std::size_t>(written));
            offset += static_cast<std::uint64_t>(written);
        }
    }
    return fsync(descriptor_) == 0 ? Result<Done>(Done{}) : reason();
}

} // namespace geodisk::tools
