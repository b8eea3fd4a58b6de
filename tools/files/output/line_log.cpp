#include "files/output/line_log.hpp"

#include <cerrno>
#include <chrono>
#include <cstdint>
#include <system_error>
#include <thread>

#include <fcntl.h>
#ifdef _WIN32
#include <io.h>
#else
#include <unistd.h>
#endif

#include "files/descriptor.hpp"
#include "files/output/output_target.hpp"

namespace geodisk::tools {
namespace {

#ifdef _WIN32
int resize(std::FILE* file, std::int64_t size) {
    return _chsize_s(_fileno(file), size);
}
#else
int resize(std::FILE* file, std::int64_t size) {
    return ftruncate(fileno(file), size) == 0 ? 0 : errno;
}
#endif

std::FILE* open_log(const Path& path) {
    const int descriptor = open_alone(path, O_CREAT | O_RDWR);
    return descriptor < 0 ? nullptr : fdopen(descriptor, "r+b");
}

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

LineLog::LineLog(const Path& path) : path_(path), file_(open_log(path)) {
    // A program that was killed takes a moment to be gone.
    for (int tries = 0; file_ == nullptr && errno == EWOULDBLOCK && tries < kTries; ++tries) {
        std::this_thread::sleep_for(kPause);
        file_ = open_log(path);
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
