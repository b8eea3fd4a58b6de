// Files that `geodisk sample` writes.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include <nlohmann/json.hpp>

#include <geodisk/version.hpp>

#include "cli/command.hpp"
#include "files/samples/sample_file.hpp"

namespace geodisk::test {
namespace {

/// Samples builtin:cube into `output` and returns the file's bytes.
std::string sample_cube(const TemporaryFolder& folder, const std::string& output,
                        const std::vector<std::string>& options) {
    std::vector<std::string> arguments{"sample", "builtin:cube", "-o", output};
    arguments.insert(arguments.end(), options.begin(), options.end());
    const Outcome outcome = run(folder, arguments);
    INFO(outcome.err);
    REQUIRE(outcome.status == 0);
    return bytes_of(folder / output);
}

std::string value_of(const tools::SampleHeader& header, const std::string& key) {
    for (const auto& [name, value] : header.entries) {
        if (name == key) {
            return value;
        }
    }
    return "missing";
}

/// All rows as CSV, the header comments left out.
std::vector<std::string> csv_rows(const std::string& bytes) {
    std::vector<std::string> lines = lines_of(bytes);
    std::erase_if(lines, [](const std::string& line) { return line.starts_with("#"); });
    return lines;
}

void check_row(const tools::SampleRow& row) {
    CHECK(row.face < 12);
    CHECK(row.bary[0] + row.bary[1] + row.bary[2] == 1.0f);
    double normal_length = 0;
    double largest = 0;
    for (int axis = 0; axis < 3; ++axis) {
        normal_length +=
            static_cast<double>(row.normal[axis]) * static_cast<double>(row.normal[axis]);
        largest = std::max(largest, std::abs(static_cast<double>(row.normal[axis])));
    }
    CHECK(normal_length == doctest::Approx(1));
    CHECK(largest == doctest::Approx(1)); // The faces of a cube are square to the axes.
}

} // namespace

TEST_CASE("all formats hold the same samples") {
    const TemporaryFolder folder;
    const std::string binary = sample_cube(folder, "a.ply", {"-d", "0.2"});
    const std::string ascii = sample_cube(folder, "b.ply", {"-d", "0.2", "--ascii"});
    const std::string csv = sample_cube(folder, "c.csv", {"-d", "0.2"});
    const std::string xyz = sample_cube(folder, "d.xyz", {"-d", "0.2"});
    CHECK(binary.starts_with("ply\nformat binary_little_endian 1.0\ncomment "));
    CHECK(ascii.starts_with("ply\nformat ascii 1.0\ncomment "));
    CHECK(contains(csv, "\nx,y,z,nx,ny,nz,face_index,bary_u,bary_v,bary_w\n"));
    const auto a = tools::read_samples(folder / "a.ply").rows;
    const auto b = tools::read_samples(folder / "b.ply").rows;
    const auto c = tools::read_samples(folder / "c.csv").rows;
    REQUIRE(a.size() > 50);
    REQUIRE(b.size() == a.size());
    REQUIRE(c.size() == a.size());
    REQUIRE(lines_of(xyz).size() == a.size());
    for (std::size_t i = 0; i < a.size(); ++i) {
        check_row(a[i]);
        CHECK((a[i].face == b[i].face && a[i].face == c[i].face));
        CHECK((std::equal(a[i].bary, a[i].bary + 3, b[i].bary) &&
               std::equal(a[i].bary, a[i].bary + 3, c[i].bary)));
        CHECK(a[i].position[0] == doctest::Approx(c[i].position[0]));
    }
}

TEST_CASE("the format is that of --format or of the extension") {
    const TemporaryFolder folder;
    const std::string csv = sample_cube(folder, "a.csv", {"-d", "0.2"});
    CHECK(sample_cube(folder, "a.txt", {"-d", "0.2", "--format", "csv"}) == csv);
    const std::string npz = sample_cube(folder, "a.npz", {"-d", "0.2"});
    CHECK(npz.starts_with("PK"));
    CHECK(sample_cube(folder, "b.npz", {"-d", "0.2"}) == npz);
    CHECK(sample_cube(folder, "a.pcd", {"-d", "0.2"}).starts_with("# .PCD v0.7"));
    CHECK(contains(sample_cube(folder, "a.obj", {"-d", "0.2"}), "# min_distance: 0.2\n"));
    check_fails(folder, 2, "--format: 'las' is no sample format",
                {"sample", "builtin:cube", "-o", "b.las", "-n", "9", "--format", "las"});
    CHECK(run(folder, {"verify", "builtin:cube", "a.npz"}).status == 0);
    sample_cube(folder, "a.glb", {"-d", "0.2"});
    check_fails(folder, 3, "geodisk writes samples as .glb but does not read them back",
                {"verify", "builtin:cube", "a.glb"});
    check_fails(folder, 2, "an .obj file holds three coordinates",
                {"sample", "builtin:veronese:2", "-o", "b.obj", "-n", "9"});
}

TEST_CASE("a dry run tells what to expect and writes nothing") {
    const TemporaryFolder folder;
    const Arguments job{"sample", "builtin:cube", "-d", "0.2"};
    const Outcome text = run(folder, joined(job, {"--dry-run"}));
    INFO(text.err);
    REQUIRE(text.status == 0);
    for (const char* const part :
         {"min distance  0.2 ", "samples       about ", " expected\n", "candidates    about ",
          "memory        ", " sampling, measured", "file          none, this was a dry run\n"}) {
        CHECK(contains(text.out, part));
    }
    const Outcome exact =
        run(folder, {"sample", "builtin:cube", "--dry-run", "-n", "90", "--exact"});
    INFO(exact.err);
    CHECK(exact.status == 0);
    const Outcome report = run(folder, joined(job, {"--dry-run", "-o", "a.ply", "--json", "-"}));
    REQUIRE(report.status == 0);
    const auto document = nlohmann::json::parse(report.out);
    CHECK(document.at("dry_run") == true);
    CHECK(document.at("pilot_part") == 1);
    CHECK(document.at("device_bytes") > 0);
    CHECK(files_in(folder).empty());
    const double expected = document.at("expected_samples");
    CHECK(document.at("expected_candidates").get<double>() ==
          doctest::Approx(20 * expected).epsilon(0.1));
    const auto rows = csv_rows(sample_cube(folder, "a.csv", {"-d", "0.2"}));
    CHECK(static_cast<double>(rows.size()) == doctest::Approx(expected).epsilon(0.2));

    const Outcome box = run(folder, {"box", "--dim", "2", "-n", "99", "--dry-run"});
    CHECK(box.status == 0);
    CHECK(contains(box.out, "samples       about 99 expected\n"));
    check_fails(folder, 2, "--output is required", {"box", "--dim", "2", "-n", "99"});
    check_fails(folder, 6, "--memory", joined(job, {"--dry-run", "--memory", "1"}));
}

TEST_CASE("what the device does is told on demand, and changes nothing") {
    const TemporaryFolder folder;
    const Arguments job{"sample", "builtin:cube", "-n", "300"};
    const Outcome quiet = run(folder, joined(job, {"-o", "a.ply"}));
    REQUIRE(quiet.status == 0);
    CHECK(quiet.err.empty());
    const Outcome verbose = run(folder, joined(job, {"-o", "b.ply", "--verbose"}));
    REQUIRE(verbose.status == 0);
    for (const char* const line :
         {"device        ", "\nkernels       compiled in ", "\nrun           min distance ",
          "\nwork          ", "\nplan          ", "\nmemory        ", "\ntime          ",
          "\non the device "}) {
        CHECK(contains(verbose.err, line));
    }
    CHECK(bytes_of(folder / "a.ply") == bytes_of(folder / "b.ply"));
    CHECK(
        contains(run(folder, {"box", "--dim", "2", "-n", "99", "--dry-run", "-v"}).err, "device"));
}

TEST_CASE("samples name the triangles and faces of the mesh file, whatever of it is dropped") {
    const TemporaryFolder folder;
    // A cube of quads with a line, a copy, and a face that repeats a vertex before most of them.
    folder.write("mesh.ply", "ply\nformat ascii 1.0\nelement vertex 8\nproperty float x\n"
                             "property float y\nproperty float z\nelement face 9\n"
                             "property list uchar int vertex_indices\nend_header\n"
                             "0 0 0\n1 0 0\n1 1 0\n0 1 0\n0 0 1\n1 0 1\n1 1 1\n0 1 1\n"
                             "4 3 2 1 0\n2 0 1\n4 1 2 3 0\n3 4 4 5\n4 4 5 6 7\n"
                             "4 0 1 5 4\n4 1 2 6 5\n4 2 3 7 6\n4 3 0 4 7\n");
    for (const Arguments& more :
         {Arguments{}, {"--density", "curvature"}, {"--lift", "normals:0.5"}}) {
        const Arguments sample{"sample", "mesh.ply", "-o",     "a.csv",
                               "-n",     "300",      "--json", "a.json"};
        const Outcome made = run(folder, joined(sample, more));
        INFO(made.err);
        REQUIRE(made.status == 0);
        const std::string report = bytes_of(folder / "a.json");
        CHECK(contains(report, "\"polygons\": 9"));
        CHECK(contains(report, "\"dropped_triangles\": 3"));
        CHECK(run(folder, joined({"verify", "mesh.ply", "a.csv"}, more)).status == 0);
        std::set<std::uint32_t> polygons;
        for (const tools::SampleRow& row : tools::read_samples(folder / "a.csv").rows) {
            CHECK((row.face < 2 || row.face > 4));
            REQUIRE(row.polygon);
            CHECK(*row.polygon == (row.face < 2 ? 0 : (row.face - 5) / 2 + 4));
            polygons.insert(*row.polygon);
        }
        CHECK(polygons == std::set<std::uint32_t>{0, 4, 5, 6, 7, 8});
    }
    REQUIRE(run(folder, {"transfer", "a.csv", "mesh.ply", "mesh.ply", "-o", "b.csv"}).status == 0);
    CHECK(tools::read_samples(folder / "b.csv").rows.front().polygon);
    REQUIRE(run(folder, {"sample", "mesh.ply", "-o", "e.ply", "-n", "99", "--metric", "euclidean"})
                .status == 0);

    const std::string header = "# min_distance: 1\nx,y,z,face_index,bary_u,bary_v,bary_w,";
    folder.write("c.csv", header + "polygon_index\n0,0,1,5,1,0,0,3\n");
    const Outcome moved = run(folder, {"verify", "mesh.ply", "c.csv"});
    CHECK(moved.status == 3);
    CHECK(contains(moved.err, "polygon_index is 3, but face 5 is of face 4 in mesh.ply"));
    folder.write("c.csv", header + "radius\n0,0,0,2,1,0,0,1\n");
    const Outcome dropped = run(folder, {"verify", "mesh.ply", "c.csv"});
    CHECK(dropped.status == 3);
    CHECK(contains(dropped.err, "face 2 repeats a vertex, is a copy or a wall"));
}

TEST_CASE("header comments tell where the samples come from") {
    const TemporaryFolder folder;
    for (const char* const output : {"a.ply", "a.csv"}) {
        sample_cube(folder, output, {"-r", "0.125", "--seed", "0x10"});
        const tools::SampleHeader header = tools::read_samples(folder / output).header;
        CHECK(value_of(header, "version").starts_with("geodisk "));
        CHECK(value_of(header, "sampling_version") == std::to_string(GEODISK_SAMPLING_VERSION));
        CHECK(value_of(header, "mesh") == "builtin:cube");
        CHECK(value_of(header, "min_distance") == "0.25");
        CHECK(value_of(header, "radius") == "0.125");
        CHECK(value_of(header, "seed") == "16");
        CHECK(std::stoul(value_of(header, "pool_size")) > 1000);
        CHECK(value_of(header, "device") != "missing");
        CHECK(value_of(header, "driver") != "missing");
    }
}

TEST_CASE("equal seeds give equal files, other seeds other samples") {
    const TemporaryFolder folder;
    const std::string first = sample_cube(folder, "a.ply", {"-n", "100", "--seed", "7"});
    const std::string again = sample_cube(folder, "b.ply", {"-n", "100", "--seed", "0x7"});
    CHECK(first == again);
    const std::string less_memory =
        sample_cube(folder, "b.ply", {"-n", "100", "--seed", "7", "--memory", "1M"});
    CHECK(first == less_memory);
    const auto seven = csv_rows(sample_cube(folder, "a.csv", {"-n", "100", "--seed", "7"}));
    const auto eight = csv_rows(sample_cube(folder, "a.csv", {"-n", "100", "--seed", "8"}));
    const auto high =
        csv_rows(sample_cube(folder, "a.csv", {"-n", "100", "--seed", "0x100000007"}));
    CHECK(seven != eight);
    CHECK(seven != high);
}

TEST_CASE("ways to give the same distance give the same samples") {
    const TemporaryFolder folder;
    // The diagonal of the cube is the square root of 3.
    const std::string world = sample_cube(folder, "a.csv", {"-d", "0.17320508075688773"});
    CHECK(csv_rows(sample_cube(folder, "a.csv", {"-d", "10%"})) == csv_rows(world));
    CHECK(csv_rows(sample_cube(folder, "a.csv", {"-r", "5%"})) == csv_rows(world));
    CHECK(csv_rows(sample_cube(folder, "a.csv", {"-r", "0.086602540378443865"})) ==
          csv_rows(world));
}

TEST_CASE("a higher pool ratio leaves fewer gaps") {
    const TemporaryFolder folder;
    const auto few = csv_rows(sample_cube(folder, "a.csv", {"-d", "0.1", "--pool-ratio", "2"}));
    const auto many = csv_rows(sample_cube(folder, "a.csv", {"-d", "0.1", "--pool-ratio", "100"}));
    CHECK(few.size() < many.size());
}

TEST_CASE("an existing output is replaced") {
    const TemporaryFolder folder;
    folder.write("a.xyz", "old");
    CHECK_FALSE(contains(sample_cube(folder, "a.xyz", {"-n", "9"}), "old"));
    CHECK(files_in(folder) == std::vector<std::string>{"a.xyz"});
}

} // namespace geodisk::test
