// Radii that vary: sampled from every source, written, verified, and refused where they cannot be.
#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <set>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "cli/command.hpp"
#include "files/samples/sample_file.hpp"
#include "unit/gltf_parts.hpp"
#include "unit/png_bytes.hpp"

namespace geodisk::test {
namespace {

constexpr int kParts = 24; // Of each side of the square.

/// A unit square as PLY: vertex properties q = 0.2 to 1 along x, s t = x y, and a mask m of 0 and
/// 255 that begins at x = 0.5.
void write_square(const TemporaryFolder& folder) {
    std::string vertices, faces, values, obj;
    for (int y = 0; y <= kParts; ++y) {
        for (int x = 0; x <= kParts; ++x) {
            const std::string at =
                std::to_string(x / double{kParts}) + " " + std::to_string(y / double{kParts});
            const std::string g = std::to_string(0.2 + 0.8 * x / kParts);
            vertices.append(at).append(" 0 ").append(g).append(" ").append(at);
            vertices.append(2 * x < kParts ? " 0\n" : " 255\n");
            values.append(g).append("\n");
            obj.append("v ").append(at).append(" 0\nvt ").append(at).append("\n");
        }
    }
    for (int y = 0; y < kParts; ++y) {
        for (int x = 0; x < kParts; ++x) {
            const int a = y * (kParts + 1) + x, b = a + kParts + 1;
            const int quad[] = {a, a + 1, b + 1, b};
            faces += "4";
            obj += "f";
            for (const int v : quad) {
                const std::string number = std::to_string(v + 1);
                faces.append(" ").append(std::to_string(v));
                obj.append(" ").append(number).append("/").append(number);
            }
            faces += "\n";
            obj += "\n";
        }
    }
    const int count = (kParts + 1) * (kParts + 1);
    folder.write("mesh.ply",
                 "ply\nformat ascii 1.0\nelement vertex " + std::to_string(count) +
                     "\nproperty float x\nproperty float y\nproperty float z\nproperty float q\n"
                     "property float s\nproperty float t\nproperty uchar m\nelement face " +
                     std::to_string(kParts * kParts) +
                     "\nproperty list uchar int vertex_indices\nend_header\n" + vertices + faces);
    folder.write("mesh.obj", obj);
    folder.write("g.txt", values);
    // Grey that rises from left to right.
    folder.write("g.png", tools::png_bytes(4, 1, "\x40\x80\xc0\xff"));
}

/// Samples and verifies with the same options, and without; returns the samples.
tools::SampleFile check_passes(const TemporaryFolder& folder, const std::string& mesh,
                               const Arguments& density, const std::string& output = "a.ply",
                               const Arguments& surface = {}) {
    const Outcome made =
        run(folder, joined(joined({"sample", mesh, "-o", output, "-n", "800"}, surface), density));
    INFO(made.err);
    REQUIRE(made.status == 0);
    CHECK(contains(made.out, "radii         0."));
    for (const bool is_told : {true, false}) {
        const Outcome verified = run(folder, joined(joined({"verify", mesh, output}, surface),
                                                    is_told ? density : Arguments()));
        INFO(verified.out, verified.err);
        CHECK(verified.status == 0);
        CHECK(contains(verified.out, "violations    0\n"));
        CHECK(contains(verified.out, "of the sum of two radii\n"));
        CHECK(contains(verified.out, "as the file has them") != is_told);
    }
    tools::SampleFile samples = tools::read_samples(folder / output);
    CHECK(std::abs(static_cast<double>(samples.rows.size()) - 800) < 120);
    return samples;
}

double header_number(const tools::SampleFile& samples, const std::string& key) {
    for (const auto& [name, value] : samples.header.entries) {
        if (name == key) {
            return std::stod(value);
        }
    }
    return NAN;
}

/// Writes a square whose vertices have colours, and texture coordinates that are their places, in
/// all formats that hold some.
void write_coloured_squares(const TemporaryFolder& folder) {
    folder.write("a.obj", "v 0 0 0 1 0 1\nv 1 0 0 0 1 1\nv 1 1 0 0 1 1\nv 0 1 0 0 1 1\n"
                          "v 2 0 0 0 1 1\nf 1 2 3\nf 1 3 4\nf 2 5 3\n");
    folder.write("t.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 2 0 0\nvt 0 0\nvt 0.25 0\n"
                          "vt 0.25 0.25\nvt 0 0.25\nvt 0.5 0\n"
                          "f 1/1 2/2 3/3\nf 1/1 3/3 4/4\nf 2/2 5/5 3/3\n");
    const auto ply = [](const std::string& type, const std::string& one) {
        const std::string on = " " + one + " 0 " + one + "\n", off = " 0 " + one + " " + one + "\n";
        const std::string property = "property " + type;
        return "ply\nformat ascii 1.0\nelement vertex 5\nproperty float x\nproperty float y\n"
               "property float z\n" +
               property + " red\n" + property + " green\n" + property + " blue\n" +
               "element face 3\nproperty list uchar int vertex_indices\nend_header\n0 0 0" + on +
               "1 0 0" + off + "1 1 0" + off + "0 1 0" + off + "2 0 0" + off +
               "3 0 1 2\n3 0 2 3\n3 1 4 2\n";
    };
    folder.write("a.ply", ply("uchar", "255"));
    folder.write("p.ply", ply("float", "1"));
    folder.write("a.off", "COFF\n5 3 0\n0 0 0 1.0 0.0 1.0 1.0\n1 0 0 0.0 1.0 1.0 1.0\n"
                          "1 1 0 0.0 1.0 1.0 1.0\n0 1 0 0.0 1.0 1.0 1.0\n2 0 0 0.0 1.0 1.0 1.0\n"
                          "3 0 1 2\n3 0 2 3\n3 1 4 2\n");
    tools::LongerSquare square;
    const std::string positions = std::to_string(
        square.add(tools::bytes_of_values<float>({0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0, 2, 0, 0}),
                   5126, 5, "VEC3"));
    const std::string colours = std::to_string(
        square.add(tools::bytes_of_values<float>({1, 0, 1, 0, 1, 1, 0, 1, 1, 0, 1, 1, 0, 1, 1}),
                   5126, 5, "VEC3"));
    const std::string uvs = std::to_string(
        square.add(tools::bytes_of_values<float>({0, 1, 0.25, 1, 0.25, 0.75, 0, 0.75, 0.5, 1}),
                   5126, 5, "VEC2"));
    const std::string corners = std::to_string(square.add(
        tools::bytes_of_values<std::uint32_t>({0, 1, 2, 0, 2, 3, 1, 4, 2}), 5125, 9, "SCALAR"));
    square.parts.primitives = R"([{"attributes": {"POSITION": )" + positions + R"(, "COLOR_0": )" +
                              colours + R"(, "TEXCOORD_0": )" + uvs + R"(}, "indices": )" +
                              corners + "}]";
    folder.write("mesh.bin", square.buffer);
    folder.write("a.gltf", tools::text_of(square.parts));
}

} // namespace

TEST_CASE("radii from every source are sampled, written and verified") {
    const TemporaryFolder folder;
    write_square(folder);
    const auto of_attribute = check_passes(folder, "mesh.ply", {"--radius-factor", "q"});
    const auto of_file =
        check_passes(folder, "mesh.obj", {"--radius-factor", "file:g.txt"}, "a.csv");
    CHECK(of_file.rows.size() == of_attribute.rows.size());
    for (const auto& samples : {of_attribute, of_file}) {
        const double largest = header_number(samples, "radius");
        std::size_t wrong = 0;
        for (const tools::SampleRow& row : samples.rows) {
            wrong += std::abs(row.radius / largest - (0.2 + 0.8 * row.position[0])) > 1e-5;
        }
        CHECK(wrong == 0);
        // Small disks lie to the left.
        const auto left = std::count_if(samples.rows.begin(), samples.rows.end(),
                                        [](const auto& row) { return row.position[0] < 0.5; });
        CHECK(left > static_cast<std::ptrdiff_t>(2 * samples.rows.size() / 3));
    }
    const auto of_map = check_passes(folder, "mesh.ply", {"--radius-factor", "map:g.png"});
    CHECK(check_passes(folder, "mesh.obj", {"--radius-factor", "map:g.png"}).rows.size() ==
          of_map.rows.size());
    const auto curved =
        check_passes(folder, "builtin:torus-knot:8", {"--radius-factor", "curvature"});
    const auto clipped =
        check_passes(folder, "builtin:torus-knot:8",
                     {"--radius-factor", "curvature", "--radius-factor-floor", "0.9"});
    CHECK(header_number(curved, "radius") > header_number(clipped, "radius"));
}

TEST_CASE("radii that vary go with lifts, edge lengths and more dimensions") {
    const TemporaryFolder folder;
    write_square(folder);
    REQUIRE(run(folder, {"sample", "mesh.ply", "-o", "a.ply", "-n", "100", "--lift",
                         "attribute:q:0.5", "--radius-factor", "s", "--radius-factor-floor", "0.3"})
                .status == 0);
    CHECK(run(folder, {"verify", "mesh.ply", "a.ply", "--lift", "attribute:q:0.5",
                       "--radius-factor", "s", "--radius-factor-floor", "0.3"})
              .status == 0);
    check_passes(folder, "builtin:klein-bottle:12", {"--density", "curvature"});
    folder.write("bare.obj", "f 1 2 3\nf 1 4 2\nf 2 4 3\nf 3 4 1\n");
    folder.write("lengths.txt", "1 2 3\n2 3 4\n1 3 5\n3 4 3.5\n1 4 4.5\n2 4 5\n");
    folder.write("g4.txt", "1\n0.5\n0.25\n0.5\n");
    const Arguments surface{"--edge-lengths", "lengths.txt"};
    check_passes(folder, "bare.obj", {"--radius-factor", "file:g4.txt"}, "a.ply", surface);
    check_fails(folder, 2, "curvature needs a mesh with coordinates",
                joined({"sample", "bare.obj", "-o", "b.ply", "-n", "9", "--density", "curvature"},
                       surface));
}

TEST_CASE("what is wrong with the radii of a file is found") {
    const TemporaryFolder folder;
    write_square(folder);
    const Arguments density{"--radius-factor", "q"};
    tools::SampleFile samples = check_passes(folder, "mesh.ply", density);
    samples.rows[5].radius *= 1.5;
    tools::write_samples(folder / "b.csv", samples.header, samples.rows, false);
    const Outcome told = run(folder, joined({"verify", "mesh.ply", "b.csv"}, density));
    CHECK(told.status == 1);
    CHECK(contains(told.err, "b.csv: 1 radius is not what the density options give"));
    CHECK(contains(told.out, "violations    0\nwrong radii   1\n"));
    CHECK(contains(told.out, "radius_factor attribute:q\n"));
    samples.rows[5].radius *= 10;
    tools::write_samples(folder / "b.csv", samples.header, samples.rows, false);
    const Outcome read = run(folder, {"verify", "mesh.ply", "b.csv"});
    CHECK(read.status == 1);
    CHECK(contains(read.err, "pairs of samples are closer than the sum of their radii"));
    CHECK(contains(read.out, "samples 5 and "));
    CHECK(contains(read.out, " of the sum of their radii\n"));
    // A distance overrides the file's radii: then it must hold for all pairs.
    CHECK(run(folder, {"verify", "mesh.ply", "a.ply", "-d", "1e-4"}).status == 0);
    CHECK(run(folder, {"verify", "mesh.ply", "a.ply", "-d", "0.1"}).status == 1);
    // Without radii in the file they are computed.
    for (tools::SampleRow& row : samples.rows) {
        row.radius = 0;
    }
    tools::write_samples(folder / "b.csv", samples.header, samples.rows, false);
    CHECK(run(folder, joined({"verify", "mesh.ply", "b.csv"}, density)).status == 0);
    CHECK(run(folder, {"verify", "mesh.ply", "b.csv"}).status == 1);
}

TEST_CASE("a density has samples in proportion, and none where it is 0") {
    const TemporaryFolder folder;
    write_square(folder);
    const auto left_of = [](const tools::SampleFile& samples, double x) {
        return std::count_if(samples.rows.begin(), samples.rows.end(),
                             [x](const auto& row) { return row.position[0] < x; });
    };
    const auto mask = check_passes(folder, "mesh.ply", {"--density", "m"}, "m.csv");
    CHECK(left_of(mask, 0.5 - 1.0 / kParts) == 0);
    CHECK(left_of(mask, 0.5) < 40);
    for (const char* const source : {"attribute:s", "map:g.png", "file:g.txt"}) {
        const auto ramp = check_passes(folder, "mesh.ply", {"--density", source});
        CHECK(2 * left_of(ramp, 0.5) < static_cast<std::ptrdiff_t>(ramp.rows.size()));
    }
    // The distance is the least one, in the options, the header and the report.
    const Outcome made = run(folder, {"sample", "mesh.ply", "-o", "d.csv", "-d", "0.02",
                                      "--density", "s", "--json", "-"});
    REQUIRE(made.status == 0);
    const auto report = nlohmann::json::parse(made.out);
    CHECK(report["min_distance"] == 0.02);
    CHECK(report["mesh"]["density"] == "attribute:s");
    CHECK(report["sample_radii"]["least"] >= 0.01 - 1e-9);
    const auto samples = tools::read_samples(folder / "d.csv");
    CHECK(header_number(samples, "min_distance") == 0.02);
    const Outcome checked =
        run(folder, {"verify", "mesh.ply", "d.csv", "--density", "s", "-d", "0.02"});
    CHECK(checked.status == 0);
    CHECK(contains(checked.out, "min distance  0.02 in mesh units\n"));
    CHECK(run(folder, {"verify", "mesh.ply", "d.csv", "-d", "0.0199"}).status == 0);
    const Outcome told =
        run(folder, {"sample", "mesh.ply", "-o", "e.csv", "-d", "0.02", "--density", "s"});
    INFO(told.out);
    CHECK(contains(told.out, "min distance  0.02 to 0.09797"));
}

TEST_CASE("aliases of options for radius factors mean the same, with a warning") {
    const TemporaryFolder folder;
    write_square(folder);
    const auto set = [&](const std::string& mesh, const Arguments& density, std::string& warnings) {
        std::filesystem::remove(folder / "o.csv");
        const Outcome made =
            run(folder, joined({"sample", mesh, "-o", "o.csv", "-n", "200"}, density));
        INFO(made.err);
        REQUIRE(made.status == 0);
        warnings = made.err;
        return tools::read_samples(folder / "o.csv").rows;
    };
    std::string warnings, none;
    const auto same = [](const auto& a, const auto& b) {
        return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const auto& x, const auto& y) {
            return x.face == y.face && x.bary[1] == y.bary[1] && x.radius == y.radius;
        });
    };
    CHECK(same(set("mesh.ply", {"--density-attribute", "q"}, warnings),
               set("mesh.ply", {"--radius-factor", "q"}, none)));
    CHECK(contains(warnings, "--density-attribute gives factors of the radius and is now "
                             "--radius-factor attribute:q; for a density, where more means more "
                             "samples, give --density attribute:q\n"));
    CHECK(none.empty());
    CHECK(same(
        set("mesh.ply", {"--density-map", "g.png", "--density-floor", "0.5"}, warnings),
        set("mesh.ply", {"--radius-factor", "map:g.png", "--radius-factor-floor", "0.5"}, none)));
    CHECK(same(set("builtin:torus-knot:8", {"--density-curvature"}, warnings),
               set("builtin:torus-knot:8", {"--density", "curvature"}, none)));
    CHECK(contains(warnings, "--density-curvature is now --density curvature"));
    CHECK(none.empty());
}

TEST_CASE("the report tells of radii that vary") {
    const TemporaryFolder folder;
    write_square(folder);
    const Outcome made = run(folder, {"sample", "mesh.ply", "-o", "a.xyz", "-r", "0.05",
                                      "--radius-factor", "q", "--json", "-"});
    REQUIRE(made.status == 0);
    const auto report = nlohmann::json::parse(made.out);
    CHECK(report["mesh"]["radius_factor"] == "attribute:q");
    CHECK(report["radius"] == 0.05);
    CHECK(report["sample_radii"]["least"] >= 0.01);
    CHECK(report["sample_radii"]["most"] <= 0.05);
    CHECK(report["rho"] > 0.6);
    const Outcome plain =
        run(folder, {"sample", "mesh.ply", "-o", "b.csv", "-r", "0.05", "--json", "-"});
    CHECK(nlohmann::json::parse(plain.out)["sample_radii"].is_null());
    CHECK_FALSE(contains(bytes_of(folder / "b.csv"), "bary_w,radius"));
}

TEST_CASE("the smallest radii count as a thousandth of the largest, with a warning") {
    const TemporaryFolder folder;
    write_square(folder);
    const std::string values = bytes_of(folder / "g.txt");
    const auto write_with_first = [&](const std::string& file, const std::string& first) {
        folder.write(file, first + values.substr(values.find('\n')));
    };
    write_with_first("tiny.txt", "1e-9");
    write_with_first("small.txt", "0.001");
    const auto sample = [&](const std::string& g, const std::string& output) {
        const Outcome outcome = run(folder, {"sample", "mesh.ply", "-o", output, "-d", "0.2",
                                             "--radius-factor", "file:" + g});
        REQUIRE(outcome.status == 0);
        return outcome.err;
    };
    CHECK(sample("tiny.txt", "a.csv") ==
          "geodisk: warning: tiny.txt: g is below 0.001 at 1 vertex, first at vertex 0 (from 0), "
          "and counts as 0.001 there\n");
    CHECK(sample("small.txt", "b.csv").empty());
    const auto rows = [&](const char* file) {
        const std::string bytes = bytes_of(folder / file);
        return bytes.substr(bytes.find("x,y,z"));
    };
    CHECK(rows("a.csv") == rows("b.csv"));
    CHECK(run(folder, {"verify", "mesh.ply", "a.csv", "--density-file", "tiny.txt"}).status == 0);
}

TEST_CASE("a density or mask is any attribute of any format") {
    const TemporaryFolder folder;
    write_coloured_squares(folder);
    std::set<std::string> sets, masked;
    for (const char* const mesh : {"a.ply", "a.obj", "a.off", "a.gltf", "p.ply"}) {
        CAPTURE(mesh);
        const auto samples = [&](const Arguments& where) {
            const Outcome made = run(
                folder, joined({"sample", mesh, "-o", "-", "--format", "xyz", "-n", "300"}, where));
            CHECK_MESSAGE(made.status == 0, made.err);
            return made.out;
        };
        sets.insert(samples({"--density", "red"}));
        masked.insert(samples({"--mask", "red<1", "--radius-factor", "blue"}));
        CHECK(samples({"--density", "attribute:color"}) != "");
    }
    CHECK(sets.size() == 1);
    CHECK(masked.size() == 1);
    check_fails(folder, 3, "a.gltf: 'uv' is of several numbers; give one of them: u and v",
                {"sample", "a.gltf", "-o", "b.ply", "-n", "9", "--density", "uv"});
    check_fails(folder, 3, "a.gltf: has no attribute 'rad'; it has color and uv",
                {"sample", "a.gltf", "-o", "b.ply", "-n", "9", "--density", "rad"});
    // Images too.
    folder.write("grey.png", tools::png_bytes(2, 1, std::string_view("\xff\x40", 2)));
    std::set<std::string> mapped;
    for (const char* const mesh : {"t.obj", "a.gltf"}) {
        const Outcome made = run(folder, {"sample", mesh, "-o", "-", "--format", "xyz", "-n", "300",
                                          "--density", "map:grey.png"});
        CHECK_MESSAGE(made.status == 0, made.err);
        mapped.insert(made.out);
    }
    CHECK(mapped.size() == 1);
}

TEST_CASE("a density of faces goes to vertices by area") {
    const TemporaryFolder folder;
    write_square(folder);
    folder.write("f.ply", "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\n"
                          "property float y\nproperty float z\nelement face 2\n"
                          "property list uchar int vertex_indices\nproperty float w\nend_header\n"
                          "0 0 0\n1 0 0\n1 3 0\n0 1 0\n3 0 1 2 1\n3 0 2 3 4\n");
    // Areas of 1.5 and 0.5: vertices 0 and 2 have (1.5 * 1 + 0.5 * 4) / 2.
    folder.write("w.txt", "1.75\n1\n1.75\n4\n");
    const auto points = [&](const std::string& source) {
        const Outcome made = run(folder, {"sample", "f.ply", "-o", "-", "--format", "xyz", "-n",
                                          "200", "--density", source});
        CHECK_MESSAGE(made.status == 0, made.err);
        return made.out;
    };
    CHECK(points("w") == points("file:w.txt"));
}

TEST_CASE("radii that cannot be are refused, naming file and vertex") {
    const TemporaryFolder folder;
    write_square(folder);
    const auto fails = [&](int status, const std::string& part, const Arguments& density,
                           const std::string& mesh = "mesh.ply") {
        check_fails(folder, status, part,
                    joined({"sample", mesh, "-o", "a.ply", "-n", "9"}, density));
    };
    fails(3, "mesh.ply: has no attribute 'w'; it has", {"--radius-factor", "w"});
    fails(3, "mesh.obj: has no attribute 'q'", {"--radius-factor", "q"}, "mesh.obj");
    fails(3,
          "mesh.ply: 's': the radius factor g of vertex 0 (from 0) is 0; it must be from 0.001 "
          "to 1; for a density, where 0 means no samples, give --density attribute:s",
          {"--radius-factor", "s"});
    for (const char* const old : {"--density-attribute", "--radius-factor"}) {
        fails(3,
              "g of vertex 12 (from 0) is 255; it must be from 0.001 to 1; for a density, where 0 "
              "means no samples, give --density attribute:m",
              {old, "m", "--radius-factor-floor", "0.1"});
    }
    fails(3, "mesh.ply: 'z': all radius factors g are zero", {"--radius-factor", "z"});
    fails(3, "'z': all radius factors g are zero",
          {"--radius-factor", "z", "--radius-factor-floor", "0.5"});
    fails(3, "none.txt: no such file", {"--radius-factor", "file:none.txt"});
    folder.write("short.txt", "1\n0.5\n");
    fails(3, "short.txt: has 2 values for the 625 vertices of the mesh",
          {"--radius-factor", "file:short.txt"});
    std::string values = bytes_of(folder / "g.txt");
    const auto with_first = [&](const std::string& first) {
        folder.write("bad.txt", first + values.substr(values.find('\n')));
    };
    with_first("-0.1");
    fails(3,
          "bad.txt: the radius factor g of vertex 0 (from 0) is -0.1; it must be from 0.001 to 1",
          {"--radius-factor", "file:bad.txt", "--radius-factor-floor", "0.1"});
    with_first("1.5");
    fails(3, "vertex 0 (from 0) is 1.5", {"--radius-factor", "file:bad.txt"});
    with_first("nan");
    fails(3, "bad.txt: line 1: 'nan' is not finite", {"--radius-factor", "file:bad.txt"});
    fails(3, "none.png: no such file", {"--radius-factor", "map:none.png"});
    fails(3, "g.txt: is no PNG, JPEG, WebP, TGA or BMP image", {"--density", "map:g.txt"});
    fails(3, "builtin:cube: has no texture coordinates", {"--radius-factor", "map:g.png"},
          "builtin:cube");
    folder.write("black.png", tools::png_bytes(1, 1, std::string_view("\0", 1)));
    fails(3, "black.png: all radius factors g are zero", {"--radius-factor", "map:black.png"});
    fails(2, "--density and --density-map contradict each other",
          {"--density-map", "g.png", "--density", "file:g.txt"});
    fails(2, "--density-floor raises radius factors; give --radius-factor",
          {"--density-floor", "0.5"});
    fails(2, "--radius-factor-floor raises radius factors; --density takes 0 and any range",
          {"--density", "q", "--radius-factor-floor", "0.5"});
    fails(2, "--density-floor and --radius-factor-floor are the same",
          {"--radius-factor", "q", "--radius-factor-floor", "0.5", "--density-floor", "0.5"});
    fails(2, "--density-floor: '0' is not a number of 0.001 to 1",
          {"--density-curvature", "--density-floor", "0"});
    fails(2, "--density: 'g.txt' is a file; give file:g.txt", {"--density", "g.txt"});
    fails(2, "--density: 'map:' names nothing", {"--density", "map:"});
    fails(3, "black.png: the density is 0 everywhere, so no samples fit",
          {"--density", "map:black.png"});
    with_first("-0.1");
    fails(3,
          "bad.txt: the density of vertex 0 (from 0) is -0.1; it must be 0 or positive, and finite",
          {"--density", "file:bad.txt"});
    fails(3, "short.txt: has 2 values for the 625 vertices of the mesh",
          {"--density", "file:short.txt"});
    check_fails(folder, 2, "g.txt: the report would replace the density",
                {"sample", "mesh.ply", "-o", "a.ply", "-n", "9", "--density", "file:g.txt",
                 "--json", "g.txt"});
    check_fails(folder, 3, "no attribute 'w'", {"verify", "mesh.ply", "g.txt", "--density", "w"});
}

namespace {

/// A plane of two triangles, and images of 64 pixels a side: a black disc on white in hole.png, the
/// reverse in disc.png, of a radius of 20 pixels; in fine.png 1,000 stripes.
void write_plane(const TemporaryFolder& folder) {
    folder.write("two.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\n"
                            "f 1/1 2/2 3/3\nf 1/1 3/3 4/4\n");
    std::string hole, disc, fine;
    for (int y = 0; y < 64; ++y) {
        for (int x = 0; x < 64; ++x) {
            const bool is_in = std::hypot(x - 31.5, y - 31.5) < 20;
            hole += is_in ? '\0' : '\xff';
            disc += is_in ? '\xff' : '\0';
        }
    }
    for (int x = 0; x < 1000; ++x) {
        fine += x % 2 == 0 ? '\0' : '\xff';
    }
    folder.write("hole.png", tools::png_bytes(64, 64, hole));
    folder.write("disc.png", tools::png_bytes(64, 64, disc));
    folder.write("fine.png", tools::png_bytes(1000, 1, fine));
}

/// Samples, verifies with the same options, and returns how many samples lie nearer to the middle
/// than 18 pixels, between, and farther than 22.
std::array<std::size_t, 3> rings_of(const TemporaryFolder& folder, const Arguments& how) {
    const Outcome made =
        run(folder, joined({"sample", "two.obj", "-o", "a.ply", "-d", "0.02", "-q"}, how));
    INFO(made.err);
    REQUIRE(made.status == 0);
    CHECK(made.err.empty());
    const Outcome verified = run(folder, joined({"verify", "two.obj", "a.ply"}, how));
    INFO(verified.out, verified.err);
    CHECK(verified.status == 0);
    const Outcome plain = run(folder, {"verify", "two.obj", "a.ply"}); // On whole faces.
    INFO(plain.out, plain.err);
    CHECK(plain.status == 0);
    std::array<std::size_t, 3> rings{};
    for (const tools::SampleRow& row : tools::read_samples(folder / "a.ply").rows) {
        CHECK(row.face < 2);
        const double pixels = 64 * std::hypot(row.position[0] - 0.5, row.position[1] - 0.5);
        ++rings[pixels < 18 ? 0 : pixels < 22 ? 1 : 2];
    }
    return rings;
}

} // namespace

TEST_CASE("an image is read within faces, as a density and as a mask") {
    const TemporaryFolder folder;
    write_plane(folder);
    const std::size_t all = [&] {
        const auto rings = rings_of(folder, {});
        return rings[0] + rings[1] + rings[2];
    }();
    constexpr double kInner = 3.14159 * 18 * 18 / 4096, kOuter = 1 - 3.14159 * 22 * 22 / 4096;
    for (const Arguments& how : {Arguments{"--density", "map:hole.png"},
                                 {"--mask", "map:hole.png"},
                                 {"--mask", "map:disc.png<0.5"}}) {
        CAPTURE(how[1]);
        const auto rings = rings_of(folder, how);
        CHECK(rings[0] == 0);
        CHECK(rings[2] > 0.96 * kOuter * static_cast<double>(all));
        CHECK(rings[2] < 1.06 * kOuter * static_cast<double>(all));
    }
    for (const Arguments& how :
         {Arguments{"--density", "map:disc.png"}, {"--mask", "map:disc.png"}}) {
        CAPTURE(how[1]);
        const auto rings = rings_of(folder, how);
        CHECK(rings[2] == 0);
        // A fade has larger radii beside the disc.
        CHECK(rings[0] > 0.88 * kInner * static_cast<double>(all));
        CHECK(rings[0] < 1.07 * kInner * static_cast<double>(all));
    }
}

TEST_CASE("samples drawn on parts of faces go with the other options") {
    const TemporaryFolder folder;
    write_plane(folder);
    const Arguments mask{"--mask", "map:hole.png"};
    const auto made = [&](const Arguments& how) {
        return run(folder, joined(joined({"sample", "two.obj", "-q"}, how), mask));
    };
    REQUIRE(made({"-o", "a.ply", "-d", "0.05"}).status == 0);
    REQUIRE(made({"-o", "again.ply", "-d", "0.05", "--memory", "64M"}).status == 0);
    CHECK(tools::read_samples(folder / "a.ply").header.find("digest") != nullptr);
    CHECK(*tools::read_samples(folder / "a.ply").header.find("digest") ==
          *tools::read_samples(folder / "again.ply").header.find("digest"));
    // Kept samples stay where they are.
    REQUIRE(made({"-o", "more.ply", "-d", "0.04", "--existing", "a.ply"}).status == 0);
    const auto before = tools::read_samples(folder / "a.ply").rows;
    const auto after = tools::read_samples(folder / "more.ply").rows;
    REQUIRE(after.size() > before.size());
    for (std::size_t i = 0; i < before.size(); ++i) {
        CHECK(before[i].face == after[i].face);
        CHECK(before[i].bary[1] == after[i].bary[1]);
        CHECK(before[i].bary[2] == after[i].bary[2]);
    }
    for (const Arguments& how : {Arguments{"-d", "0.05", "--maximal"},
                                 {"-n", "200", "--exact"},
                                 {"-d", "0.1", "--classes", "2"},
                                 {"-d", "0.05", "--metric", "euclidean"},
                                 {"-n", "100", "--order", "progressive"}}) {
        CAPTURE(how.back());
        const Outcome outcome = made(joined({"-o", "b.ply"}, how));
        INFO(outcome.err);
        CHECK(outcome.status == 0);
        CHECK(run(folder, joined({"verify", "two.obj", "b.ply", "-q"}, mask)).status == 0);
    }
    CHECK(run(folder, joined({"analyze", "two.obj", "a.ply"}, mask)).status == 0);
    const Outcome refused = made({"-o", "c.ply", "-d", "0.05", "--features", "30"});
    CHECK(refused.status == 2);
    CHECK(contains(refused.err, "--features goes with no image that shows more than the corners"));
}

TEST_CASE("an image that is finer than faces are split says how fine it was read") {
    const TemporaryFolder folder;
    write_plane(folder);
    const Outcome made = run(
        folder, {"sample", "two.obj", "-o", "a.ply", "-d", "0.01", "--density", "map:fine.png"});
    CHECK(made.status == 0);
    CHECK(contains(made.err, "fine.png: is finer than faces are split for it: on large faces it is "
                             "read every 4 pixels"));
}

} // namespace geodisk::test
