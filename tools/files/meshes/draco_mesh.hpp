// Primitives of glTF that Draco has compressed.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace geodisk::tools {

/// A decoded primitive, or why there is none.
struct DracoMesh {
    struct Attribute {
        std::uint32_t id = 0;       ///< Draco's own number of it, which glTF names.
        std::size_t components = 0; ///< Numbers per vertex.
        bool is_normalized = false; ///< Integers are divided by the largest of their type.
        std::vector<double> values; ///< Vertex after vertex.
    };

    std::string failure; ///< Empty if it was decoded.
    std::uint64_t vertex_count = 0;
    std::vector<std::uint32_t> corners; ///< Three vertices per triangle.
    std::vector<Attribute> attributes;
};

/// Decodes the attributes of the numbers `ids` and the triangles.
DracoMesh draco_decoded(std::string_view bytes, const std::vector<std::uint32_t>& ids);

} // namespace geodisk::tools
