// Points and lines of glTF, as files to avoid have them.
#include "files/meshes/line_file.hpp"

#include "gltf_parts.hpp"
#include "test_files.hpp"

#include <array>
#include <string>
#include <vector>

using namespace geodisk::tools;

namespace {

using Places = std::vector<std::array<double, 3>>;
using Ends = std::vector<std::array<std::uint32_t, 2>>;

SampleFile lines_of_parts(const Parts& parts, const std::string& buffer = kBuffer) {
    const TemporaryFolder folder;
    folder.write("mesh.bin", buffer);
    return read_points_and_lines(folder.write("a.gltf", text_of(parts)));
}

Places places_of(const SampleFile& file) {
    Places places;
    for (const SampleRow& row : file.rows) {
        places.push_back({row.position[0], row.position[1], row.position[2]});
    }
    return places;
}

/// The square with one primitive of a mode, with its indices or without.
Parts of_mode(int mode, bool has_indices) {
    Parts parts;
    parts.primitives = R"([{"attributes": {"POSITION": 0}, "mode": )" + std::to_string(mode) +
                       (has_indices ? R"(, "indices": 1}])" : "}]");
    return parts;
}

void check_no_lines(const Parts& parts, std::string_view part) {
    check_fails(ExitCode::bad_input, part, [&] { lines_of_parts(parts); });
}

} // namespace

TEST_CASE("glTF lines, loops and strips are lines, and points are points") {
    const Places square{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
    const std::vector<Ends> plain{
        {}, {{0, 1}, {2, 3}}, {{0, 1}, {1, 2}, {2, 3}, {3, 0}}, {{0, 1}, {1, 2}, {2, 3}}};
    // The indices are 0 1 2 0 2 3.
    const std::vector<Ends> indexed{{},
                                    {{0, 1}, {2, 0}, {2, 3}},
                                    {{0, 1}, {1, 2}, {2, 0}, {0, 2}, {2, 3}, {3, 0}},
                                    {{0, 1}, {1, 2}, {2, 0}, {0, 2}, {2, 3}}};
    for (int mode = 0; mode <= 3; ++mode) {
        CAPTURE(mode);
        for (const bool has_indices : {false, true}) {
            const SampleFile file = lines_of_parts(of_mode(mode, has_indices));
            CHECK_FALSE(file.has_faces);
            CHECK(file.warnings.empty());
            CHECK(places_of(file) == square);
            CHECK(file.segments == (has_indices ? indexed : plain)[static_cast<std::size_t>(mode)]);
        }
    }
    const TemporaryFolder folder;
    const SampleFile binary =
        read_points_and_lines(folder.write("a.GLB", binary_of(of_mode(2, false))));
    CHECK(binary.segments == plain[2]);
}

TEST_CASE("glTF lines go where nodes and instances place them") {
    Parts parts = of_mode(1, false);
    parts.nodes = R"("scene": 0, "scenes": [{"nodes": [0]}],
        "nodes": [{"translation": [0, 0, 5], "children": [1]},
                  {"mesh": 0, "scale": [2, 1, 1],
                   "extensions": {"EXT_mesh_gpu_instancing": {"attributes": {"TRANSLATION": 2}}}}],)";
    parts.accessors =
        R"([{"bufferView": 0, "componentType": 5126, "count": 2, "type": "VEC3"},
            {"bufferView": 1, "componentType": 5123, "count": 6, "type": "SCALAR"},
            {"bufferView": 0, "byteOffset": 24, "componentType": 5126, "count": 2, "type": "VEC3"}])";
    const SampleFile file = lines_of_parts(parts);
    CHECK(places_of(file) == Places{{2, 1, 5}, {4, 1, 5}, {0, 1, 5}, {2, 1, 5}});
    CHECK(file.segments == Ends{{0, 1}, {2, 3}});
}

TEST_CASE("glTF vertices that no line uses are no points to avoid") {
    Parts parts;
    parts.primitives = R"([{"attributes": {"POSITION": 0}, "mode": 3, "indices": 1}])";
    parts.accessors = R"([{"bufferView": 0, "componentType": 5126, "count": 4, "type": "VEC3"},
        {"bufferView": 1, "byteOffset": 8, "componentType": 5123, "count": 2, "type": "SCALAR"}])";
    const SampleFile file = lines_of_parts(parts);
    CHECK(places_of(file) == Places{{1, 1, 0}, {0, 1, 0}});
    CHECK(file.segments == Ends{{0, 1}});
}

TEST_CASE("glTF without lines alone is refused or warned of") {
    check_no_lines({}, "mesh 0: has triangles, but only points and lines can be avoided");
    Parts odd = of_mode(1, true);
    odd.accessors = R"([{"bufferView": 0, "componentType": 5126, "count": 4, "type": "VEC3"},
                        {"bufferView": 1, "componentType": 5123, "count": 3, "type": "SCALAR"}])";
    check_no_lines(odd, "mesh 0, primitive 0: 3 indices are not those of lines");
    odd.accessors = R"([{"bufferView": 0, "componentType": 5126, "count": 2, "type": "VEC3"},
                        {"bufferView": 1, "componentType": 5123, "count": 6, "type": "SCALAR"}])";
    check_no_lines(odd, "vertex index 2 is out of range, it has 2 vertices");
    Parts unknown = of_mode(1, false);
    unknown.more = R"(, "extensionsRequired": ["EXT_bent"])";
    check_no_lines(unknown, "requires the extension 'EXT_bent'");
    Parts far = of_mode(1, false);
    far.buffer = R"("uri": "../mesh.bin", "byteLength": 60)";
    check_no_lines(far, "add --allow-outside");
    Parts hidden = of_mode(1, false);
    hidden.nodes = R"("nodes": [{"mesh": 0, "extensions": {"KHR_node_visibility":
                                                           {"visible": false}}}],)";
    const SampleFile none = lines_of_parts(hidden);
    CHECK(none.rows.empty());
    REQUIRE(none.warnings.size() == 1);
    CHECK(none.warnings[0].kind == "hidden_nodes");
    const TemporaryFolder folder;
    const auto path = folder.write("a.gltf", text_of(of_mode(1, false)));
    check_fails(ExitCode::bad_input, "has no columns, so none of the name width",
                [&] { read_points_and_lines(path, "width"); });
}
