#include "files/line_log.hpp"

#include <cerrno>
#include <chrono>
#include <cstdint>
#include <filesystem>
#include <system_error>
#include <thread>

#include "files/output_target.hpp"

#ifdef _WIN32
#include <fcntl.h>
#include <io.h>
#include <share.h>
#include <sys/stat.h>
#else
#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>
#endif

namespace geodisk::tools {
namespace {

#ifdef _WIN32
std::FILE* open_alone(const Path& path) {
    int descriptor = -1;
    const int error =
        _wsopen_s(&descriptor, path.c_str(), _O_CREAT | _O_RDWR | _O_BINARY | _O_NOINHERIT,
                  _SH_DENYWR, _S_IREAD | _S_IWRITE);
    if (error != 0) {
        errno = error == EACCES && std::filesystem::exists(path) ? EWOULDBLOCK : error;
        return nullptr;
    }
    return _fdopen(descriptor, "r+b");
}

int resize(std::FILE* file, std::int64_t size) {
    return _chsize_s(_fileno(file), size);
}
#else
std::FILE* open_alone(const Path& path) {
    const int descriptor = open(path.c_str(), O_CREAT | O_RDWR | O_CLOEXEC, 0666);
    if (descriptor < 0) {
        return nullptr;
    }
    // Where the file system knows no locks, nothing tells of others.
    if (flock(descriptor, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK) {
        close(descriptor);
        errno = EWOULDBLOCK;
        return nullptr;
    }
    return fdopen(descriptor, "r+b");
}

int resize(std::FILE* file, std::int64_t size) {
    return ftruncate(fileno(file), size) == 0 ? 0 : errno;
}
#endif

constexpr int kTries = 20;
constexpr std::chrono::milliseconds kPause(100);

/// Bytes up to the end of the last whole line.
std::int64_t whole_lines(std::FILE* file) {
    std::int64_t read = 0, whole = 0;
    char bytes[65536];
    for (std::size_t count; (count = std::fread(bytes, 1, sizeof bytes, file)) > 0;) {
        for (std::size_t i = 0; i < count; ++i) {
            if (bytes[i] == '\n') {
                whole = read + static_cast<std::int64_t>(i) + 1;
            }
        }
        read += static_cast<std::int64_t>(count);
    }
    return whole;
}

} // namespace

LineLog::LineLog(const Path& path) : path_(path), file_(open_alone(path)) {
    // A program that was killed takes a moment to be gone.
    for (int tries = 0; file_ == nullptr && errno == EWOULDBLOCK && tries < kTries; ++tries) {
        std::this_thread::sleep_for(kPause);
        file_ = open_alone(path);
    }
    if (file_ == nullptr) {
        if (errno == EWOULDBLOCK) {
            fail_to_write(path_, "another program is writing it");
        }
        fail(errno);
    }
    int error = resize(file_, whole_lines(file_));
    if (error == 0 && std::fseek(file_, 0, SEEK_END) != 0) {
        error = errno;
    }
    if (error != 0) {
        std::fclose(file_);
        fail(error);
    }
}

LineLog::~LineLog() {
    std::fclose(file_);
}

void LineLog::append(const std::string& line) {
    const std::string bytes = line + '\n';
    errno = 0;
    if (std::fwrite(bytes.data(), 1, bytes.size(), file_) != bytes.size() ||
        std::fflush(file_) != 0) {
        fail(errno);
    }
}

void LineLog::fail(int error) const {
    fail_to_write(path_, std::generic_category().message(error));
}

} // namespace geodisk::tools
