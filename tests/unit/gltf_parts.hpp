// A small glTF file, in parts that tests change.
#pragma once

#include "files/meshes/mesh_file.hpp"

#include "test_files.hpp"

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace geodisk::tools {

template <class Value>
std::string bytes_of_values(const std::vector<Value>& values) {
    return {reinterpret_cast<const char*>(values.data()), values.size() * sizeof(Value)};
}

/// A unit square of four vertices, then the indices of two triangles as 16 bits.
inline const std::string kBuffer = bytes_of_values<float>({0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0}) +
                                   bytes_of_values<std::uint16_t>({0, 1, 2, 0, 2, 3});

/// A glTF file of that square, in parts to change.
struct Parts {
    std::string nodes = R"("scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],)";
    std::string primitives = R"([{"attributes": {"POSITION": 0}, "indices": 1}])";
    std::string accessors =
        R"([{"bufferView": 0, "componentType": 5126, "count": 4, "type": "VEC3"},
            {"bufferView": 1, "componentType": 5123, "count": 6, "type": "SCALAR"}])";
    std::string views = R"([{"buffer": 0, "byteLength": 48},
                            {"buffer": 0, "byteOffset": 48, "byteLength": 12}])";
    std::string buffer = R"("uri": "mesh.bin", "byteLength": 60)";
    std::string more;
};

inline std::string text_of(const Parts& parts) {
    return R"({"asset": {"version": "2.0"}, )" + parts.nodes + R"("meshes": [{"primitives": )" +
           parts.primitives + R"(}], "accessors": )" + parts.accessors + R"(, "bufferViews": )" +
           parts.views + R"(, "buffers": [{)" + parts.buffer + "}]" + parts.more + "}";
}

inline MeshFile mesh_of(const Parts& parts, const std::string& buffer = kBuffer) {
    const TemporaryFolder folder;
    folder.write("mesh.bin", buffer);
    return read_mesh(folder.write("a.gltf", text_of(parts)).string());
}

/// The file, with further views and accessors from byte 60 of the buffer on.
struct LongerSquare {
    Parts parts;
    std::string buffer = kBuffer;

    /// Adds a view and an accessor of these bytes; returns the accessor's number.
    int add(const std::string& bytes, int component_type, int count, const std::string& type) {
        const std::size_t offset = buffer.size();
        buffer += bytes;
        parts.views.pop_back();
        parts.views += ", {\"buffer\": 0, \"byteOffset\": " + std::to_string(offset) +
                       ", \"byteLength\": " + std::to_string(bytes.size()) + "}]";
        parts.accessors.pop_back();
        parts.accessors += ", {\"bufferView\": " + std::to_string(next_) +
                           ", \"componentType\": " + std::to_string(component_type) +
                           ", \"count\": " + std::to_string(count) + ", \"type\": \"" + type +
                           "\"}]";
        return next_++;
    }

    MeshFile mesh() {
        parts.buffer = R"("uri": "mesh.bin", "byteLength": )" + std::to_string(buffer.size());
        return mesh_of(parts, buffer);
    }

  private:
    int next_ = 2;
};

inline void check_refused(const Parts& parts, std::string_view part,
                          const std::string& buffer = kBuffer) {
    check_fails(ExitCode::bad_input, part, [&] { mesh_of(parts, buffer); });
}

inline std::string little_endian(std::size_t value) {
    std::string bytes;
    for (int i = 0; i < 4; ++i) {
        bytes += static_cast<char>(value >> 8 * i & 0xff);
    }
    return bytes;
}

inline std::string binary_of(Parts parts) {
    parts.buffer = R"("byteLength": 60)";
    std::string json = text_of(parts);
    json.resize((json.size() + 3) / 4 * 4, ' ');
    return "glTF" + little_endian(2) + little_endian(12 + 8 + json.size() + 8 + 60) +
           little_endian(json.size()) + "JSON" + json + little_endian(60) +
           std::string("BIN\0", 4) + kBuffer;
}

} // namespace geodisk::tools
