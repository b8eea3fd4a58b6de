// `geodisk verify` accepts what `geodisk sample` wrote, and nothing else.
#include <doctest/doctest.h>

#include <string>

#include <nlohmann/json.hpp>

#include "cli/command.hpp"
#include "files/samples/sample_file.hpp"

namespace geodisk::test {
namespace {

constexpr const char* kVerifiedMesh = "builtin:torus-knot:8";

tools::SampleFile make_checked_samples(const TemporaryFolder& folder) {
    const Outcome made = run(folder, {"sample", kVerifiedMesh, "-o", "a.ply", "-n", "400"});
    REQUIRE(made.status == 0);
    tools::SampleFile samples = tools::read_samples(folder / "a.ply");
    REQUIRE(samples.rows.size() > 300);
    return samples;
}

void write_back(const TemporaryFolder& folder, const tools::SampleFile& samples) {
    tools::write_samples(folder / "b.csv", samples.header, samples.rows, false);
}

} // namespace

TEST_CASE("samples pass, in every format with faces") {
    const TemporaryFolder folder;
    for (const std::string output : {"a.ply", "a.csv", "a.npz", "a.pcd"}) {
        REQUIRE(run(folder, {"sample", kVerifiedMesh, "-o", output, "-n", "400"}).status == 0);
        const Outcome outcome = run(folder, {"verify", kVerifiedMesh, output});
        INFO(outcome.out, outcome.err);
        CHECK(outcome.status == 0);
        CHECK(outcome.err.empty());
        CHECK(contains(outcome.out, "violations    0\n"));
        CHECK(contains(outcome.out, "smallest      "));
        CHECK(contains(outcome.out, "rho           0.7"));
        CHECK_FALSE(contains(outcome.out, "\r"));
        CHECK(run(folder, {"verify", kVerifiedMesh, output, "-q"}).out.empty());
    }
    REQUIRE(run(folder, {"sample", kVerifiedMesh, "-o", "a.xyz", "-n", "9"}).status == 0);
}

TEST_CASE("meshes of every kind pass") {
    const TemporaryFolder folder;
    for (const std::string mesh : {"builtin:plate:4", "builtin:folded-sheet:6", "builtin:moebius:4",
                                   "builtin:lattice:1", "builtin:terrain:12"}) {
        INFO(mesh);
        REQUIRE(run(folder, {"sample", mesh, "-o", "a.ply", "-n", "500"}).status == 0);
        const Outcome outcome = run(folder, {"verify", mesh, "a.ply"});
        INFO(outcome.out, outcome.err);
        CHECK(outcome.status == 0);
    }
}

TEST_CASE("a sample moved onto another one is found") {
    const TemporaryFolder folder;
    tools::SampleFile samples = make_checked_samples(folder);
    samples.rows[7] = samples.rows[42];
    write_back(folder, samples);
    const Outcome outcome = run(folder, {"verify", kVerifiedMesh, "b.csv"});
    CHECK(outcome.status == 1);
    CHECK(contains(outcome.err, "geodisk: b.csv: 1 pair of samples is closer than "));
    CHECK(contains(outcome.out, "violations    1\n"));
    CHECK(contains(outcome.out, "too close     2 of "));
    CHECK(contains(outcome.out, "samples 7 and 42: 0\n"));
}

TEST_CASE("a larger distance is violated by many pairs, each counted once") {
    const TemporaryFolder folder;
    const std::size_t n = make_checked_samples(folder).rows.size();
    const Outcome outcome =
        run(folder, {"verify", kVerifiedMesh, "a.ply", "--min-distance", "1000"});
    CHECK(outcome.status == 1);
    std::string plain = outcome.out;
    std::erase(plain, ',');
    CHECK(contains(plain, "violations    " + std::to_string(n * (n - 1) / 2) + "\n"));
}

TEST_CASE("a distance beyond all proportion to the mesh finds the same closest pair") {
    const TemporaryFolder folder;
    make_checked_samples(folder);
    nlohmann::json smallest;
    for (const char* const distance : {"1000", "1e12", "1e300"}) {
        const Outcome outcome =
            run(folder, {"verify", kVerifiedMesh, "a.ply", "-d", distance, "--json", "-"});
        CHECK(outcome.status == 1);
        nlohmann::json found = nlohmann::json::parse(outcome.out).at("smallest");
        CHECK(found.at("distance").get<double>() < 10);
        CHECK((smallest.is_null() || found == smallest));
        smallest = found;
    }
}

TEST_CASE("the report has pairs and samples, whatever the exit status") {
    const TemporaryFolder folder;
    tools::SampleFile samples = make_checked_samples(folder);
    const auto report = [&](int status, const std::vector<std::string>& arguments) {
        const Outcome outcome = run(folder, arguments);
        CHECK(outcome.status == status);
        return nlohmann::json::parse(outcome.out.empty() ? bytes_of(folder / "c.json")
                                                         : outcome.out);
    };
    const auto good = report(0, {"verify", kVerifiedMesh, "a.ply", "--json", "-"});
    CHECK(good["samples"] == samples.rows.size());
    CHECK(good["violations"]["pairs"] == 0);
    CHECK(good["violations"]["samples"] == 0);
    CHECK(good["smallest"]["distance"] > good["min_distance"]);
    CHECK(good["off_the_mesh"] == 0);

    // Three samples at one place are three pairs.
    for (const std::size_t row : {7u, 9u}) {
        samples.rows[row] = samples.rows[42];
    }
    write_back(folder, samples);
    const auto bad = report(1, {"verify", kVerifiedMesh, "b.csv", "--json", "c.json", "-q"});
    CHECK(bad["violations"]["pairs"] == 3);
    CHECK(bad["violations"]["samples"] == 3);
    CHECK(bad["violations"]["complete"] == true);
    CHECK(bad["violations"]["rows_a"] == nlohmann::json({7, 7, 9}));
    CHECK(bad["violations"]["rows_b"] == nlohmann::json({9, 42, 42}));
    CHECK(bad["violations"]["distances"] == nlohmann::json({0, 0, 0}));
    CHECK(bad["smallest"]["distance"] == 0);
    CHECK(bad["smallest"]["samples"] == nlohmann::json({7, 9}));

    const auto far = report(0, {"verify", kVerifiedMesh, "a.ply", "-d", "1e-6", "--json", "-"});
    CHECK(far["smallest"].is_null());
    check_fails(folder, 2, "a.ply: the report would replace the samples",
                {"verify", kVerifiedMesh, "a.ply", "--json", "a.ply"});
    check_fails(folder, 4, "none", {"verify", kVerifiedMesh, "a.ply", "--json", "none/c.json"});
    check_fails(folder, 3, "no such file", {"verify", kVerifiedMesh, "d.ply", "--json", "d.json"});
}

TEST_CASE("a distance that nobody comes near is bounded") {
    const TemporaryFolder folder;
    make_checked_samples(folder);
    for (const char* const distance : {"1e-3", "1e-12", "1e-300"}) {
        const Outcome outcome = run(folder, {"verify", kVerifiedMesh, "a.ply", "-d", distance});
        INFO(outcome.out, outcome.err);
        CHECK(outcome.status == 0);
        CHECK(contains(outcome.out, "smallest      > "));
    }
}

TEST_CASE("positions off the mesh are found") {
    const TemporaryFolder folder;
    tools::SampleFile samples = make_checked_samples(folder);
    samples.rows[3].position[1] += 0.01;
    write_back(folder, samples);
    const Outcome outcome = run(folder, {"verify", kVerifiedMesh, "b.csv"});
    CHECK(outcome.status == 1);
    CHECK(contains(outcome.err, "1 position does not agree with face and weights"));
    CHECK(contains(outcome.out, "sample 3: "));
    const Outcome other = run(folder, {"verify", "builtin:torus-knot:9", "a.ply"});
    CHECK(other.status == 1);
}

TEST_CASE("rows that are not on the mesh at all are malformed") {
    const TemporaryFolder folder;
    const tools::SampleFile good = make_checked_samples(folder);
    tools::SampleFile bad = good;
    bad.rows[5].face = 100000;
    write_back(folder, bad);
    check_fails(folder, 3, "b.csv: sample 5: ", {"verify", kVerifiedMesh, "b.csv"});
    bad = good;
    bad.rows[6].bary[1] += 0.5f;
    write_back(folder, bad);
    check_fails(folder, 3, "weights", {"verify", kVerifiedMesh, "b.csv"});
    folder.write("c.csv", "x,y,z,face_index\n1,2,3,0\n");
    check_fails(folder, 3, "no column bary_u", {"verify", kVerifiedMesh, "c.csv"});
    check_fails(folder, 3, "no such file", {"verify", kVerifiedMesh, "none.csv"});
    folder.write("c.txt", "");
    check_fails(folder, 3, "has no header row", {"verify", kVerifiedMesh, "c.txt"});
}

TEST_CASE("points of other programs are put on the nearest face") {
    const TemporaryFolder folder;
    make_checked_samples(folder);
    REQUIRE(run(folder, {"shapes", "cube", "-o", "cube.ply"}).status == 0);
    folder.write("points.csv", "x,y,z\n-0.25,-0.25,-0.4999999\n-0.5000002,0.25,0.25\n"
                               "0,0.5,0\n");
    const Outcome passed =
        run(folder, {"verify", "cube.ply", "points.csv", "-d", ".3", "--json", "a.json"});
    CHECK(passed.status == 0);
    CHECK(contains(passed.err, "points.csv: 3 points without faces put on the nearest face of "
                               "cube.ply, from up to 2e-07 away, 1e-07 on average (tolerance "
                               "0.00173)"));
    CHECK(contains(bytes_of(folder / "a.json"), "points_moved"));
    CHECK(run(folder, {"verify", "cube.ply", "points.csv", "-d", "2"}).status == 1);
    const Outcome far =
        run(folder, {"verify", "cube.ply", "points.csv", "-d", ".3", "--tolerance", "1.5e-7"});
    CHECK(far.status == 1);
    CHECK(contains(far.out, "sample 1: 2e-07 away from the surface"));
    CHECK(contains(far.err, "1 point lies farther off the mesh than --tolerance allows. Give the "
                            "mesh that the points were made on, or raise --tolerance"));
    check_fails(folder, 2, "--tolerance",
                {"verify", "cube.ply", "points.csv", "-d", ".3", "--tolerance", "far"});
    // Other commands take no point that lies elsewhere.
    CHECK(run(folder, {"analyze", "cube.ply", "points.csv", "-d", ".3", "-q"}).status == 0);
    const Outcome analyzed =
        run(folder, {"analyze", "cube.ply", "points.csv", "-d", ".3", "--tolerance", "1.5e-7"});
    CHECK(analyzed.status == 3);
    CHECK(contains(analyzed.err, "1 point lies farther off cube.ply than --tolerance allows; "
                                 "sample 1 is 2e-07 away. Give the mesh that the points were made "
                                 "on, or raise --tolerance"));
    const Outcome moved =
        run(folder, {"transfer", "points.csv", "cube.ply", "cube.ply", "-o", "moved.ply"});
    CHECK(moved.status == 0);
    CHECK(run(folder, {"verify", "cube.ply", "moved.ply"}).status == 0);
}

TEST_CASE("the distance comes from the option or the header") {
    const TemporaryFolder folder;
    tools::SampleFile samples = make_checked_samples(folder);
    samples.header.entries.clear();
    write_back(folder, samples);
    CHECK(run(folder, {"verify", kVerifiedMesh, "b.csv", "--min-distance", "0.1%"}).status == 0);
    samples.header.entries = {{"min_distance", "wide"}};
    write_back(folder, samples);
    check_fails(folder, 3, "'wide'", {"verify", kVerifiedMesh, "b.csv"});
}

TEST_CASE("without a distance the closest pair is told, and that none was checked") {
    const TemporaryFolder folder;
    folder.write("points.xyz", "-0.5 -0.5 -0.5\n-0.5 -0.5 -0.25\n-0.375 -0.5 -0.5\n0.5 0.5 0.5\n");
    const Outcome outcome =
        run(folder, {"verify", "builtin:cube", "points.xyz", "--json", "a.json"});
    INFO(outcome.out, outcome.err);
    CHECK(outcome.status == 0);
    CHECK(contains(outcome.out, "smallest      0.125 in mesh units, samples 0 and 2\n"));
    CHECK_FALSE(contains(outcome.out, "violations"));
    CHECK(contains(outcome.err, "points.xyz: no minimum distance is known, so none was checked; "
                                "give --min-distance"));
    const auto report = nlohmann::json::parse(bytes_of(folder / "a.json"));
    CHECK(report["smallest"]["samples"] == nlohmann::json({0, 2}));
    CHECK(report["min_distance"].is_null());
    CHECK(report["violations"].is_null());
    const Outcome maximal = run(folder, {"verify", "builtin:cube", "points.xyz", "--maximal"});
    CHECK(maximal.status == 2);
    CHECK(contains(maximal.err, "--maximal needs a minimum distance; give --min-distance"));

    // Other faults are found all the same.
    folder.write("far.xyz", "-0.5 -0.5 -0.5\n2 0 0\n");
    CHECK(run(folder, {"verify", "builtin:cube", "far.xyz"}).status == 1);
    folder.write("one.xyz", "-0.5 -0.5 -0.5\n");
    CHECK(contains(run(folder, {"verify", "builtin:cube", "one.xyz"}).out, "smallest      none"));
}

TEST_CASE("without a distance other commands take that of the closest pair") {
    const TemporaryFolder folder;
    folder.write("points.xyz", "-0.5 -0.5 -0.5\n-0.5 -0.5 -0.25\n-0.375 -0.5 -0.5\n0.5 0.5 0.5\n");
    const auto told = [&](const Arguments& arguments) {
        const Outcome outcome = run(folder, arguments);
        INFO(outcome.err);
        CHECK(outcome.status == 0);
        return contains(outcome.err, "points.xyz: its header has no minimum distance, so that of "
                                     "the closest pair is used, 0.125; give --min-distance");
    };
    CHECK(told({"analyze", "builtin:cube", "points.xyz", "--json", "a.json"}));
    CHECK(told({"spectrum", "builtin:cube", "points.xyz", "-o", "a.csv", "--harmonics", "7"}));
    CHECK(told({"render", "builtin:cube", "points.xyz", "-o", "a.png", "--size", "80x60"}));
    CHECK_FALSE(told({"analyze", "builtin:cube", "points.xyz", "-d", "0.1"}));
    const auto report = nlohmann::json::parse(bytes_of(folder / "a.json"));
    CHECK(contains(report["warnings"].dump(), "closest_distance"));
    folder.write("one.xyz", "-0.5 -0.5 -0.5\n");
    const auto fails = [&](const std::string& message, const Arguments& arguments) {
        const Outcome outcome = run(folder, arguments);
        CHECK(outcome.status == 2);
        CHECK(contains(outcome.err, message));
    };
    fails("one.xyz: its header has no minimum distance, and no path joins two of its samples; give "
          "--min-distance",
          {"analyze", "builtin:cube", "one.xyz"});
    folder.write("same.xyz", "-0.5 -0.5 -0.5\n-0.5 -0.5 -0.5\n0.5 0.5 0.5\n");
    fails("samples 0 and 1 lie at one place; give --min-distance",
          {"render", "builtin:cube", "same.xyz", "-o", "b.png"});
    CHECK(!std::filesystem::exists(folder / "b.png"));
}

TEST_CASE("no samples are no violation") {
    const TemporaryFolder folder;
    write_back(folder, {});
    const Outcome outcome = run(folder, {"verify", kVerifiedMesh, "b.csv", "-d", "1"});
    CHECK(outcome.status == 0);
    CHECK(contains(outcome.out, "samples       0 in b.csv\n"));
    CHECK(contains(outcome.err, "warning: b.csv: has no samples\n"));
}

} // namespace geodisk::test
