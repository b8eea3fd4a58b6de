#include "files/stream_path.hpp"

#include <string>
#include <system_error>

#include "program/exact_text.hpp"

namespace geodisk::tools {
namespace {

/// The number N of /dev/fd/N, or of another name of that folder.
std::optional<int> descriptor_at(const std::filesystem::path& path) {
    const auto number = parse_integer<int>(path.filename().string());
    if (!number || *number < 0) {
        return std::nullopt;
    }
    std::error_code ignored;
    for (const char* const folder : {"/dev/fd", "/proc/self/fd"}) {
        if (std::filesystem::equivalent(path.parent_path(), folder, ignored)) {
            return number;
        }
    }
    return std::nullopt;
}

/// Links of /proc/N/fd lead to open files, whatever name those have now.
bool is_open_file(const std::filesystem::path& path) {
    const std::filesystem::path folder = path.parent_path();
    return folder.filename() == "fd" && folder.parent_path().parent_path() == "/proc";
}

} // namespace

std::optional<std::filesystem::path> followed(const Path& path) {
    constexpr int kMaxLinks = 40; // As Linux has it.
    std::filesystem::path end = path;
    std::error_code ignored;
    for (int links = 0; std::filesystem::is_symlink(end, ignored); ++links) {
        if (is_open_file(end) || descriptor_at(end)) {
            return end;
        }
        const std::filesystem::path next = std::filesystem::read_symlink(end, ignored);
        if (links == kMaxLinks || next.empty()) {
            return std::nullopt;
        }
        end = end.parent_path() / next; // `next` alone where it is absolute.
    }
    return end;
}

std::optional<StreamPath> find_stream(const Path& path, int standard) {
    if (path == "-") {
        return StreamPath{standard};
    }
    const std::optional<std::filesystem::path> end = followed(path);
    if (!end) {
        return std::nullopt;
    }
    if (const std::optional<int> descriptor = descriptor_at(*end)) {
        return StreamPath{*descriptor};
    }
    std::error_code ignored;
    const std::filesystem::file_status status = std::filesystem::status(*end, ignored);
    const bool is_stream = std::filesystem::is_fifo(status) ||
                           std::filesystem::is_character_file(status) ||
                           std::filesystem::is_socket(status);
    return is_stream || is_open_file(*end) ? std::optional(StreamPath{}) : std::nullopt;
}

std::optional<StreamPath> output_stream(const Path& path) {
    return find_stream(path, 1);
}

bool is_standard_output(const Path& path) {
    const auto stream = output_stream(path);
    return stream && stream->descriptor == 1;
}

std::optional<StreamPath> input_stream(const Path& path) {
    return find_stream(path, 0);
}

} // namespace geodisk::tools
