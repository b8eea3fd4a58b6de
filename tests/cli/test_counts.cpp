// Counts: `--exact`, and what it refuses.
#include <doctest/doctest.h>

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "cli/command.hpp"
#include "files/sample_file.hpp"

namespace geodisk::test {
namespace {

using Json = nlohmann::json;
using Arguments = std::vector<std::string>;

constexpr const char* kMesh = "builtin:torus-knot:8";

void sample(const TemporaryFolder& folder, const char* file, const Arguments& options) {
    Arguments arguments{"sample", kMesh, "-o", file, "--json", "report.json"};
    arguments.insert(arguments.end(), options.begin(), options.end());
    const Outcome outcome = run(folder, arguments);
    INFO(outcome.err);
    REQUIRE(outcome.status == 0);
}

Json report_in(const TemporaryFolder& folder) {
    return Json::parse(bytes_of(folder / "report.json"));
}

std::string distance_in(const TemporaryFolder& folder, const char* file) {
    const tools::SampleFile samples = tools::read_samples(folder / file);
    const std::string* const distance = samples.header.find("min_distance");
    REQUIRE(distance != nullptr);
    return *distance;
}

} // namespace

TEST_CASE("an exact count keeps the first samples of a run with at most 1 % more") {
    const TemporaryFolder folder;
    for (const Arguments& options : {Arguments{}, {"--radius-factor", "curvature"}}) {
        Arguments arguments{"--count", "300", "--exact", "--seed", "2"};
        arguments.insert(arguments.end(), options.begin(), options.end());
        sample(folder, "exact.ply", arguments);
        const Json report = report_in(folder);
        CHECK(report["samples"] == 300);
        CHECK(report["exact"] == true);
        CHECK(report["cut"] <= 3);
        CHECK(report["runs"] <= 6);
        arguments = {"--min-distance", distance_in(folder, "exact.ply"), "--seed", "2"};
        arguments.insert(arguments.end(), options.begin(), options.end());
        sample(folder, "all.ply", arguments);
        CHECK(report_in(folder)["samples"] == 300 + report["cut"].get<int>());
        const tools::SampleFile exact = tools::read_samples(folder / "exact.ply");
        const tools::SampleFile all = tools::read_samples(folder / "all.ply");
        REQUIRE(exact.rows.size() == 300);
        for (std::size_t i = 0; i < exact.rows.size(); ++i) {
            REQUIRE(exact.rows[i].face == all.rows[i].face);
            REQUIRE(exact.rows[i].bary[1] == all.rows[i].bary[1]);
        }
        arguments = {"verify", kMesh, "exact.ply"};
        arguments.insert(arguments.end(), options.begin(), options.end());
        CHECK(run(folder, arguments).status == 0);
    }
}

TEST_CASE("existing samples count towards an exact count") {
    const TemporaryFolder folder;
    sample(folder, "a.ply", {"--count", "100", "--exact"});
    sample(folder, "b.ply", {"--count", "150", "--exact", "--existing", "a.ply"});
    const tools::SampleFile all = tools::read_samples(folder / "b.ply");
    CHECK(all.rows.size() == 150);
    CHECK(all.extra_values("given")[99] == 1);
    CHECK(all.extra_values("given")[100] == 0);
    CHECK(run(folder, {"verify", kMesh, "b.ply"}).status == 0);
}

TEST_CASE("boxes have exact counts") {
    const TemporaryFolder folder;
    const Outcome made =
        run(folder, {"box", "--dim", "3", "--count", "200", "--exact", "-o", "box.csv"});
    INFO(made.err);
    REQUIRE(made.status == 0);
    CHECK(contains(made.out, "samples       200 as asked for, of 20"));
    CHECK(run(folder, {"verify", "box.csv"}).status == 0);
}

TEST_CASE("exact counts that cannot be are refused without a file") {
    const TemporaryFolder folder;
    struct Case {
        Arguments options;
        const char* message;
    };
    const Case cases[] = {
        {{"--exact", "-d", "1"}, "--exact needs a number of samples"},
        {{"--exact", "-n", "0"}, "--count: '0' is not a whole number of at least 1"},
        {{"--exact", "-n", "5000000000"}, "is too many; the maximum is 4,294,967,295"},
        {{"--exact", "-n", "4000000000"}, "the minimum distance is too small"},
        {{"--exact", "-n", "10", "--method", "darts", "-d", "1"}, "--exact is for --method pool"},
    };
    for (const Case& wrong : cases) {
        Arguments arguments{"sample", kMesh, "-o", "a.ply"};
        arguments.insert(arguments.end(), wrong.options.begin(), wrong.options.end());
        const Outcome outcome = run(folder, arguments);
        CAPTURE(outcome.err);
        CHECK(outcome.status == 2);
        CHECK(contains(outcome.err, wrong.message));
    }
    // Nothing fits beside a point to avoid that reaches everywhere.
    sample(folder, "one.csv", {"--count", "1"});
    const Outcome full = run(
        folder, {"sample", kMesh, "-o", "a.ply", "-n", "5", "--exact", "--avoid", "one.csv:1000"});
    CHECK(full.status == 2);
    CHECK(contains(full.err, "no distance tried gave more than 0 of 5 samples"));
    CHECK(!std::filesystem::exists(folder / "a.ply"));
}

} // namespace geodisk::test
