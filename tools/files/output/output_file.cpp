#include "files/output/output_file.hpp"

#include <cerrno>
#include <system_error>
#include <utility>

#include "files/output/stream_writer.hpp"
#include "files/output/temporary_file.hpp"
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

} // namespace

AtomicFile::AtomicFile(const Path& path) : given_(path), target_(output_target(path)) {
    if (stream()) {
        return;
    }
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
        fail_to_write(given_, "belongs to another user; replacing it would change its owner");
    }
}

AtomicFile::~AtomicFile() {
    discard();
}

void AtomicFile::write(std::string_view bytes) {
    if (stream()) {
        bytes_ += bytes;
        return;
    }
    errno = 0;
    if (std::fwrite(bytes.data(), 1, bytes.size(), file_) != bytes.size()) {
        fail(errno);
    }
}

std::filesystem::path AtomicFile::share() {
    errno = 0;
    if (!stream() && std::fflush(file_) != 0) {
        fail(errno);
    }
    return temporary_;
}

void AtomicFile::sync() {
    if (stream()) {
        return;
    }
    share();
    if (const int error = sync_to_disk(file_); error != 0) {
        fail(error);
    }
}

void AtomicFile::commit() {
    if (stream()) {
        write_to_stream();
        return;
    }
    sync();
#ifdef _WIN32
    close(); // Open files cannot be renamed there.
#endif
    if (const int error = move_file(temporary_, claimed_.empty() ? target_.path : claimed_);
        error != 0) {
        discard();
        fail(error);
    }
    temporary_.clear();
    claimed_.clear();
    noted_claim_ = {};
    close();
}

bool AtomicFile::claim(const Path& path) {
    sync();
    const int error = claim_name(temporary_, path);
    if (error == EEXIST) {
        return false;
    }
    given_ = path;
    if (error != 0) {
        fail(error);
    }
    claimed_ = path;
    noted_claim_ = NotedTemporary(claimed_);
    return true;
}

void AtomicFile::release() noexcept {
    if (!claimed_.empty()) {
        std::error_code ignored;
        std::filesystem::remove(claimed_, ignored);
        claimed_.clear();
        noted_claim_ = {};
    }
}

void AtomicFile::write_to_stream() {
    const int error = write_stream(target_.path, *target_.stream, bytes_);
    if (error == EPIPE) {
        fail_output(""); // Whoever reads has enough, as of `| head`.
    }
    if (error != 0) {
        fail(error);
    }
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
    release();
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

void check_writable(const Path& path) {
    const AtomicFile probe(path); // Creates and removes the temporary file.
}

} // namespace geodisk::tools
