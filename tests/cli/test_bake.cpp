// `geodisk bake`: maps of the nearest sample, and what it refuses.
#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <map>
#include <random>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>

#include "cli/command.hpp"
#include "cli/png_image.hpp"

namespace geodisk::test {
namespace {

using Json = nlohmann::json;

void write_mesh_file(const TemporaryFolder& folder, const char* name, const std::string& text) {
    std::ofstream(folder / name) << text;
}

/// Two triangles: the unit square, in the left half of the texture.
const char* const kBakedSquare = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n"
                                 "vt 0 0\nvt 0.5 0\nvt 0.5 1\nvt 0 1\nf 1/1 2/2 3/3 4/4\n";
const char* const kEnds = "x,y,z\n0,0.5,0\n1,0.5,0\n";

void check_bake_refused(const TemporaryFolder& folder, int status, const std::string& message,
                        Arguments arguments) {
    arguments.insert(arguments.begin(), "bake");
    check_fails(folder, status, message, arguments);
}

} // namespace

TEST_CASE("bake: pictures show cells and distances") {
    const TemporaryFolder folder;
    write_mesh_file(folder, "square.obj", kBakedSquare);
    write_mesh_file(folder, "ends.csv", kEnds);
    const Outcome outcome = run(folder, {"bake", "square.obj", "ends.csv", "-o", "cells.png",
                                         "--size", "64x32", "--json", "map.json"});
    INFO(outcome.err);
    REQUIRE(outcome.status == 0);
    CHECK(contains(outcome.out, "1,024 of 64 x 32 have a face"));
    const PngImage cells = read_png(folder / "cells.png");
    REQUIRE(cells.width == 64);
    REQUIRE(cells.height == 32);
    const Pixel left = cells.pixels[0], right = cells.pixels[31];
    CHECK_FALSE(left == right);
    for (std::size_t i = 0; i < cells.pixels.size(); ++i) {
        const std::size_t column = i % 64;
        REQUIRE(cells.pixels[i] == (column < 16 ? left : column < 32 ? right : Pixel{0, 0, 0, 0}));
    }
    const Json json = Json::parse(bytes_of(folder / "map.json"));
    CHECK(json["size"] == Json{64, 32});
    CHECK(json["texels"]["covered"] == 1024);
    CHECK(json["texels"]["overlapping"] == 0);
    CHECK(json["texels"]["unreached"] == 0);
    CHECK(json["largest_distance"].get<double>() < 0.72);

    REQUIRE(run(folder, {"bake", "square.obj", "ends.csv", "-o", "grey.png", "--size", "64x32",
                         "--style", "distance", "-q"})
                .status == 0);
    const PngImage grey = read_png(folder / "grey.png");
    for (std::size_t i = 0; i < grey.pixels.size(); ++i) {
        const Pixel pixel = grey.pixels[i];
        REQUIRE(pixel.red == pixel.green);
        REQUIRE(pixel.alpha == (i % 64 < 32 ? 255 : 0));
    }
    CHECK(grey.pixels[15 * 64].red < 16);
    CHECK(grey.pixels[15].red > 240); // A corner of the middle line.
}

TEST_CASE("bake: cells that touch have different colours") {
    const TemporaryFolder folder;
    write_mesh_file(folder, "square.obj", kBakedSquare);
    std::mt19937 random(11);
    std::uniform_real_distribution<double> anywhere(0, 1);
    std::vector<std::array<double, 2>> points(150);
    std::string table = "x,y,z\n";
    for (auto& [x, y] : points) {
        x = anywhere(random), y = anywhere(random);
        table += std::to_string(x) + "," + std::to_string(y) + ",0\n";
    }
    write_mesh_file(folder, "points.csv", table);
    REQUIRE(run(folder,
                {"bake", "square.obj", "points.csv", "-o", "cells.png", "--size", "512x256", "-q"})
                .status == 0);
    const PngImage cells = read_png(folder / "cells.png");
    REQUIRE(cells.width == 512);
    const auto nearest = [&](std::size_t column, std::size_t row) {
        const double x = (static_cast<double>(column) + 0.5) / 256;
        const double y = 1 - (static_cast<double>(row) + 0.5) / 256;
        return static_cast<std::size_t>(
            std::ranges::min_element(
                points, {}, [&](const auto& p) { return std::hypot(p[0] - x, p[1] - y); }) -
            points.begin());
    };
    // Texels where two cells lie side by side: few are a corner that the grid does not show.
    constexpr int kBorder = 4;
    std::map<std::pair<std::size_t, std::size_t>, int> borders;
    std::map<std::size_t, Pixel> colors;
    std::set<std::array<int, 3>> kinds;
    for (std::size_t row = 0; row < 256; ++row) {
        for (std::size_t column = 0; column < 256; ++column) {
            const std::size_t own = nearest(column, row);
            const Pixel& pixel = cells.pixels[row * 512 + column];
            colors.emplace(own, pixel);
            kinds.insert({pixel.red, pixel.green, pixel.blue});
            if (column + 1 < 256) {
                const std::size_t next = nearest(column + 1, row);
                ++borders[std::minmax(own, next)];
            }
        }
    }
    CHECK(kinds.size() <= 6);
    int touching = 0;
    for (const auto& [pair, count] : borders) {
        if (pair.first != pair.second && count >= kBorder) {
            ++touching;
            CHECK_FALSE(colors.at(pair.first) == colors.at(pair.second));
        }
    }
    CHECK(touching > 150);
}

TEST_CASE("bake: overlaps and repeats are reported") {
    const TemporaryFolder folder;
    write_mesh_file(folder, "ends.csv", kEnds);
    write_mesh_file(folder, "twice.obj",
                    "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\nvt 2 0\nvt 2 1\nvt 0 1\n"
                    "f 1/1 2/2 3/3 4/4\n");
    const Outcome outcome = run(folder, {"bake", "twice.obj", "ends.csv", "-o", "map.npz", "--size",
                                         "16", "--json", "map.json"});
    REQUIRE(outcome.status == 0);
    CHECK(contains(outcome.out, "256 texels have several faces"));
    CHECK(contains(outcome.out, "2 faces have texture coordinates outside of 0 to 1"));
    const Json json = Json::parse(bytes_of(folder / "map.json"));
    CHECK(json["texels"]["overlapping"] == 256);
    CHECK(json["repeating_faces"] == 2);
    const std::string npz = bytes_of(folder / "map.npz");
    CHECK(contains(npz, "'<i4', 'fortran_order': False, 'shape': (16, 16)"));
    // Neither memory nor a second run matter.
    REQUIRE(run(folder, {"bake", "twice.obj", "ends.csv", "-o", "again.npz", "--size", "16",
                         "--memory", "64M", "-q"})
                .status == 0);
    CHECK(bytes_of(folder / "again.npz") == npz);
}

TEST_CASE("bake: padding surrounds islands") {
    const TemporaryFolder folder;
    write_mesh_file(folder, "square.obj", kBakedSquare);
    write_mesh_file(folder, "ends.csv", kEnds);
    const Arguments bake{"bake", "square.obj", "ends.csv", "--size", "64x32", "--padding", "3"};
    const Outcome outcome = run(folder, joined(bake, {"-o", "cells.png", "--json", "map.json"}));
    INFO(outcome.err);
    REQUIRE(outcome.status == 0);
    CHECK(contains(outcome.out, "padding       96 texels"));
    CHECK(Json::parse(bytes_of(folder / "map.json"))["texels"]["padded"] == 96);
    const PngImage cells = read_png(folder / "cells.png");
    const Pixel right = cells.pixels[31];
    for (std::size_t i = 0; i < cells.pixels.size(); ++i) {
        const std::size_t column = i % 64;
        REQUIRE((cells.pixels[i] == right) == (column >= 16 && column < 35));
        REQUIRE(cells.pixels[i].alpha == (column < 35 ? 255 : 0));
    }
    REQUIRE(run(folder, joined(bake, {"-o", "map.npy", "-q"})).status == 0);
    const std::string npy = bytes_of(folder / "map.npy");
    CHECK(contains(npy, "'descr': '<f4', 'fortran_order': False, 'shape': (32, 64)"));
    CHECK(npy.size() == 128 + 4 * 32 * 64);
    REQUIRE(run(folder, joined(bake, {"-o", "deep.png", "--style", "distance", "--depth", "16"}))
                .status == 0);
    const PngImage deep = read_png(folder / "deep.png"); // As 8 bits.
    CHECK(deep.pixels[15].red > 240);
    CHECK(deep.pixels[35].alpha == 0);
}

TEST_CASE("bake: what cannot be made leaves no file") {
    const TemporaryFolder folder;
    write_mesh_file(folder, "square.obj", kBakedSquare);
    write_mesh_file(folder, "ends.csv", kEnds);
    write_mesh_file(folder, "none.csv", "x,y,z\n");
    write_mesh_file(folder, "corner.csv", "x,y,z,face_index,bary_u,bary_v,bary_w\n0,0,0,0,1,0,0\n");
    write_mesh_file(folder, "bare.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    write_mesh_file(folder, "tiny.obj",
                    "v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 1e-5 0\nvt 0 1e-5\nf 1/1 2/2 3/3\n");
    write_mesh_file(folder, "far.obj",
                    "v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 1e9 0\nvt 0 1\nf 1/1 2/2 3/3\n");
    check_bake_refused(folder, 3, "has no texture coordinates",
                       {"bare.obj", "ends.csv", "-o", "no.npz"});
    check_bake_refused(folder, 3, "has no texture coordinates",
                       {"builtin:cube:2", "ends.csv", "-o", "no.npz"});
    check_bake_refused(folder, 3, "no face covers", {"tiny.obj", "corner.csv", "-o", "no.npz"});
    check_bake_refused(folder, 3, "too far from 0", {"far.obj", "corner.csv", "-o", "no.npz"});
    check_bake_refused(folder, 3, "none.csv", {"square.obj", "none.csv", "-o", "no.npz"});
    check_bake_refused(folder, 2, "maps are written as .npz, .npy or .png",
                       {"square.obj", "ends.csv", "-o", "no.tif"});
    check_bake_refused(folder, 2, "for distances as floats, write .npy",
                       {"square.obj", "ends.csv", "-o", "no.exr"});
    for (const char* const padding : {"-1", "1.5", "20000", "all"}) {
        check_bake_refused(folder, 2, "--padding takes 0 to 16384 texels",
                           {"square.obj", "ends.csv", "-o", "no.npz", "--padding", padding});
    }
    check_bake_refused(folder, 2, "--depth: '32' is neither 8 nor 16",
                       {"square.obj", "ends.csv", "-o", "no.png", "--depth", "32"});
    check_bake_refused(folder, 2, "--depth 16 is for *.png with --style distance",
                       {"square.obj", "ends.csv", "-o", "no.png", "--depth", "16"});
    for (const char* const size : {"0", "20000", "16x", "x16", "16x16x16", "many"}) {
        check_bake_refused(folder, 2, "--size",
                           {"square.obj", "ends.csv", "-o", "no.npz", "--size", size});
    }
    check_bake_refused(folder, 2, "--style",
                       {"square.obj", "ends.csv", "-o", "no.png", "--style", "disks"});
}

} // namespace geodisk::test
