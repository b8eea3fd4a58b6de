// A report as one HTML file that needs nothing else.
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "report/page_array.hpp"

namespace geodisk::tools {
class AtomicFile;
}

namespace geodisk::tools::report {

struct Page {
    std::string facts; ///< A JSON object; page.js tells what it knows of.
    std::span<const PageArray> arrays;
};

/// JSON as it may stand within <script>, whatever is in its strings.
std::string in_script(std::string json);

/// Throws UserError(usage) unless this program can make pages.
void require_front_end();

/// Writes the page. Its marks {{NAME}} give way to the texts of the front end, the facts and the
/// arrays. Throws UserError(bad_output), and what ends the program on a signal.
void write_page(AtomicFile& file, const Page& page);

} // namespace geodisk::tools::report
