// The axis that points up.
#pragma once

namespace geodisk::tools {

enum class Up { x, y, z };

/// Returns the name of an axis.
constexpr char small_letter(Up up) {
    return up == Up::x ? 'x' : up == Up::y ? 'y' : 'z';
}

} // namespace geodisk::tools
