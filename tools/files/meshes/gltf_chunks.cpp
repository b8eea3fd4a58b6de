#include "files/meshes/gltf_chunks.hpp"

#include <cstddef>
#include <cstdint>
#include <limits>

#include "files/text_file.hpp"
#include "program/failure.hpp"

namespace geodisk::tools {
namespace {

std::uint32_t word_at(std::string_view bytes, std::size_t at) {
    std::uint32_t value = 0;
    for (std::size_t i = 4; i-- > 0;) {
        value = value << 8 | static_cast<unsigned char>(bytes[at + i]);
    }
    return value;
}

GltfChunks chunks_of_glb(const Path& path, std::string_view bytes) {
    constexpr std::size_t kHeader = 12, kChunkHeader = 8;
    constexpr std::uint32_t kJson = 0x4e4f534a, kBinary = 0x004e4942;
    if (bytes.size() < kHeader + kChunkHeader) {
        fail_input(path, "the file ends inside the header of glTF");
    }
    if (const std::uint32_t version = word_at(bytes, 4); version != 2) {
        fail_input(path, "is glTF " + std::to_string(version) + ".0; only 2.0 is read");
    }
    GltfChunks chunks;
    bool has_json = false;
    std::size_t at = kHeader;
    while (bytes.size() - at >= kChunkHeader) {
        const std::size_t size = word_at(bytes, at);
        const std::uint32_t type = word_at(bytes, at + 4);
        at += kChunkHeader;
        if (size > bytes.size() - at) {
            fail_input(path, "the file ends inside a chunk of " + std::to_string(size) + " bytes");
        }
        if (type == kJson && !has_json) {
            chunks.json = bytes.substr(at, size);
            has_json = true;
        } else if (type == kBinary && chunks.binary.empty()) {
            chunks.binary = bytes.substr(at, size);
        }
        at += size;
    }
    if (!has_json) {
        fail_input(path, "is not a glTF file that can be read: it has no chunk of JSON");
    }
    drop_final_nuls(chunks.json);
    return chunks;
}

} // namespace

GltfChunks gltf_chunks(const Path& path, const std::string& bytes) {
    if (bytes.size() > std::numeric_limits<std::uint32_t>::max()) {
        fail_input(path, "is larger than 4 GiB, which no glTF file may be");
    }
    if (bytes.starts_with("glTF")) {
        return chunks_of_glb(path, bytes);
    }
    refuse_other_mesh(path, bytes, ".gltf");
    GltfChunks chunks{bytes, {}};
    drop_final_nuls(chunks.json);
    return chunks;
}

} // namespace geodisk::tools
