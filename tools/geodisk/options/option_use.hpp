// OptionUse: why a command takes an option, which decides how its help describes it.
#pragma once

#include <string>

namespace geodisk::tools {

enum class OptionUse {
    sampling, ///< Samples are made by it.
    checking, ///< Samples of a file are compared with it.
    choosing, ///< It chooses a part of the surface.
};

/// Returns the help of an option in a command of this use.
inline std::string help_for(OptionUse use, const char* sampling, const char* checking,
                            const char* choosing = "") {
    return use == OptionUse::sampling ? sampling : use == OptionUse::checking ? checking : choosing;
}

} // namespace geodisk::tools
