// glTF files that are hostile, damaged or of another version are refused.
#include "gltf_parts.hpp"
#include "test_files.hpp"

#include <cstdint>
#include <optional>
#include <string>

#ifndef _WIN32
#include <sys/stat.h>
#endif

using namespace geodisk::tools;

TEST_CASE("glTF that is nested too deeply or of another version is refused") {
    const TemporaryFolder folder;
    const auto check = [&](const std::string& text, std::string_view part) {
        check_fails(ExitCode::bad_input, part,
                    [&] { read_mesh(folder.write("a.gltf", text).string()); });
        std::string binary = binary_of({}).substr(0, 12) + little_endian(text.size()) + "JSON";
        check_fails(ExitCode::bad_input, part,
                    [&] { read_mesh(folder.write("a.glb", binary + text).string()); });
    };
    const std::string deep(20000, '['), ends(20000, ']');
    check(R"({"asset": {"version": "2.0"}, "extras": )" + deep + ends + "}",
          "is nested too deeply");
    check(R"({"asset": {"version": "2.0"}, "extras": )" + deep, "is nested too deeply");
    check(R"({"asset": {"version": "1.0"}})", "is glTF 1.0; only 2.0 is read");
    check(R"({"asset": {"version": 1}})", "is glTF 1.0; only 2.0 is read");
    check(R"({"asset": {"version": 2}})", "has no faces");
    check(R"({"meshes": {"m": {}}})", "is glTF 1.0; only 2.0 is read");
    check(R"({"asset": {"version": "3.0"}})", "is glTF 3.0; only 2.0 is read");
    check(R"({"asset": {"version": "2.1", "minVersion": "2.1"}})", "is glTF 2.1; only 2.0");
    check("{}", "it has no asset.version");
    check("[]", "its JSON is no object");
    Parts parts;
    parts.more = ", \"extras\": \"" + deep + "\\\"" + deep + "\""; // In text they are no arrays.
    CHECK(mesh_of(parts).triangle_count() == 2);
    const std::string old = "glTF" + little_endian(1) + std::string(20, ' ');
    check_fails(ExitCode::bad_input, "is glTF 1.0; only 2.0 is read",
                [&] { read_mesh(folder.write("b.glb", old).string()); });
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
    parts.buffer = R"("uri": "data:application/octet-stream;base64,AAAA", "byteLength": 3)";
    check_refused(parts, "its data reach beyond their buffer");
    parts = {};
    parts.more = R"(, "images": [{"uri": "../none.png"}, {"uri": "data:image/png;base64,AAAA"},
                                 {"bufferView": 0, "mimeType": "image/png"}])";
    CHECK(mesh_of(parts).triangle_count() == 2);
}

#ifndef _WIN32
TEST_CASE("pipes that a glTF file names are refused") {
    const TemporaryFolder folder;
    folder.write("mesh.bin", kBuffer);
    REQUIRE(mkfifo((folder / "pipe").c_str(), 0600) == 0);
    Parts parts;
    parts.buffer = R"("uri": "pipe", "byteLength": 60)";
    MeshSources sources;
    sources.mesh = folder.write("buffer.gltf", text_of(parts)).string();
    check_fails(ExitCode::bad_input, "pipe: is a pipe, not a regular file",
                [&] { read_mesh(sources); });
    parts = {};
    parts.primitives = R"([{"attributes": {"POSITION": 0}, "indices": 1, "material": 0}])";
    parts.more = R"(, "images": [{"uri": "pipe"}], "textures": [{"source": 0}], "materials":
                    [{"pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}}])";
    sources.mesh = folder.write("image.gltf", text_of(parts)).string();
    sources.fields.materials = true;
    check_fails(ExitCode::bad_input, "pipe: is a pipe, not a regular file",
                [&] { read_mesh(sources); });
}
#endif

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
