// `geodisk spectrum` shows blue noise where there is some.
#include <doctest/doctest.h>

#include <cmath>
#include <string>

#include <nlohmann/json.hpp>

#include "cli/command.hpp"
#include "cli/png_image.hpp"

namespace geodisk::test {

namespace {

void check_blue_noise(const nlohmann::json& report, double anisotropy_db, double tolerance) {
    CHECK(report["low_power"].get<double>() < 0.2);
    CHECK(report["peak"]["power"].get<double>() > 1.2);
    CHECK(report["peak"]["frequency"].get<double>() == doctest::Approx(1.1).epsilon(0.2));
    CHECK(report["mean_anisotropy_db"].get<double>() ==
          doctest::Approx(report["expected_anisotropy_db"].get<double>()).epsilon(tolerance));
    CHECK(report["expected_anisotropy_db"].get<double>() ==
          doctest::Approx(anisotropy_db).epsilon(0.01));
}

} // namespace

TEST_CASE("samples in the plane are blue noise without a direction") {
    const TemporaryFolder folder;
    Arguments files;
    for (int seed = 0; seed < 5; ++seed) {
        files.push_back(std::to_string(seed) + ".csv");
        REQUIRE(run(folder, {"box", "--dim", "2", "--periodic", "-d", "0.03", "--seed",
                             std::to_string(seed), "-o", files.back()})
                    .status == 0);
    }
    const Outcome outcome =
        run(folder, joined(joined({"spectrum"}, files), {"--json", "-", "-o", "s.png"}));
    INFO(outcome.err);
    REQUIRE(outcome.status == 0);
    const auto report = nlohmann::json::parse(outcome.out);
    CHECK(report["sets"] == 5);
    check_blue_noise(report, -6.99, 0.1);
    CHECK(report["rings"]["power"].size() == report["rings"]["frequency"].size());
    const PngImage image = read_png(folder / "s.png");
    CHECK(image.width == 2 * 133 + 1);
    CHECK(image.height == image.width);
    // Dark in the middle, lighter around it.
    const auto light_at = [&](int x, int y) {
        int sum = 0;
        for (int dy = -3; dy <= 3; ++dy) {
            for (int dx = -3; dx <= 3; ++dx) {
                sum += image
                           .pixels[static_cast<std::size_t>(y + dy) *
                                       static_cast<std::size_t>(image.width) +
                                   static_cast<std::size_t>(x + dx)]
                           .red;
            }
        }
        return sum / 49;
    };
    CHECK(light_at(133, 133) < 30);
    CHECK(light_at(133 + 60, 133) > 80);

    const Outcome table = run(folder, joined(joined({"spectrum"}, files), {"-o", "s.csv"}));
    CHECK(table.status == 0);
    CHECK(contains(table.out, "anisotropy"));
    CHECK(bytes_of(folder / "s.csv").starts_with("frequency,frequencies,power,anisotropy_db\n"));
}

TEST_CASE("samples of a surface are blue noise without a direction") {
    const TemporaryFolder folder;
    Arguments files{"builtin:icosphere:4"};
    for (int seed = 0; seed < 5; ++seed) {
        files.push_back(std::to_string(seed) + (seed % 2 == 0 ? ".ply" : ".csv"));
        REQUIRE(run(folder, {"sample", "builtin:icosphere:4", "-d", "0.4", "--seed",
                             std::to_string(seed), "-o", files.back()})
                    .status == 0);
    }
    const Arguments spectrum = joined({"spectrum"}, files);
    const Outcome outcome =
        run(folder, joined(spectrum, {"--json", "-", "-o", "s.csv", "--harmonics", "500"}));
    REQUIRE(outcome.status == 0);
    CHECK(contains(outcome.err, "500 harmonics of 2,562 vertices"));
    const auto report = nlohmann::json::parse(outcome.out);
    CHECK(report["sets"] == 5);
    CHECK(report["min_distance"] == 0.4);
    CHECK(report["harmonics"]["count"] == 500);
    CHECK(report["harmonics"]["highest_frequency"].get<double>() ==
          doctest::Approx(0.4 * std::sqrt(500 / 3.1416 / 12.54)).epsilon(0.12)); // It is coarse.
    CHECK(report["harmonics"]["expected_bytes"].get<double>() > 1e6);
    CHECK(report["warnings"].back()["kind"] == "coarse_mesh");
    check_blue_noise(report, -3.98, 0.15);
    CHECK(report["rings"]["power"].size() == report["rings"]["count"].size());
    CHECK(bytes_of(folder / "s.csv").starts_with("frequency,frequencies,power,anisotropy_db\n"));

    const Outcome text = run(folder, joined(spectrum, {"--harmonics", "100"}));
    CHECK(text.status == 0);
    CHECK(text.err.empty());
    CHECK(contains(text.out, "100 up to 0."));
    CHECK(contains(text.out, "takes --harmonics 1000"));

    const std::string mesh = files.front();
    check_fails(folder, 2, "is a mesh; give samples", {"spectrum", mesh});
    check_fails(folder, 2, "--reach", {"spectrum", mesh, "0.ply", "--reach", "2"});
    check_fails(folder, 2, "no directions", {"spectrum", mesh, "0.ply", "-o", "s.png"});
    check_fails(folder, 2, "so only 2,561 harmonics",
                {"spectrum", mesh, "0.ply", "--harmonics", "2562"});
    check_fails(folder, 2, "--harmonics", {"spectrum", mesh, "0.ply", "--harmonics", "0"});
    check_fails(folder, 3, "0.ply", {"spectrum", "builtin:cube", "0.ply"});
    REQUIRE(run(folder, {"sample", mesh, "-d", "0.5", "-o", "other.ply"}).status == 0);
    check_fails(folder, 3, "other.ply: has a minimum distance of 0.5, 0.ply one of 0.4",
                {"spectrum", mesh, "0.ply", "other.ply"});
    CHECK(run(folder, {"spectrum", mesh, "0.ply", "other.ply", "-d", "0.4", "--harmonics", "50"})
              .status == 0);
}

TEST_CASE("what has no spectrum is told") {
    const TemporaryFolder folder;
    REQUIRE(run(folder, {"box", "--dim", "2", "-d", "0.1", "-o", "a.csv"}).status == 0);
    REQUIRE(run(folder, {"box", "--dim", "3", "-d", "0.2", "-o", "b.csv"}).status == 0);
    REQUIRE(
        run(folder, {"box", "--dim", "2", "-d", "0.1", "--extents", "1,2", "-o", "c.csv"}).status ==
        0);
    check_fails(folder, 2, "SAMPLES", {"spectrum"});
    check_fails(folder, 2, "--harmonics", {"spectrum", "a.csv", "--harmonics", "9"});
    check_fails(folder, 2, "the header of a box has its own", {"spectrum", "a.csv", "-d", "0.2"});
    check_fails(folder, 2, "--reach", {"spectrum", "a.csv", "--reach", "0"});
    check_fails(folder, 2, "s.txt", {"spectrum", "a.csv", "-o", "s.txt"});
    check_fails(folder, 2, "would replace", {"spectrum", "a.csv", "-o", "a.csv"});
    check_fails(folder, 2, "two dimensions", {"spectrum", "b.csv", "-o", "s.png"});
    const Outcome space = run(folder, {"spectrum", "b.csv", "--reach", "2", "-o", "b-s.csv"});
    CHECK(space.status == 0);
    CHECK(contains(space.out, "1 x 1 x 1"));
    REQUIRE(run(folder, {"box", "--dim", "1", "-d", "0.1", "-o", "line.csv"}).status == 0);
    check_fails(folder, 3, "one dimension", {"spectrum", "line.csv"});
    check_fails(folder, 3, "c.csv: has a box of 1 x 2", {"spectrum", "a.csv", "c.csv"});
    check_fails(folder, 3, "no.csv", {"spectrum", "no.csv"});
    folder.write("none.csv", "# box: 1 x 1\n# sides: open\n# min_distance: 0.1\nx,y\n");
    check_fails(folder, 3, "no samples", {"spectrum", "none.csv"});
    folder.write("far.csv", "# box: 1 x 1\n# sides: open\n# min_distance: 1e-6\nx,y\n0,0\n");
    check_fails(folder, 6, "--reach", {"spectrum", "far.csv"});
    folder.write("near.csv", "# box: 1 x 1\n# sides: open\n# min_distance: 10\nx,y\n0,0\n");
    check_fails(folder, 3, "too small", {"spectrum", "near.csv"});
}

} // namespace geodisk::test
