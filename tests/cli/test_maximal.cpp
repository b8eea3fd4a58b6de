// `geodisk sample --dense` and `--maximal`, and `geodisk verify --maximal`.
#include <doctest/doctest.h>

#include <filesystem>
#include <string>

#include "cli/command.hpp"
#include "cli/json_file.hpp"

namespace geodisk::test {
namespace {

/// Samples the cube into a.ply, and returns the report.
Json sampled(const TemporaryFolder& folder, const Arguments& options, std::string* summary) {
    Arguments arguments{"sample", "builtin:cube", "-o", "a.ply", "--json", "a.json"};
    arguments.insert(arguments.end(), options.begin(), options.end());
    const Outcome outcome = run(folder, arguments);
    INFO(outcome.err);
    REQUIRE(outcome.status == 0);
    *summary = outcome.out;
    return json_in(folder, "a.json");
}

std::string refusal(const Arguments& options) {
    const TemporaryFolder folder;
    const Outcome outcome = run(folder, options);
    CHECK(outcome.status == 2);
    CHECK_FALSE(std::filesystem::exists(folder / "a.ply"));
    return outcome.err;
}

} // namespace

TEST_CASE("a maximal set is certified, and verify agrees") {
    const TemporaryFolder folder;
    std::string summary;
    const Json report = sampled(folder, {"-d", "0.2", "--maximal"}, &summary);
    CHECK(contains(summary, "certified: every point is within 0.2"));
    CHECK(report["stopped_by"] == "maximal");
    CHECK(report["maximal"]["certificate"] == true);
    CHECK(report["maximal"]["rounds"] > 0);
    CHECK(report["maximal"]["cells"] > 12);
    CHECK(report["maximal"]["disks"] == report["disks"]);
    CHECK(report["maximal"]["largest_gap"] > 0.2);
    CHECK(report["maximal"]["largest_gap"] < 0.2002);
    const Outcome verified =
        run(folder, {"verify", "builtin:cube", "a.ply", "--maximal", "--json", "v.json"});
    INFO(verified.err);
    CHECK(verified.status == 0);
    CHECK(contains(verified.out, "every point is covered"));
    const Json found = json_in(folder, "v.json")["maximal"];
    CHECK(found["certificate"] == true);
    CHECK(found["largest_gap"] > 0.19);
    CHECK(found["uncovered"].is_null());
}

TEST_CASE("a certificate tells of points to avoid and of a mask") {
    const TemporaryFolder folder;
    folder.write("one.xyz", "0.5 0.5 0\n");
    std::string summary;
    sampled(folder, {"-d", "0.3", "--maximal", "--avoid", "one.xyz:0.4", "--mask", "z<0.5"},
            &summary);
    CHECK(contains(summary, "certified: every point that may have a sample is within 0.3"));
    CHECK(contains(summary, " of a sample or avoided\n"));
}

TEST_CASE("verify finds a point that is uncovered") {
    const TemporaryFolder folder;
    std::string summary;
    const Json pool = sampled(folder, {"-d", "0.2"}, &summary);
    CHECK(pool["maximal"].is_null());
    CHECK(pool["dense"] == false);
    const Outcome verified =
        run(folder, {"verify", "builtin:cube", "a.ply", "--maximal", "--json", "v.json"});
    CHECK(verified.status != 0);
    CHECK(contains(verified.err, "the set is not maximal"));
    CHECK(contains(verified.err, "a sample fits in triangle"));
    const Json found = json_in(folder, "v.json")["maximal"];
    CHECK(found["certificate"] == false);
    CHECK(found["largest_gap"] > 0.2);
    CHECK(found["uncovered"]["weights"].size() == 3);

    const Json dense = sampled(folder, {"-d", "0.2", "--dense"}, &summary);
    CHECK(dense["dense"] == true);
    CHECK(dense["pool_ratio"] == 100);
    CHECK(dense["samples"] > pool["samples"]);
    CHECK(contains(summary, "(dense)"));
}

TEST_CASE("what contradicts dense and maximal sets is refused") {
    const auto cube = [](const Arguments& options) {
        Arguments all{"sample", "builtin:cube", "-o", "a.ply", "-d", "0.2"};
        all.insert(all.end(), options.begin(), options.end());
        return refusal(all);
    };
    CHECK(contains(cube({"--dense", "--pool-ratio", "50"}), "give just one of them"));
    CHECK(contains(cube({"--dense", "--maximal"}), "--dense adds nothing"));
    CHECK(contains(cube({"--dense", "--method", "darts", "--darts", "9"}), "raise --darts"));
    CHECK(contains(refusal({"box", "-o", "a.csv", "--dim", "2", "-d", "0.1", "--maximal"}),
                   "--maximal is for surfaces"));
}

} // namespace geodisk::test
