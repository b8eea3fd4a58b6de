// Samples that are kept and points that are avoided, and how `geodisk verify` tells them apart.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "cli/command.hpp"
#include "cli/json_file.hpp"
#include "files/output/output_file.hpp"
#include "files/samples/sample_file.hpp"

namespace geodisk::test {
namespace {

constexpr const char* kExistingMesh = "builtin:torus-knot:8";

bool same(const tools::SampleRow& a, const tools::SampleRow& b) {
    return a.face == b.face && std::ranges::equal(a.bary, b.bary) &&
           std::ranges::equal(a.position, b.position);
}

/// Checks that b.ply begins with the samples of a.ply, which alone are marked.
std::size_t check_kept(const TemporaryFolder& folder) {
    const tools::SampleFile given = tools::read_samples(folder / "a.ply");
    const tools::SampleFile all = tools::read_samples(folder / "b.ply");
    const auto marks = all.extra_values("existing");
    REQUIRE(marks.size() == all.rows.size());
    REQUIRE(all.rows.size() > given.rows.size());
    for (std::size_t i = 0; i < all.rows.size(); ++i) {
        REQUIRE(marks[i] == (i < given.rows.size() ? 1 : 0));
        REQUIRE((marks[i] == 0 || same(all.rows[i], given.rows[i])));
    }
    return given.rows.size();
}

} // namespace

TEST_CASE("existing samples are kept and marked, and new ones keep the distance") {
    const TemporaryFolder folder;
    REQUIRE(run(folder, {"sample", kExistingMesh, "-o", "a.ply", "-n", "100"}).status == 0);
    const Outcome made = run(folder, {"sample", kExistingMesh, "-o", "b.ply", "-n", "400", "--seed",
                                      "2", "--existing", "a.ply", "--json", "b.json"});
    INFO(made.out, made.err);
    REQUIRE(made.status == 0);
    CHECK(made.err.empty());
    const std::size_t given = check_kept(folder);
    CHECK(contains(made.out, "existing      " + std::to_string(given) + " of them\n"));
    CHECK(json_in(folder, "b.json")["existing"]["samples"] == given);
    CHECK(json_in(folder, "b.json")["existing"]["close_pairs"] == 0);
    const Outcome verified = run(folder, {"verify", kExistingMesh, "b.ply"});
    INFO(verified.out, verified.err);
    CHECK(verified.status == 0);
    CHECK(contains(verified.out, "existing      " + std::to_string(given) + " of them\n"));
    CHECK(contains(verified.out, " of the minimum distance, pairs of existing samples aside\n"));
    const tools::SampleFile all = tools::read_samples(folder / "b.ply");
    REQUIRE(all.header.find("existing") != nullptr);
    CHECK(*all.header.find("existing") == "a.ply");

    // In all formats that have columns, and first in the others.
    for (const std::string output : {"b.csv", "b.pcd"}) {
        REQUIRE(run(folder, {"sample", kExistingMesh, "-o", output, "-n", "400", "--seed", "2",
                             "--existing", "a.ply"})
                    .status == 0);
        CHECK(tools::read_samples(folder / output).extra_values("existing").size() ==
              all.rows.size());
    }
    for (const std::string output : {"b.xyz", "b.npz", "b.glb"}) {
        CHECK(
            run(folder, {"sample", kExistingMesh, "-o", output, "-n", "400", "--existing", "a.ply"})
                .status == 0);
    }
}

TEST_CASE("radii that vary, darts and a dry run take existing samples") {
    const TemporaryFolder folder;
    REQUIRE(run(folder, {"sample", kExistingMesh, "-o", "a.ply", "-n", "100"}).status == 0);
    for (const Arguments& more : {Arguments{"-d", "0.2", "--radius-factor", "curvature"},
                                  Arguments{"-n", "400", "-d", "0.1", "--method", "darts"}}) {
        REQUIRE(run(folder,
                    joined({"sample", kExistingMesh, "-o", "b.ply", "--existing", "a.ply"}, more))
                    .status == 0);
        check_kept(folder);
        const Outcome verified = run(folder, {"verify", kExistingMesh, "b.ply"});
        INFO(verified.out, verified.err);
        CHECK(verified.status == 0);
    }
    CHECK(run(folder, {"sample", kExistingMesh, "--dry-run", "-n", "400", "--existing", "a.ply"})
              .status == 0);
    const Outcome page =
        run(folder, {"batch", kExistingMesh, "-o", "out", "-n", "400", "--existing", "a.ply"});
    INFO(page.out, page.err);
    CHECK(page.status == 0);
}

TEST_CASE("points of other programs are put on the mesh, and pairs too close are told") {
    const TemporaryFolder folder;
    folder.write("points.xyz", "0.5 0.25 0.0051\n0.25 0.25 0.005\n0.2501 0.25 0.005\n");
    const Outcome made = run(folder, {"sample", "builtin:plate:4", "-o", "b.ply", "-d", "0.1",
                                      "--existing", "points.xyz", "--json", "b.json"});
    INFO(made.out, made.err);
    REQUIRE(made.status == 0);
    CHECK(contains(made.err, "points.xyz: 3 points without faces put on the nearest face"));
    CHECK(contains(made.err, "1 pair of existing samples closer than the minimum distance; they "
                             "are kept. The closest are samples 1 and 2, at 0.0001"));
    CHECK(contains(made.out, "3 of them; 1 pair among these too close\n"));
    const Json told = json_in(folder, "b.json");
    CHECK(told["existing"]["close_pairs"] == 1);
    CHECK(told["existing"]["closest"]["samples"] == Json({1, 2}));
    const Outcome verified =
        run(folder, {"verify", "builtin:plate:4", "b.ply", "--json", "v.json"});
    INFO(verified.out, verified.err);
    CHECK(verified.status == 0);
    CHECK(contains(verified.out, "violations    0\n"));
    CHECK(contains(verified.out, "3 of them; 1 pair among these too close, no violation\n"));
    CHECK(json_in(folder, "v.json")["existing"]["violations"]["pairs"] == 1);

    // A new sample that is too close to an existing one is a violation all the same.
    tools::SampleFile moved = tools::read_samples(folder / "b.ply");
    moved.rows.back() = moved.rows.front();
    {
        tools::AtomicFile file((folder / "c.ply").string());
        tools::write_samples(file, tools::sample_target((folder / "c.ply").string(), "", false),
                             moved.header, moved.rows, 3, {moved.extra});
        file.commit();
    }
    CHECK(run(folder, {"verify", "builtin:plate:4", "c.ply"}).status == 1);
}

TEST_CASE("of existing samples far closer than the distance some pairs count, and the closest") {
    const TemporaryFolder folder;
    REQUIRE(run(folder, {"sample", kExistingMesh, "-o", "a.csv", "-n", "500"}).status == 0);
    const Outcome made = run(folder, {"sample", kExistingMesh, "-o", "b.csv", "-d", "100%",
                                      "--existing", "a.csv", "--json", "b.json"});
    INFO(made.out, made.err);
    REQUIRE(made.status == 0);
    CHECK(contains(made.err, "a.csv: at least "));
    const Json given = json_in(folder, "b.json")["existing"];
    CHECK(given["complete"] == false);
    CHECK(given["close_pairs"] > 0);

    // The closest pair is that of all samples.
    const tools::SampleFile all = tools::read_samples(folder / "a.csv");
    std::string points;
    for (const tools::SampleRow& row : all.rows) {
        for (const double x : row.position) {
            points += std::to_string(x) + " ";
        }
        points += "\n";
    }
    folder.write("a.xyz", points);
    REQUIRE(run(folder, {"verify", kExistingMesh, "a.xyz", "--json", "a.json"}).status == 0);
    const Json closest = json_in(folder, "a.json")["smallest"];
    CHECK(given["closest"]["samples"] == closest["samples"]);

    const Outcome verified = run(folder, {"verify", kExistingMesh, "b.csv", "--json", "v.json"});
    INFO(verified.out, verified.err);
    CHECK(verified.status == 0);
    CHECK(contains(verified.out, " of them; at least "));
    CHECK(json_in(folder, "v.json")["existing"]["violations"]["complete"] == false);
}

TEST_CASE("a column existing of another program marks nothing") {
    const TemporaryFolder folder;
    folder.write("points.csv", "x,y,z,existing\n0.5,0.25,0.005,1\n0.5,0.26,0.005,7\n");
    const Outcome verified = run(folder, {"verify", "builtin:plate:4", "points.csv", "-d", "0.1"});
    CHECK(verified.status == 1);
    CHECK(contains(verified.err, "points.csv: ignoring the column: sample 1 has no 0 or 1 in the "
                                 "column existing\n"));
    CHECK(contains(verified.out, " of the minimum distance\n"));
}

TEST_CASE("a column that the header names must have its numbers") {
    const TemporaryFolder folder;
    const auto fails = [&](const std::string& column, const std::string& key,
                           const std::string& value, const std::string& part) {
        folder.write("points.csv", "# " + key + "\n# min_distance: 0.1\nx,y,z," + column +
                                       "\n0.5,0.25,0.005,0\n0.2,0.25,0.005," + value + "\n");
        check_fails(folder, 3, "points.csv: sample 1 has no " + part + " in the column " + column,
                    {"verify", "builtin:plate:4", "points.csv"});
    };
    fails("existing", "existing: a.csv", "3", "0 or 1");
    fails("existing", "existing: a.csv", "0.5", "0 or 1");
    fails("class", "classes: 2", "-1", "whole number");
    fails("class", "classes: 2", "1.5", "whole number");
    fails("class", "classes: 2", "x", "whole number");
    fails("feature", "features: 30", "0.5", "whole number");
    fails("level", "level_distances: 0.2 0.1", "1.5", "whole number");
}

TEST_CASE("points are avoided, each by a radius of its own, and verified") {
    const TemporaryFolder folder;
    folder.write("wells.csv", "x,y,z,Size\n0.5,0.25,0.005,0.2\n0.2,0.2,0.005,0.05\n");
    const char* const mesh = "builtin:plate:4";
    REQUIRE(run(folder, {"sample", mesh, "-o", "free.ply", "-d", "0.03"}).status == 0);
    const Outcome made = run(folder, {"sample", mesh, "-o", "b.ply", "-d", "0.03", "--avoid",
                                      "wells.csv:Size", "--json", "b.json"});
    INFO(made.out, made.err);
    REQUIRE(made.status == 0);
    CHECK(contains(made.out, "avoided       2 points\n"));
    CHECK(json_in(folder, "b.json")["avoided"] == 2);
    const tools::SampleFile all = tools::read_samples(folder / "b.ply");
    CHECK(all.extra_values("existing").empty());
    CHECK(*all.header.find("avoid") == "wells.csv:Size");
    for (const tools::SampleRow& row : all.rows) {
        const bool is_above = row.position[2] > 0.004;
        const double x = row.position[0], y = row.position[1];
        REQUIRE((!is_above || std::hypot(x - 0.5, y - 0.25) >= 0.2));
        REQUIRE((!is_above || std::hypot(x - 0.2, y - 0.2) >= 0.05));
    }
    const Outcome verified = run(folder, {"verify", mesh, "b.ply", "--avoid", "wells.csv:size"});
    INFO(verified.out, verified.err);
    CHECK(verified.status == 0);
    CHECK(contains(verified.out, "avoided       2 points; 0 samples within the radii\n"));
    const Outcome wider =
        run(folder, {"verify", mesh, "b.ply", "--avoid", "wells.csv:0.21", "--json", "v.json"});
    CHECK(wider.status == 1);
    CHECK(contains(wider.err, "within the radius of a point or line to avoid"));
    const Json intrusions = json_in(folder, "v.json")["avoided"]["intrusions"];
    CHECK(intrusions["count"] > 0);
    CHECK(intrusions["rows"].size() == intrusions["count"]);

    // A sample counts once, however many disks it lies in, for the one in which it is deepest.
    folder.write("twice.csv", "x,y,z,size\n0.5,0.25,0.005,0.1\n0.5,0.25,0.005,0.1\n"
                              "0.5,0.24,0.005,0.2\n0.5,0.26,0.005,1e9\n");
    CHECK(run(folder, {"verify", mesh, "free.ply", "--avoid", "twice.csv:size", "--json", "t.json"})
              .status == 1);
    const Json rows = json_in(folder, "t.json")["avoided"]["intrusions"]["rows"];
    CHECK(rows.size() == tools::read_samples(folder / "free.ply").rows.size());
    CHECK(run(folder, {"verify", mesh, "free.ply", "--avoid", "wells.csv:size"}).status == 1);

    // With samples to keep, which may lie within; a file and a radius for each option.
    folder.write("inside.xyz", "0.5 0.25 0.005\n");
    REQUIRE(run(folder, {"sample", mesh, "-o", "c.ply", "-d", "0.03", "--existing", "inside.xyz",
                         "--avoid", "wells.csv:5%", "--avoid", "inside.xyz:0.1"})
                .status == 0);
    CHECK(run(folder, {"verify", mesh, "c.ply", "--avoid", "inside.xyz:0.1"}).status == 0);
}

TEST_CASE("points to avoid that leave no room are refused, unless samples are kept") {
    const TemporaryFolder folder;
    const Arguments sample{"sample", "builtin:cube", "-o", "b.ply"};
    folder.write("one.xyz", "0 0 0.5\n");
    const std::string none = "the points leave no room for samples; lower their radii";
    for (const Arguments& more :
         {Arguments{"-d", "0.1"}, Arguments{"-n", "100"}, Arguments{"-n", "10", "--exact"},
          Arguments{"-d", "0.1", "--maximal"}}) {
        check_fails(folder, 2, none, joined(joined(sample, more), {"--avoid", "one.xyz:1e30"}));
    }
    check_fails(folder, 2, none,
                {"sample", "builtin:cube", "--dry-run", "-d", "1", "--avoid", "one.xyz:1e30"});
    // Just no room: only the run knows.
    check_fails(folder, 2, "candidates lies outside the radii of the points; lower them",
                joined(sample, {"-d", "0.1", "--avoid", "one.xyz:2.1"}));
    check_fails(folder, 2, "--count: found no room for a sample, down to distance",
                joined(sample, {"-n", "100", "--avoid", "one.xyz:2.1"}));

    folder.write("points.csv", "x,y,z,size\n0,0,0.5,0.2\n0,0,-0.5,1e9\n0.5,0.5,0,3\n");
    const Outcome kept =
        run(folder,
            joined(sample, {"-d", "0.1", "--existing", "one.xyz", "--avoid", "points.csv:size"}));
    INFO(kept.out, kept.err);
    CHECK(kept.status == 0);
    CHECK(contains(kept.err, "no new sample fits beside the existing ones and the points to avoid; "
                             "lower the distance or the radii"));
    CHECK(contains(kept.out, "avoided       3 points\n"));
    const Outcome full = run(folder, joined(sample, {"-d", "9", "--existing", "one.xyz"}));
    CHECK(full.status == 0);
    CHECK(contains(full.err, "no new sample fits beside the existing ones; lower the distance\n"));
}

TEST_CASE("points that cannot be avoided are refused") {
    const TemporaryFolder folder;
    folder.write("wells.csv", "x,y,z,size\n0.5,0.25,0.005,0.2\n0.2,0.2,0.005,0\n");
    folder.write("far.xyz", "0.5 0.25 3.005\n");
    const auto fails = [&](int status, const std::string& part, const Arguments& more) {
        check_fails(folder, status, part,
                    joined({"sample", "builtin:plate:4", "-o", "b.ply", "-d", "0.1"}, more));
    };
    fails(2, "--avoid: 'wells.csv' is not POINTS:RADIUS", {"--avoid", "wells.csv"});
    fails(2, "--avoid", {"--avoid", "wells.csv:0"});
    fails(2, "--avoid", {"--avoid", "wells.csv:-1"});
    fails(3, "wells.csv: has no column width", {"--avoid", "wells.csv:width"});
    fails(3, "wells.csv: point 1: its size is 0, not a positive radius",
          {"--avoid", "wells.csv:size"});
    fails(3,
          "than --tolerance allows; point 0 is 3 away. Give the mesh that the "
          "points were made on",
          {"--avoid", "far.xyz:1"});
    REQUIRE(run(folder, {"sample", kExistingMesh, "-o", "other.csv", "-n", "50"}).status == 0);
    fails(3, "other.csv: point 0", {"--avoid", "other.csv:1"});
    fails(3, "none.csv", {"--avoid", "none.csv:1"});
}

TEST_CASE("empty files of samples to keep and points to avoid change nothing, with a word") {
    const TemporaryFolder folder;
    folder.write("empty.csv", "x,y,z\n");
    const auto rows = [&](const Arguments& more, const std::string& said) {
        const Outcome made = run(
            folder,
            joined({"sample", "builtin:plate:4", "-d", "0.1", "-o", "a.csv", "--no-header"}, more));
        INFO(made.err);
        CHECK(made.status == 0);
        CHECK(contains(made.err, said));
        return bytes_of(folder / "a.csv");
    };
    const std::string plain = rows({}, "");
    const std::string kept = "empty.csv: has no samples to keep, so --existing does nothing";
    CHECK(rows({"--existing", "empty.csv"}, kept) == plain);
    CHECK(rows({"--avoid", "empty.csv:0.1"},
               "empty.csv: has no points to avoid, so --avoid does nothing") == plain);
    CHECK(rows({"--existing", "empty.csv", "--classes", "2"}, kept) ==
          rows({"--classes", "2"}, ""));
}

TEST_CASE("distances through space keep existing samples too") {
    const TemporaryFolder folder;
    REQUIRE(run(folder, {"sample", kExistingMesh, "-o", "a.csv", "-n", "50"}).status == 0);
    const Outcome more =
        run(folder, {"sample", kExistingMesh, "-o", "b.csv", "-d", "0.05", "--metric", "euclidean",
                     "--existing", "a.csv", "--seed", "2"});
    INFO(more.err);
    REQUIRE(more.status == 0);
    const auto before = tools::read_samples(folder / "a.csv").rows;
    const auto after = tools::read_samples(folder / "b.csv").rows;
    REQUIRE(after.size() > before.size());
    for (std::size_t i = 0; i < before.size(); ++i) {
        CHECK(after[i].face == before[i].face);
    }
}

TEST_CASE("existing samples that cannot be kept are refused") {
    const TemporaryFolder folder;
    REQUIRE(run(folder, {"sample", kExistingMesh, "-o", "a.ply", "-n", "50"}).status == 0);
    const auto fails = [&](int status, const std::string& part, const Arguments& more,
                           const char* mesh = "builtin:plate:4") {
        check_fails(folder, status, part, joined({"sample", mesh, "-o", "b.ply"}, more));
    };
    folder.write("far.xyz", "0.5 0.25 0.005\n0.5 0.25 3.005\n");
    fails(3,
          "far.xyz: 1 point lies farther off builtin:plate:4 than --tolerance allows; sample 1 "
          "is 3 away",
          {"-d", "0.1", "--existing", "far.xyz"});
    fails(3, "a.ply: sample", {"-d", "0.1", "--existing", "a.ply"});
    folder.write("nan.xyz", "0.5 nan 0\n");
    fails(3, "nan.xyz: line 1", {"-d", "0.1", "--existing", "nan.xyz"});
    fails(3, "none.ply", {"-d", "0.1", "--existing", "none.ply"});
    fails(2, "--tolerance is for points that are read; give --existing or --avoid",
          {"-d", "0.1", "--tolerance", "1"});
    fails(2, "samples of --existing count too, so ask for more than",
          {"-n", "20", "--existing", "a.ply"}, kExistingMesh);
    check_fails(folder, 2, "the samples would replace the existing samples",
                {"sample", kExistingMesh, "-o", "a.ply", "-n", "400", "--existing", "a.ply"});
}

} // namespace geodisk::test
