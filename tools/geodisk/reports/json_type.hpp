// Json: the type alone, as its library takes a second to compile.
#pragma once

#include <nlohmann/json_fwd.hpp>

namespace geodisk::tools {

using Json = nlohmann::ordered_json;

} // namespace geodisk::tools
