// Boxes in words, alike for every command that has one.
#pragma once

#include <string>

#include <geodisk/box.hpp>

namespace geodisk::tools {

/// "1 x 0.5 x 2".
std::string sides_text(const BoxParams& box, std::string (*text)(double side));

/// The same for people, and whether the sides are open or periodic: "1 x 0.5, open".
std::string box_text(const BoxParams& box);

/// "open" or "periodic".
const char* kind_text(const BoxParams& box);

double diagonal_of(const BoxParams& box);

} // namespace geodisk::tools
