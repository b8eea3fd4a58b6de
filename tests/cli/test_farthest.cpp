// `--order farthest` of `geodisk sample` and `transfer`.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "cli/command.hpp"
#include "cli/json_file.hpp"
#include "files/samples/sample_file.hpp"

namespace geodisk::test {
namespace {

constexpr const char* kFarthestMesh = "builtin:torus-knot:8";

Json sample_farthest(const TemporaryFolder& folder, const char* file, const Arguments& options) {
    Arguments arguments{"sample", kFarthestMesh, "-n", "300", "-o", file, "--json", "report.json"};
    arguments.insert(arguments.end(), options.begin(), options.end());
    const Outcome outcome = run(folder, arguments);
    INFO(outcome.err);
    REQUIRE(outcome.status == 0);
    return json_in(folder, "report.json");
}

using Place = std::pair<std::uint32_t, float>;

std::vector<Place> places_in(const TemporaryFolder& folder, const char* file) {
    std::vector<Place> places;
    for (const tools::SampleRow& row : tools::read_samples(folder / file).rows) {
        places.emplace_back(row.face, row.bary[1]);
    }
    return places;
}

std::vector<double> column_in(const TemporaryFolder& folder, const char* file, const char* name) {
    std::vector<double> numbers = tools::read_samples(folder / file, name).numbers;
    for (double& number : numbers) {
        number = double{static_cast<float>(number)}; // Text has the shortest one.
    }
    return numbers;
}

} // namespace

TEST_CASE("samples in farthest-point order are those of dart order, with their cover") {
    const TemporaryFolder folder;
    sample_farthest(folder, "dart.csv", {});
    const Json report =
        sample_farthest(folder, "far.csv", {"--order", "farthest", "--classes", "2"});
    sample_farthest(folder, "classes.csv", {"--classes", "2"});
    const std::vector<Place> before = places_in(folder, "classes.csv");
    const std::vector<Place> after = places_in(folder, "far.csv");
    CHECK(std::is_permutation(before.begin(), before.end(), after.begin(), after.end()));
    CHECK(before != after);
    CHECK(before[0] == after[0]);
    const std::vector<double> cover = column_in(folder, "far.csv", "cover");
    REQUIRE(cover.size() == after.size());
    CHECK(std::isinf(cover[0]));
    CHECK(std::ranges::is_sorted(cover, std::greater<>()));
    CHECK(cover.back() > 0);
    CHECK(report["farthest"]["samples"] == after.size());
    CHECK(report["farthest"]["kept"] == after.size());
    CHECK(report["farthest"]["left_out_within"] == 0);
    CHECK(report["farthest"]["min_cover"].get<double>() == cover.back());
    CHECK(report["seconds"]["order"].get<double>() > 0);
    CHECK(run(folder, {"verify", kFarthestMesh, "far.csv"}).status == 0); // Also the classes.
}

TEST_CASE("the first samples of the order are kept, and are as far apart as their cover") {
    const TemporaryFolder folder;
    sample_farthest(folder, "all.ply", {"--order", "farthest"});
    const Json report = sample_farthest(folder, "few.ply", {"--order", "farthest", "--keep", "40"});
    const std::vector<Place> all = places_in(folder, "all.ply");
    const std::vector<Place> few = places_in(folder, "few.ply");
    CHECK(few == std::vector(all.begin(), all.begin() + 40));
    CHECK(report["samples"] == 40);
    CHECK(report["farthest"]["samples"] == all.size());
    const std::vector<double> cover = column_in(folder, "few.ply", "cover");
    const auto verify = [&](double distance) {
        return run(folder, {"verify", kFarthestMesh, "few.ply", "-d", std::to_string(distance)})
            .status;
    };
    CHECK(verify(0.9999 * cover.back()) == 0);
    CHECK(verify(1.0001 * cover.back()) == 1);
    CHECK(run(folder, {"verify", kFarthestMesh, "few.ply"}).status == 0);
    check_fails(folder, 2, "--keep: there are only ",
                {"sample", kFarthestMesh, "-n", "50", "-o", "b.ply", "--order", "farthest",
                 "--keep", "5000"});
}

TEST_CASE("transfer puts samples of a file in the same order") {
    const TemporaryFolder folder;
    sample_farthest(folder, "dart.ply", {});
    sample_farthest(folder, "far.ply", {"--order", "farthest"});
    const Outcome outcome =
        run(folder, {"transfer", "dart.ply", kFarthestMesh, kFarthestMesh, "-o", "few.glb",
                     "--order", "farthest", "--keep", "30", "--json", "report.json"});
    INFO(outcome.err);
    REQUIRE(outcome.status == 0);
    CHECK(contains(outcome.out, "kept          the first 30 of them; the others are within "));
    CHECK(json_in(folder, "report.json")["farthest"]["kept"] == 30);
    CHECK(contains(bytes_of(folder / "few.glb"), "_COVER"));
    REQUIRE(run(folder, {"transfer", "dart.ply", kFarthestMesh, kFarthestMesh, "-o", "all.csv",
                         "--order", "farthest"})
                .status == 0);
    CHECK(places_in(folder, "all.csv") == places_in(folder, "far.ply"));
    CHECK(column_in(folder, "all.csv", "cover") == column_in(folder, "far.ply", "cover"));
}

TEST_CASE("the order goes on from existing samples") {
    const TemporaryFolder folder;
    REQUIRE(run(folder, {"sample", kFarthestMesh, "-n", "40", "-o", "first.ply"}).status == 0);
    const std::vector<Place> first = places_in(folder, "first.ply");
    sample_farthest(folder, "far.csv", {"--order", "farthest", "--existing", "first.ply"});
    const std::vector<Place> far = places_in(folder, "far.csv");
    REQUIRE(far.size() > first.size());
    CHECK(std::equal(first.begin(), first.end(), far.begin()));
    const std::vector<double> cover = column_in(folder, "far.csv", "cover");
    const auto next = cover.begin() + static_cast<std::ptrdiff_t>(first.size());
    CHECK(std::all_of(cover.begin(), next, [](double distance) { return std::isinf(distance); }));
    CHECK(std::isfinite(*next));
    CHECK(std::is_sorted(next, cover.end(), std::greater<>()));
    CHECK(run(folder, {"verify", kFarthestMesh, "far.csv"}).status == 0);

    sample_farthest(folder, "dart.csv", {"--existing", "first.ply"});
    const std::vector<Place> dart = places_in(folder, "dart.csv");
    const std::vector<double> rows = column_in(folder, "far.csv", "row");
    for (std::size_t i = 0; i < far.size(); ++i) {
        CHECK(far[i] == dart[static_cast<std::size_t>(rows[i])]);
    }
    REQUIRE(run(folder, {"transfer", "dart.csv", kFarthestMesh, kFarthestMesh, "-o", "again.csv",
                         "--order", "farthest", "--first", std::to_string(first.size())})
                .status == 0);
    CHECK(places_in(folder, "again.csv") == far);
    CHECK(column_in(folder, "again.csv", "row") == rows);
    REQUIRE(run(folder, {"transfer", "dart.csv", kFarthestMesh, kFarthestMesh, "-o", "start.csv",
                         "--order", "farthest", "--start", "57"})
                .status == 0);
    CHECK(places_in(folder, "start.csv").front() == dart[57]);
    CHECK(column_in(folder, "start.csv", "row").front() == 57);
}

TEST_CASE("columns that a format lacks are left out with a warning") {
    const TemporaryFolder folder;
    sample_farthest(folder, "dart.ply", {});
    const auto warns = [&](const std::string& column, const std::string& output, Arguments all) {
        all.insert(all.end(), {"-o", output, "-q"});
        const Outcome outcome = run(folder, all);
        INFO(outcome.err);
        CHECK(outcome.status == 0);
        CHECK(contains(outcome.err, output + ": an " + output.substr(1) +
                                        " file has no columns, so the column " + column +
                                        " is left out"));
        CHECK(std::filesystem::exists(folder / output));
    };
    warns("cover", "a.xyz", {"sample", kFarthestMesh, "-n", "50", "--order", "farthest"});
    warns("cover", "b.obj",
          {"transfer", "dart.ply", kFarthestMesh, kFarthestMesh, "--order", "farthest"});
    warns("existing", "c.xyz", {"sample", kFarthestMesh, "-n", "600", "--existing", "dart.ply"});
    warns("feature", "d.xyz", {"sample", kFarthestMesh, "-n", "50", "--features", "30"});
    warns("level", "e.xyz", {"sample", kFarthestMesh, "-n", "50", "--order", "progressive"});
    CHECK_FALSE(
        contains(run(folder, {"sample", kFarthestMesh, "-n", "50", "-o", "f.xyz"}).err, "column"));
}

TEST_CASE("what farthest-point order does not go with is refused") {
    const TemporaryFolder folder;
    sample_farthest(folder, "a.csv", {});
    struct Case {
        Arguments options;
        const char* message;
    };
    const Case cases[] = {
        {{"--keep", "3"}, "--keep is for --order farthest"},
        {{"--order", "farthest", "--keep", "0"}, "--keep: '0' is not a whole number"},
        {{"--order", "farthest", "--levels", "3"}, "--levels is for --order progressive"},
        {{"--order", "farthest", "--dry-run"}, "it takes no --order farthest"},
    };
    for (const Case& wrong : cases) {
        const bool is_dry = wrong.options.back() == "--dry-run";
        check_fails(folder, 2, wrong.message,
                    joined({"sample", kFarthestMesh, "-d", "0.5"},
                           joined(wrong.options, is_dry ? Arguments{} : Arguments{"-o", "b.ply"})));
    }
    const auto refuses = [&](const Arguments& options, const char* message) {
        check_fails(
            folder, 2, message,
            joined({"transfer", "a.csv", kFarthestMesh, kFarthestMesh, "-o", "b.ply"}, options));
    };
    refuses({"--start", "3"}, "--start is for --order farthest");
    refuses({"--first", "3"}, "--first is for --order farthest");
    refuses({"--order", "farthest", "--start", "x"}, "--start: 'x' is not a whole number");
    refuses({"--order", "farthest", "--start", "5000"}, "--start: there are only ");
    refuses({"--order", "farthest", "--first", "5000"}, "--first: there are only ");
    refuses({"--order", "farthest", "--first", "9", "--keep", "8"},
            "--keep: 9 samples come first as they are, more than 8");
    refuses({"--order", "farthest", "--first", "9", "--start", "8"},
            "--start and --first exclude each other");
    refuses({"--order", "dart"}, "--order: 'dart' is neither file nor farthest");
}

} // namespace geodisk::test
