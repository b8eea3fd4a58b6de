// Masks that limit samples: parts of meshes, properties and images, sampled, verified and refused.
#include <doctest/doctest.h>

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <utility>

#include "cli/command.hpp"
#include "files/samples/sample_file.hpp"
#include "unit/png_bytes.hpp"
#include "unit/test_files.hpp"

namespace geodisk::test {
namespace {

/// Three unit squares side by side at x = 0, 1 and 2, of two materials, in three groups; the third
/// is apart. Each is two triangles.
constexpr const char* kObj = "v 0 0 0\nv 1 0 0\nv 2 0 0\nv 0 1 0\nv 1 1 0\nv 2 1 0\n"
                             "v 2.5 0 0\nv 3.5 0 0\nv 2.5 1 0\nv 3.5 1 0\n"
                             "vt 0.25 0\nvt 0.75 0\n"
                             "usemtl red wood\ng left all\nf 1/1 2/1 5/1 4/1\n"
                             "usemtl steel\ng middle all\nf 2/1 3/1 6/1 5/1\n"
                             "usemtl red wood\no third one\ng\nf 7/2 8/2 10/2 9/2\n";

/// The unit square in two triangles, which have a property q, and the vertices p; "twice" is of
/// both.
constexpr const char* kPly =
    "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\n"
    "property float z\nproperty float p\nproperty int twice\nelement face 2\n"
    "property list uchar int vertex_indices\nproperty int q\nproperty int twice\nend_header\n"
    "0 0 0 1 0\n1 0 0 2 0\n1 1 0 3 0\n0 1 0 nan 0\n3 0 1 2 7 0\n3 0 2 3 9 0\n";

/// A triangle in wheel, which is below car, and two in a node without a name.
const std::string kGltf =
    R"({"asset": {"version": "2.0"}, "scenes": [{"nodes": [0, 2]}], "nodes": [
        {"name": "car", "children": [1]}, {"name": "wheel", "mesh": 0},
        {"mesh": 1, "translation": [3, 0, 0]}],
        "materials": [{"name": "rubber"}, {"name": "bark"}, {}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "material": 0}]},
                   {"primitives": [{"attributes": {"POSITION": 0}, "material": 2},
                                   {"attributes": {"POSITION": 1}}]}],
        "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3"},
                      {"bufferView": 1, "componentType": 5126, "count": 3, "type": "VEC3"}],
        "bufferViews": [{"buffer": 0, "byteLength": 36},
                        {"buffer": 0, "byteOffset": 12, "byteLength": 36}],
        "buffers": [{"byteLength": 48, "uri": "data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAAAACAPwAAgD8AAAAA"}]})";

/// Samples, checks that just these triangles have samples, and verifies.
void check_faces(const TemporaryFolder& folder, const std::string& mesh, const Arguments& where,
                 const std::vector<std::uint32_t>& faces, const Arguments& how = {}) {
    const Outcome made =
        run(folder, joined(joined({"sample", mesh, "-o", "a.csv", "-d", "0.1"}, where), how));
    INFO(made.err);
    REQUIRE(made.status == 0);
    std::vector<std::uint32_t> found;
    for (const tools::SampleRow& row : tools::read_samples(folder / "a.csv").rows) {
        found.push_back(row.face);
    }
    std::ranges::sort(found);
    found.erase(std::unique(found.begin(), found.end()), found.end());
    CHECK(found == faces);
    CHECK(run(folder, joined({"verify", mesh, "a.csv", "-q"}, where)).status == 0);
    std::filesystem::remove(folder / "a.csv");
}

} // namespace

TEST_CASE("samples lie on the parts of a mesh that are named") {
    const TemporaryFolder folder;
    folder.write("m.obj", kObj);
    check_faces(folder, "m.obj", {"--only", "material:red wood"}, {0, 1, 4, 5});
    check_faces(folder, "m.obj", {"--only", "material:1"}, {2, 3});
    check_faces(folder, "m.obj", {"--only", "group:all"}, {0, 1, 2, 3});
    check_faces(folder, "m.obj", {"--only", "group:third one"}, {4, 5});
    check_faces(folder, "m.obj", {"--only", "group:left", "--only", "part:1"}, {0, 1, 4, 5});
    check_faces(folder, "m.obj", {"--mask", "x>=1"}, {2, 3, 4, 5});
    check_faces(folder, "m.obj", {"--mask", "x<=2", "--mask", "x>=1"}, {2, 3});
    check_faces(folder, "m.obj", {"--only", "part:0"}, {0, 1, 2, 3},
                {"--method", "darts", "--darts", "5000"});
    folder.write("g.png", tools::png_bytes(2, 1, "\x10\xf0"));
    check_faces(folder, "m.obj", {"--mask", "map:g.png"}, {4, 5});
    check_faces(folder, "m.obj", {"--mask", "map:g.png<0.5", "--only", "group:left"}, {0, 1});

    // A count is that of the faces left, and other samples are found.
    const Outcome made = run(folder, {"sample", "m.obj", "-o", "all.ply", "-n", "300"});
    REQUIRE(made.status == 0);
    const Outcome found = run(folder, {"verify", "m.obj", "all.ply", "--only", "material:steel"});
    CHECK(found.status != 0);
    CHECK(contains(found.out, " on faces that --only left out, first sample "));
    CHECK(contains(found.err, " samples are on faces that --only left out"));
    const Outcome counted = run(folder, {"sample", "m.obj", "-o", "b.ply", "-n", "300", "--only",
                                         "material:steel", "--columns", "material,group,part"});
    INFO(counted.out);
    REQUIRE(counted.status == 0);
    CHECK(contains(counted.out, "samples on 2 of the triangles only"));
    const tools::SampleFile file = tools::read_samples(folder / "b.ply");
    CHECK(file.rows.size() > 280);
    CHECK(file.rows.size() < 320);
    CHECK(std::ranges::all_of(file.extra_values("material"), [](auto v) { return v == 1; }));
    CHECK(std::ranges::all_of(file.extra_values("group"), [](auto v) { return v == 2; }));
    CHECK(std::ranges::all_of(file.extra_values("part"), [](auto v) { return v == 0; }));
    CHECK(*file.header.find("only") == "material:steel");
    CHECK(*file.header.find("material") == "0 red wood");
}

TEST_CASE("faces that are seen from outside take samples, and shells within do not") {
    const TemporaryFolder folder;
    std::string shells;
    for (const double size : {1.0, 0.5}) { // Octahedra.
        for (int axis = 0; axis < 3; ++axis) {
            for (const double end : {size, -size}) {
                double point[3] = {};
                point[axis] = end;
                shells += "v " + std::to_string(point[0]) + " " + std::to_string(point[1]) + " " +
                          std::to_string(point[2]) + "\n";
            }
        }
    }
    for (int shell = 0; shell < 2; ++shell) {
        for (int face = 0; face < 8; ++face) {
            shells += "f";
            for (int axis = 0; axis < 3; ++axis) {
                shells += " " + std::to_string(1 + 6 * shell + 2 * axis + (face >> axis & 1));
            }
            shells += "\n";
        }
    }
    folder.write("m.obj", shells);
    const std::vector<std::uint32_t> outer{0, 1, 2, 3, 4, 5, 6, 7};
    check_faces(folder, "m.obj", {"--only", "outside"}, outer);
    check_faces(folder, "m.obj", {"--only", "outside:1"}, outer);
    const Arguments end{"-d", "0.1", "-o", "no.csv"};
    check_fails(folder, 2, "--only: 'outside:2' has no share of rays from 0 to 1",
                joined({"sample", "m.obj", "--only", "outside:2"}, end));
    check_fails(folder, 2,
                "--only: 'outsid' is none of material:NAME, group:NAME, node:NAME, part:N "
                "and outside",
                joined({"sample", "m.obj", "--only", "outsid"}, end));
    folder.write("lengths.txt", "1 3 1\n");
    check_fails(
        folder, 3, "lengths.txt",
        joined({"sample", "m.obj", "--only", "outside", "--edge-lengths", "lengths.txt"}, end));
}

TEST_CASE("values of vertices in files are masks, by number or by name") {
    const TemporaryFolder folder;
    folder.write("m.obj", kObj);
    // The first four of ten vertices are of "left", one of them of no label; the others of "right".
    std::string annotation = tools::big_endian(10);
    for (std::uint32_t v = 0; v < 10; ++v) {
        const bool is_left = v == 0 || v == 1 || v == 3 || v == 4;
        annotation += tools::big_endian(v) + tools::big_endian(is_left ? 5 : 9);
    }
    annotation += tools::big_endian(1) + tools::big_endian(2) + tools::big_endian(0);
    for (const auto& [name, red] :
         {std::pair<std::string, std::uint32_t>{"left", 5}, {"right", 9}}) {
        annotation += tools::big_endian(static_cast<std::uint32_t>(name.size())) + name;
        for (const std::uint32_t part : {red, 0u, 0u, 0u}) {
            annotation += tools::big_endian(part);
        }
    }
    folder.write("lh.a.annot", annotation);
    folder.write("lh.a.label", "#!ascii label\n5\n0 0 0 0 0\n1 1 0 0 0\n3 0 1 0 0\n4 1 1 0 0\n"
                               "2 2 0 0 0\n");
    folder.write("a.txt", "0\n1\n2\n3\n4\n5\n6\n7\n8\n9\n");
    check_faces(folder, "m.obj", {"--mask", "file:lh.a.annot=left"}, {0, 1});
    check_faces(folder, "m.obj", {"--mask", "file:lh.a.annot!=left"}, {4, 5});
    check_faces(folder, "m.obj", {"--mask", "file:lh.a.annot=1"}, {4, 5});
    check_faces(folder, "m.obj", {"--walls", "file:lh.a.annot=left"}, {2, 3, 4, 5});
    check_faces(folder, "m.obj", {"--mask", "file:lh.a.label"}, {0, 1});
    check_faces(folder, "m.obj", {"--mask", "file:lh.a.label<1"}, {4, 5});
    check_faces(folder, "m.obj", {"--mask", "file:a.txt<5", "--mask", "file:a.txt>=-1"}, {0, 1});
    check_faces(folder, "m.obj", {"--density", "file:lh.a.label"}, {0, 1, 2, 3});

    const Arguments sample{"sample", "m.obj", "-d", "0.1", "-o", "b.csv"};
    const Outcome made = run(folder, joined(sample, {"--attributes", "file:lh.a.annot"}));
    INFO(made.err);
    REQUIRE(made.status == 0);
    const std::string text = tools::bytes_of(folder / "b.csv");
    CHECK(contains(text, "# attributes: file:lh.a.annot\n"));
    CHECK(contains(text, ",lh.a.annot\n"));
    std::filesystem::remove(folder / "b.csv");

    const auto check = [&](const Arguments& options, int status, std::string_view part) {
        const Outcome outcome = run(folder, joined(sample, options));
        INFO(outcome.err);
        CHECK(outcome.status == status);
        CHECK(contains(outcome.err, part));
        CHECK_FALSE(std::filesystem::exists(folder / "b.csv"));
    };
    folder.write("short.txt", "1\n2\n");
    folder.write("s.stl", "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\n"
                          "vertex 0 1 0\nendloop\nendfacet\nendsolid a\n");
    check({"--mask", "file:lh.a.annot=lefty"}, 3,
          "lh.a.annot: has no value called 'lefty'; did you mean left");
    check({"--mask", "file:a.txt=left"}, 3,
          "a.txt: has no value called 'left', as its values have no names");
    check({"--mask", "file:lh.a.annot<left"}, 2, "is not PROPERTY<VALUE");
    check({"--mask", "file:lh.a.annot"}, 2,
          "--mask: the values of 'file:lh.a.annot' are labels; tell which, such as "
          "'file:lh.a.annot=right'");
    check({"--walls", "file:lh.a.annot"}, 2, "--walls: the values of 'file:lh.a.annot' are labels");
    check({"--density", "file:lh.a.annot"}, 2,
          "--density: the values of 'file:lh.a.annot' are labels, whose numbers are no amounts");
    check({"--mask", "file:"}, 2, "names nothing");
    check({"--mask", "file:short.txt"}, 3,
          "short.txt: has 2 values for the 10 vertices of the mesh");
    check({"--mask", "file:none.txt"}, 3, "none.txt");
    check({"--mask", "lh.a.label"}, 2, "file:lh.a.label for values");
    const Outcome stl =
        run(folder, {"sample", "s.stl", "-d", "0.1", "-o", "b.csv", "--mask", "file:a.txt"});
    CHECK(stl.status == 2);
    CHECK(contains(stl.err, "file:a.txt needs numbers of vertices, which s.stl has not"));
    const Outcome over = run(folder, {"sample", "m.obj", "-d", "0.1", "-o", "a.txt", "--format",
                                      "csv", "--attributes", "file:a.txt"});
    CHECK(over.status == 2);
    CHECK(tools::bytes_of(folder / "a.txt").starts_with("0\n1\n"));
}

TEST_CASE("samples lie on nodes and materials of glTF") {
    const TemporaryFolder folder;
    folder.write("m.gltf", kGltf);
    check_faces(folder, "m.gltf", {"--only", "node:car"}, {0});
    check_faces(folder, "m.gltf", {"--only", "node:wheel"}, {0});
    check_faces(folder, "m.gltf", {"--only", "node:2"}, {1, 2});
    check_faces(folder, "m.gltf", {"--only", "material:rubber"}, {0});
    check_faces(folder, "m.gltf", {"--only", "material:2"}, {1});
    const auto fails = [&](const std::string& only, const std::string& part) {
        check_fails(folder, 3, part,
                    {"sample", "m.gltf", "-o", "a.ply", "-d", "0.1", "--only", only});
    };
    fails("material:bark", "no face is of material:bark, as --only requests; the materials are "
                           "'rubber' and '2'");
    fails("node:bus", "the nodes are 'car', 'wheel' and '2'");
    fails("group:a", "m.gltf: has no groups for --only group:a; OBJ files may (g, o)");
}

TEST_CASE("names are the same in every composition and encoding") {
    const TemporaryFolder folder;
    const std::string start = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nusemtl a\nf 1 2 3\ng ";
    for (const char* const name :
         {"Gro\xcc\x88\xc3\x9f\x65", "Gr\xc3\xb6\xc3\x9f\x65", "Gr\xf6\xdf\x65"}) {
        CAPTURE(name);
        folder.write("n.obj", start + name + "\nusemtl " + name + "\nf 1 3 4\n");
        for (const char* const kind : {"material:", "group:"}) {
            check_faces(folder, "n.obj", {"--only", kind + std::string("Gr\xc3\xb6\xc3\x9f\x65")},
                        {1});
            check_faces(folder, "n.obj", {"--only", kind + std::string("Gro\xcc\x88\xc3\x9f\x65")},
                        {1});
        }
    }
    check_fails(folder, 3, "the materials are 'a' and 'Gr\xc3\xb6\xc3\x9f\x65'",
                {"sample", "n.obj", "-o", "a.ply", "-d", "0.1", "--only", "material:Groesse"});
}

TEST_CASE("samples lie where a property holds") {
    const TemporaryFolder folder;
    folder.write("m.ply", kPly);
    check_faces(folder, "m.ply", {"--mask", "q>7"}, {1});
    check_faces(folder, "m.ply", {"--mask", "q=7"}, {0});
    check_faces(folder, "m.ply", {"--mask", "q!=9"}, {0});
    check_faces(folder, "m.ply", {"--mask", "q>=7"}, {0, 1});
    check_faces(folder, "m.ply", {"--mask", "p<=3"}, {0});
    check_faces(folder, "m.ply", {"--mask", "p!=5"}, {0});
    const auto fails = [&](const Arguments& where, int status, const std::string& part) {
        CAPTURE(part);
        check_fails(folder, status, part,
                    joined({"sample", "m.ply", "-o", "a.ply", "-d", "0.1"}, where));
    };
    fails({"--mask", "p<3"}, 3, "m.ply: has no face that --mask allows, so no samples fit");
    fails({"--mask", "q>7", "--only", "part:0", "--mask", "q<9"}, 3,
          "has no face that --only and --mask allow");
    fails({"--mask", "r>7"}, 3, "m.ply: has no attribute 'r'; it has p, twice, q and face_twice");
    fails({"--mask", "face_twice>0"}, 3, "so no samples fit: 'face_twice' is from 0 to 0");
    fails({"--mask", "q"}, 2, "--mask: 'q' is not PROPERTY<VALUE");
    fails({"--mask", "q>x"}, 2, "--mask: 'q>x' is not PROPERTY<VALUE");
    fails({"--mask", "q>nan"}, 2, "--mask: 'q>nan' is not PROPERTY<VALUE");
    fails({"--mask", "m.ply"}, 2, "give map:m.ply for an image");
    fails({"--mask", "map:"}, 2, "names nothing");
    fails({"--only", "wood"}, 2, "--only: 'wood' is none of material:NAME");
    fails({"--only", "part:x"}, 2, "is not the number of a part");
    fails({"--only", "part:1"}, 3, "m.ply: has no part:1, as --only requests; its only part is 0");
    fails({"--only", "material:a"}, 3,
          "m.ply: has no materials for --only material:a; OBJ (usemtl) and glTF files may");
    folder.write("m.obj", kObj);
    check_fails(folder, 3,
                "m.obj: no face is of material:red wod, as --only requests; the materials are "
                "'red wood' and 'steel'; did you mean red wood?",
                {"sample", "m.obj", "-o", "a.ply", "-d", "0.1", "--only", "material:red wod"});
    check_fails(folder, 3, "m.obj: has no attribute 'q'; it has uv",
                {"sample", "m.obj", "-o", "a.ply", "-d", "0.1", "--mask", "q>0"});
    check_fails(folder, 3, "does not have the group of a face, as --columns requests; use an OBJ",
                {"sample", "m.ply", "-o", "a.ply", "-d", "0.1", "--columns", "group"});
}

TEST_CASE("a mask of colours goes by values from 0 to 1, and one that leaves out nothing warns") {
    const TemporaryFolder folder;
    const auto colours_of = [](const std::string& type, const std::string& full) {
        return "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\n"
               "property float z\nproperty " +
               type + " red\nproperty " + type + " green\nproperty " + type +
               " blue\nelement face 2\n"
               "property list uchar int vertex_indices\nend_header\n0 0 0 0 " +
               full + " 0\n1 0 0 0 " + full + " 0\n1 1 0 0 " + full +
               " 0\n0 1 0 0 0 0\n3 0 1 2\n3 0 2 3\n";
    };
    for (const auto& colour :
         {std::pair{"uchar", "255"}, {"ushort", "65535"}, {"float", "255"}, {"float", "1"}}) {
        CAPTURE(colour.first);
        folder.write("c.ply", colours_of(colour.first, colour.second));
        check_faces(folder, "c.ply", {"--mask", "green>0.4"}, {0});
        check_faces(folder, "c.ply", {"--radius-factor", "green", "--radius-factor-floor", "0.5"},
                    {0, 1});
    }
    const auto told = [&](const Arguments& where) {
        return run(folder, joined({"sample", "c.ply", "-o", "a.csv", "-d", "0.1"}, where));
    };
    const Outcome whole = told({"--mask", "green>=0", "--only", "part:0"});
    CHECK(whole.status == 0);
    CHECK(contains(whole.err, "--mask green>=0 leaves out no face: 'green' is from 0 to 1"));
    CHECK(contains(whole.err, "--only leaves out no face"));
    CHECK_FALSE(contains(told({"--mask", "green>0.4"}).err, "leaves out"));
    const Outcome none = told({"--mask", "green>100"});
    CHECK(none.status == 3);
    CHECK(contains(none.err, "so no samples fit: 'green' is from 0 to 1"));
    CHECK(contains(told({"--density", "red"}).err, "the density is 0 everywhere"));
    folder.write("ones.txt", "3\n3\n3\n3\n");
    const Outcome even = told({"--density", "file:ones.txt"});
    CHECK(even.status == 0);
    CHECK(contains(even.err, "the density is 3 everywhere, so it leaves out nothing"));
}

TEST_CASE("a mask goes by any coordinate of R^n") {
    const TemporaryFolder folder;
    folder.write("r4.ply", "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x0\n"
                           "property float x1\nproperty float x2\nproperty float x3\n"
                           "element face 2\nproperty list uchar int vertex_indices\nend_header\n"
                           "-1 0 0 1\n1 0 0 1\n1 1 0 1\n1 0 1 2\n3 0 1 2\n3 1 2 3\n");
    check_faces(folder, "r4.ply", {"--mask", "x0>0"}, {1});
    check_faces(folder, "r4.ply", {"--mask", "x3<1.5"}, {0});
    check_fails(folder, 2, "--mask x4: the mesh has 4 coordinates per vertex",
                {"sample", "r4.ply", "-o", "b.csv", "-d", "0.1", "--mask", "x4>0"});
}

} // namespace geodisk::test
