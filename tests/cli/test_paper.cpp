// The program that redraws the paper's figures: its files, what it prints beside them, its
// failures. What the figures say is nothing a test could know.
#include <doctest/doctest.h>

#include <algorithm>

#include "cli/command.hpp"
#include "cli/png_image.hpp"

namespace geodisk::test {
namespace {

Setting paper() {
    Setting setting;
    setting.program = GEODISK_PAPER;
    return setting;
}

/// Runs it and checks that it writes `name`.csv, with so many rows below the columns, and other
/// files, plots above all.
Outcome check_figure(const std::string& name, const std::vector<std::string>& others,
                     std::ptrdiff_t rows, const std::vector<std::string>& arguments) {
    INFO(name);
    const TemporaryFolder folder;
    Outcome outcome = run(folder, arguments, paper());
    REQUIRE(outcome.status == 0);
    CHECK(outcome.err.empty());
    std::vector<std::string> expected = others;
    expected.push_back(name + ".csv");
    std::sort(expected.begin(), expected.end());
    CHECK(files_in(folder) == expected);

    std::vector<std::string> lines = lines_of(bytes_of(folder / (name + ".csv")));
    REQUIRE_FALSE(lines.empty());
    CHECK(contains(lines[0], ", commit "));
    std::erase_if(lines, [](const std::string& line) { return line.starts_with("# "); });
    CHECK(std::ssize(lines) == rows + 1);
    for (const std::string& line : lines) {
        CHECK(std::count(line.begin(), line.end(), ',') ==
              std::count(lines[0].begin(), lines[0].end(), ','));
    }
    for (const std::string& other : others) {
        if (other.ends_with(".png")) {
            const PngImage image = read_png(folder / other);
            CHECK(std::count(image.pixels.begin(), image.pixels.end(), image.pixels.front()) <
                  std::ssize(image.pixels));
            continue;
        }
        CHECK(contains(bytes_of(folder / other), other.ends_with(".svg") ? "<svg " : ", commit "));
        CHECK_FALSE(contains(bytes_of(folder / other), "nan"));
    }
    CHECK(contains(outcome.out, name + ".csv"));
    return outcome;
}

} // namespace

TEST_CASE("table1 stands beside the printed rows") {
    const Outcome outcome = check_figure("table1", {"table1.svg"}, 5,
                                         {"table1", "builtin:icosphere:2", "-n", "100", "--ratios",
                                          "7,20", "--pool-ratios", "5,10", "--repeats", "2"});
    CHECK(contains(outcome.out, "measured"));
    CHECK(contains(outcome.out, "91.39"));
    CHECK_FALSE(contains(outcome.out, "75.94"));
}

TEST_CASE("fig3 shows each mesh at each density") {
    check_figure("fig3", {"fig3-1.png", "fig3-2.png"}, 4,
                 {"fig3", "builtin:icosphere:2", "builtin:torus-knot:4", "--counts", "50,100",
                  "--size", "64"});
}

TEST_CASE("fig10 keeps samples apart in R^4 and in another pose") {
    const Outcome outcome =
        check_figure("fig10", {"fig10.png"}, 4, {"fig10", "-n", "2000", "--size", "64"});
    CHECK(contains(outcome.out, "klein-bottle"));
}

TEST_CASE("fig11 varies radii along a mesh") {
    check_figure("fig11", {"fig11.png"}, 1,
                 {"fig11", "builtin:icosphere:3", "-n", "200", "--size", "64"});
}

TEST_CASE("fig12 shows boxes and a spectrum") {
    check_figure("fig12",
                 {"fig12abc.png", "fig12d.png", "fig12e.svg", "fig12f.svg", "fig12-spectrum.csv"},
                 3,
                 {"fig12", "--square", "0.05", "--cube", "0.1", "--spectrum", "0.05", "--repeats",
                  "2", "--size", "64"});
}

TEST_CASE("figures draws all of them" * doctest::test_suite("slow")) {
    const TemporaryFolder folder;
    const Outcome outcome = run(folder,
                                {"figures", "--quick", "--size", "64", "builtin:showpiece:60",
                                 "--resolutions", "builtin:showpiece:60,builtin:showpiece:80"},
                                paper());
    REQUIRE(outcome.status == 0);
    const std::vector<std::string> files = files_in(folder);
    for (const char* const figure : {"3", "4", "5", "7", "8", "9", "10", "11", "12", "13", "14"}) {
        CHECK(std::count(files.begin(), files.end(), std::string("fig") + figure + ".csv") == 1);
        CHECK(contains(outcome.out, std::string("geodisk_paper fig") + figure + " "));
    }
}

TEST_CASE("fig4 tells methods apart by their spectra") {
    check_figure("fig4", {"fig4-curves.csv", "fig4a.svg", "fig4b.svg"}, 6,
                 {"fig4", "builtin:icosphere:3", "-n", "60", "--harmonics", "100", "--repeats", "3",
                  "--deals", "40"});
    const TemporaryFolder folder;
    check_fails(folder, 2, "--harmonics", {"fig4", "builtin:icosphere:1", "--harmonics", "1000"},
                paper());
}

TEST_CASE("fig5 sweeps samples and candidates") {
    check_figure("fig5", {"fig5a.svg", "fig5b.svg", "fig5c.svg"}, 5,
                 {"fig5", "builtin:cube", "--counts", "20,60", "--ratios", "2,5,10",
                  "--ratio-count", "40", "--repeats", "1"});
}

TEST_CASE("fig7 shows what each metric loses, and that exact distances lose nothing") {
    const Outcome outcome =
        check_figure("fig7", {"fig7.svg", "fig7.png"}, std::ptrdiff_t{4} * 3 * 2,
                     {"fig7", "--distances", "0.15,0.3", "--repeats", "1", "--size", "64"});
    CHECK(contains(outcome.out, "same set"));
    CHECK_FALSE(contains(outcome.out, "another set"));
}

TEST_CASE("fig9 counts pairs that are too close") {
    check_figure(
        "fig9", {"fig9.svg", "fig9.png"}, 6,
        {"fig9", "builtin:plate:4", "--size", "64", "--counts", "40,200", "--repeats", "1"});
}

TEST_CASE("fig8 has a row for each mesh") {
    const Outcome outcome = check_figure("fig8", {"fig8.svg", "fig8.png"}, 2,
                                         {"fig8", "--size", "64", "builtin:icosphere:1",
                                          "builtin:icosphere:3", "-n", "60", "--repeats", "2"});
    CHECK(contains(outcome.out, "1280"));
}

TEST_CASE("fig13 compares metrics and methods") {
    check_figure("fig13", {"fig13a.svg", "fig13b.svg"}, 2,
                 {"fig13", "builtin:icosphere:3", "--counts", "30,60", "--repeats", "1"});
    check_figure("fig13", {"fig13a.svg", "fig13b.svg"}, 1,
                 {"fig13", "builtin:icosphere:3", "--counts", "30", "--repeats", "1", "--trials",
                  "2", "--ratio", "5"});
}

TEST_CASE("fig14 approaches the maximal density") {
    const Outcome outcome =
        check_figure("fig14", {"fig14.svg"}, 6,
                     {"fig14", "--radius", "0.03", "--ratios", "2,5", "--repeats", "2"});
    // Printed for one radius alone.
    CHECK_FALSE(contains(outcome.out, "0.7791"));
}

TEST_CASE("boxes has a row for each dimension") {
    const Outcome outcome = check_figure(
        "boxes", {}, 3, {"boxes", "-n", "200", "--dims", "1,3,6", "--repeats", "1", "--open"});
    CHECK(contains(outcome.out, "1.5"));
}

TEST_CASE("the paper's figures explain their failures") {
    const TemporaryFolder folder;
    check_fails(folder, 2, "subcommand", {}, paper());
    check_fails(folder, 2, "MESH is required", {"table1"}, paper());
    check_fails(folder, 2, "--count", {"fig8", "builtin:cube", "-n", "few"}, paper());
    check_fails(folder, 2, "--distances", {"fig7", "--distances", "0"}, paper());
    check_fails(folder, 2, "--size", {"fig3", "builtin:cube", "--size", "5"}, paper());
    check_fails(folder, 2, "--least", {"fig11", "builtin:cube", "--least", "2"}, paper());
    check_fails(folder, 2, "--size", {"figures", "--size", "no"}, paper());
    check_fails(folder, 2, "--ratios", {"fig14", "--ratios", "0.5"}, paper());
    check_fails(folder, 2, "--dims", {"boxes", "--dims", "7"}, paper());
    check_fails(folder, 3, "missing.obj", {"fig13", "missing.obj"}, paper());
    check_fails(folder, 4, "cannot write", {"fig14", "--out", "none"}, paper());
    check_fails(folder, 5, "none of them", {"fig5", "builtin:cube", "--device", "none of them"},
                paper());
}

} // namespace geodisk::test
