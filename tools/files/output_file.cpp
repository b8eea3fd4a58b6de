#include "files/output_file.hpp"

#include <cerrno>
#include <system_error>

#include "files/open_file.hpp"
#include "program/failure.hpp"

#ifdef _WIN32
#include <io.h>
#else
#include <unistd.h>
#endif

namespace geodisk::tools {
namespace {

/// 0 or an errno value.
int sync_to_disk(std::FILE* file) {
#ifdef _WIN32
    return _commit(_fileno(file)) == 0 ? 0 : errno;
#else
    return fsync(fileno(file)) == 0 ? 0 : errno;
#endif
}

[[noreturn]] void fail_output(const Path& path, const std::string& reason) {
    throw UserError(ExitCode::bad_output, path.string() + ": cannot write: " + reason);
}

} // namespace

AtomicFile::AtomicFile(const Path& target) : target_(target) {
    std::error_code ignored;
    const std::filesystem::file_status status = std::filesystem::status(target, ignored);
    if (std::filesystem::is_directory(status)) {
        fail_output(target, "is a folder");
    }
    // Renaming over a device or pipe would replace it instead of writing into it.
    if (std::filesystem::exists(status) && !std::filesystem::is_regular_file(status)) {
        fail_output(target, "is not a regular file");
    }
    // The rename must replace what a symbolic link points to, not the link.
    if (std::filesystem::is_symlink(std::filesystem::symlink_status(target, ignored))) {
        const std::filesystem::path resolved = std::filesystem::weakly_canonical(target, ignored);
        target_ = resolved.empty() ? target : resolved;
    }
    for (int attempt = 0; file_ == nullptr && attempt < 1000; ++attempt) {
        temporary_ = target_;
        temporary_ += ".tmp" + std::to_string(attempt);
        file_ = create_new(temporary_);
        if (file_ == nullptr && errno != EEXIST) {
            break;
        }
    }
    if (file_ == nullptr) {
        fail(errno);
    }
}

AtomicFile::~AtomicFile() {
    discard();
}

void AtomicFile::write(std::string_view bytes) {
    errno = 0;
    if (std::fwrite(bytes.data(), 1, bytes.size(), file_) != bytes.size()) {
        fail(errno);
    }
}

void AtomicFile::sync() {
    errno = 0;
    if (std::fflush(file_) != 0) {
        fail(errno);
    }
    if (const int error = sync_to_disk(file_); error != 0) {
        fail(error);
    }
}

void AtomicFile::commit() {
    sync();
    std::FILE* const file = file_;
    file_ = nullptr;
    std::error_code error;
    if (std::fclose(file) != 0) {
        error = std::error_code(errno, std::generic_category());
    } else {
        std::filesystem::rename(temporary_, target_, error);
    }
    if (error) {
        discard();
        fail_output(target_, error.message());
    }
    temporary_.clear();
}

void AtomicFile::fail(int error) const {
    fail_output(target_, std::generic_category().message(error));
}

void AtomicFile::discard() noexcept {
    if (file_ != nullptr) {
        std::fclose(file_);
        file_ = nullptr;
    }
    if (!temporary_.empty()) {
        std::error_code ignored;
        std::filesystem::remove(temporary_, ignored);
        temporary_.clear();
    }
}

bool is_same_file(const Path& a, const Path& b) {
    std::error_code ignored;
    if (std::filesystem::equivalent(a, b, ignored)) {
        return true;
    }
    // Paths of files that do not exist yet stay relative unless made absolute first.
    const auto canonical = [&](const Path& path) {
        return std::filesystem::weakly_canonical(std::filesystem::absolute(path, ignored), ignored);
    };
    return !canonical(a).empty() && canonical(a) == canonical(b);
}

void check_writable(const Path& path) {
    const AtomicFile probe(path); // Creates and removes the temporary file.
}

} // namespace geodisk::tools
