// Views of glTF that meshoptimizer has compressed.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace geodisk::tools {

struct MeshoptStream {
    std::string_view bytes;
    std::uint64_t count = 0;
    std::uint64_t stride = 0; ///< Bytes of each of `count` elements.
    std::string mode;         ///< ATTRIBUTES, TRIANGLES or INDICES.
    std::string filter;       ///< OCTAHEDRAL, QUATERNION, EXPONENTIAL, NONE or "".
};

/// Returns the elements one after another; nothing if they cannot be decoded, or not by this build.
std::optional<std::string> meshopt_decoded(const MeshoptStream& stream);

/// Says why not, for the end of a message: "which this build does not read", for one.
std::string meshopt_failure();

} // namespace geodisk::tools
