#include "files/name_case.hpp"

#include <algorithm>
#include <system_error>

namespace geodisk::tools {
namespace {

using Unit = std::filesystem::path::value_type;

/// `name` with large letters of ASCII small and small ones large.
std::filesystem::path in_other_case(const std::filesystem::path& name) {
    auto text = name.native();
    std::ranges::transform(text, text.begin(), [](Unit unit) {
        const bool is_letter = (unit >= 'a' && unit <= 'z') || (unit >= 'A' && unit <= 'Z');
        return is_letter ? static_cast<Unit>(unit ^ 0x20) : unit;
    });
    return text;
}

} // namespace

bool ignores_case(const std::filesystem::path& path) {
    std::error_code error;
    std::filesystem::path folder = std::filesystem::absolute(path, error);
    // Up to one that is there and has letters in its name.
    while (folder.has_relative_path() && (!std::filesystem::exists(folder, error) ||
                                          in_other_case(folder.filename()) == folder.filename())) {
        folder = folder.parent_path();
    }
    const std::filesystem::path other = folder.parent_path() / in_other_case(folder.filename());
    return folder.has_filename() && std::filesystem::equivalent(folder, other, error);
}

} // namespace geodisk::tools
