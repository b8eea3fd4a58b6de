// The parts of a page that are the same in all: texts that are compiled into the program.
#pragma once

#include <span>
#include <string_view>

namespace geodisk::tools::report {

/// A text, in the pieces that compilers take.
using Text = std::span<const std::string_view>;

/// Returns true if the program was built with three.js, which pages need.
bool has_front_end();

/// The text called `name` as page.html does; empty where there is none.
Text front_end_text(std::string_view name);

} // namespace geodisk::tools::report
