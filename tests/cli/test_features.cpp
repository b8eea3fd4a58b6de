// Samples on corners and curves, made and verified.
#include <doctest/doctest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "cli/command.hpp"
#include "cli/json_file.hpp"
#include "files/output/output_file.hpp"
#include "files/samples/sample_file.hpp"
#include "program/exact_text.hpp"

namespace geodisk::test {
namespace {} // namespace

TEST_CASE("features come first, are marked, and keep their distance") {
    const TemporaryFolder folder;
    const char* const mesh = "builtin:cube:4";
    const Outcome made = run(folder, {"sample", mesh, "-o", "a.ply", "-d", "5%", "--features", "30",
                                      "--json", "a.json"});
    INFO(made.out, made.err);
    REQUIRE(made.status == 0);
    CHECK(contains(made.out, "features      8 corners, "));
    const Json features = json_in(folder, "a.json")["features"];
    CHECK(features["corners"] == 8);
    CHECK(features["corners_left_out"] == 0);
    CHECK(features["length"] == 12.0);
    const tools::SampleFile samples = tools::read_samples(folder / "a.ply");
    const auto column = samples.extra_values("feature");
    REQUIRE(column.size() == samples.rows.size());
    CHECK(std::is_sorted(column.rbegin(), column.rend()));
    CHECK(features["on_curves"] == std::ranges::count(column, 1u));
    CHECK(*samples.header.find("features") == "30");
    const Outcome verified = run(folder, {"verify", mesh, "a.ply"});
    INFO(verified.out, verified.err);
    CHECK(verified.status == 0);

    // With samples to keep, which are told apart, and a mask.
    const Outcome more = run(folder, {"sample", mesh, "-o", "b.csv", "-d", "5%", "--features", "30",
                                      "--existing", "a.ply", "--mask", "z>0"});
    INFO(more.out, more.err);
    CHECK(more.status == 0);
    CHECK(contains(more.out, "0 corners, 0 samples on curves"));
    CHECK(run(folder, {"verify", mesh, "b.csv", "--mask", "z>0"}).status == 0);
}

TEST_CASE("corners closer than the distance are left out, and a smooth surface has no features") {
    const TemporaryFolder folder;
    const Outcome few =
        run(folder, {"sample", "builtin:cube:4", "-o", "a.ply", "-d", "1.2", "--features", "30"});
    CHECK(few.status == 0);
    CHECK(contains(few.out, "left out, closer than the distance to another"));
    CHECK(run(folder, {"verify", "builtin:cube:4", "a.ply"}).status == 0);
    const Outcome none = run(
        folder, {"sample", "builtin:icosphere", "-o", "b.ply", "-d", "0.2", "--features", "60"});
    CHECK(none.status == 0);
    CHECK(contains(none.err, "so there are no features"));
}

TEST_CASE("marks that do not fit their places are found") {
    const TemporaryFolder folder;
    const char* const mesh = "builtin:cube:4";
    const Outcome made =
        run(folder, {"sample", mesh, "-o", "a.ply", "-d", "20%", "--features", "30"});
    REQUIRE(made.status == 0);
    const tools::SampleFile samples = tools::read_samples(folder / "a.ply");
    const auto marks = samples.extra_values("feature");
    const std::size_t last = marks.size() - 1;
    for (const auto& [sample, wrong] : std::vector<std::pair<std::size_t, std::uint32_t>>{
             {0, 0}, {0, 1}, {8, 0}, {8, 2}, {last, 1}, {last, 2}, {last, 7}}) {
        const std::size_t row = sample;
        const std::uint32_t mark = wrong;
        std::string bad = "# features: 30\nx,y,z,face_index,bary_u,bary_v,bary_w,feature\n";
        for (std::size_t i = 0; i < marks.size(); ++i) {
            const tools::SampleRow& at = samples.rows[i];
            bad += tools::exact_text(at.position[0]) + ',' + tools::exact_text(at.position[1]) +
                   ',' + tools::exact_text(at.position[2]) + ',' + std::to_string(at.face) + ',' +
                   tools::exact_text(double{at.bary[0]}) + ',' +
                   tools::exact_text(double{at.bary[1]}) + ',' +
                   tools::exact_text(double{at.bary[2]}) + ',' +
                   std::to_string(i == row ? mark : marks[i]) + '\n';
        }
        std::ofstream(folder / "bad.csv") << bad;
        const Outcome found = run(folder, {"verify", mesh, "bad.csv", "-d", "20%"});
        INFO(row, " ", mark, found.out, found.err);
        CHECK(found.status == 1);
        CHECK(contains(found.err, "1 sample has a wrong mark in the column feature"));
    }
}

TEST_CASE(
    "darts on features stop at a count among the samples on corners, on curves and on faces") {
    const TemporaryFolder folder;
    const auto sample = [&](const char* count) {
        const Outcome done =
            run(folder, {"sample", "builtin:cube:4", "-o", "a.csv", "-d", "5%", "--features", "30",
                         "--method", "darts", "-n", count, "--no-header"});
        INFO(done.err);
        REQUIRE(done.status == 0);
        return lines_of(bytes_of(folder / "a.csv"));
    };
    const std::vector<std::string> all = sample("500");
    REQUIRE(all.size() == 501);
    for (const std::size_t count : {1u, 8u, 20u, 300u}) {
        CAPTURE(count);
        const std::vector<std::string> some = sample(std::to_string(count).c_str());
        REQUIRE(some.size() == count + 1); // With the names of the columns.
        CHECK(std::equal(some.begin(), some.end(), all.begin()));
    }
}

TEST_CASE("what takes no features ends in an error, without a file") {
    const TemporaryFolder folder;
    for (const auto& [options, message] : std::vector<std::pair<Arguments, const char*>>{
             {{"--features", "0"}, "is not a number of 1 to 180"},
             {{"--features", "181"}, "is not a number of 1 to 180"},
             {{"--features", "sharp"}, "is not a number of 1 to 180"}}) {
        const Outcome refused =
            run(folder, joined({"sample", "builtin:cube:4", "-o", "b.ply", "-d", "5%"}, options));
        INFO(refused.err);
        CHECK(refused.status != 0);
        CHECK(contains(refused.err, message));
        CHECK_FALSE(std::filesystem::exists(folder / "b.ply"));
    }
}

} // namespace geodisk::test
