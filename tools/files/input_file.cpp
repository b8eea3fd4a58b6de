#include "files/input_file.hpp"

#include <cerrno>
#include <cstdio>
#include <memory>
#include <optional>
#include <system_error>

#include "files/open_file.hpp"
#include "files/stream_path.hpp"
#include "program/failure.hpp"

namespace geodisk::tools {
namespace {

struct FileCloser {
    void operator()(std::FILE* file) const noexcept { std::fclose(file); }
};

[[noreturn]] void fail_with_errno(const Path& path, int error) {
    fail_input(path, "cannot read: " + std::generic_category().message(error));
}

void check_regular(const Path& path) {
    std::error_code error;
    const std::filesystem::file_status status = std::filesystem::status(path, error);
    if (status.type() == std::filesystem::file_type::not_found) {
        fail_input(path, "no such file");
    }
    if (error) {
        fail_input(path, "cannot read: " + error.message());
    }
    check_no_folder(path);
    if (!std::filesystem::is_regular_file(status)) {
        fail_input(path, std::filesystem::is_fifo(status) ? "is a pipe, not a regular file"
                                                          : "is not a regular file");
    }
}

std::string read_bytes(const Path& path, const std::optional<StreamPath>& stream) {
    const std::unique_ptr<std::FILE, FileCloser> file(stream ? open_stream_to_read(path, *stream)
                                                             : open_to_read(path));
    if (!file && errno == ENODEV) {
        fail_input(path, "is a device, not a regular file");
    }
    if (!file) {
        fail_with_errno(path, errno);
    }
    std::error_code ignored;
    std::string bytes;
    if (!stream) {
        bytes.reserve(static_cast<std::size_t>(std::filesystem::file_size(path, ignored)));
    }
    char buffer[1 << 16];
    std::size_t count = 0;
    while ((count = std::fread(buffer, 1, sizeof buffer, file.get())) > 0) {
        bytes.append(buffer, count);
    }
    if (std::ferror(file.get()) != 0) {
        fail_with_errno(path, errno);
    }
    return bytes;
}

} // namespace

void check_no_folder(const Path& path) {
    std::error_code ignored;
    if (std::filesystem::is_directory(path, ignored)) {
        fail_input(path, "is a folder, not a file");
    }
}

std::string read_file(const Path& path) {
    const auto stream = input_stream(path);
    return stream ? read_bytes(path, stream) : read_regular_file(path);
}

std::string read_regular_file(const Path& path) {
    check_regular(path);
    return read_bytes(path, std::nullopt);
}

std::string head_of(const Path& path, std::size_t max_bytes) {
    std::error_code ignored;
    if (input_stream(path) || !std::filesystem::is_regular_file(path, ignored)) {
        return {};
    }
    const std::unique_ptr<std::FILE, FileCloser> file(open_to_read(path));
    std::string head(file ? max_bytes : 0, '\0');
    if (file) {
        head.resize(std::fread(head.data(), 1, head.size(), file.get()));
    }
    return head;
}

std::string lower_case(std::string text) {
    for (char& character : text) {
        if (character >= 'A' && character <= 'Z') {
            character = static_cast<char>(character - 'A' + 'a');
        }
    }
    return text;
}

std::string lower_extension(const Path& path) {
    return lower_case(path.extension().string());
}

} // namespace geodisk::tools
