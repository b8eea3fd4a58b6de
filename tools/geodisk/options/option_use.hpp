// OptionUse: why a command takes an option, which decides how its help describes it.
#pragma once

#include <string>

namespace geodisk::tools {

enum class OptionUse {
    sampling, ///< Samples are made by it.
    checking, ///< Samples of a file are compared with it.
};

/// Returns the help of an option in a command of this use.
inline std::string help_for(OptionUse use, const char* sampling, const char* checking) {
    return use == OptionUse::sampling ? sampling : checking;
}

} // namespace geodisk::tools
