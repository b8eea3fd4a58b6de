// Colours of samples by the materials of glTF and OBJ files.
#include "files/images/textures.hpp"
#include "files/meshes/mesh_file.hpp"
#include "files/name_case.hpp"
#include "files/samples/sample_fields.hpp"

#include "gltf_parts.hpp"
#include "jpeg_bytes.hpp"
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

using Colour = std::array<double, 3>;

constexpr Colour kRed{1, 0, 0}, kGreen{0, 1, 0}, kBlue{0, 0, 1}, kWhiteColour{1, 1, 1};

/// Red and green above, blue and white below.
const std::string kColourImage =
    png_bytes(2, 2, std::string_view("\xff\0\0\0\xff\0\0\0\xff\xff\xff\xff", 12), 8, 2);

MeshFile read_with_materials(const std::filesystem::path& path) {
    MeshSources sources;
    sources.mesh = path.string();
    sources.fields.materials = true;
    return read_mesh(sources);
}

/// Colours at the three corners of a triangle.
std::vector<Colour> corner_colours(const MeshFile& mesh, std::uint32_t triangle) {
    std::vector<SampleRow> rows(3);
    for (std::size_t k = 0; k < 3; ++k) {
        rows[k].face = triangle;
        rows[k].bary[k] = 1;
    }
    const SampleField field = texture_colours(mesh, Textures(mesh), rows);
    std::vector<Colour> colours(3);
    for (std::size_t i = 0; i < 9; ++i) {
        colours[i / 3][i % 3] = field.values[i];
    }
    return colours;
}

void check_colours(const MeshFile& mesh, std::uint32_t triangle,
                   const std::vector<Colour>& expected) {
    const std::vector<Colour> colours = corner_colours(mesh, triangle);
    for (std::size_t k = 0; k < 3; ++k) {
        for (std::size_t i = 0; i < 3; ++i) {
            INFO(triangle << ' ' << k << ' ' << i);
            CHECK(colours[k][i] == doctest::Approx(expected[k][i]).epsilon(1e-12));
        }
    }
}

/// Returns the warning of this kind; one of 0 elements if the mesh has none.
MeshWarning warning_of(const MeshFile& mesh, std::string_view kind) {
    const auto found = std::ranges::find(mesh.warnings, kind, &MeshWarning::kind);
    return found == mesh.warnings.end() ? MeshWarning{} : *found;
}

std::string base64(std::string_view bytes) {
    constexpr std::string_view kDigits =
        "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        std::uint32_t group = 0;
        for (std::size_t k = 0; k < 3; ++k) {
            group =
                group << 8 | (i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0u);
        }
        for (std::size_t k = 0; k < 4; ++k) {
            text += i + k > bytes.size() ? '=' : kDigits[group >> (18 - 6 * k) & 63];
        }
    }
    return text;
}

/// An OBJ file of one triangle for each text of its lines, at the pixels' centres: those of red,
/// green and white.
std::string obj_of(const std::vector<std::string>& faces, const std::string& library = "a.mtl") {
    std::string text = "mtllib " + library +
                       "\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\n"
                       "vt 0.25 0.75\nvt 0.75 0.75\nvt 0.75 0.25\nvt 1.75 -0.25\n";
    for (const std::string& face : faces) {
        text += face + '\n';
    }
    return text;
}

struct Obj {
    std::string obj, mtl;
};

MeshFile mesh_of(const Obj& files) {
    const TemporaryFolder folder;
    folder.write("a.mtl", files.mtl);
    folder.write("a.png", kColourImage);
    return read_with_materials(folder.write("a.obj", files.obj));
}

void check_refused(const Obj& files, std::string_view part) {
    check_fails(ExitCode::bad_input, part, [&] { mesh_of(files); });
}

const std::string kFace = "f 1/1 2/2 3/3";

/// A glTF file of one triangle for each primitive. Texture coordinates: set 0 at the centres of
/// the pixels red, green and white, set 1 at 0.5 times those, set 2 beyond the edges.
struct Gltf {
    std::string materials, textures = R"([{"source": 0}])", images = R"([{"uri": "a b.png"}])";
    std::vector<std::string> primitives{R"("material": 0)"};
    std::string attributes = R"("POSITION": 0, "TEXCOORD_0": 1, "TEXCOORD_1": 2, "TEXCOORD_2": 3)";
    std::string more;
};

std::string text_of(const Gltf& gltf) {
    const std::string buffer =
        bytes_of_values<float>({0,     0,     0,     1,    0,    0,     0,     1,     0,
                                0.25,  0.25,  0.75,  0.25, 0.75, 0.75,  0.125, 0.125, 0.375,
                                0.125, 0.375, 0.375, 1.25, 0.25, -0.75, 1.75,  2.25,  -5}) +
        kColourImage;
    std::string primitives;
    for (const std::string& primitive : gltf.primitives) {
        primitives += (primitives.empty() ? "{" : ", {") + std::string(R"("attributes": {)") +
                      gltf.attributes + "}" + (primitive.empty() ? "" : ", " + primitive) + "}";
    }
    std::string accessors, views;
    for (std::size_t i = 0; i < 4; ++i) {
        const std::size_t offset = i == 0 ? 0 : 36 + (i - 1) * 24;
        accessors += std::string(i == 0 ? "" : ", ") + R"({"bufferView": )" + std::to_string(i) +
                     R"(, "componentType": 5126, "count": 3, "type": ")" +
                     (i == 0 ? "VEC3" : "VEC2") + "\"}";
        views += R"({"buffer": 0, "byteOffset": )" + std::to_string(offset) +
                 R"(, "byteLength": )" + (i == 0 ? "36" : "24") + "}, ";
    }
    views += R"({"buffer": 0, "byteOffset": 108, "byteLength": )" +
             std::to_string(kColourImage.size()) + "}";
    const auto list = [](const char* name, const std::string& value) {
        return value.empty() ? "" : std::string(", \"") + name + "\": " + value;
    };
    return R"({"asset": {"version": "2.0"}, "nodes": [{"mesh": 0}], "scenes": [{"nodes": [0]}],
               "meshes": [{"primitives": [)" +
           primitives + R"(]}], "accessors": [)" + accessors + R"(], "bufferViews": [)" + views +
           R"(], "buffers": [{"byteLength": )" + std::to_string(buffer.size()) +
           R"(, "uri": "data:;base64,)" + base64(buffer) + "\"}]" +
           list("materials", gltf.materials) + list("textures", gltf.textures) +
           list("images", gltf.images) + gltf.more + "}";
}

MeshFile mesh_of(const Gltf& gltf) {
    const TemporaryFolder folder;
    folder.write("a b.png", kColourImage);
    folder.write("a.jpg", jpeg_bytes());
    return read_with_materials(folder.write("a.gltf", text_of(gltf)));
}

void check_refused(const Gltf& gltf, std::string_view part) {
    check_fails(ExitCode::bad_input, part, [&] {
        const MeshFile mesh = mesh_of(gltf);
        if (mesh.materials) {
            const Textures decoded(mesh);
        }
    });
}

/// A material with a texture, whose object has more entries.
std::string textured(const std::string& info = "", const std::string& factor = "") {
    return R"([{"name": "paint", "pbrMetallicRoughness": {"baseColorTexture": {"index": 0)" + info +
           "}" + factor + "}}]";
}

/// sRGB, by its definition.
double encoded(double light) {
    return light <= 0.0031308 ? 12.92 * light : 1.055 * std::pow(light, 1 / 2.4) - 0.055;
}

} // namespace

TEST_CASE("OBJ faces have the colours of their materials") {
    const MeshFile mesh = mesh_of(
        Obj{obj_of({"usemtl plain", kFace, "usemtl in wood", kFace, "usemtl dim", kFace}),
            "# A comment\nnewmtl unused\nKd nonsense\nmap_Kd none.png\nnewmtl plain\nKd 0.25 .5 1\n"
            "newmtl in wood\n  map_Kd a.png  # The image.\r\nnewmtl dim\nKd 0.5\nmap_kd a.png\n"
            "newmtl plain\nKd 0 0 0\n"});
    CHECK(mesh.materials->images.size() == 1); // Two materials have the same.
    CHECK(warning_of(mesh, "no_material").count == 0);
    CHECK(warning_of(mesh, "no_texture_coordinates").count == 0);
    check_colours(mesh, 0, {{0.25, 0.5, 1}, {0.25, 0.5, 1}, {0.25, 0.5, 1}});
    check_colours(mesh, 1, {kRed, kGreen, kWhiteColour});
    check_colours(mesh, 2, {{0.5, 0, 0}, {0, 0.5, 0}, {0.5, 0.5, 0.5}});
    // Between the centres of pixels, as with one image for all.
    SampleRow row;
    std::fill_n(row.bary, 2, 0.5F);
    row.bary[2] = 0;
    row.face = 1;
    const SampleField field = texture_colours(mesh, Textures(mesh), std::vector<SampleRow>{row});
    CHECK(field.name == "color");
    CHECK(field.values == std::vector<double>{0.5, 0.5, 0});
}

TEST_CASE("options of map_Kd scale, move and clamp texture coordinates") {
    const auto colours = [](const std::string& map, const std::string& face,
                            const std::vector<Colour>& expected) {
        check_colours(mesh_of(Obj{obj_of({"usemtl m", face}), "newmtl m\nmap_Kd " + map + '\n'}), 0,
                      expected);
    };
    colours("-o 0.5 a.png", kFace, {kGreen, kRed, kBlue});
    colours("-o 0.5 0.5 0 a.png", kFace, {kWhiteColour, kBlue, kRed});
    // At (0.25, 0.75), (0.75, 0.75) and (0.75, 0.25): u stays, 3 v - 1.5 is 0.75 or -0.75.
    colours("-s 1 3 -o 0 -1.5 a.png", kFace, {kRed, kGreen, kWhiteColour});
    colours("-s -1 1 1 a.png", kFace, {kGreen, kRed, kBlue});
    // At (1.75, -0.25): repeated at (0.75, 0.75), clamped to the lower right.
    colours("a.png", "f 1/4 2/4 3/4", {kGreen, kGreen, kGreen});
    colours("-clamp on a.png", "f 1/4 2/4 3/4", {kWhiteColour, kWhiteColour, kWhiteColour});
    colours("-clamp off -blendu on -texres 64 a.png", "f 1/4 2/4 3/4", {kGreen, kGreen, kGreen});
    const MeshFile mesh =
        mesh_of(Obj{obj_of({"usemtl m", kFace}), "newmtl m\nmap_Kd -mm 0.2 0.5 -t 1 1 1 a.png\n"});
    check_colours(mesh, 0, {kRed, kGreen, kWhiteColour});
    CHECK(warning_of(mesh, "ignored_map_option").count == 2);
    CHECK(contains(warning_of(mesh, "ignored_map_option").message, "material 'm': -mm"));
}

TEST_CASE("MTL files and their images are found beside the file that names them") {
    const TemporaryFolder folder;
    std::filesystem::create_directory(folder / "in side");
    folder.write("in side/the paint.mtl",
                 "newmtl m\nmap_Kd ..\\an image.png\nnewmtl n\nmap_Kd -s 1 1 \"own im#1.png\"\n");
    folder.write("an image.png", kColourImage);
    folder.write("in side/own im#1.png", png_bytes(1, 1, std::string_view("\0\0\xff", 3), 8, 2));
    folder.write("other.mtl", "newmtl o\nKd 0 1 0\n");
    folder.write("a.obj", obj_of({"mtllib other.mtl", "usemtl m", kFace, "usemtl n", kFace,
                                  "usemtl o", kFace},
                                 "in side\\the paint.mtl"));
    const MeshFile mesh = read_with_materials(folder / "a.obj");
    check_colours(mesh, 0, {kRed, kGreen, kWhiteColour});
    check_colours(mesh, 1, {kBlue, kBlue, kBlue});
    check_colours(mesh, 2, {kGreen, kGreen, kGreen});
    // Several files in one line.
    folder.write("in.mtl", "newmtl m\nKd 1 0 0\n");
    folder.write("b.obj", obj_of({"usemtl m", kFace, "usemtl o", kFace}, "in.mtl other.mtl"));
    const MeshFile both = read_with_materials(folder / "b.obj");
    check_colours(both, 0, {kRed, kRed, kRed});
    check_colours(both, 1, {kGreen, kGreen, kGreen});
}

TEST_CASE("files are found by names in another case, encoding or folder") {
    const TemporaryFolder folder;
    std::filesystem::create_directory(folder / "textures");
    folder.write("textures/Wood.png", kColourImage);
    folder.write("gr\xc3\xbcn 2.png", png_bytes(1, 1, std::string_view("\0\xff\0", 3), 8, 2));
    folder.write("the paint.mtl",
                 "newmtl a\nmap_Kd Textures\\wood.PNG\nnewmtl Gro\xcc\x88\xc3\x9f\x65\n"
                 "map_Kd C:\\Users\\anna\\gr\xc3\xbcn 2.png\n"
                 "newmtl gr\xfcn\nmap_Kd /none/gr\xfcn 2.png\n");
    folder.write("other blue.mtl", "newmtl blue\nKd 0 0 1\n");
    folder.write("a.obj", obj_of({"usemtl a", kFace, "usemtl Gr\xc3\xb6\xc3\x9f\x65", kFace,
                                  "usemtl gr\xfcn", kFace, "usemtl blue", kFace},
                                 "The Paint.mtl other blue.mtl"));
    const MeshFile mesh = read_with_materials(folder / "a.obj");
    check_colours(mesh, 0, {kRed, kGreen, kWhiteColour});
    check_colours(mesh, 1, {kGreen, kGreen, kGreen});
    check_colours(mesh, 2, {kGreen, kGreen, kGreen});
    check_colours(mesh, 3, {kBlue, kBlue, kBlue});
    CHECK(mesh.part_names.materials[2] == "gr\xc3\xbcn");
    std::string notes;
    for (const MeshWarning& warning : mesh.warnings) {
        notes += warning.message + '\n';
    }
    CHECK(contains(notes, "its image 'C:\\Users\\anna\\gr\xc3\xbcn 2.png' is read as "));
    if (!ignores_case(folder / "a.obj")) {
        CHECK(contains(notes, "its material file 'The Paint.mtl' is read as "));
        CHECK(contains(notes, "material 'a': its image 'Textures\\wood.PNG' is read as "));
    }
}

TEST_CASE("images of a set are the tiles of texture coordinates") {
    const TemporaryFolder folder;
    const auto tile = [&](const std::string& name, std::string_view colour) {
        folder.write(name, png_bytes(1, 1, colour, 8, 2));
    };
    tile("s.1001.png", std::string_view("\xff\0\0", 3));
    tile("S.1012.PNG", std::string_view("\0\xff\0", 3));
    tile("t_u1_v1.png", std::string_view("\xff\0\0", 3));
    tile("t_u2_v2.png", std::string_view("\0\xff\0", 3));
    const std::string far = "vt 1 1\nvt 2 1\nvt 2 2\nf 1/-3 2/-2 4/-1\n";
    const auto mesh_of_map = [&](const std::string& map, const std::string& more) {
        folder.write("a.mtl", "newmtl m\nmap_Kd " + map + "\n");
        folder.write("a.obj", obj_of({"usemtl m", kFace}) + more);
        return read_with_materials(folder / "a.obj");
    };
    for (const char* const map : {"s.<UDIM>.png", "s.<udim>.png", "s.1001.png", "t_<UVTILE>.png"}) {
        CAPTURE(map);
        const MeshFile mesh = mesh_of_map(map, far);
        check_colours(mesh, 0, {kRed, kRed, kRed});
        check_colours(mesh, 1, {kGreen, kGreen, kGreen}); // At the edges of other tiles too.
        CHECK(warning_of(mesh, "image_tiles").count == (map[3] == '0' ? 1 : 0));
    }
    const std::string none = "vt 1 0\nvt 2 0\nvt 2 1\nf 1/-3 2/-2 4/-1\n";
    check_colours(mesh_of_map("s.1001.png", none), 1, {kRed, kRed, kRed}); // Repeats.
    const MeshFile missing = mesh_of_map("s.<UDIM>.png", none);
    check_fails(ExitCode::bad_input, "lies in tile 1002 of its texture (UDIM)",
                [&] { const Textures decoded(missing); });
    MeshSources sources;
    sources.mesh = (folder / "a.obj").string();
    sources.fields.uvs = true;
    mesh_of_map("s.<UDIM>.png", far);
    const MeshFile for_all = read_mesh(sources);
    const Textures set(for_all, folder / "s.<UDIM>.png");
    SampleRow row;
    row.face = 1;
    row.bary[1] = 1;
    CHECK(texture_colours(for_all, set, std::vector<SampleRow>{row}).values ==
          std::vector<double>{0, 1, 0});
}

TEST_CASE("comments of PLY files name images") {
    const TemporaryFolder folder;
    folder.write("a b.png", kColourImage);
    folder.write("c.png", png_bytes(1, 1, std::string_view("\0\0\xff", 3), 8, 2));
    const auto read_ply = [&](const std::string& comments, const std::string& property,
                              const std::string& first, const std::string& second) {
        return read_with_materials(folder.write(
            "a.ply", "ply\nformat ascii 1.0\n" + comments +
                         "element vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
                         "property float s\nproperty float t\nelement face 2\n"
                         "property list uchar int vertex_indices\n" +
                         property +
                         "end_header\n0 0 0 0.25 0.75\n1 0 0 0.75 0.75\n"
                         "0 1 0 0.75 0.25\n3 0 1 2" +
                         first + "\n3 0 1 2" + second + "\n"));
    };
    const std::string one = "comment TextureFile A b.png\n",
                      both = one + "comment TextureFile c.png\n";
    const std::string number = "property int texnumber\n";
    check_colours(read_ply(one, "", "", ""), 0, {kRed, kGreen, kWhiteColour});
    const MeshFile mesh = read_ply(both, number, " 1", " 0");
    check_colours(mesh, 0, {kBlue, kBlue, kBlue});
    check_colours(mesh, 1, {kRed, kGreen, kWhiteColour});
    CHECK(mesh.fields.empty());
    const auto fails = [&](const std::string& comments, const std::string& property,
                           const std::string& values, std::string_view part) {
        check_fails(ExitCode::bad_input, part,
                    [&] { read_ply(comments, property, values, values); });
    };
    fails(both, "", "", "a.ply: names several images, but its faces have no texnumber");
    fails(both, number, " 2", "record 0: texnumber is 2, but the file names 2 images");
    fails("comment TextureFile none.png\n", "", "", "none.png is not there; correct the comment");
    fails("", "", "", "a.ply: has no materials, which --texture auto needs");
}

TEST_CASE("faces without material have the colours of their vertices") {
    const std::string colours = "v 0 0 0 1 0 0\nv 1 0 0 0 1 0\nv 1 1 0 1 1 1\n";
    const TemporaryFolder folder;
    folder.write("a.mtl", "newmtl m\nKd 0 0 1\n");
    const MeshFile mesh = read_with_materials(
        folder.write("a.obj", "mtllib a.mtl\n" + colours + "f 1 2 3\nusemtl m\nf 1 2 3\n"));
    check_colours(mesh, 0, {kRed, kGreen, kWhiteColour});
    check_colours(mesh, 1, {kBlue, kBlue, kBlue});
    CHECK(warning_of(mesh, "no_material").count == 0);
    // In glTF they multiply the light of a material.
    LongerSquare square;
    const int accessor = square.add(
        bytes_of_values<float>({1, 0, 0, 0.5, 0.5, 0.5, 0, 1, 1, 1, 1, 1}), 5126, 4, "VEC3");
    const std::string attributes =
        R"([{"attributes": {"POSITION": 0, "COLOR_0": )" + std::to_string(accessor) + "}";
    square.parts.primitives = attributes + R"(, "indices": 1}])";
    const auto read_square = [&] {
        folder.write("mesh.bin", square.buffer);
        square.parts.buffer =
            R"("uri": "mesh.bin", "byteLength": )" + std::to_string(square.buffer.size());
        return read_with_materials(folder.write("a.gltf", text_of(square.parts)));
    };
    const double half = encoded(0.5);
    check_colours(read_square(), 0, {kRed, {half, half, half}, {0, 1, 1}});
    square.parts.primitives = attributes + R"(, "indices": 1, "material": 0}])";
    square.parts.more = R"(, "materials": [{"pbrMetallicRoughness":
        {"baseColorFactor": [0.5, 1, 1, 1]}}])";
    check_colours(read_square(), 0, {{half, 0, 0}, {encoded(0.25), half, half}, {0, 1, 1}});
}

TEST_CASE("OBJ faces without material or texture coordinates are counted") {
    const MeshFile mesh = mesh_of(Obj{obj_of({"f 1 2 3", "usemtl nowhere", "f 1 2 3 4", "usemtl m",
                                              "f 2 3 4", "f 1/1 2/2 4", "f 1/1 3/2 4/3"}),
                                      "newmtl m\nKd 0.5 1 1\nmap_Kd a.png\n"});
    const std::vector<Colour> white(3, kWhiteColour);
    check_colours(mesh, 0, white);
    check_colours(mesh, 1, white);
    check_colours(mesh, 2, white); // The other half of the quad.
    check_colours(mesh, 3, std::vector<Colour>(3, {0.5, 1, 1}));
    check_colours(mesh, 4, std::vector<Colour>(3, {0.5, 1, 1}));
    check_colours(mesh, 5, {{0.5, 0, 0}, kGreen, {0.5, 1, 1}});
    const std::string plain = warning_of(mesh, "no_material").message;
    CHECK(contains(plain, "2 faces without material are white"));
    CHECK(contains(plain, "line 10"));
    const std::string bare = warning_of(mesh, "no_texture_coordinates").message;
    CHECK(contains(bare, "2 faces have a texture but no texture coordinates"));
    CHECK(contains(bare, "line 14"));
}

TEST_CASE("OBJ materials that cannot be read are refused") {
    const std::string used = obj_of({"usemtl m", kFace});
    check_refused(Obj{used, "newmtl m\nmap_Kd none.png\n"},
                  "a.mtl: line 2: material 'm': its image ");
    check_refused(Obj{used, "newmtl m\nmap_Kd none.png\n"},
                  "none.png is not there; correct map_Kd");
    check_refused(Obj{used, "newmtl m\nmap_Kd .\n"}, "is not there");
    check_refused(Obj{used, "newmtl m\n\nKd 1 x 1\n"}, "a.mtl: line 3: 'x' is not a finite number");
    check_refused(Obj{used, "newmtl m\nKd 1 nan 1\n"}, "'nan' is not a finite number");
    check_refused(Obj{used, "newmtl m\nKd spectral a.rfl\n"}, "Kd is read as three numbers");
    check_refused(Obj{used, "newmtl m\nmap_Kd -o a.png\n"}, "-o of map_Kd needs a number");
    check_refused(Obj{used, "newmtl m\nmap_Kd -s 1 1.7e308 -o 0 1.7e308 a.png\n"},
                  "line 11: its texture coordinates are too large where its material puts them");
    check_refused(Obj{obj_of({"usemtl m", kFace}, "none.mtl"), ""},
                  "none.mtl is not there; correct mtllib");
    check_refused(Obj{"v 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl m\nf 1 2 3\n", ""},
                  "a.obj: has no materials, which --texture auto needs");
    // Damaged images are named with their material.
    const TemporaryFolder folder;
    folder.write("a.mtl", "newmtl m\nmap_Kd a.png\n");
    folder.write("a.png", kColourImage.substr(0, 60));
    const MeshFile mesh = read_with_materials(folder.write("a.obj", used));
    check_fails(ExitCode::bad_input,
                "a.mtl: material 'm': ", [&] { const Textures decoded(mesh); });
}

TEST_CASE("formats without materials are refused") {
    for (const auto& [name, bytes] :
         {std::pair{"a.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n"},
          {"a.stl", "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\n"
                    "vertex 0 1 0\nendloop\nendfacet\nendsolid a\n"}}) {
        const TemporaryFolder folder;
        const std::filesystem::path path = folder.write(name, bytes);
        check_fails(ExitCode::bad_input, "has no materials, which --texture auto needs",
                    [&] { read_with_materials(path); });
    }
    check_fails(ExitCode::bad_input, "builtin:cube: has no materials",
                [&] { read_with_materials("builtin:cube"); });
    Gltf gltf;
    gltf.primitives = {""};
    check_refused(gltf, "has no materials, which --texture auto needs");
}

TEST_CASE("glTF faces have the colours of their materials") {
    Gltf gltf;
    gltf.materials = R"([{"pbrMetallicRoughness": {"baseColorFactor": [0.25, 0.5, 1, 0.1]}},
        {"pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}},
        {"pbrMetallicRoughness": {"baseColorTexture": {"index": 0},
                                  "baseColorFactor": [0.5, 0.002, 0.5, 1]}},
        {"pbrMetallicRoughness": {"baseColorTexture": {"index": 77}}}, {},
        {"extensions": {"KHR_materials_pbrSpecularGlossiness":
            {"diffuseFactor": [1, 0.5, 1, 1], "diffuseTexture": {"index": 0}}}}])";
    gltf.primitives = {R"("material": 0)", R"("material": 1)", R"("material": 2)",
                       R"("material": 4)", R"("material": 5)", ""};
    const MeshFile mesh = mesh_of(gltf);
    CHECK(mesh.materials->images.size() == 1);
    const Colour plain{encoded(0.25), encoded(0.5), 1};
    check_colours(mesh, 0, {plain, plain, plain});
    check_colours(mesh, 1, {kRed, kGreen, kWhiteColour});
    check_colours(mesh, 2,
                  {{encoded(0.5), 0, 0},
                   {0, encoded(0.002), 0},
                   {encoded(0.5), encoded(0.002), encoded(0.5)}});
    check_colours(mesh, 3, {kWhiteColour, kWhiteColour, kWhiteColour});
    check_colours(mesh, 4, {kRed, {0, encoded(0.5), 0}, {1, encoded(0.5), 1}});
    check_colours(mesh, 5, {kWhiteColour, kWhiteColour, kWhiteColour});
    CHECK(contains(warning_of(mesh, "no_material").message, "1 face without material is white"));
    // A factor multiplies light, not its code: 128 is 0.2158605 of the light.
    const TemporaryFolder folder;
    gltf.primitives = {R"("material": 2)"};
    folder.write("a b.png", png_bytes(1, 1, std::string_view("\x80\x80\x80", 3), 8, 2));
    const MeshFile grey = read_with_materials(folder.write("a.gltf", text_of(gltf)));
    CHECK(corner_colours(grey, 0)[0][0] == doctest::Approx(encoded(0.5 * 0.2158605)).epsilon(1e-6));
}

TEST_CASE("images of glTF are files, data and views") {
    Gltf gltf;
    gltf.materials = textured();
    for (const std::string& image :
         {std::string(R"({"uri": "a%20b.png"})"),
          std::string(R"({"bufferView": 4, "mimeType": "image/png"})"),
          R"({"uri": "data:image/png;base64,)" + base64(kColourImage) + "\"}"}) {
        gltf.images = "[" + image + "]";
        check_colours(mesh_of(gltf), 0, {kRed, kGreen, kWhiteColour});
    }
    gltf.images = R"([{"uri": "a.jpg"}])";
    const TemporaryFolder folder;
    const ColourImage jpeg(folder.write("a.jpg", jpeg_bytes()));
    check_colours(mesh_of(gltf), 0,
                  {jpeg.at(0.25, 0.75), jpeg.at(0.75, 0.75), jpeg.at(0.75, 0.25)});
}

TEST_CASE("texture coordinates of glTF are of the set and transform of the material") {
    const auto colours = [](const std::string& info, const std::vector<Colour>& expected) {
        Gltf gltf;
        gltf.materials = textured(info);
        check_colours(mesh_of(gltf), 0, expected);
    };
    const auto moved = [&](const std::string& transform, const std::vector<Colour>& expected) {
        colours(R"(, "extensions": {"KHR_texture_transform": {)" + transform + "}}", expected);
    };
    moved(R"("offset": [0.5, 0])", {kGreen, kRed, kBlue});
    moved(R"("offset": [0, 0.5])", {kBlue, kWhiteColour, kGreen});
    moved(R"("scale": [2, 2], "texCoord": 1)", {kRed, kGreen, kWhiteColour});
    colours(R"(, "texCoord": 1, "extensions": {"KHR_texture_transform": {"scale": [2, 2]}})",
            {kRed, kGreen, kWhiteColour});
    // A quarter turn from u to -v: (u, v) becomes (v, -u), with the offset (v, 1 - u).
    moved(R"("rotation": 1.5707963267948966, "offset": [0, 1])", {kBlue, kRed, kGreen});
    // First scaled: (u, v) becomes (3 v, 1 - u), and 3 v is 0.75 or 2.25.
    moved(R"("rotation": 1.5707963267948966, "offset": [0, 1], "scale": [1, 3])",
          {kWhiteColour, kGreen, kRed});
    // Each primitive has the set of its own material, and no other needs it.
    Gltf gltf;
    gltf.materials =
        R"([{"pbrMetallicRoughness": {"baseColorTexture": {"index": 0, "texCoord": 2}}},
            {"pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}},
            {"pbrMetallicRoughness": {"baseColorTexture": {"index": 0, "texCoord": 3}}}])";
    gltf.primitives = {R"("material": 1)", R"("material": 0)", R"("material": 2)"};
    const MeshFile mesh = mesh_of(gltf);
    check_colours(mesh, 0, {kRed, kGreen, kWhiteColour});
    check_colours(mesh, 1, {kRed, kBlue, {0.5, 0, 0.5}});
    check_colours(mesh, 2, {kWhiteColour, kWhiteColour, kWhiteColour});
    CHECK(warning_of(mesh, "no_texture_coordinates").count == 1);
}

TEST_CASE("samplers of glTF repeat, mirror or clamp") {
    // At (1.25, 0.25), (-0.75, 1.75) and (2.25, -5), from above.
    const auto colours = [](const std::string& sampler, const std::vector<Colour>& expected) {
        Gltf gltf;
        gltf.materials = textured(R"(, "texCoord": 2)");
        gltf.textures = R"([{"source": 0, "sampler": 0}])";
        gltf.more = R"(, "samplers": [{)" + sampler + "}]";
        check_colours(mesh_of(gltf), 0, expected);
    };
    const Colour violet{0.5, 0, 0.5}, teal{0.5, 1, 0.5}; // Half of the rows above and below.
    colours("", {kRed, kBlue, violet});
    colours(R"("wrapS": 10497, "wrapT": 10497)", {kRed, kBlue, violet});
    // -5 is 1 when mirrored: the lower edge.
    colours(R"("wrapS": 33648, "wrapT": 33648)", {kGreen, kGreen, kBlue});
    colours(R"("wrapS": 33071, "wrapT": 33071)", {kGreen, kBlue, kGreen});
    colours(R"("wrapS": 33071)", {kGreen, kBlue, teal});
}

TEST_CASE("glTF materials that cannot be read are refused") {
    Gltf gltf;
    gltf.materials = textured();
    const auto fails = [](const Gltf& changed, std::string_view part) {
        check_refused(changed, part);
    };
    Gltf changed = gltf;
    changed.images = R"([{"uri": "none.png"}])";
    fails(changed, "a.gltf: material 'paint': image 0: ");
    fails(changed, "none.png: no such file");
    changed.images = R"([{"uri": "../a.png"}])";
    fails(changed, "material 'paint': image 0: '../a.png' is not a file of its folder");
    changed.images = R"([{"uri": "data:;base64,iVBO?"}])";
    fails(changed, "material 'paint': image 0: its data: URI is damaged");
    changed.images = R"([{"uri": "data:;base64,iVBORw0KGgo="}])";
    fails(changed, "a.gltf: material 'paint': image 0: cannot be read as a PNG image");
    changed.images = R"([{"uri": "a.gltf"}])";
    fails(changed, "image 0, a.gltf: is no PNG, JPEG, WebP, TGA or BMP image");
    changed.images = R"([{"bufferView": 99}])";
    fails(changed, "bufferView 99 is out of range");
    changed.images = R"([{}])";
    fails(changed, "material 'paint': image 0: has no bufferView");
    changed.images = "";
    fails(changed, "image 0 is out of range");
    changed = gltf;
    changed.textures = R"([{"extensions": {"KHR_texture_basisu": {"source": 0}}}])";
    fails(changed, "material 'paint': its texture has no PNG, JPEG or WebP image; what "
                   "KHR_texture_basisu has is not read");
    changed.textures = R"([{"source": 0, "sampler": 0}])";
    changed.more = R"(, "samplers": [{"wrapS": 7}])";
    fails(changed, "material 'paint': the sampler of its texture has the unknown wrapS 7");
    changed = gltf;
    changed.primitives = {R"("material": 3)"};
    fails(changed, "material 3 is out of range");
    changed = gltf;
    changed.attributes = R"("POSITION": 0, "TEXCOORD_0": 0)";
    fails(changed, "its TEXCOORD_0 is not of two numbers");
    changed = gltf;
    changed.materials = textured("", R"(, "baseColorFactor": [1, 1])");
    fails(changed, "baseColorFactor has 2 numbers instead of 4");
    changed.materials = textured(R"(, "extensions": {"KHR_texture_transform": {"rotation": "x"}})");
    fails(changed, "material 'paint': rotation is not a number");
    changed.materials =
        textured(R"(, "extensions": {"KHR_texture_transform": {"scale": [1e308, 1e308],
                                     "offset": [1.7e308, 1.7e308]}})");
    fails(changed, "its texture coordinates are too large where its material puts them");
}
