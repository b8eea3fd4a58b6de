#include "files/output_file.hpp"

#include <cerrno>
#include <system_error>
#include <utility>

#include "files/temporary_file.hpp"

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

} // namespace

AtomicFile::AtomicFile(const Path& path) : given_(path), target_(output_target(path)) {
    TemporaryFile made = make_temporary(target_.path);
    file_ = made.file;
    if (file_ == nullptr) {
        fail(errno);
    }
    temporary_ = std::move(made.path);
    noted_ = NotedTemporary(temporary_);
    const int error = target_.replaced ? take_rights(file_, *target_.replaced) : 0;
    if (error != 0) {
        discard();
        fail_to_write(given_, "belongs to somebody else, and would no longer");
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
#ifdef _WIN32
    close(); // Open files cannot be renamed there.
#endif
    std::error_code error;
    std::filesystem::rename(temporary_, target_.path, error);
    if (error) {
        discard();
        fail_to_write(given_, error.message());
    }
    temporary_.clear();
    close();
}

void AtomicFile::fail(int error) const {
    fail_to_write(given_, std::generic_category().message(error));
}

void AtomicFile::close() noexcept {
    if (file_ != nullptr) {
        std::fclose(file_);
        file_ = nullptr;
    }
}

void AtomicFile::discard() noexcept {
#ifdef _WIN32
    close();
#endif
    if (!temporary_.empty()) {
        std::error_code ignored;
        std::filesystem::remove(temporary_, ignored);
        temporary_.clear();
    }
    close(); // Only now, as it ends the lock.
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
