// Attributes of mesh files, from the readers to samples.
#include "files/images/textures.hpp"
#include "files/meshes/data_uri.hpp"
#include "files/meshes/mesh_fields.hpp"
#include "files/meshes/mesh_file.hpp"
#include "files/output/output_file.hpp"
#include "files/samples/sample_fields.hpp"
#include "geometry/frames.hpp"

#include "gltf_parts.hpp"
#include "png_bytes.hpp"
#include "test_files.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

using namespace geodisk::tools;

namespace {

/// A square of four corners with colours, texture coordinates and normals.
const std::string kObj = "v 0 0 0 1 0 0\nv 1 0 0 0 1 0\nv 1 1 0 0 0 1\nv 0 1 0 1 1 1\n"
                         "vt 0 0\nvt 2 0\nvt 2 2\nvt 0 2\nvn 0 0 2\nvn 0.6 0 0.8\n"
                         "f 1/1/1 2/2/2 3/3/2 4/4/1\n";

std::string ply_of(const std::string& properties, const std::vector<std::string>& values,
                   const std::string& face_properties = "", const std::string& face_values = "") {
    const char* const corners[] = {"0 0 0", "1 0 0", "0 1 0"};
    std::string text = "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\n"
                       "property float y\nproperty float z\n" +
                       properties + "element face 1\nproperty list uchar int vertex_indices\n" +
                       face_properties + "end_header\n";
    for (std::size_t i = 0; i < 3; ++i) {
        text += std::string(corners[i]) + ' ' + values[i] + '\n';
    }
    return text + "3 0 1 2 " + face_values + '\n';
}

MeshFile mesh_with(const std::string& name, const std::string& bytes, const std::string& wanted,
                   bool normals = false) {
    const TemporaryFolder folder;
    MeshSources sources;
    sources.mesh = folder.write(name, bytes).string();
    sources.fields = parse_fields(wanted);
    sources.fields.normals = normals;
    return read_mesh(sources);
}

void check_refused(const std::string& name, const std::string& bytes, const std::string& wanted,
                   std::string_view part) {
    check_fails(ExitCode::bad_input, part, [&] { mesh_with(name, bytes, wanted); });
}

SampleRow row_at(std::uint32_t face, float u, float v, float w) {
    SampleRow row;
    row.face = face;
    row.bary[0] = u;
    row.bary[1] = v;
    row.bary[2] = w;
    return row;
}

/// Values of all attributes at a sample, in order.
std::vector<double> values_at(const MeshFile& mesh, const SampleRow& row) {
    std::vector<double> values;
    for (const SampleField& field : sample_fields(mesh, std::vector<SampleRow>{row})) {
        values.insert(values.end(), field.values.begin(), field.values.end());
    }
    return values;
}

using Values = std::vector<double>;

} // namespace

TEST_CASE("names of columns of colours and texture coordinates mean all of them") {
    const std::string properties = "property uchar red\nproperty uchar green\nproperty uchar blue\n"
                                   "property float heat\n";
    const std::string bytes = ply_of(properties, {"255 0 0 1", "0 255 0 2", "0 0 255 3"});
    const MeshFile mesh = mesh_with("m.ply", bytes, "heat,red,green,blue");
    REQUIRE(mesh.fields.size() == 2);
    CHECK(mesh.fields[0].name == "heat");
    CHECK(mesh.fields[1].components == std::vector<std::string>{"red", "green", "blue"});
    CHECK(mesh_with("m.obj", kObj, "u,v").fields.front().name == "uv");
    check_refused("m.ply", bytes, "green,u", "has no attribute 'u'");
    const MeshFile own = mesh_with("m.ply", ply_of("property float red\n", {"1", "2", "3"}),
                                   "red"); // No colour without green.
    CHECK(own.fields.front().name == "red");
}

TEST_CASE("attributes are all, or names without repetition") {
    CHECK(parse_fields("all").all);
    CHECK(parse_fields("uv,color").names == std::vector<std::string>{"uv", "color"});
    CHECK_FALSE(parse_fields("").are_given());
    for (const char* const text : {"uv,uv", "uv,,color", ",", "uv,all"}) {
        CAPTURE(text);
        check_fails(ExitCode::usage, "--attributes", [&] { parse_fields(text); });
    }
}

TEST_CASE("attributes of OBJ are interpolated in the triangles of polygons") {
    const MeshFile mesh = mesh_with("a.obj", kObj, "uv,color", true);
    REQUIRE(mesh.fields.size() == 2); // In the order of the names.
    CHECK(mesh.fields[0].name == "uv");
    CHECK(mesh.fields[1].components == std::vector<std::string>{"red", "green", "blue"});
    CHECK(values_at(mesh, row_at(0, 0.5F, 0.25F, 0.25F)) == Values{1, 0.5, 0.5, 0.25, 0.25});
    CHECK(values_at(mesh, row_at(1, 0, 0, 1)) == Values{0, 2, 1, 1, 1});
    const Vec3 normal = file_normal(mesh, row_at(0, 0, 1, 0));
    CHECK(normal.x == doctest::Approx(0.6));
    CHECK(normal.z == doctest::Approx(0.8));
    CHECK(mesh_with("a.obj", kObj, "").fields.empty());
    const MeshFile bytes =
        mesh_with("a.obj", "v 0 0 0 255 0 51\nv 1 0 0 0 0 0\nv 0 1 0 0 0 0\nf 1 2 3\n", "all");
    CHECK(values_at(bytes, row_at(0, 1, 0, 0)) == Values{1, 0, 0.2});
}

TEST_CASE("attributes of PLY are scalars, colours, texture coordinates and labels") {
    const std::string ply =
        ply_of("property uchar red\nproperty uchar green\nproperty uchar blue\nproperty float s\n"
               "property float t\nproperty double heat\nproperty int label\nproperty float nx\n"
               "property float ny\nproperty float nz\n",
               {"255 0 0 0 0 1.5 -7 0 0 1", "0 255 0 1 0 2.5 8 0 0 1", "0 0 255 0 1 4 9 0 0 1"},
               "property int label\nproperty uchar red\n", "5 6");
    const MeshFile mesh = mesh_with("a.ply", ply, "all");
    std::vector<std::string> names;
    for (const MeshField& field : mesh.fields) {
        names.push_back(field.name);
    }
    CHECK(names ==
          std::vector<std::string>{"color", "uv", "heat", "label", "face_label", "face_red"});
    CHECK(values_at(mesh, row_at(0, 0.25F, 0.5F, 0.25F)) ==
          Values{0.25, 0.5, 0.25, 0.5, 0.25, 2.625, 8, 5, 6});
    CHECK(sample_fields(mesh, std::vector<SampleRow>{row_at(0, 1, 0, 0)})[3].is_whole);
    CHECK(values_at(mesh_with("a.ply", ply, "label"), row_at(0, 0.4F, 0.3F, 0.3F)) == Values{-7});
    const std::string wedges =
        ply_of("", {"", "", ""}, "property list uchar float texcoord\n", "6 0 0 4 0 0 4");
    CHECK(values_at(mesh_with("a.ply", wedges, "uv"), row_at(0, 0, 0.5F, 0.5F)) == Values{2, 2});
    check_refused("a.ply",
                  ply_of("", {"", "", ""}, "property list uchar float texcoord\n", "2 0 0"), "uv",
                  "texcoord has 2 numbers for 3 corners");
}

TEST_CASE("attributes of OFF follow the coordinates") {
    const std::string off = "STCNOFF\n3 1 0\n0 0 0 0 0 1 255 0 0 255 0.5 0\n"
                            "1 0 0 0 0 1 0 255 0 255 1 0\n0 1 0 0 0 1 0 0 255 255 0 1\n3 0 1 2\n";
    const MeshFile mesh = mesh_with("a.off", off, "color,uv", true);
    CHECK(values_at(mesh, row_at(0, 1, 0, 0)) == Values{1, 0, 0, 1, 0.5, 0});
    CHECK(file_normal(mesh, row_at(0, 1, 0, 0)).z == 1);
    check_refused("a.off", "COFF\n3 1 0\n0 0 0 1\n1 0 0 1\n0 1 0 1\n3 0 1 2\n", "color",
                  "a colour of 3 or of 4 numbers");
}

TEST_CASE("attributes that cannot be used are refused by name and place") {
    const std::string heat = "property float heat\n";
    const std::string ply = ply_of(heat, {"1", "nan", "2"});
    check_refused("a.ply", ply, "heat", "record 1: 'heat' is not finite");
    check_refused("a.ply", ply, "heaat",
                  "has no attribute 'heaat'; it has heat; did you mean heat");
    check_refused("a.stl",
                  "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\n"
                  "vertex 0 1 0\nendloop\nendfacet\nendsolid a\n",
                  "color", "has no attribute 'color', or any other");
    for (const char* const name : {"radius", "Class", "bary_u", "mesh", "qx", "points", "existing",
                                   "cover", "row", "normal", "normal_x", "st", "displayColor"}) {
        CAPTURE(name);
        const std::string taken =
            ply_of(heat + "property float " + name + "\n", {"1 1", "2 2", "3 3"});
        check_refused("a.ply", taken, name, "has the name of a column of samples");
        const MeshFile others = mesh_with("a.ply", taken, "all");
        REQUIRE(others.fields.size() == 1);
        CHECK(others.fields[0].name == "heat");
        CHECK(others.warnings.back().kind == "attribute_name");
        CHECK(others.warnings.back().message ==
              "the attribute '" + std::string(name) +
                  "' has the name of a column of samples, so '" + name +
                  "' is left out; rename it in the file to have it");
    }
    // Composed letters, their parts, and Latin-1 are one name.
    const std::string composed = "t\xc3\xb6", parts = "to\xcc\x88", latin = "t\xf6";
    for (const std::string& in_file : {composed, parts, latin}) {
        const std::string named = ply_of("property float " + in_file + "\n", {"1", "2", "3"});
        for (const std::string& wanted : {composed, parts, latin}) {
            CHECK(mesh_with("a.ply", named, wanted).fields.size() == 1);
        }
    }
    for (const char* const names : {"heat HEAT", "my-heat my.heat", "heat _heat"}) {
        CAPTURE(names);
        const std::string text = names;
        const std::string first = text.substr(0, text.find(' ')),
                          second = text.substr(text.find(' ') + 1);
        const std::string twice = ply_of(
            "property float " + first + "\nproperty float " + second + "\n", {"1 2", "1 2", "1 2"});
        check_refused("a.ply", twice, first + "," + second, "two attributes would have the column");
        const MeshFile one = mesh_with("a.ply", twice, "all");
        CHECK(values_at(one, row_at(0, 1, 0, 0)) == Values{1});
        CHECK(one.warnings.back().kind == "attribute_name");
    }
    const std::string part = "v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nf 1/1 2/1 3\n";
    check_refused("a.obj", part, "uv", "line 5: vertex 3 has no value of 'uv'");
    const MeshFile left_out = mesh_with("a.obj", part, "all");
    CHECK(left_out.fields.empty());
    CHECK(left_out.warnings.back().kind == "partial_attribute");
    check_fails(ExitCode::bad_input, "has no normals, as --normals file requests",
                [&] { mesh_with("a.obj", part, "", true); });
    check_refused("a.obj",
                  "v 0 0 0\nv 1 0 0\nv 1 1 0\nvt 0 0\nvt 1 1\nv 2 1 0\n"
                  "f 1/1 2/1 3/1 1/2 4/1\n",
                  "uv", "vertex 1 has two values of 'uv' in it");
}

TEST_CASE("with all, attributes that cannot be read are left out") {
    const auto left_out = [](const std::string& file, const std::string& bytes,
                             std::string_view name, std::string_view part) {
        CAPTURE(bytes);
        check_refused(file, bytes, std::string(name), part);
        const MeshFile mesh = mesh_with(file, bytes, "all");
        CHECK(std::ranges::find(mesh.fields, name, &MeshField::name) == mesh.fields.end());
        CHECK(contains(mesh.warnings.back().message, part));
        CHECK(
            contains(mesh.warnings.back().message, ", so '" + std::string(name) + "' is left out"));
    };
    const std::string start = "v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 1 0\n";
    left_out("a.obj", start + "f 1/1 2/7 3/1\n", "uv", "line 6: texture index 7 is out of range");
    left_out("a.obj", start + "f 1/-9 2/1 3/1\n", "uv", "texture index -9 is out of range");
    left_out("a.obj", start + "vt nan 0\nf 1/1 2/1 3/1\n", "uv", "'nan' is not a finite number");
    left_out("a.obj", start + "vt 1\nf 1/1 2/1 3/1\n", "uv", "texture coordinates are two numbers");
    left_out("a.obj", start + "v 1 1 0\nf 1/1 2/1 4/1 3/1 1/2\n", "uv", "two values of 'uv'");
    left_out("a.obj", "v 0 0 0 1 0 nan\nv 1 0 0 1 0 0\nv 0 1 0 1 0 0\nf 1 2 3\n", "color",
             "line 4: 'color' is not finite");
    left_out("a.ply", ply_of("property float heat\n", {"1", "nan", "2"}), "heat",
             "record 1: 'heat' is not finite");
    left_out("a.ply",
             "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
             "property float z\nelement face 1\nproperty list uchar int vertex_indices\n"
             "property list uchar float texcoord\nend_header\n0 0 0\n1 0 0\n0 1 0\n"
             "3 0 1 2 4 0 0 1 1\n",
             "uv", "texcoord has 4 numbers for 3 corners");
    LongerSquare square;
    square.parts.primitives = R"([{"attributes": {"POSITION": 0, "COLOR_0": )" +
                              std::to_string(square.add(std::string(36, '\0'), 5126, 3, "VEC3")) +
                              R"(}, "indices": 1}])";
    square.parts.buffer = "\"uri\": \"" + data_uri(square.buffer) + R"(", "byteLength": )" +
                          std::to_string(square.buffer.size());
    left_out("a.gltf", text_of(square.parts), "color",
             "has COLOR_0 for another number of vertices");
}

TEST_CASE("texture colours are those at the texture coordinates") {
    const TemporaryFolder folder;
    const std::filesystem::path png =
        folder.write("a.png", png_bytes(2, 1, std::string_view("\xff\0\0\0\0\xff", 6), 8, 2));
    MeshSources sources;
    sources.mesh = folder
                       .write("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0.25 0\nvt 0.75 0\n"
                                       "vt 0.25 1\nf 1/1 2/2 3/3\n")
                       .string();
    sources.fields.uvs = true;
    const MeshFile mesh = read_mesh(sources);
    CHECK(mesh.fields.empty());
    const std::vector<SampleRow> rows{row_at(0, 1, 0, 0), row_at(0, 0, 1, 0),
                                      row_at(0, 0.5F, 0.5F, 0)};
    const SampleField colours = texture_colours(mesh, Textures(mesh, png), rows);
    CHECK(colours.name == "color");
    CHECK(colours.values == Values{1, 0, 0, 0, 0, 1, 0.5, 0, 0.5});
    sources.mesh = folder.write("b.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n").string();
    check_fails(ExitCode::bad_input, "has no texture coordinates, which an image needs",
                [&] { read_mesh(sources); });
}

TEST_CASE("attributes become columns behind all others") {
    const TemporaryFolder folder;
    std::vector<SampleRow> rows{row_at(0, 1, 0, 0), row_at(0, 0, 1, 0)};
    const std::vector<SampleField> fields{
        {"color", {"red", "green", "blue"}, false, true, {1, 0.5, 0, 0, 0, 2}},
        {"label", {"label"}, true, false, {-1, 70000}},
        {"heat", {"heat"}, false, false, {0.5, 1e300}}};
    for (const auto& [file_name, part] :
         {std::pair{"a.csv",
                    "bary_w,red,green,blue,label,heat\n0,0,0,0,0,0,0,1,0,0,1,0.5,0,-1,0.5\n"},
          {"a.ply", "property uchar red\nproperty uchar green\nproperty uchar blue\n"
                    "property int label\nproperty double heat\n"},
          {"a.pcd", " rgb label heat\nSIZE"},
          {"a.npz", "label.npy"}}) {
        const std::string name = file_name;
        CAPTURE(name);
        AtomicFile file(folder / name);
        write_samples(file, sample_target(folder / name, {}, true), {}, rows, 3, {{}, fields});
        file.commit();
        CHECK(contains(bytes_of(folder / name), part));
    }
    CHECK(contains(bytes_of(folder / "a.ply"), "1 0 0 255 128 0 -1 0.5\n"));
    CHECK(contains(bytes_of(folder / "a.ply"), "0 1 0 0 0 255 70000 1e+300\n"));
    CHECK(contains(bytes_of(folder / "a.pcd"), "\nTYPE F F F F F F U F F F U I F\n"));
    CHECK(contains(bytes_of(folder / "a.pcd"), " 0 1 0 255 70000 1e+300\n")); // 0x0000ff.
    CHECK(contains(bytes_of(folder / "a.pcd"), " 1 0 0 16744448 -1 0.5\n"));  // 0xff8000.
    CHECK(read_samples(folder / "a.csv").rows.size() == 2);
}

TEST_CASE("colours have one unit, whatever the types of PLY") {
    const auto values_of = [](const std::string& type, const std::string& colours) {
        const std::string properties =
            "property T red\nproperty T green\nproperty T blue\nproperty T alpha\n";
        std::string head;
        for (const char c : properties) {
            head += c == 'T' ? type : std::string(1, c);
        }
        return mesh_with("m.ply", ply_of(head, {colours, colours, colours}), "color")
            .fields.front()
            .values;
    };
    const Values half{1, 0.2, 0, 0.4};
    for (const auto& colour : {std::pair{"uchar", "255 51 0 102"},
                               {"int", "255 51 0 102"},
                               {"ushort", "65535 13107 0 26214"},
                               {"double", "255 51 0 102"},
                               {"double", "1 0.2 0 0.4"}}) {
        CAPTURE(colour.first);
        Values expected;
        for (int i = 0; i < 3; ++i) {
            expected.insert(expected.end(), half.begin(), half.end());
        }
        CHECK(values_of(colour.first, colour.second) == expected);
    }
}

TEST_CASE("binary PCD has the bits of a colour in a float, as the Point Cloud Library") {
    const TemporaryFolder folder;
    const std::vector<SampleField> opaque{
        {"color", {"red", "green", "blue"}, false, true, {1, 0.5, 0}}};
    const std::vector<SampleField> clear{
        {"color", {"red", "green", "blue", "alpha"}, false, true, {1, 0.5, 0, 0.2}},
        {"face_color", {"face_red", "face_green", "face_blue"}, false, true, {0, 1, 0}}};
    const auto bytes_with = [&](const std::vector<SampleField>& fields) {
        AtomicFile file(folder / "a.pcd");
        write_samples(file, sample_target(folder / "a.pcd"), {}, std::vector{row_at(0, 1, 0, 0)}, 3,
                      {{}, fields});
        file.commit();
        return bytes_of(folder / "a.pcd");
    };
    const std::string packed = bytes_with(opaque);
    CHECK(contains(packed, " bary_w rgb\n"));
    CHECK(contains(packed, " F F F F\nCOUNT"));
    CHECK(packed.ends_with(std::string_view("\0\x80\xff\0", 4)));
    const std::string with_alpha = bytes_with(clear);
    CHECK(contains(with_alpha, " bary_w rgba face_red face_green face_blue\n"));
    CHECK(contains(with_alpha, " F U U U U\nCOUNT"));
    CHECK(with_alpha.ends_with(std::string_view("\0\x80\xff\x33\0\xff\0", 7)));
}

namespace {

/// Returns `v` as a quaternion turns it: v + 2 w (q x v) + 2 q x (q x v).
Vec3 turned(const std::array<double, 4>& frame, const Vec3& v) {
    const Vec3 q{frame[0], frame[1], frame[2]};
    return v + 2 * frame[3] * cross(q, v) + 2.0 * cross(q, cross(q, v));
}

Vec3 vector_of(Up up) {
    return {up == Up::x ? 1.0 : 0, up == Up::y ? 1.0 : 0, up == Up::z ? 1.0 : 0};
}

constexpr Up kUps[] = {Up::x, Up::y, Up::z};

} // namespace

TEST_CASE("frames turn the axis of a model to the normal, or a part of the way") {
    for (const Vec3& normal : {Vec3{0, 0, 1}, Vec3{0, 0, -1}, Vec3{1, 0, 0}, Vec3{-1, 0, 0},
                               Vec3{0, -1, 0}, Vec3{0.6, 0, -0.8}, normalize(Vec3{1, 2, 3})}) {
        for (const Up model : kUps) {
            for (const Up world : kUps) {
                CAPTURE(normal.z);
                const Vec3 axis = vector_of(model), up = vector_of(world);
                const auto full = frame_of(normal, 2, {model, world, 1});
                CHECK(length(turned(full, axis) - normal) < 1e-12);
                CHECK(length(turned(frame_of(normal, 2, {model, world, 0}), axis) - up) < 1e-12);
                const Vec3 part = turned(frame_of(normal, 2, {model, world, 0.25}), axis);
                const double whole = std::acos(dot(up, normal));
                CHECK(std::acos(std::min(dot(up, part), 1.0)) ==
                      doctest::Approx(whole / 4).epsilon(1e-6));
                CHECK(std::acos(std::clamp(dot(part, normal), -1.0, 1.0)) ==
                      doctest::Approx(whole * 3 / 4).epsilon(1e-6));
                CHECK(full[3] >= 0);
                CHECK(full[0] * full[0] + full[1] * full[1] + full[2] * full[2] +
                          full[3] * full[3] ==
                      doctest::Approx(1));
            }
        }
    }
}

TEST_CASE("frames have an angle that other samples do not change") {
    const auto flat = frame_of({0, 0, 1}, 1);
    CHECK(flat[2] == doctest::Approx(std::sin(0.5)));
    const float weights[3] = {0.25F, 0.5F, 0.25F};
    CHECK(frame_angle(7, 3, weights) == frame_angle(7, 3, weights));
    CHECK(frame_angle(7, 3, weights) != frame_angle(8, 3, weights));
    CHECK(frame_angle(7, 3, weights) != frame_angle(7, 4, weights));
}

namespace {

/// Two samples with all kinds of attributes, one of them turned by half a turn about z.
void write_scene(const std::filesystem::path& path, bool has_frames) {
    SampleRow moved = row_at(4, 0, 1, 0);
    moved.position[0] = 2;
    moved.normal[2] = 1;
    std::vector<SampleField> fields{
        {"color", {"red", "green", "blue", "alpha"}, false, true, {1, 0.5, 0, 1, 0, 0, 1, 0.25}},
        {"uv", {"u", "v"}, false, false, {0, 1, 0.5, 0.5}},
        {"8-label", {"8-label"}, true, false, {-1, 7}}};
    if (has_frames) {
        fields.push_back(
            {"frames", {"qx", "qy", "qz", "qw"}, false, false, {0, 0, 1, 0, 0, 0, 0, 1}, true});
    }
    const std::vector<ExtraColumn> numbers{{"part", {4294967295u, 0}}};
    AtomicFile file(path);
    write_samples(file, sample_target(path), {{{"min_distance", "0.5"}, {"mesh", "a\"b.ply"}}},
                  std::vector{row_at(3, 1, 0, 0), moved}, 3, {numbers, fields});
    file.commit();
}

} // namespace

TEST_CASE("USD has an instance for each sample") {
    const TemporaryFolder folder;
    write_scene(folder / "a.usda", true);
    const std::string text = bytes_of(folder / "a.usda");
    for (const char* const part :
         {"#usda 1.0\n", "point3f[] positions = [(0, 0, 0), (2, 0, 0)]\n",
          "quath[] orientations = [(0, 0, 0, 1), (1, 0, 0, 0)]\n",
          "float3[] scales = [(0.25, 0.25, 0.25), (0.25, 0.25, 0.25)]\n",
          "int[] protoIndices = [0, 0]\n", "uint[] primvars:face_index = [3, 4] (",
          "color3f[] primvars:displayColor = [(1, 0.21404114, 0), (0, 0, 1)] (", // As light.
          "float[] primvars:displayOpacity = [1, 0.25] (",
          "texCoord2f[] primvars:st = [(0, 1), (0.5, 0.5)] (",
          "int[] primvars:_8_label = [-1, 7] (", "uint[] primvars:part = [4294967295, 0] (",
          R"(\"mesh\":\"a\\\"b.ply\")", "def Mesh \"Sample\""}) {
        CAPTURE(part);
        CHECK(contains(text, part));
    }
    write_scene(folder / "b.usda", false);
    CHECK(contains(bytes_of(folder / "b.usda"), "def Sphere \"Sample\""));
    CHECK_FALSE(contains(bytes_of(folder / "b.usda"), "orientations"));
    AtomicFile file(folder / "c.usda");
    write_samples(file, sample_target(folder / "c.usda"), {}, {}, 3);
    file.commit();
    CHECK(contains(bytes_of(folder / "c.usda"), "positions = []\n"));
    check_fails(ExitCode::usage, "a .usda file holds three coordinates",
                [] { check_dimension(sample_target("a.usda"), 4); });
}
