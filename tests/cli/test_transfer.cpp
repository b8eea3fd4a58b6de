// `geodisk transfer` puts samples on another mesh of the same faces, and on no other.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include <nlohmann/json.hpp>

#include "cli/command.hpp"
#include "files/meshes/mesh_file.hpp"
#include "files/samples/sample_file.hpp"
#include "support/data_file.hpp"
#include "support/stand_in_meshes.hpp"

namespace geodisk::test {
namespace {

using Json = nlohmann::json;
using Arguments = std::vector<std::string>;

Arguments transfer(const std::string& from, const std::string& to, const Arguments& more = {}) {
    Arguments arguments{"transfer", "a.ply", from, to, "-o", "b.ply"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return arguments;
}

void make_source_samples(const TemporaryFolder& folder, const std::string& mesh,
                         const std::string& count = "300") {
    const Outcome made = run(folder, {"sample", mesh, "-o", "a.ply", "-n", count});
    INFO(made.err);
    REQUIRE(made.status == 0);
}

std::string header_value(const tools::SampleFile& samples, const std::string& key) {
    for (const auto& [name, value] : samples.header.entries) {
        if (name == key) {
            return value;
        }
    }
    return "";
}

/// Carries a.ply over and returns the report. `verify` must find the smallest distance, and no pair
/// closer than the second smallest but that one.
Json check_transfer(const TemporaryFolder& folder, const std::string& from, const std::string& to) {
    const Outcome outcome = run(folder, transfer(from, to, {"--json", "b.json"}));
    INFO(outcome.err);
    REQUIRE(outcome.status == 0);
    Json report = Json::parse(bytes_of(folder / "b.json"));
    const tools::SampleFile before = tools::read_samples(folder / "a.ply");
    const tools::SampleFile after = tools::read_samples(folder / "b.ply");
    REQUIRE(after.rows.size() == before.rows.size());
    CHECK(report["samples"] == after.rows.size());
    for (std::size_t i = 0; i < after.rows.size(); ++i) {
        CHECK(after.rows[i].face == before.rows[i].face);
        CHECK(std::equal(after.rows[i].bary, after.rows[i].bary + 3, before.rows[i].bary));
    }
    CHECK(header_value(after, "mesh") == to);
    CHECK(header_value(after, "transferred_from") == "a.ply");
    for (const auto& [key, value] : before.header.entries) {
        CHECK(header_value(after, "source_" + key) == value);
    }

    CHECK(run(folder, {"verify", to, "b.ply"}).status == 0);
    const Json& smallest = report["smallest"];
    const double wider = smallest["distance"].get<double>() * (1 + 1e-7);
    const Outcome closest = run(folder, {"verify", to, "b.ply", "-d", Json(wider).dump()});
    CHECK(contains(closest.out, "violations    1\n"));
    const std::string pair =
        "samples " + smallest["samples"][0].dump() + " and " + smallest["samples"][1].dump();
    CHECK(contains(closest.out, pair + ": "));
    CHECK(contains(outcome.out, pair + "\n"));
    return report;
}

double distance_in(const Json& report) {
    return report["smallest"]["distance"].get<double>();
}

/// Two triangles side by side, in the plane z = `height`.
std::string square(const std::string& side, const std::string& height = "0",
                   const std::string& faces = "f 1 2 3\nf 1 3 4\n") {
    return "v 0 0 " + height + "\nv " + side + " 0 " + height + "\nv " + side + " " + side + " " +
           height + "\nv 0 " + side + " " + height + "\n" + faces;
}

/// A sample on square("1").
tools::SampleRow place(std::uint32_t face, float u, float v) {
    tools::SampleRow row;
    row.face = face;
    row.bary[0] = 1 - u - v;
    row.bary[1] = u;
    row.bary[2] = v;
    const bool is_upper = face == 1; // Its corners are (0,0) (1,1) (0,1).
    row.position[0] = is_upper ? u : u + v;
    row.position[1] = is_upper ? u + v : v;
    return row;
}

} // namespace

TEST_CASE("samples carried over to their own mesh stay as they are") {
    const TemporaryFolder folder;
    const std::string mesh = "builtin:torus-knot:8";
    make_source_samples(folder, mesh);
    check_transfer(folder, mesh, mesh);
    const tools::SampleFile before = tools::read_samples(folder / "a.ply");
    const tools::SampleFile after = tools::read_samples(folder / "b.ply");
    for (std::size_t i = 0; i < after.rows.size(); ++i) {
        CHECK(std::equal(after.rows[i].position, after.rows[i].position + 3,
                         before.rows[i].position));
        CHECK(std::equal(after.rows[i].normal, after.rows[i].normal + 3, before.rows[i].normal));
    }
}

TEST_CASE("a sheet unfolded keeps its distances") {
    const TemporaryFolder folder;
    make_source_samples(folder, "builtin:folded-sheet:6");
    const Json stays = check_transfer(folder, "builtin:folded-sheet:6", "builtin:folded-sheet:6");
    const Json flat = check_transfer(folder, "builtin:folded-sheet:6", "builtin:unfolded-sheet:6");
    CHECK(distance_in(flat) == doctest::Approx(distance_in(stays)).epsilon(1e-9));
    CHECK(flat["smallest"]["samples"] == stays["smallest"]["samples"]);
    for (const tools::SampleRow& row : tools::read_samples(folder / "b.ply").rows) {
        CHECK(row.position[2] == 0);
    }
}

TEST_CASE("distances follow the scale, however far it is from the first") {
    const TemporaryFolder folder;
    folder.write("a.obj", square("1"));
    make_source_samples(folder, "a.obj", "50");
    const double here = distance_in(check_transfer(folder, "a.obj", "a.obj"));
    for (const auto& [side, scale] : {std::pair{"1000000", 1e6}, std::pair{"0.0001", 1e-4}}) {
        folder.write("b.obj", square(side, "7"));
        CHECK(distance_in(check_transfer(folder, "a.obj", "b.obj")) ==
              doctest::Approx(scale * here).epsilon(1e-9));
    }
}

TEST_CASE("a cluster of samples and samples far apart are measured") {
    const TemporaryFolder folder;
    folder.write("a.obj", square("1"));
    const tools::SampleFile two{{place(0, 0.75f, 0), place(1, 0, 0.75f)}, {}, 3, {}, {}};
    tools::write_samples(folder / "a.ply", two.header, two.rows, false);
    CHECK(distance_in(check_transfer(folder, "a.obj", "a.obj")) ==
          doctest::Approx(0.75 * std::sqrt(2.0)));
    tools::SampleFile cluster;
    for (int i = 0; i < 20; ++i) {
        cluster.rows.push_back(place(0, 0.5f + static_cast<float>(i * i) * 0x1p-20f, 0.25f));
    }
    tools::write_samples(folder / "a.ply", cluster.header, cluster.rows, false);
    CHECK(distance_in(check_transfer(folder, "a.obj", "a.obj")) == doctest::Approx(0x1p-20));
}

TEST_CASE("samples that no path joins have no smallest distance") {
    const TemporaryFolder folder;
    folder.write("a.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 0 0\nv 1 1 0\nv 0 1 0\n"
                          "f 1 2 3\nf 4 5 6\n"); // The square, cut in two.
    const std::vector<tools::SampleRow> apart{place(0, 0.25f, 0.25f), place(1, 0.25f, 0.25f)};
    tools::write_samples(folder / "a.ply", {}, apart, false);
    const Arguments apart_again = {"--keep-seams-a", "--keep-seams-b"};
    const Outcome outcome =
        run(folder, transfer("a.obj", "a.obj", joined(apart_again, {"--json", "-"})));
    REQUIRE(outcome.status == 0);
    const Json report = Json::parse(outcome.out);
    CHECK(report["samples"] == 2);
    CHECK(report["smallest"].is_null());
    CHECK(header_value(tools::read_samples(folder / "b.ply"), "min_distance").empty());
    CHECK(contains(run(folder, transfer("a.obj", "a.obj", apart_again)).out, "no path joins"));
}

TEST_CASE("other coordinates, edge lengths and lifts make the second mesh") {
    const TemporaryFolder folder;
    folder.write("a.obj", square("1"));
    make_source_samples(folder, "a.obj", "50");
    const double flat = distance_in(check_transfer(folder, "a.obj", "a.obj"));
    folder.write("in4d.txt", "0 0 0 0\n3 0 0 0\n3 3 0 0\n0 3 0 0\n");
    folder.write("lengths.txt", "1 2 2\n2 3 2\n3 4 2\n4 1 2\n1 3 2.8284271247461903\n");
    for (const auto& [more, scale] : {std::pair{Arguments{"--coordinates-b", "in4d.txt"}, 3.0},
                                      std::pair{Arguments{"--edge-lengths-b", "lengths.txt"}, 2.0},
                                      std::pair{Arguments{"--lift-b", "normals:5"}, 1.0}}) {
        const auto& shown = more.front(); // Before Clang 16 lambdas capture no bindings.
        CAPTURE(shown);
        Arguments arguments = transfer("a.obj", "a.obj", more);
        arguments.insert(arguments.end(), {"--json", "-"});
        const Outcome outcome = run(folder, arguments);
        INFO(outcome.err);
        REQUIRE(outcome.status == 0);
        CHECK(distance_in(Json::parse(outcome.out)) == doctest::Approx(scale * flat));
        const std::string name = more[0].substr(0, more[0].size() - 2);
        CHECK(run(folder, {"verify", "a.obj", "b.ply", name, more[1]}).status == 0);
    }
    CHECK(header_value(tools::read_samples(folder / "b.ply"), "lift") == "normals:5");
}

TEST_CASE("meshes of other faces and samples of other meshes are refused") {
    const TemporaryFolder folder;
    folder.write("a.obj", square("1"));
    folder.write("turned.obj", square("1", "0", "f 1 2 3\nf 3 4 1\n"));
    make_source_samples(folder, "a.obj", "50");
    check_fails(folder, 3,
                "turned.obj: face 1 has the corners 2 3 0, but 0 2 3 in a.obj (all counted from 0)",
                transfer("a.obj", "turned.obj"));
    check_fails(folder, 3, "builtin:cube: has 12 triangles, but a.obj has 2",
                transfer("a.obj", "builtin:cube"));
    folder.write("other.obj", square("2"));
    check_fails(folder, 3, "a.ply: sample 0 is ", transfer("other.obj", "a.obj"));
    check_fails(folder, 3, "on other.obj; are these samples of another mesh?",
                transfer("other.obj", "a.obj"));
    make_source_samples(folder, "builtin:cube:2", "50");
    check_fails(folder, 3, "is out of range, a.obj has 2 triangles", transfer("a.obj", "a.obj"));
    make_source_samples(folder, "builtin:veronese:2", "50");
    check_fails(folder, 3, "its samples have 4 coordinates, the vertices of a.obj have 3",
                transfer("a.obj", "a.obj"));
}

TEST_CASE("samples in the place of a mesh are told the order of arguments") {
    const TemporaryFolder folder;
    folder.write("a.obj", square("1"));
    for (const char* const name : {"a.ply", "a.csv", "a.npz", "a.pcd"}) {
        REQUIRE(run(folder, {"sample", "a.obj", "-n", "20", "-o", name}).status == 0);
        const std::string message = std::string(name) + ": holds samples, but a mesh is expected "
                                                        "here; give SAMPLES MESH_A MESH_B";
        check_fails(folder, 3, message, {"transfer", "a.obj", name, "a.obj", "-o", "b.ply"});
        check_fails(folder, 3, message, {"transfer", "a.obj", "a.obj", name, "-o", "b.ply"});
    }
    // Points without faces may as well be a mesh that cannot be read.
    folder.write("points.csv", "x,y,z\n0,0,0\n");
    check_fails(folder, 3, "points.csv: unknown mesh format",
                {"transfer", "a.obj", "points.csv", "a.obj", "-o", "b.ply"});
}

TEST_CASE("a file without samples is carried over, with a warning") {
    const TemporaryFolder folder;
    folder.write("a.obj", square("1"));
    folder.write("none.csv", "x,y,z,face_index,bary_u,bary_v,bary_w\n");
    const Outcome outcome =
        run(folder, {"transfer", "none.csv", "a.obj", "a.obj", "-o", "b.csv", "--json", "b.json"});
    CHECK(outcome.status == 0);
    CHECK(contains(outcome.err, "warning: none.csv: has no samples\n"));
    CHECK(tools::read_samples(folder / "b.csv").rows.empty());
    const Json report = Json::parse(bytes_of(folder / "b.json"));
    CHECK(report["warnings_a"].back()["kind"] == "no_samples");
}

TEST_CASE("wrong usage of transfer is explained") {
    const TemporaryFolder folder;
    folder.write("a.obj", square("1"));
    make_source_samples(folder, "a.obj", "9");
    check_fails(folder, 2, "MESH_B is required", {"transfer", "a.ply", "a.obj", "-o", "b.ply"});
    check_fails(folder, 2, "--output is required", {"transfer", "a.ply", "a.obj", "a.obj"});
    check_fails(folder, 2, "a.ply: the output would replace the samples read",
                {"transfer", "a.ply", "a.obj", "a.obj", "-o", "a.ply"});
    check_fails(folder, 2, "./a.obj: the report would replace a mesh",
                transfer("a.obj", "a.obj", {"--json", "./a.obj"}));
    check_fails(folder, 2, "b.ply: the report would replace the output",
                transfer("a.obj", "a.obj", {"--json", "b.ply"}));
    check_fails(folder, 4, "none", {"transfer", "a.ply", "a.obj", "a.obj", "-o", "none/b.ply"});
    check_fails(folder, 3, "no such file", {"transfer", "c.ply", "a.obj", "a.obj", "-o", "b.ply"});
    check_fails(folder, 3, "no such file", transfer("c.obj", "a.obj"));
    folder.write("in4d.txt", "0 0 0 0\n1 0 0 0\n1 1 0 0\n0 1 0 0\n");
    check_fails(
        folder, 2, "these samples have 4",
        {"transfer", "a.ply", "a.obj", "a.obj", "--coordinates-b", "in4d.txt", "-o", "b.xyz"});
}

TEST_CASE("a scanned animal changes its pose") {
    const auto check_poses = [](const TemporaryFolder& folder, const std::string& first,
                                const std::string& second) {
        make_source_samples(folder, first, "1000");
        const Json stays = check_transfer(folder, first, first);
        const Json moved = check_transfer(folder, first, second);
        CHECK(distance_in(moved) < distance_in(stays)); // No pose is without compression.
        check_fails(folder, 3, "are these samples of another mesh?", transfer(second, first));
    };
    const TemporaryFolder folder;
    tools::write_mesh(folder / "rests.ply", stand_in("spot_pose_a_6k.obj").make());
    tools::write_mesh(folder / "moves.ply", stand_in("spot_pose_b_6k.obj").make());
    check_poses(folder, "rests.ply", "moves.ply");
    const auto rests = data_file("meshes/spot_pose_a_6k.obj", true);
    const auto moves = data_file("meshes/spot_pose_b_6k.obj", true);
    if (rests && moves) {
        check_poses(TemporaryFolder(), rests->string(), moves->string());
    }
}

} // namespace geodisk::test
