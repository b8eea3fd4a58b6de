#include "files/meshes/meshopt.hpp"

namespace geodisk::tools {

std::optional<std::string> meshopt_decoded(const MeshoptStream&) {
    return std::nullopt;
}

std::string meshopt_failure() {
    return "which this build does not read";
}

} // namespace geodisk::tools
