// glTF files: what is read of them.
#include "files/meshes/mesh_file.hpp"
#include "files/meshes/part_columns.hpp"
#include "files/samples/sample_fields.hpp"

#include "gltf_parts.hpp"
#include "mesh_facts.hpp"
#include "test_files.hpp"

#include <cstring>
#include <string>
#include <vector>

using namespace geodisk::tools;

namespace {

using Corners = std::vector<std::uint32_t>;

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

TEST_CASE("attributes of glTF are those of corners, whatever primitives share") {
    Parts parts;
    // Colours in bytes, a label, and a normal along x; a mirrored node that is flat along x.
    parts.nodes = R"("scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0, "scale": [-2, 1, 1]}],)";
    parts.primitives = R"([{"attributes": {"POSITION": 0, "COLOR_0": 2, "_LABEL": 3, "NORMAL": 4},
                            "indices": 1},
                           {"attributes": {"POSITION": 0, "COLOR_0": 2, "NORMAL": 4}, "indices": 1}])";
    parts.accessors =
        R"([{"bufferView": 0, "componentType": 5126, "count": 4, "type": "VEC3"},
            {"bufferView": 1, "componentType": 5123, "count": 6, "type": "SCALAR"},
            {"bufferView": 2, "componentType": 5121, "count": 4, "type": "VEC3", "normalized": true},
            {"bufferView": 3, "componentType": 5121, "count": 4, "type": "SCALAR"},
            {"bufferView": 4, "componentType": 5126, "count": 4, "type": "VEC3"}])";
    parts.views =
        R"([{"buffer": 0, "byteLength": 48}, {"buffer": 0, "byteOffset": 48, "byteLength": 12},
                      {"buffer": 0, "byteOffset": 60, "byteLength": 12},
                      {"buffer": 0, "byteOffset": 72, "byteLength": 4},
                      {"buffer": 0, "byteOffset": 76, "byteLength": 48}])";
    parts.buffer = R"("uri": "mesh.bin", "byteLength": 124)";
    const std::string buffer = kBuffer + std::string("\xff\0\0\0\xff\0\0\0\xff\0\0\0", 12) +
                               std::string("\1\2\3\4", 4) +
                               bytes_of_values<float>({1, 0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0});
    const TemporaryFolder folder;
    folder.write("mesh.bin", buffer);
    MeshSources sources;
    sources.mesh = folder.write("a.gltf", text_of(parts)).string();
    sources.fields = parse_fields("color");
    sources.fields.normals = true;
    const MeshFile mesh = read_mesh(sources);
    SampleRow row;
    row.face = 1; // Of corners 0, 3 and 2, as it is turned over.
    row.bary[1] = row.bary[2] = 0.5F;
    // Half of the light of blue, as sRGB encodes it.
    const std::vector<double> colour = sample_fields(mesh, std::vector{row})[0].values;
    REQUIRE(colour.size() == 4);
    CHECK(colour[0] == 0);
    CHECK(colour[2] == doctest::Approx(0.735357));
    CHECK(colour[3] == 1);
    const Vec3 normal = file_normal(mesh, row);
    CHECK(normal.x < 0);
    CHECK(normal.y == 0);
    sources.fields = parse_fields("_LABEL");
    check_fails(ExitCode::bad_input, "triangle 2: vertex 0 has no value of '_LABEL'",
                [&] { read_mesh(sources); });
    sources.fields = parse_fields("all");
    CHECK(read_mesh(sources).fields.size() == 1);
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

TEST_CASE("glTF faces know their node, mesh and primitive") {
    Parts parts;
    parts.nodes = R"("nodes": [{}, {"mesh": 0}, {"mesh": 0, "translation": [3, 0, 0]}],)";
    parts.primitives = R"([{"attributes": {"POSITION": 0}, "mode": 0},
                           {"attributes": {"POSITION": 0}, "indices": 1},
                           {"attributes": {"POSITION": 0}, "mode": 6}])";
    const MeshFile mesh = mesh_of(parts);
    REQUIRE(mesh.parts.size() == 4);
    CHECK(mesh.part_of_triangle == Corners{0, 0, 1, 1, 2, 2, 3, 3});
    std::vector<SampleRow> rows(2);
    rows[0].face = 2;
    rows[1].face = 4;
    const auto columns = part_columns(mesh, {"node", "mesh", "primitive"}, rows);
    REQUIRE(columns.size() == 3);
    CHECK(columns[0].values == Corners{1, 2});
    CHECK(columns[1].values == Corners{0, 0});
    CHECK(columns[2].values == Corners{2, 1});
    parts.nodes = "";
    const MeshFile bare = mesh_of(parts);
    check_parts("a.gltf", bare, {"mesh", "primitive"});
    check_fails(ExitCode::bad_input, "a.gltf: does not have the node of a face",
                [&] { check_parts("a.gltf", bare, {"node"}); });
}

TEST_CASE("glTF faces know their material, and nodes those above them") {
    Parts parts;
    parts.nodes = R"("nodes": [{"name": "car", "children": [1]}, {"mesh": 0}], "materials":
                       [{}, {"name": "paint"}],)";
    parts.primitives = R"([{"attributes": {"POSITION": 0}, "indices": 1, "material": 1},
                           {"attributes": {"POSITION": 0}, "indices": 1, "material": "x"}])";
    const MeshFile mesh = mesh_of(parts);
    REQUIRE(mesh.parts.size() == 2);
    CHECK(mesh.parts[0].material == 1);
    CHECK_FALSE(mesh.parts[1].material.has_value());
    CHECK(mesh.part_names.materials == std::vector<std::string>{"", "paint"});
    CHECK(mesh.part_names.nodes == std::vector<std::string>{"car", ""});
    CHECK(mesh.part_names.node_above[1] == 0);
    CHECK_FALSE(mesh.part_names.node_above[0].has_value());
    CHECK(part_column_of_triangles(mesh, "material").front() == 1);
    CHECK(part_column_of_triangles(mesh, "material").back() == 0xffffffff);
}

TEST_CASE("names of columns are checked") {
    CHECK(parse_part_columns("").empty());
    CHECK(parse_part_columns("primitive,mesh") == std::vector<std::string>{"primitive", "mesh"});
    for (const std::string text : {"meshes", "mesh,", ",mesh", "mesh,mesh"}) {
        check_fails(ExitCode::usage, "--columns: ", [&] { parse_part_columns(text); });
    }
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

namespace {

void check_positions(const MeshFile& mesh, const std::vector<double>& expected) {
    REQUIRE(mesh.positions.size() == expected.size());
    for (std::size_t i = 0; i < expected.size(); ++i) {
        CAPTURE(i);
        CHECK(mesh.positions[i] == doctest::Approx(expected[i]));
    }
}

} // namespace

TEST_CASE("glTF joints place skinned vertices, whatever the node of the mesh") {
    // Two joints, of which the second is 10 to the right and twice as large, and the inverse of the
    // first moves down by one. Corners belong to the first, the second, both alike, and none.
    for (const bool has_inverses : {true, false}) {
        LongerSquare square;
        square.add(bytes_of_values<std::uint8_t>({0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 9, 0}),
                   5121, 4, "VEC4");
        square.add(bytes_of_values<float>({1, 0, 0, 0, 0, 2, 0, 0, 3, 3, 0, 0, 0, 0, 0, 0}), 5126,
                   4, "VEC4");
        square.add(bytes_of_values<float>({1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, -1, 1, //
                                           1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0,  1}),
                   5126, 2, "MAT4");
        square.parts.primitives =
            R"([{"attributes": {"POSITION": 0, "JOINTS_0": 2, "WEIGHTS_0": 3}, "indices": 1}])";
        square.parts.nodes =
            R"("scene": 0, "scenes": [{"nodes": [0]}], "nodes": [
               {"mesh": 0, "skin": 0, "translation": [500, 0, 0], "scale": [7, 7, 7]},
               {"children": [2]}, {"translation": [10, 0, 0], "scale": [2, 2, 2]}],
               "skins": [{"joints": [1, 2])" +
            std::string(has_inverses ? R"(, "inverseBindMatrices": 4)" : "") + "}],";
        const double down = has_inverses ? -1 : 0;
        check_positions(square.mesh(), {0, 0, down, 12, 0, 0, (1 + 12) / 2.0, (1 + 2) / 2.0,
                                        down / 2, 0, 1, down});
    }
}

TEST_CASE("glTF skins that do not fit are refused") {
    LongerSquare square;
    square.add(std::string(16, '\5'), 5121, 4, "VEC4");
    square.add(bytes_of_values<float>(std::vector<float>(16, 0.25f)), 5126, 4, "VEC4");
    square.parts.primitives =
        R"([{"attributes": {"POSITION": 0, "JOINTS_0": 2, "WEIGHTS_0": 3}, "indices": 1}])";
    const std::string nodes = R"("nodes": [{"mesh": 0, "skin": 0}, {}],)";
    square.parts.nodes = nodes + R"("skins": [{"joints": [0, 1]}],)";
    check_fails(ExitCode::bad_input, "vertex 0 has a joint that its skin has not",
                [&] { square.mesh(); });
    square.parts.nodes = nodes + R"("skins": [{"joints": [0, 7]}],)";
    check_fails(ExitCode::bad_input, "node 7 is out of range", [&] { square.mesh(); });
    square.parts.nodes = nodes + R"("skins": [{"joints": [0], "inverseBindMatrices": 0}],)";
    check_fails(ExitCode::bad_input, "accessor 0 is not of type MAT4", [&] { square.mesh(); });
    square.parts.nodes = nodes;
    check_fails(ExitCode::bad_input, "skin 0 is out of range", [&] { square.mesh(); });
    square.parts.nodes =
        R"("scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0, "skin": 0}, {"children": [2]},
           {"children": [1]}], "skins": [{"joints": [1, 2]}],)";
    check_fails(ExitCode::bad_input, "nodes must make a tree", [&] { square.mesh(); });
}

TEST_CASE("glTF instances stand where their node has them") {
    LongerSquare square;
    square.add(bytes_of_values<float>({0, 0, 0, 0, 0, 4}), 5126, 2, "VEC3");
    square.add(bytes_of_values<float>({1, 1, 1, 3, 3, 3}), 5126, 2, "VEC3");
    square.parts.nodes = R"("nodes": [{"mesh": 0, "translation": [100, 0, 0], "extensions":
        {"EXT_mesh_gpu_instancing": {"attributes": {"TRANSLATION": 2, "SCALE": 3}}}}],)";
    square.parts.more = R"(, "extensionsRequired": ["EXT_mesh_gpu_instancing"])";
    const MeshFile mesh = square.mesh();
    CHECK(mesh.triangle_count() == 4);
    CHECK(mesh.warnings.empty());
    check_positions(mesh, {100, 0, 0, 101, 0, 0, 101, 1, 0, 100, 1, 0, //
                           100, 0, 4, 103, 0, 4, 103, 3, 4, 100, 3, 4});
    square.parts.nodes = R"("nodes": [{"mesh": 0, "extensions":
        {"EXT_mesh_gpu_instancing": {"attributes": {"TRANSLATION": 0, "SCALE": 3}}}}],)";
    check_fails(ExitCode::bad_input, "node 0: its instances have attributes of other counts",
                [&] { square.mesh(); });
}

TEST_CASE("glTF morph targets move vertices by their default weights") {
    LongerSquare square;
    square.add(bytes_of_values<float>({0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 2}), 5126, 4, "VEC3");
    square.parts.primitives =
        R"([{"attributes": {"POSITION": 0}, "indices": 1, "targets": [{"POSITION": 2}, {}]}],
           "weights": [0.5, 1])";
    check_positions(square.mesh(), {0, 0, .5, 1, 0, .5, 1, 1, .5, 0, 1, 1});
    square.parts.nodes = R"("nodes": [{"mesh": 0, "weights": [2, 0]}],)";
    check_positions(square.mesh(), {0, 0, 2, 1, 0, 2, 1, 1, 2, 0, 1, 4});
    square.parts.nodes = R"("nodes": [{"mesh": 0, "weights": [0, 0]}],)";
    check_positions(square.mesh(), kSquare);
}

TEST_CASE("glTF files are not refused for what sampling does not need") {
    const std::string odd = R"({"type": 7, "uri": 3, "bufferView": -1, "source": "x", "pbr": []})";
    for (const std::string list :
         {"cameras", "images", "materials", "textures", "samplers", "animations", "skins"}) {
        CAPTURE(list);
        Parts parts;
        parts.more = ", \"" + list + "\": [" + odd + "]";
        CHECK(mesh_of(parts).warnings.empty());
        parts.more = ", \"" + list + "\": 5";
        CHECK(mesh_of(parts).triangle_count() == 2);
    }
    Parts parts;
    parts.more = R"(, "extras": {"a": NaN, "b": [-Infinity, Infinity], "c": ")"
                 "\xe9\xff"
                 R"("}, "extensions": {"KHR_lights_punctual": {"lights": [{}]}},
                 "extensionsUsed": ["FOO_anything"])";
    CHECK(mesh_of(parts).warnings.empty());
    parts = {};
    parts.buffer =
        R"("uri": "mesh.bin", "byteLength": 60}, {"uri": "../none.bin", "byteLength": 8)";
    CHECK(mesh_of(parts).triangle_count() == 2); // Nothing reads that buffer.
    parts = {};
    parts.primitives = R"([{"attributes": {"POSITION": 0, "NORMAL": 99}, "indices": 1,
                            "material": 99, "mode": 4.0}])";
    CHECK(mesh_of(parts).triangle_count() == 2);
}

TEST_CASE("extensions that a glTF file requires are read, ignored or refused by name") {
    Parts parts;
    for (const std::string name :
         {"KHR_techniques_webgl", "KHR_materials_unlit", "KHR_texture_basisu", "EXT_texture_webp",
          "KHR_lights_punctual", "KHR_materials_pbrSpecularGlossiness", "MSFT_texture_dds",
          "KHR_animation_pointer", "ADOBE_materials_clearcoat_specular", "KHR_xmp_json_ld"}) {
        CAPTURE(name);
        parts.more = ", \"extensionsRequired\": [\"" + name + "\"]";
        const MeshFile mesh = mesh_of(parts);
        REQUIRE(mesh.warnings.size() == 1);
        CHECK(mesh.warnings[0].message ==
              "extension '" + name + "' is required and ignored: it does not change the surface");
    }
    for (const std::string name : {"KHR_mesh_quantization", "KHR_draco_mesh_compression",
                                   "EXT_meshopt_compression", "EXT_mesh_gpu_instancing"}) {
        parts.more = ", \"extensionsRequired\": [\"" + name + "\"]";
        CHECK(mesh_of(parts).warnings.empty());
    }
    parts.more = R"(, "extensionsRequired": ["FOO_bent_space"])";
    check_refused(parts, "requires the extension 'FOO_bent_space', which is not read");
}

TEST_CASE("glTF scenes, hidden nodes and names of files") {
    Parts parts;
    parts.nodes = R"("scene": 1, "scenes": [{"nodes": [0]}, {"nodes": [1, 2]}], "nodes": [
        {"mesh": 0}, {"mesh": 0, "translation": [5, 0, 0]},
        {"extensions": {"KHR_node_visibility": {"visible": false}}, "children": [3]},
        {"mesh": 0}],)";
    const MeshFile mesh = mesh_of(parts);
    CHECK(mesh.positions[0] == 5);
    CHECK(mesh.triangle_count() == 2);
    REQUIRE(mesh.warnings.size() == 1);
    CHECK(mesh.warnings[0].kind == "hidden_nodes");

    const TemporaryFolder folder;
    folder.write("a %20 b.bin", kBuffer);
    parts = {};
    for (const std::string uri : {"a%20%2520%20b.bin", "a %20 b.bin", "./a %20 b.bin"}) {
        CAPTURE(uri);
        parts.buffer = "\"uri\": \"" + uri + "\", \"byteLength\": 60";
        CHECK(read_mesh(folder.write("a.gltf", text_of(parts)).string()).triangle_count() == 2);
    }
}
