// The arguments of the program as UTF-8, on every system.
#pragma once

#include <string>
#include <vector>

namespace geodisk::tools {

/// Those after the program's name. Windows hands main() what its code page can express, which need
/// not be all of a file's name.
std::vector<std::string> utf8_arguments(int argc, char** argv);

} // namespace geodisk::tools
