// PictureSubject: what the report of a picture tells of the samples.
#pragma once

#include <string>

#include "geodisk/reports/json.hpp"

namespace geodisk::tools {

/// Subject of a picture, and the words of a report for it.
struct PictureSubject {
    std::string samples_file;
    std::string lines; ///< For people, but for the samples.
    Json json;         ///< For programs.
};

} // namespace geodisk::tools
