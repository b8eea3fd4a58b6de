// The axis that points up.
#pragma once

#include <optional>
#include <string_view>

namespace geodisk::tools {

enum class Up { x, y, z };

/// Returns the name of an axis.
constexpr char small_letter(Up up) {
    return up == Up::x ? 'x' : up == Up::y ? 'y' : 'z';
}

/// Returns the axis of that name, if it is one.
constexpr std::optional<Up> find_up(std::string_view name) {
    for (const Up up : {Up::x, Up::y, Up::z}) {
        if (name.size() == 1 && name[0] == small_letter(up)) {
            return up;
        }
    }
    return std::nullopt;
}

} // namespace geodisk::tools
