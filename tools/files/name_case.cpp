#include "files/name_case.hpp"

#include <algorithm>
#include <system_error>

namespace geodisk::tools {
namespace {

using Unit = std::filesystem::path::value_type;

bool is_small(Unit unit) {
    return unit >= 'a' && unit <= 'z';
}

bool is_large(Unit unit) {
    return unit >= 'A' && unit <= 'Z';
}

Unit other_case(Unit unit) {
    return is_small(unit) || is_large(unit) ? static_cast<Unit>(unit ^ 0x20) : unit;
}

Unit small_letter(Unit unit) {
    return is_large(unit) ? other_case(unit) : unit;
}

std::filesystem::path with_units(const std::filesystem::path& path, Unit (*change)(Unit)) {
    auto text = path.native();
    std::ranges::transform(text, text.begin(), change);
    return text;
}

} // namespace

bool ignores_case(const std::filesystem::path& path) {
    std::error_code error;
    std::filesystem::path folder = std::filesystem::absolute(path, error);
    // Up to one that is there and has letters in its name.
    while (folder.has_relative_path() &&
           (!std::filesystem::exists(folder, error) ||
            with_units(folder.filename(), other_case) == folder.filename())) {
        folder = folder.parent_path();
    }
    const std::filesystem::path other =
        folder.parent_path() / with_units(folder.filename(), other_case);
    return folder.has_filename() && std::filesystem::equivalent(folder, other, error);
}

std::filesystem::path small_letters(const std::filesystem::path& path) {
    return with_units(path, small_letter);
}

} // namespace geodisk::tools
