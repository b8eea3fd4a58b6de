#include "files/samples/job_frame_text.hpp"

#include <charconv>
#include <cstddef>
#include <string_view>
#include <vector>

#include "files/samples/sample_columns.hpp"
#include "program/failure.hpp"

namespace geodisk::tools {

std::string job_frame_text(const JobFrame& frame) {
    constexpr std::string_view kDigits = "0123456789abcdef";
    std::string text;
    for (const std::byte byte : to_bytes(frame)) {
        text += kDigits[std::to_integer<std::size_t>(byte >> 4)];
        text += kDigits[std::to_integer<std::size_t>(byte & std::byte{15})];
    }
    return text;
}

JobFrame job_frame_of_text(const std::string& text, const std::string& path) {
    std::vector<std::byte> bytes;
    for (std::size_t at = 0; at + 2 <= text.size(); at += 2) {
        unsigned byte = 0;
        const char* const end = text.data() + at + 2;
        if (std::from_chars(text.data() + at, end, byte, 16).ptr != end) {
            break;
        }
        bytes.push_back(static_cast<std::byte>(byte));
    }
    const auto frame =
        2 * bytes.size() == text.size()
            ? frame_from_bytes(bytes)
            : Result<JobFrame>(Error{Status::invalid_argument, "it is not of hexadecimal digits"});
    if (!frame) {
        fail_input(path, "its header has a wrong " + std::string(kJobFrame) + ": " +
                             frame.error().message);
    }
    return *frame;
}

} // namespace geodisk::tools
