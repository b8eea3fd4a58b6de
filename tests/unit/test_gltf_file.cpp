// glTF files: what is read of them, and that hostile ones are refused.
#include "files/mesh_file.hpp"

#include "mesh_facts.hpp"
#include "test_files.hpp"

#include <cstring>
#include <string>
#include <vector>

using namespace geodisk::tools;

namespace {

using Corners = std::vector<std::uint32_t>;

template <class Value>
std::string bytes_of_values(const std::vector<Value>& values) {
    return {reinterpret_cast<const char*>(values.data()), values.size() * sizeof(Value)};
}

/// A unit square of four vertices, then the indices of two triangles as 16 bits.
const std::string kBuffer = bytes_of_values<float>({0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0}) +
                            bytes_of_values<std::uint16_t>({0, 1, 2, 0, 2, 3});

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

std::string text_of(const Parts& parts) {
    return R"({"asset": {"version": "2.0"}, )" + parts.nodes + R"("meshes": [{"primitives": )" +
           parts.primitives + R"(}], "accessors": )" + parts.accessors + R"(, "bufferViews": )" +
           parts.views + R"(, "buffers": [{)" + parts.buffer + "}]" + parts.more + "}";
}

MeshFile mesh_of(const Parts& parts, const std::string& buffer = kBuffer) {
    const TemporaryFolder folder;
    folder.write("mesh.bin", buffer);
    return read_mesh(folder.write("a.gltf", text_of(parts)).string());
}

void check_refused(const Parts& parts, std::string_view part, const std::string& buffer = kBuffer) {
    check_fails(ExitCode::bad_input, part, [&] { mesh_of(parts, buffer); });
}

std::string little_endian(std::size_t value) {
    std::string bytes;
    for (int i = 0; i < 4; ++i) {
        bytes += static_cast<char>(value >> 8 * i & 0xff);
    }
    return bytes;
}

std::string binary_of(Parts parts) {
    parts.buffer = R"("byteLength": 60)";
    std::string json = text_of(parts);
    json.resize((json.size() + 3) / 4 * 4, ' ');
    return "glTF" + little_endian(2) + little_endian(12 + 8 + json.size() + 8 + 60) +
           little_endian(json.size()) + "JSON" + json + little_endian(60) +
           std::string("BIN\0", 4) + kBuffer;
}

const std::vector<double> kSquare{0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0};

} // namespace

TEST_CASE("glTF meshes are read from text and binary files") {
    const MeshFile mesh = mesh_of({});
    CHECK(mesh.positions == kSquare);
    CHECK(mesh.triangles == Corners{0, 1, 2, 0, 2, 3});
    CHECK(mesh.polygons.empty());
    CHECK(mesh.warnings.empty());
    const TemporaryFolder folder;
    const MeshFile binary = read_mesh(folder.write("a.GLB", binary_of({})).string());
    CHECK(binary.positions == kSquare);
    CHECK(binary.triangles == mesh.triangles);
}

TEST_CASE("glTF strips, fans and bare vertices make triangles that face one way") {
    Parts parts;
    const auto corners_of = [&](const std::string& primitive) {
        parts.primitives = "[{\"attributes\": {\"POSITION\": 0}, " + primitive + "}]";
        return mesh_of(parts).triangles;
    };
    CHECK(corners_of("\"mode\": 5") == Corners{0, 1, 2, 1, 3, 2});
    CHECK(corners_of("\"mode\": 6") == Corners{1, 2, 0, 2, 3, 0});
    parts.primitives = R"([{"attributes": {"POSITION": 0}, "mode": 1},
                           {"attributes": {"POSITION": 0}, "indices": 1},
                           {"attributes": {"POSITION": 0}, "indices": 1, "mode": 5}])";
    const MeshFile several = mesh_of(parts); // They share vertices.
    CHECK(several.positions.size() == 12);
    CHECK(several.triangle_count() == 6);
    CHECK(several.warnings[0].kind == "other_primitives");
}

TEST_CASE("glTF nodes place meshes, also mirrored ones, in a tree") {
    Parts parts;
    parts.nodes = R"("scenes": [{"nodes": [2]}], "nodes": [
        {"mesh": 0, "translation": [10, 0, 0], "rotation": [0, 0, 0.70710678118654752, 0.70710678118654752]},
        {"mesh": 0, "matrix": [-2, 0, 0, 0, 0, 2, 0, 0, 0, 0, 2, 0, 0, 0, 5, 1]},
        {"children": [0, 1], "scale": [1, 1, 3]}],)";
    const MeshFile mesh = mesh_of(parts);
    CHECK(mesh.triangles == Corners{0, 1, 2, 0, 2, 3, 4, 6, 5, 4, 7, 6});
    const std::vector<double> expected{10, 0, 0,  10, 1, 0,  9,  1, 0,  9, 0, 0,
                                       0,  0, 15, -2, 0, 15, -2, 2, 15, 0, 2, 15};
    REQUIRE(mesh.positions.size() == expected.size());
    for (std::size_t i = 0; i < expected.size(); ++i) {
        CHECK(mesh.positions[i] == doctest::Approx(expected[i]));
    }
    parts.nodes =
        R"("nodes": [{"children": [1]}, {"children": [0]}, {"mesh": 0}], "scenes": [{"nodes": [0]}],)";
    check_refused(parts, "node 0 is met twice");
    parts.nodes = R"("nodes": [{"children": [1]}, {"mesh": 0}],)";
    CHECK(mesh_of(parts).triangle_count() == 2);
    parts.nodes = "";
    CHECK(mesh_of(parts).triangle_count() == 2);
}

TEST_CASE("glTF positions may be sparse or quantized") {
    Parts parts;
    parts.accessors =
        R"([{"bufferView": 0, "componentType": 5126, "count": 4, "type": "VEC3", "sparse": {"count": 1,
             "indices": {"bufferView": 2, "componentType": 5121},
             "values": {"bufferView": 0, "byteOffset": 12}}},
            {"bufferView": 1, "componentType": 5123, "count": 6, "type": "SCALAR"}])";
    parts.views =
        R"([{"buffer": 0, "byteLength": 48}, {"buffer": 0, "byteOffset": 48, "byteLength": 12},
                      {"buffer": 0, "byteOffset": 52, "byteLength": 1}])";
    std::vector<double> moved = kSquare;
    std::copy_n(moved.begin() + 3, 3, moved.begin() + 6); // The index at byte 52 is 2.
    const MeshFile sparse = mesh_of(parts);
    CHECK(sparse.positions == moved);
    CHECK(sparse.warnings[0].kind == "zero_area_faces");

    parts = {};
    parts.accessors =
        R"([{"bufferView": 0, "componentType": 5121, "normalized": true, "count": 4, "type": "VEC3"},
            {"bufferView": 1, "componentType": 5123, "count": 6, "type": "SCALAR"}])";
    parts.views = R"([{"buffer": 0, "byteLength": 16, "byteStride": 4},
                      {"buffer": 0, "byteOffset": 48, "byteLength": 12}])";
    std::string buffer = kBuffer;
    const unsigned char bytes[16] = {0, 0, 0, 9, 255, 0, 0, 9, 255, 255, 0, 9, 0, 255, 0, 9};
    std::memcpy(buffer.data(), bytes, sizeof bytes);
    CHECK(mesh_of(parts, buffer).positions == kSquare);
}

TEST_CASE("hostile glTF files are refused") {
    const auto with_accessor = [](const std::string& accessor) {
        Parts parts;
        parts.accessors =
            "[" + accessor +
            R"(, {"bufferView": 1, "componentType": 5123, "count": 6, "type": "SCALAR"}])";
        return parts;
    };
    const char* const beyond = "mesh 0, primitive 0: its data reach beyond";
    check_refused(
        with_accessor(
            R"({"bufferView": 0, "componentType": 5126, "count": 1000000000, "type": "VEC3"})"),
        beyond);
    check_refused(
        with_accessor(R"({"bufferView": 0, "componentType": 5126, "count": 5, "type": "VEC3"})"),
        beyond);
    check_refused(
        with_accessor(
            R"({"bufferView": 0, "componentType": 5126, "count": 4611686018427387905, "type": "VEC3"})"),
        "more vertices than a face can refer to");
    check_refused(
        with_accessor(
            R"({"bufferView": 0, "byteOffset": 4, "componentType": 5126, "count": 4, "type": "VEC3"})"),
        beyond);
    check_refused(
        with_accessor(
            R"({"bufferView": 0, "byteOffset": 18446744073709551612, "componentType": 5126, "count": 4, "type": "VEC3"})"),
        "");
    check_refused(
        with_accessor(R"({"bufferView": 9, "componentType": 5126, "count": 4, "type": "VEC3"})"),
        "bufferView 9 is out of range");
    check_refused(with_accessor(R"({"componentType": 5126, "count": 4, "type": "VEC3"})"),
                  "its positions have no data");
    check_refused(
        with_accessor(R"({"bufferView": 0, "componentType": 5126, "count": 4, "type": "VEC2"})"),
        "not of 3 coordinates");
    check_refused(
        with_accessor(R"({"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3"})"),
        "vertex index 3 is out of range, it has 3 vertices");
    check_refused(
        with_accessor(
            R"({"bufferView": 0, "componentType": 5126, "count": 4, "type": "VEC3", "sparse":
             {"count": 2, "indices": {"bufferView": 1, "byteOffset": 8, "componentType": 5125},
              "values": {"bufferView": 0}}})"),
        beyond);
    check_refused(
        with_accessor(
            R"({"bufferView": 0, "componentType": 5126, "count": 4, "type": "VEC3", "sparse":
             {"count": 1, "indices": {"bufferView": 1, "byteOffset": 2, "componentType": 5125},
              "values": {"bufferView": 0}}})"),
        "sparse index");
    Parts parts;
    parts.views = R"([{"buffer": 0, "byteLength": 48, "byteOffset": 18446744073709551608},
                      {"buffer": 0, "byteOffset": 48, "byteLength": 12}])";
    check_refused(parts, "");
    parts = {};
    parts.views = R"([{"buffer": 1, "byteLength": 48}, {"buffer": 0, "byteLength": 12}])";
    check_refused(parts, "buffer 1 is out of range");
    parts = {};
    parts.primitives = R"([{"attributes": {"NORMAL": 0}, "indices": 1}])";
    check_refused(parts, "has no POSITION");
    parts = {};
    parts.nodes = R"("scenes": [{"nodes": [7]}], "nodes": [{"mesh": 0}],)";
    check_refused(parts, "node 7 is out of range");
    parts.nodes = R"("scenes": [{"nodes": [0]}], "nodes": [{"mesh": 3}],)";
    check_refused(parts, "mesh 3 is out of range");
    parts = {};
    parts.more = R"(, "extensionsRequired": ["KHR_draco_mesh_compression"])";
    check_refused(parts, "compressed by Draco");
    parts.more = R"(, "extensionsRequired": ["EXT_meshopt_compression"])";
    check_refused(parts, "requires the extension 'EXT_meshopt_compression'");
}

TEST_CASE("glTF buffers are read from the folder of the file alone, images not at all") {
    Parts parts;
    for (const std::string uri :
         {"../mesh.bin", "/etc/passwd", "a/../../mesh.bin", "%2e%2e/mesh.bin",
          "http://example.org/mesh.bin", "file:mesh.bin", "..\\\\mesh.bin"}) {
        CAPTURE(uri);
        parts.buffer = "\"uri\": \"" + uri + "\", \"byteLength\": 60";
        check_refused(parts, "is not a file of its folder");
    }
    parts.buffer = R"("uri": "none.bin", "byteLength": 60)";
    check_refused(parts, "none.bin: no such file");
    parts.buffer = R"("uri": "mesh.bin", "byteLength": 61)";
    check_refused(parts, "File size mismatch");
    parts.buffer = R"("uri": "data:application/octet-stream;base64,AAAA", "byteLength": 3)";
    check_refused(parts, "its data reach beyond their buffer");
    parts = {};
    parts.more = R"(, "images": [{"uri": "../none.png"}, {"uri": "data:image/png;base64,AAAA"},
                                 {"bufferView": 0, "mimeType": "image/png"}])";
    CHECK(mesh_of(parts).triangle_count() == 2);
}

TEST_CASE("cut and altered glTF files are read or refused") {
    const TemporaryFolder folder;
    std::uint32_t random = 99;
    const auto next_random = [&random] { return random = random * 1664525u + 1013904223u; };
    const auto survives = [&](const std::string& bytes) {
        const std::optional<UserError> error =
            error_of([&] { read_mesh(folder.write("a.glb", bytes).string()); });
        CHECK((!error || error->code() == ExitCode::bad_input));
    };
    const std::string bytes = binary_of({});
    for (std::size_t size = 0; size < bytes.size(); size += 7) {
        survives(bytes.substr(0, size));
    }
    for (int round = 0; round < 2000; ++round) {
        std::string altered = bytes;
        for (int i = 0; i < 2; ++i) {
            const std::size_t at = (next_random() >> 8) % altered.size();
            const bool is_digit = altered[at] >= '0' && altered[at] <= '9';
            altered[at] = static_cast<char>(is_digit ? '0' + (next_random() >> 24) % 10
                                                     : next_random() >> 24);
        }
        survives(altered);
    }
}
