// The parts of a glTF file, text or binary.
#pragma once

#include <string>
#include <string_view>

#include "program/path.hpp"

namespace geodisk::tools {

struct GltfChunks {
    std::string json;
    std::string_view binary; ///< Chunk of .glb alone; a part of the bytes of the file.
};

/// Splits `bytes`, those of the file `path`. Throws UserError(bad_input) if they are no glTF 2.
GltfChunks gltf_chunks(const Path& path, const std::string& bytes);

} // namespace geodisk::tools
