// Values of attributes as floats, for formats that hold nothing wider.
#pragma once

#include <cmath>

namespace geodisk::tools {

/// Returns true for a value that a float turns into another one of its kind: an integer, such as a
/// label, into another integer, or a finite number into infinity. Other numbers are only rounded.
inline bool is_lost_in_float(double value) {
    const float held = static_cast<float>(value);
    return std::isfinite(value) &&
           (!std::isfinite(held) || (std::trunc(value) == value && double{held} != value));
}

} // namespace geodisk::tools
