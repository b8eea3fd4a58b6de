// Attributes, normals and frames of samples, by `geodisk sample` and `transfer`.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <numbers>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

#include "cli/command.hpp"
#include "cli/json_file.hpp"
#include "unit/png_bytes.hpp"

namespace geodisk::test {
namespace {

/// A roof of two quads with colours and texture coordinates.
constexpr const char* kRoof = "v 0 0 0 1 0 0\nv 0 2 0 1 0 0\nv 1 0 1 0 1 0\nv 1 2 1 0 1 0\n"
                              "v 2 0 0 0 0 1\nv 2 2 0 0 0 1\nvt 0 0\nvt 0 1\nvt 0.5 0\nvt 0.5 1\n"
                              "vt 1 0\nvt 1 1\nf 1/1 3/3 4/4 2/2\nf 3/3 5/5 6/6 4/4\n";

/// The lines of a CSV file behind its comments.
std::vector<std::string> table_of(const TemporaryFolder& folder, const char* name) {
    std::vector<std::string> lines = lines_of(bytes_of(folder / name));
    std::erase_if(lines, [](const std::string& line) { return line.starts_with("# "); });
    return lines;
}

void sample_roof(const TemporaryFolder& folder, const char* output, const Arguments& more = {}) {
    folder.write("roof.obj", kRoof);
    const Outcome made =
        run(folder, joined({"sample", "roof.obj", "-o", output, "-d", "0.5", "--seed", "3"}, more));
    INFO(made.err);
    REQUIRE(made.status == 0);
}

} // namespace

TEST_CASE("attributes and frames are columns behind those of every file") {
    const TemporaryFolder folder;
    sample_roof(folder, "a.csv");
    sample_roof(folder, "b.csv", {"--attributes", "all", "--frames"});
    const std::vector<std::string> bare = table_of(folder, "a.csv"),
                                   all = table_of(folder, "b.csv");
    REQUIRE(all.size() == bare.size());
    CHECK(all[0] == bare[0] + ",red,green,blue,u,v,qx,qy,qz,qw");
    for (std::size_t i = 1; i < all.size(); ++i) {
        CHECK(all[i].starts_with(bare[i] + ','));
    }
    const Outcome checked = run(folder, {"verify", "roof.obj", "b.csv"});
    CHECK(checked.status == 0);

    // Frames turn with the samples, by the seed in their file.
    const Outcome moved = run(folder, {"transfer", "b.csv", "roof.obj", "roof.obj", "-o", "c.csv",
                                       "--attributes", "color,uv", "--frames"});
    INFO(moved.err);
    REQUIRE(moved.status == 0);
    CHECK(table_of(folder, "c.csv") == all);

    // A manifest may ask for other attributes than the batch.
    folder.write("list.txt", "roof.obj -o r.csv --attributes uv\n");
    const Outcome batch = run(folder, {"batch", "list.txt", "-o", "out", "-d", "0.5", "--seed", "3",
                                       "--normals", "smooth"});
    INFO(batch.err);
    REQUIRE(batch.status == 0);
    CHECK(table_of(folder, "out/r.csv")[0] == bare[0] + ",u,v");
}

TEST_CASE("frames are upright, or turn a part of the way to the normal") {
    const TemporaryFolder folder; // A slope of 45 degrees, whose normal is (0, -1, 1).
    folder.write("slope.obj", "v 0 0 0\nv 1 0 0\nv 1 1 1\nv 0 1 1\nf 1 2 3 4\n");
    const auto frame_with = [&](const Arguments& more) {
        const Outcome made =
            run(folder, joined({"sample", "slope.obj", "-o", "a.csv", "-d", "0.8"}, more));
        INFO(made.err);
        REQUIRE(made.status == 0);
        std::istringstream numbers(table_of(folder, "a.csv").at(1));
        std::vector<double> frame;
        for (std::string number; std::getline(numbers, number, ',');) {
            frame.push_back(std::stod(number));
        }
        frame.erase(frame.begin(), frame.end() - 4);
        std::filesystem::remove(folder / "a.csv");
        return frame;
    };
    const auto is_close = [](const std::vector<double>& a, const std::vector<double>& b) {
        return std::ranges::equal(a, b, [](double x, double y) { return std::abs(x - y) < 1e-6; });
    };
    const std::vector<double> upright = frame_with({"--frames=upright"});
    const double s = upright[2], c = upright[3]; // Of half the random angle about z.
    CHECK(is_close(upright, {0, 0, s, c}));
    CHECK(s != 0);
    // A turn about x by 45 degrees or a part of that follows; x is a step along the contour.
    const auto tilted = [&](double angle) {
        const double x = std::sin(angle / 2), w = std::cos(angle / 2);
        return std::vector{x * c, -x * s, w * s, w * c};
    };
    CHECK(is_close(frame_with({"--frames"}), tilted(std::numbers::pi / 4)));
    CHECK(is_close(frame_with({"--frames=0.5"}), tilted(std::numbers::pi / 8)));
    CHECK(is_close(frame_with({"--frames=z,0.25"}), tilted(std::numbers::pi / 16)));
    // A model whose y points up turns about y, and then by 90 degrees about x, which takes y to z.
    const double half = std::sqrt(0.5);
    CHECK(is_close(frame_with({"--frames=y,upright"}), {half * c, half * s, half * s, half * c}));
    CHECK(is_close(frame_with({"--frames=y,upright", "--up", "y"}), {0, s, 0, c}));

    const Arguments command{"sample", "slope.obj",         "-o", "a.usda", "-d",
                            "0.8",    "--frames=y,upright"};
    const Outcome scene = run(folder, command);
    CHECK(contains(scene.out, "frames        y,upright, where z points up; --up sets it\n"));
    CHECK(contains(scene.out, "scene         z up, as --frames has it; --up sets it"));
    CHECK(contains(bytes_of(folder / "a.usda"), "points = [(0, 0, 1), (0.866"));
    const auto fails = [&](const char* reason, const Arguments& more) {
        check_fails(folder, 2, reason,
                    joined({"sample", "slope.obj", "-o", "b.csv", "-d", "0.5"}, more));
    };
    fails("--frames: 'flat' is neither x, y or z for the axis", {"--frames=flat"});
    fails("--frames: '1.5' is neither", {"--frames=1.5"});
    fails("--frames: 'y,z' gives the axis of the model twice", {"--frames=y,z"});
    fails("--frames: 'upright,0.5' gives the part of the way to the normal twice",
          {"--frames=upright,0.5"});
    fails("if it is the value of --frames, give --frames=y", {"--frames", "y"});
    fails("--up is for samples in *.gltf, *.glb and *.usda, for pictures, and for --frames=upright",
          {"--frames=y", "--up", "z"});
}

TEST_CASE("normals are those of faces, of the file, or smooth") {
    const TemporaryFolder folder;
    sample_roof(folder, "a.csv");
    sample_roof(folder, "b.csv", {"--normals", "face"});
    CHECK(bytes_of(folder / "a.csv") == bytes_of(folder / "b.csv"));
    sample_roof(folder, "c.csv", {"--normals", "smooth"});
    CHECK(table_of(folder, "c.csv") != table_of(folder, "a.csv"));
    check_fails(folder, 3, "roof.obj: has no normals, as --normals file requests",
                {"sample", "roof.obj", "-o", "d.csv", "-d", "0.5", "--normals", "file"});
    check_fails(folder, 2, "--normals: 'sharp' is none of face, file and smooth",
                {"sample", "roof.obj", "-o", "d.csv", "-d", "0.5", "--normals", "sharp"});
    check_fails(folder, 2, "an .xyz file holds points alone, so no column of --normals",
                {"sample", "roof.obj", "-o", "d.xyz", "-d", "0.5", "--normals", "smooth"});
}

TEST_CASE("--texture auto gives the colours of materials") {
    const TemporaryFolder folder;
    folder.write(
        "ramp.png",
        tools::png_bytes(4, 1, std::string_view("\0\0\0\x55\0\0\xaa\0\0\xff\0\0", 12), 8, 2));
    folder.write("a.mtl", "newmtl paint\nmap_Kd ramp.png\nnewmtl dim\nKd 0.5 1 1\n"
                          "map_Kd ramp.png\nnewmtl plain\nKd 0.25 0.5 0.75\n");
    const auto roof = [&](const char* name, const std::string& first, const std::string& second) {
        const std::string text(kRoof);
        const std::size_t at = text.rfind("f "), before = text.rfind("f ", at - 1);
        folder.write(name, "mtllib a.mtl\n" + text.substr(0, before) + first +
                               text.substr(before, at - before) + second + text.substr(at));
    };
    const auto table = [&](const Arguments& words) {
        const Outcome made = run(folder, joined(words, {"-o", "t.csv"}));
        INFO(made.err);
        REQUIRE(made.status == 0);
        const std::vector<std::string> lines = table_of(folder, "t.csv");
        std::filesystem::remove(folder / "t.csv");
        return lines;
    };
    const Arguments start{"sample", "roof.obj", "-d", "0.5", "--seed", "3"};

    // One image for all is the same image by its material.
    roof("roof.obj", "usemtl paint\n", "");
    const std::vector<std::string> image = table(joined(start, {"--texture", "ramp.png"}));
    CHECK(image[0].ends_with(",red,green,blue"));
    CHECK(table(joined(start, {"--texture", "auto"})) == image);

    // By material of the face: here with and without an image.
    roof("roof.obj", "usemtl dim\n", "usemtl plain\n");
    std::size_t plain = 0;
    const std::vector<std::string> mixed = table(joined(start, {"--texture", "auto"}));
    REQUIRE(mixed.size() == image.size());
    const auto values_of = [](const std::string& line) {
        std::vector<std::string> values;
        for (std::size_t begin = 0; begin <= line.size();) {
            const std::size_t end = std::min(line.find(',', begin), line.size());
            values.push_back(line.substr(begin, end - begin));
            begin = end + 1;
        }
        return values;
    };
    const std::vector<std::string> names = values_of(mixed[0]);
    const auto column = [&](const char* name) {
        return static_cast<std::size_t>(std::ranges::find(names, name) - names.begin());
    };
    REQUIRE(column("face_index") < names.size());
    for (std::size_t i = 1; i < mixed.size(); ++i) {
        const std::vector<std::string> values = values_of(mixed[i]);
        if (std::stoi(values[column("face_index")]) >= 2) {
            CHECK(mixed[i].ends_with(",0.25,0.5,0.75"));
            ++plain;
        } else {
            const double red = std::stod(values_of(image[i])[column("red")]);
            CHECK(std::stod(values[column("red")]) == doctest::Approx(red / 2).epsilon(1e-6));
        }
    }
    CHECK(plain > 0);
    CHECK(plain < mixed.size() - 1);

    // Batches, manifests and transfer give the same.
    folder.write("list.txt", "roof.obj -o r.csv --texture auto\n");
    const Outcome batch =
        run(folder, {"batch", "list.txt", "-o", "out", "-d", "0.5", "--seed", "3"});
    INFO(batch.err);
    REQUIRE(batch.status == 0);
    CHECK(table_of(folder, "out/r.csv") == mixed);
    REQUIRE(run(folder, joined(start, {"-o", "bare.csv"})).status == 0);
    CHECK(table({"transfer", "bare.csv", "roof.obj", "roof.obj", "--texture", "auto"}) == mixed);

    // Faces without material have the colours of their vertices.
    roof("roof.obj", "", "usemtl plain\n");
    const Outcome white = run(folder, joined(start, {"-o", "w.csv", "--texture", "auto"}));
    CHECK(white.status == 0);
    CHECK(white.err.empty());
    const auto fails = [&](int status, const char* part, const Arguments& more) {
        check_fails(folder, status, part, joined(start, more));
    };
    // Attributes stand beside the colours of a texture.
    const std::vector<std::string> both =
        table(joined(start, {"--texture", "auto", "--attributes", "color"}));
    CHECK(both[0].ends_with(",vertex_red,vertex_green,vertex_blue,red,green,blue"));
    fails(2, "ramp.png: the picture would replace a file that roof.obj names",
          {"-o", "a.csv", "--texture", "auto", "--picture", "ramp.png"});
    fails(3, "auto: no such file", {"-o", "a.csv", "--texture", "./auto"});
    std::filesystem::remove(folder / "ramp.png");
    roof("roof.obj", "usemtl paint\n", "");
    fails(3, "a.mtl: line 2: material 'paint': its image ramp.png is not there",
          {"-o", "a.csv", "--texture", "auto"});
    folder.write("roof.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    fails(3, "roof.obj: has no materials, which --texture auto needs",
          {"-o", "a.csv", "--texture", "auto"});
}

TEST_CASE("no output replaces a file that a mesh names, however it is named") {
    const TemporaryFolder folder;
    std::filesystem::create_directory(folder / "in");
    const char* const continued = "mtllib x.mtl \\\n m.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\n"
                                  "usemtl a\nf 1 2 3\n";
    for (const char* const name : {"m.obj", "m.dat"}) {
        folder.write(name, continued);
    }
    folder.write("n.dat", "v 0 0 0\nv 2 0 0\nv 0 1 0\nf 1 2 3\n");
    folder.write("x.mtl", "");
    const std::string materials = "newmtl a\nKd 1 0.5 0\n";
    folder.write("m.mtl", materials);
    const Arguments start{"sample", "m.obj", "-d", "0.2", "--texture", "auto"};
    REQUIRE(run(folder, joined(start, {"-o", "s.csv"})).status == 0);
    const auto fails = [&](int status, const char* part, const Arguments& arguments,
                           const Setting& setting = {}) {
        check_fails(folder, status, part, arguments, setting);
        CHECK(bytes_of(folder / "m.mtl") == materials);
    };
    const char* const replaced = "m.mtl: the samples would replace a file that m.obj names";
    fails(2, replaced, joined(start, {"-o", "m.mtl", "--format", "ply"}));
    fails(2, "m.mtl: the report would replace a file that m.obj names",
          joined(start, {"-o", "t.csv", "--json", "in/../m.mtl"}));
    fails(2, "m.mtl: the samples would replace a file that m.dat names",
          {"sample", "n.dat", "--from", "m.dat", "--mesh-format", "obj", "-d", "0.2", "-o", "m.mtl",
           "--format", "ply"});
    folder.write("tile.1001.png", "kept");
    fails(2, "tile.1001.png: the samples would replace the texture",
          {"sample", "n.dat", "--mesh-format", "obj", "-d", "0.2", "--texture", "tile.<UDIM>.png",
           "-o", "tile.1001.png", "--format", "csv"});
    CHECK(bytes_of(folder / "tile.1001.png") == "kept");
    Setting piped;
    piped.stdin_path = (folder / "m.obj").string();
    fails(3, "'x.mtl' is not read, as a mesh from a stream has no folder",
          {"sample", "-", "--mesh-format", "obj", "-d", "0.2", "--texture", "auto", "-o", "m.mtl",
           "--format", "ply"},
          piped);

    // Beyond the folder of the mesh only where it is trusted, which a batch hands on.
    folder.write("in/m.obj", "mtllib ../m.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl a\nf 1 2 3\n");
    const Arguments outside{"sample", "in/m.obj", "-d", "0.2", "--texture", "auto", "-o", "u.csv"};
    fails(3, "in/m.obj: its material file '../m.mtl' is not a file of its folder", outside);
    CHECK(run(folder, joined(outside, {"--allow-outside"})).status == 0);
    folder.write("list.txt", "in/m.obj --allow-outside\n");
    const Outcome batch =
        run(folder, {"batch", "list.txt", "-o", "out", "-d", "0.2", "--texture", "auto"});
    INFO(batch.err);
    CHECK(batch.status == 0);
    CHECK(contains(bytes_of(folder / "out/batch.jsonl"), "--allow-outside"));
}

TEST_CASE("attributes that a mesh lacks, and formats that lack columns, are refused") {
    const TemporaryFolder folder;
    folder.write("roof.obj", kRoof);
    const auto fails = [&](int status, const char* part, const Arguments& more) {
        check_fails(folder, status, part, joined({"sample", "roof.obj", "-d", "0.5"}, more));
    };
    fails(3, "roof.obj: has no attribute 'heat'; it has color and uv",
          {"-o", "a.csv", "--attributes", "heat"});
    fails(2, "so no column of --attributes", {"-o", "a.xyz", "--attributes", "all"});
    fails(2, "so no column of --frames", {"-o", "a.obj", "--frames"});
    fails(2, "so no column of --texture", {"-o", "a.xyz", "--texture", "missing.png"});
    fails(3, "nowhere.png", {"-o", "a.csv", "--texture", "nowhere.png"});
    fails(2, "--attributes: uv is given twice", {"-o", "a.csv", "--attributes", "uv,uv"});
    folder.write("four.off", "nOFF\n4 3 1 0\n0 0 0 0\n1 0 0 0\n0 1 0 1\n3 0 1 2\n");
    check_fails(folder, 2, "--frames needs a mesh with 3 coordinates per vertex; this one has 4",
                {"sample", "four.off", "-o", "a.csv", "-d", "0.5", "--frames"});
}

TEST_CASE("attributes that a float does not hold are refused by glTF, and doubles in USD") {
    const TemporaryFolder folder;
    const auto mesh = [](const std::string& type, const std::string& a, const std::string& b) {
        return "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\n"
               "property float z\nelement face 2\nproperty list uchar int vertex_indices\n"
               "property " +
               type + " mark\nend_header\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n3 0 1 2 " + a + "\n3 0 2 3 " +
               b + '\n';
    };
    folder.write("labels.ply", mesh("uint", "4000000001", "4000000003"));
    folder.write("large.ply", mesh("double", "1e300", "-1e300"));
    folder.write("small.ply", mesh("uint", "7", "16777216"));
    const auto sampled = [](const std::string& name, const std::string& out) {
        return Arguments{"sample", name, "-o", out, "-d", "0.3", "--attributes", "mark"};
    };
    for (const std::string name : {"labels.ply", "large.ply"}) {
        CAPTURE(name);
        check_fails(folder, 2, "glTF holds attributes as floats", sampled(name, "a.glb"));
        REQUIRE(run(folder, sampled(name, "a.usda")).status == 0);
        CHECK(bytes_of(folder / "a.usda").find("double[] primvars:mark") != std::string::npos);
    }
    CHECK(bytes_of(folder / "a.usda").find("1e+300") != std::string::npos);
    CHECK(run(folder, sampled("small.ply", "b.glb")).status == 0);
}

TEST_CASE("no two columns of a file have one name") {
    const TemporaryFolder folder;
    const auto mesh = [](const std::string& name) {
        return "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\n"
               "property float z\nproperty uchar red\nproperty uchar green\nproperty uchar blue\n"
               "property float " +
               name +
               "\nelement face 2\nproperty list uchar int vertex_indices\nend_header\n"
               "0 0 0 1 2 3 4\n1 0 0 1 2 3 5\n1 1 0 1 2 3 6\n0 1 0 1 2 3 7\n3 0 1 2\n3 0 2 3\n";
    };
    folder.write("vertex.ply", mesh("vertex"));
    folder.write("rgb.ply", mesh("rgb"));
    const auto sampled = [](const std::string& name, const std::string& attributes,
                            const std::string& out) {
        return Arguments{"sample", name, "-o", out, "-d", "0.3", "--attributes", attributes};
    };
    check_fails(folder, 3, "the attribute 'vertex' has the name of a column of samples",
                joined(sampled("vertex.ply", "vertex", "a.csv"), {"--at-vertices"}));
    check_fails(folder, 2, "a.pcd: two columns would be called 'rgb'",
                sampled("rgb.ply", "all", "a.pcd"));
    CHECK(run(folder, sampled("rgb.ply", "rgb", "a.pcd")).status == 0);
    CHECK(run(folder, sampled("rgb.ply", "all", "a.vtp")).status == 0);
    folder.write("five.txt", "0 0 0 0\n1 0 0 1\n1 1 0 0\n0 1 0 1\n");
    folder.write("coordinates.ply", mesh("coordinates"));
    check_fails(
        folder, 2, "a.vtp: two columns would be called 'coordinates'",
        joined(sampled("coordinates.ply", "coordinates", "a.vtp"), {"--coordinates", "five.txt"}));
}

TEST_CASE("columns that have none somewhere are -1 in glTF") {
    const TemporaryFolder folder;
    folder.write("a.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3\ng top\nf 1 3 4\n");
    REQUIRE(run(folder, {"sample", "a.obj", "-d", "0.2", "--columns", "group", "-o", "a.gltf"})
                .status == 0);
    const Json document = Json::parse(bytes_of(folder / "a.gltf"));
    const Json& attributes = document["meshes"][0]["primitives"][0]["attributes"];
    const Json& group = document["accessors"][attributes["_GROUP"].get<std::size_t>()];
    CHECK(group["min"][0] == -1);
    CHECK(group["max"][0] == 0);
}

TEST_CASE("scenes are turned as pictures guess, as an option says, or as glTF is") {
    const TemporaryFolder folder;
    REQUIRE(run(folder, {"shapes", "terrain:10", "-o", "t.ply"}).status == 0);
    const auto made = [&](const Arguments& more) {
        return run(folder, joined({"sample", "t.ply", "-d", "20%"}, more));
    };
    const Outcome guessed = made({"-o", "a.usda", "--json", "a.json"});
    INFO(guessed.out, guessed.err);
    REQUIRE(guessed.status == 0);
    CHECK(contains(guessed.out, "scene         z up, a guess, --up sets it; a unit is 1 m\n"));
    CHECK(contains(bytes_of(folder / "a.usda"), "upAxis = \"Z\""));
    CHECK(json_in(folder, "a.json")["scene"]["up"] == "z");
    const Outcome set = made({"-o", "b.usda", "--up", "y", "--units", "cm"});
    CHECK(contains(set.out, "scene         y up, as --up says; a unit is 0.01 m\n"));
    CHECK(contains(bytes_of(folder / "b.usda"), "upAxis = \"Y\""));
    CHECK(contains(bytes_of(folder / "b.usda"), "metersPerUnit = 0.01\n"));
    const Outcome turned = made({"-o", "c.gltf"});
    CHECK(contains(turned.out, "z up, a guess, --up sets it; turned, as the format has another"));
    CHECK(contains(bytes_of(folder / "c.gltf"), "\"rotation\""));
    REQUIRE(run(folder,
                {"batch", "t.ply", "-d", "20%", "-o", "out", "--format", "usda", "--units", "ft"})
                .status == 0);
    CHECK(contains(bytes_of(folder / "out/t.usda"), "metersPerUnit = 0.3048\n"));
    REQUIRE(made({"-o", "d.ply"}).status == 0);
    CHECK(contains(run(folder, {"transfer", "d.ply", "t.ply", "t.ply", "-o", "d.usda"}).out,
                   "scene         z up, a guess"));
    REQUIRE(run(folder, {"cells", "t.ply", "d.ply", "-o", "e.usda", "--up", "x"}).status == 0);
    CHECK(contains(bytes_of(folder / "e.usda"), "rotateY"));
    REQUIRE(run(folder, {"box", "--dim", "3", "-n", "9", "-o", "f.usda", "--up", "z"}).status == 0);
    CHECK(contains(bytes_of(folder / "f.usda"), "upAxis = \"Z\""));
    check_fails(folder, 2, "--units is for samples in",
                {"sample", "builtin:cube", "-d", "1", "-o", "g.ply", "--units", "m"});
    check_fails(folder, 2, "--up is for samples in",
                {"sample", "builtin:cube", "-d", "1", "-o", "g.ply", "--up", "z"});
    check_fails(folder, 2, "is neither mm, cm, m",
                {"sample", "builtin:cube", "-d", "1", "-o", "g.usda", "--units", "league"});
}

} // namespace geodisk::test
