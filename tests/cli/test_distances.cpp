// `geodisk distances`: files, sources, the picture, and what it refuses. It needs no device.
#include <doctest/doctest.h>

#include <filesystem>
#include <fstream>
#include <set>
#include <string>
#include <vector>

#include "cli/command.hpp"
#include "cli/json_file.hpp"
#include "cli/png_image.hpp"

namespace geodisk::test {
namespace {

using Arguments = std::vector<std::string>;

const char* const kTwoSquares = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 5 0 0\nv 6 0 0\nv 5 1 0\n"
                                "f 1 2 3\nf 1 3 4\nf 5 6 7\n";

std::string measured(const TemporaryFolder& folder, Arguments arguments) {
    arguments.insert(arguments.begin(), "distances");
    arguments.insert(arguments.end(), {"-o", "far.csv", "--json", "far.json"});
    const Outcome outcome = run(folder, arguments);
    INFO(outcome.err);
    REQUIRE(outcome.status == 0);
    return bytes_of(folder / "far.csv");
}

void check_not_measured(const TemporaryFolder& folder, int status, const std::string& message,
                        Arguments arguments) {
    arguments.insert(arguments.begin(), "distances");
    arguments.insert(arguments.end(), {"-o", "no.csv", "--json", "no.json"});
    check_fails(folder, status, message, arguments);
    CHECK_FALSE(std::filesystem::exists(folder / "no.csv"));
    CHECK_FALSE(std::filesystem::exists(folder / "no.json"));
}

} // namespace

TEST_CASE("distances from vertices and points, where a path leads") {
    const TemporaryFolder folder;
    std::ofstream(folder / "square.obj") << kTwoSquares;
    CHECK(measured(folder, {"square.obj", "--vertices", "1"}) ==
          "vertex,distance,source\n0,1,1\n1,0,1\n2,1,1\n3,1.4142135623730951,1\n");
    const auto report = json_in(folder, "far.json");
    CHECK(report["reached"] == 4);
    CHECK(report["distances"] == 7);
    CHECK(report["sources"] == 1);
    CHECK(measured(folder, {"square.obj", "--vertices", "0,2,4"}) ==
          "vertex,distance,source\n0,0,0\n1,1,0\n2,0,2\n3,1,0\n4,0,4\n5,1,4\n6,1,4\n");
    CHECK(measured(folder, {"square.obj", "--vertices", "4,5", "--each", "--within", "1.2"}) ==
          "vertex,distance,source\n4,0,4\n5,1,4\n6,1,4\n4,1,5\n5,0,5\n");
    std::ofstream(folder / "well.csv") << "x,y,z\n0.25,0,0\n";
    CHECK(measured(folder, {"square.obj", "well.csv", "--within", "0.5"}) ==
          "vertex,distance,source\n0,0.25,0\n");
}

TEST_CASE("distances as arrays, and as a picture") {
    const TemporaryFolder folder;
    const Outcome outcome = run(folder, {"distances", "builtin:icosphere:3", "--vertices", "0",
                                         "-o", "far.npz", "--picture", "far.png"});
    INFO(outcome.err);
    REQUIRE(outcome.status == 0);
    CHECK(outcome.out.find("distances     642 of 642, up to 3.1") != std::string::npos);
    CHECK(bytes_of(folder / "far.npz").substr(0, 2) == "PK");
    const PngImage picture = read_png(folder / "far.png");
    CHECK(picture.width == 1920);
    CHECK(picture.height == 1080);
    std::set<int> reds; // From yellow near the source to blue far from it.
    for (const Pixel& pixel : picture.pixels) {
        reds.insert(pixel.red);
    }
    CHECK(reds.size() > 150);
}

TEST_CASE("distances are refused without a source, and where they could not be written") {
    const TemporaryFolder folder;
    std::ofstream(folder / "square.obj") << kTwoSquares;
    check_not_measured(folder, 2, "give --vertices, or POINTS: from where to measure",
                       {"square.obj"});
    check_not_measured(folder, 2, "--vertices: there is no vertex 8, since the mesh has 8",
                       {"builtin:cube:1", "--vertices", "8"});
    check_not_measured(folder, 2, "--vertices contradicts POINTS: sources are either",
                       {"square.obj", "well.csv", "--vertices", "0"});
    check_not_measured(folder, 2, "--picture shows the distances from the nearest source",
                       {"square.obj", "--vertices", "0", "--each", "--picture", "a.png"});
    check_not_measured(folder, 2, "--within", {"square.obj", "--vertices", "0", "--within", "-1"});
    check_not_measured(folder, 2, "pictures are written as *.png",
                       {"square.obj", "--vertices", "0", "--picture", "a.jpg"});
    check_fails(folder, 2, "far.ply: distances are written as .npz, .csv or .shape.gii",
                {"distances", "square.obj", "--vertices", "0", "-o", "far.ply"});
}

TEST_CASE("distances are a shape of GIFTI") {
    const TemporaryFolder folder;
    std::ofstream(folder / "square.obj") << kTwoSquares;
    const auto measure = [&](const Arguments& more) {
        Arguments arguments{"distances", "square.obj", "--vertices", "1"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        return run(folder, arguments);
    };
    REQUIRE(measure({"-o", "a.shape.gii"}).status == 0);
    REQUIRE(measure({"-o", "b", "--format", "gii"}).status == 0);
    CHECK(bytes_of(folder / "a.shape.gii") == bytes_of(folder / "b"));
    CHECK(contains(bytes_of(folder / "b"), "<Value>distance from 1</Value>"));
    const Outcome labels = measure({"-o", "a.label.gii"});
    CHECK(labels.status == 2);
    CHECK(contains(labels.err, "distances are no labels; write *.shape.gii"));
    CHECK_FALSE(std::filesystem::exists(folder / "a.label.gii"));
}

} // namespace geodisk::test
