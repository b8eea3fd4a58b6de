// `--exact` and `--order progressive`, and what they refuse.
#include <doctest/doctest.h>

#include <cmath>
#include <cstddef>
#include <filesystem>
#include <fstream>
#include <string>

#include "cli/command.hpp"
#include "cli/json_file.hpp"
#include "files/samples/sample_file.hpp"

namespace geodisk::test {
namespace {

constexpr const char* kCountsMesh = "builtin:torus-knot:8";

void sample(const TemporaryFolder& folder, const char* file, const Arguments& options) {
    Arguments arguments{"sample", kCountsMesh, "-o", file, "--json", "report.json"};
    arguments.insert(arguments.end(), options.begin(), options.end());
    const Outcome outcome = run(folder, arguments);
    INFO(outcome.err);
    REQUIRE(outcome.status == 0);
}

Json report_in(const TemporaryFolder& folder) {
    return json_in(folder, "report.json");
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
        arguments = {"verify", kCountsMesh, "exact.ply"};
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
    CHECK(all.extra_values("existing")[99] == 1);
    CHECK(all.extra_values("existing")[100] == 0);
    CHECK(run(folder, {"verify", kCountsMesh, "b.ply"}).status == 0);
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
        {{"-n", "1e9", "--exact"}, "samples need a pool of 2e+10 candidates, the maximum is"},
        {{"-n", "1e8", "--dense"}, "lower --count or the pool ratio"},
    };
    for (const Case& wrong : cases) {
        check_fails(folder, 2, wrong.message,
                    joined({"sample", kCountsMesh, "-o", "a.ply"}, wrong.options));
    }
    // Nothing fits beside a point to avoid that reaches everywhere.
    sample(folder, "one.csv", {"--count", "1"});
    const Arguments avoid{"sample", kCountsMesh, "-o", "a.ply", "--avoid", "one.csv:1000"};
    for (const Arguments& count : {Arguments{"-n", "5", "--exact"}, {"-n", "50"}}) {
        check_fails(folder, 2, "--avoid: the points leave no room for samples; lower their radii",
                    joined(avoid, count));
    }
}

TEST_CASE("a progressive order has levels that are spaced, each by its distance") {
    const TemporaryFolder folder;
    for (const Arguments& options : {Arguments{}, {"--radius-factor", "curvature"}}) {
        Arguments arguments{"-d", "0.3", "--seed", "3", "--order", "progressive"};
        arguments.insert(arguments.end(), options.begin(), options.end());
        sample(folder, "a.ply", arguments);
        const Json levels = report_in(folder)["levels"];
        REQUIRE(levels.size() >= 2);
        const tools::SampleFile all = tools::read_samples(folder / "a.ply");
        const auto column = all.extra_values("level");
        REQUIRE(column.size() == all.rows.size());
        for (std::size_t level = 0; level < levels.size(); ++level) {
            const double scale = std::pow(2.0, static_cast<double>(levels.size() - 1 - level));
            CHECK(levels[level]["min_distance"].get<double>() == 0.3 * scale);
            const std::size_t end = levels[level]["samples"];
            REQUIRE(end > 0);
            CHECK(column[end - 1] == level);
            CHECK((end == column.size() || column[end] == level + 1));
        }
        arguments = {"verify", kCountsMesh, "a.ply", "--json", "verify.json"};
        arguments.insert(arguments.end(), options.begin(), options.end());
        CHECK(run(folder, arguments).status == 0);
        const Json verified = json_in(folder, "verify.json")["levels"];
        REQUIRE(verified.size() == levels.size());
        for (std::size_t level = 0; level < levels.size(); ++level) {
            CHECK(verified[level]["samples"] == levels[level]["samples"]);
            CHECK(verified[level]["violations"]["pairs"] == 0);
        }
        // The first level is an ordinary run.
        arguments = {"-d", levels[0]["min_distance"].dump(), "--seed", "3"};
        arguments.insert(arguments.end(), options.begin(), options.end());
        sample(folder, "first.ply", arguments);
        const tools::SampleFile first = tools::read_samples(folder / "first.ply");
        REQUIRE(first.rows.size() == levels[0]["samples"]);
        for (std::size_t i = 0; i < first.rows.size(); ++i) {
            REQUIRE(first.rows[i].face == all.rows[i].face);
            REQUIRE(first.rows[i].bary[1] == all.rows[i].bary[1]);
        }
    }
}

TEST_CASE("a progressive order has counts, existing samples and levels of one's own") {
    const TemporaryFolder folder;
    sample(folder, "a.csv", {"-n", "300", "--exact", "--order", "progressive", "--levels", "3"});
    CHECK(report_in(folder)["samples"] == 300);
    CHECK(report_in(folder)["levels"].size() == 3);
    CHECK(report_in(folder)["levels"][2]["samples"] == 300);
    CHECK(run(folder, {"verify", kCountsMesh, "a.csv"}).status == 0);
    sample(folder, "b.csv",
           {"-n", "600", "--order", "progressive", "--level-factor", "1.5", "--existing", "a.csv"});
    const tools::SampleFile more = tools::read_samples(folder / "b.csv");
    CHECK(more.extra_values("existing")[299] == 1);
    CHECK(more.extra_values("existing")[300] == 0);
    CHECK(more.extra_values("level")[299] == 0);
    CHECK(run(folder, {"verify", kCountsMesh, "b.csv"}).status == 0);
    // One level is dart order.
    sample(folder, "one.csv", {"-n", "50", "--order", "progressive", "--levels", "1"});
    sample(folder, "dart.csv", {"-n", "50"});
    CHECK(tools::read_samples(folder / "one.csv").rows.size() ==
          tools::read_samples(folder / "dart.csv").rows.size());
}

TEST_CASE("verify finds levels that are not spaced, and files that contradict themselves") {
    const TemporaryFolder folder;
    sample(folder, "a.csv", {"-d", "0.5", "--order", "progressive", "--levels", "3"});
    const std::string text = bytes_of(folder / "a.csv");
    const auto verify = [&](const std::string& old_text, const std::string& new_text) {
        std::string changed = text;
        const std::size_t at = changed.find(old_text);
        REQUIRE(at != std::string::npos);
        changed.replace(at, old_text.size(), new_text);
        std::ofstream(folder / "b.csv") << changed;
        return run(folder, {"verify", kCountsMesh, "b.csv"});
    };
    const Outcome close = verify("level_distances: 2 1 0.5", "level_distances: 2 1.4 0.5");
    CHECK(close.status == 1);
    CHECK(contains(close.err, "closer than 1.4, the distance of level 1"));
    CHECK(contains(verify("level_distances: 2 1 0.5", "level_distances: 1 0.5").err,
                   "is of level 2, but the header has 2 levels"));
    CHECK(contains(verify("level_distances: 2 1 0.5", "level_distances: 1 2 0.5").err,
                   "not positive numbers that fall"));
    CHECK(contains(verify(",level", ",lewel").err, "it has no column level"));
    CHECK(run(folder, {"verify", kCountsMesh, "a.csv"}).status == 0);
    // A prefix of whole lines is a set of its own.
    const Outcome less =
        verify("# samples: " + std::to_string(tools::read_samples(folder / "a.csv").rows.size()),
               "# none: 0");
    CHECK(less.status == 0);
    const std::string ends = "level_samples: ";
    CHECK(contains(verify(ends, ends + "9").err, "samples up to level 0, the column level "));
    CHECK(contains(verify(ends, ends + "1 ").err, "its header has 3 levels, but the samples of 4"));
}

TEST_CASE("orders that cannot be are refused without a file") {
    const TemporaryFolder folder;
    struct Case {
        Arguments options;
        const char* message;
    };
    const Case cases[] = {
        {{"--order", "random"}, "--order: 'random' is none of dart, progressive and farthest"},
        {{"--levels", "3"}, "--levels is for --order progressive"},
        {{"--level-factor", "3"}, "--level-factor is for --order progressive"},
        {{"--order", "progressive", "--levels", "0"}, "--levels: '0' is not a whole number"},
        {{"--order", "progressive", "--levels", "33"}, "the maximum is 32"},
        {{"--order", "progressive", "--level-factor", "1"}, "--level-factor: '1'"},
        {{"--order", "progressive", "--dry-run"}, "--dry-run tries one run"},
    };
    for (const Case& wrong : cases) {
        const bool is_dry = wrong.options.back() == "--dry-run";
        check_fails(folder, 2, wrong.message,
                    joined({"sample", kCountsMesh, "-d", "0.5"},
                           joined(wrong.options, is_dry ? Arguments{} : Arguments{"-o", "a.ply"})));
    }
}

} // namespace geodisk::test
