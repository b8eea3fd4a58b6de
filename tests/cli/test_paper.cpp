// The program that redraws the paper's figures: its files and its failures. What the figures say is
// nothing a test could know.
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

struct Figure {
    std::string name;
    std::vector<std::string> others; ///< Files beside the table.
    std::ptrdiff_t rows;
    std::vector<std::string> arguments;
};

/// Runs the command of that name. Checks that it writes NAME.csv with this many rows below the
/// columns, and the other files.
Outcome check_figure(const Figure& figure) {
    const std::string& name = figure.name;
    INFO(name);
    const TemporaryFolder folder;
    std::vector<std::string> arguments{name};
    arguments.insert(arguments.end(), figure.arguments.begin(), figure.arguments.end());
    Outcome outcome = run(folder, arguments, paper());
    REQUIRE(outcome.status == 0);
    CHECK(outcome.err.empty());
    std::vector<std::string> expected = figure.others;
    expected.push_back(name + ".csv");
    std::sort(expected.begin(), expected.end());
    CHECK(files_in(folder) == expected);

    std::vector<std::string> lines = lines_of(bytes_of(folder / (name + ".csv")));
    REQUIRE_FALSE(lines.empty());
    CHECK(contains(lines[0], ", commit "));
    std::erase_if(lines, [](const std::string& line) { return line.starts_with("# "); });
    CHECK(std::ssize(lines) == figure.rows + 1);
    for (const std::string& line : lines) {
        CHECK(std::count(line.begin(), line.end(), ',') ==
              std::count(lines[0].begin(), lines[0].end(), ','));
    }
    for (const std::string& other : figure.others) {
        if (other.ends_with(".png")) {
            const PngImage image = read_png(folder / other);
            CHECK(std::count(image.pixels.begin(), image.pixels.end(), image.pixels.front()) <
                  std::ssize(image.pixels));
            continue;
        }
        CHECK(contains(bytes_of(folder / other), other.ends_with(".svg") ? "<svg " : ", commit "));
        CHECK_FALSE(contains(bytes_of(folder / other), "nan"));
    }
    return outcome;
}

const std::vector<Figure>& figures() {
    static const std::vector<Figure> kAll{
        {"table1",
         {"table1.svg"},
         5,
         {"builtin:icosphere:2", "-n", "100", "--ratios", "7,20", "--pool-ratios", "5,10",
          "--repeats", "2"}},
        {"fig3",
         {"fig3-1.png", "fig3-2.png"},
         4,
         {"builtin:icosphere:2", "builtin:torus-knot:4", "--counts", "50,100", "--size", "64"}},
        {"fig4",
         {"fig4-curves.csv", "fig4a.svg", "fig4b.svg"},
         6,
         {"builtin:icosphere:3", "-n", "60", "--harmonics", "100", "--repeats", "3", "--deals",
          "40"}},
        {"fig5",
         {"fig5a.svg", "fig5b.svg", "fig5c.svg"},
         5,
         {"builtin:cube", "--counts", "20,60", "--ratios", "2,5,10", "--ratio-count", "40",
          "--repeats", "1"}},
        {"fig8",
         {"fig8.svg", "fig8.png"},
         2,
         {"--size", "64", "builtin:icosphere:1", "builtin:icosphere:3", "-n", "60", "--repeats",
          "2"}},
        {"fig9",
         {"fig9.svg", "fig9.png"},
         6,
         {"builtin:plate:4", "--size", "64", "--counts", "40,200", "--repeats", "1"}},
        {"fig10", {"fig10.png"}, 4, {"-n", "2000", "--size", "64"}},
        {"fig11", {"fig11.png"}, 1, {"builtin:icosphere:3", "-n", "200", "--size", "64"}},
        {"fig12",
         {"fig12abc.png", "fig12d.png", "fig12e.svg", "fig12f.svg", "fig12-spectrum.csv"},
         3,
         {"--square", "0.05", "--cube", "0.1", "--spectrum", "0.05", "--repeats", "2", "--size",
          "64"}},
        {"fig13",
         {"fig13a.svg", "fig13b.svg"},
         2,
         {"builtin:icosphere:3", "--counts", "30,60", "--repeats", "1"}},
        {"fig13",
         {"fig13a.svg", "fig13b.svg"},
         1,
         {"builtin:icosphere:3", "--counts", "30", "--repeats", "1", "--trials", "2", "--ratio",
          "5"}},
        {"fig14", {"fig14.svg"}, 6, {"--radius", "0.03", "--ratios", "2,5", "--repeats", "2"}},
        {"boxes", {}, 3, {"-n", "200", "--dims", "1,3,6", "--repeats", "1", "--open"}}};
    return kAll;
}

} // namespace

TEST_CASE("each figure writes its files") {
    for (const Figure& figure : figures()) {
        check_figure(figure);
    }
}

TEST_CASE("fig7 shows what each metric loses, and that exact distances lose nothing") {
    const Outcome outcome =
        check_figure({"fig7",
                      {"fig7.svg", "fig7.png"},
                      std::ptrdiff_t{4} * 3 * 2,
                      {"--distances", "0.15,0.3", "--repeats", "1", "--size", "64"}});
    CHECK(contains(outcome.out, "same set"));
    CHECK_FALSE(contains(outcome.out, "another set"));
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
    }
}

TEST_CASE("the paper's figures explain their failures") {
    const TemporaryFolder folder;
    const Outcome nothing = run(folder, {}, paper());
    CHECK(nothing.status == 2);
    CHECK(nothing.err.find("Usage: geodisk_paper [OPTIONS] SUBCOMMAND") != std::string::npos);
    check_fails(folder, 2, "MESH is required", {"table1"}, paper());
    check_fails(folder, 2, "--harmonics", {"fig4", "builtin:icosphere:1", "--harmonics", "1000"},
                paper());
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
