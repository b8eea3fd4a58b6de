// `geodisk cells`: areas, the dual graph, and what it refuses.
#include <doctest/doctest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <numeric>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "cli/command.hpp"

namespace geodisk::test {
namespace {

using Json = nlohmann::json;

void write_file(const TemporaryFolder& folder, const char* name, const std::string& text) {
    std::ofstream(folder / name) << text;
}

/// The corners of builtin:cube, and a column that is not kept.
const char* const kCorners = "x,y,z,label\n-0.5,-0.5,-0.5,1\n0.5,-0.5,-0.5,2\n-0.5,0.5,-0.5,3\n"
                             "0.5,0.5,-0.5,4\n-0.5,-0.5,0.5,5\n0.5,-0.5,0.5,6\n-0.5,0.5,0.5,7\n"
                             "0.5,0.5,0.5,8\n";

/// The last column of a CSV file.
std::vector<double> last_column(const std::string& csv, const std::string& name) {
    std::vector<double> values;
    bool is_table = false;
    for (const std::string& line : lines_of(csv)) {
        const std::string last = line.substr(line.rfind(',') + 1);
        if (is_table) {
            values.push_back(std::stod(last));
        }
        is_table = is_table || last == name;
    }
    return values;
}

void check_cells_refused(const TemporaryFolder& folder, int status, const std::string& message,
                         Arguments arguments) {
    arguments.insert(arguments.begin(), "cells");
    arguments.insert(arguments.end(), {"--json", "no.json"});
    check_fails(folder, status, message, arguments);
    for (const char* const name : {"no.csv", "no.xyz", "no.json", "no.obj", "no.npz"}) {
        CHECK_FALSE(std::filesystem::exists(folder / name));
    }
}

} // namespace

TEST_CASE("cells: areas and dual graph of the corners of a cube") {
    const TemporaryFolder folder;
    write_file(folder, "corners.csv", kCorners);
    const Outcome outcome =
        run(folder, {"cells", "builtin:cube:4", "corners.csv", "-o", "areas.csv", "--dual",
                     "dual.obj", "--json", "cells.json"});
    INFO(outcome.err);
    REQUIRE(outcome.status == 0);
    CHECK(outcome.out.find("12 triangles, 100% manifold; Euler characteristic 2, of the mesh 2") !=
          std::string::npos);
    const std::string csv = bytes_of(folder / "areas.csv");
    CHECK(csv.find("# area_error: ") != std::string::npos);
    const std::vector<double> areas = last_column(csv, "area");
    REQUIRE(areas.size() == 8);
    for (const double area : areas) {
        CHECK(area == doctest::Approx(0.75).epsilon(1e-5));
    }
    const std::vector<std::string> dual = lines_of(bytes_of(folder / "dual.obj"));
    CHECK(std::ranges::count_if(dual, [](const auto& line) { return line[0] == 'v'; }) == 8);
    CHECK(std::ranges::count_if(dual, [](const auto& line) { return line[0] == 'f'; }) == 12);
    CHECK(dual[0] == "v -0.5 -0.5 -0.5");
    const Json json = Json::parse(bytes_of(folder / "cells.json"));
    CHECK(json["samples"] == 8);
    CHECK(json["areas"]["unreached"] == 0);
    CHECK(json["dual"]["edges"] == 18);
    CHECK(json["dual"]["manifold_triangles"] == 12);
    CHECK(json["dual"]["angles"]["least"].get<double>() == doctest::Approx(45));
    CHECK(json["dual"]["angles"]["part_30_to_120"] == 1.0);

    // The dual graph is a mesh, and areas again replace those of the file.
    const Outcome again = run(folder, {"cells", "builtin:cube:4", "areas.csv", "-o", "again.csv",
                                       "--dual", "dual.npz", "-q"});
    INFO(again.err);
    CHECK(again.status == 0);
    CHECK(bytes_of(folder / "again.csv") == csv);
    CHECK(run(folder, {"sample", "dual.obj", "-d", "0.5", "-o", "on_dual.csv"}).status == 0);
    CHECK(bytes_of(folder / "dual.npz").find("triangles.npy") != std::string::npos);
}

TEST_CASE("cells: areas of masked samples sum to the masked area") {
    const TemporaryFolder folder;
    const Arguments mask{"--mask", "z>=0"};
    REQUIRE(run(folder, joined({"sample", "builtin:cube:4", "-o", "top.csv", "-n", "60"}, mask))
                .status == 0);
    REQUIRE(run(folder, joined({"cells", "builtin:cube:4", "top.csv", "-o", "areas.csv"}, mask))
                .status == 0);
    const std::vector<double> areas = last_column(bytes_of(folder / "areas.csv"), "area");
    CHECK(std::accumulate(areas.begin(), areas.end(), 0.0) == doctest::Approx(3).epsilon(1e-5));
}

TEST_CASE("cells: what cannot be found leaves no file") {
    const TemporaryFolder folder;
    write_file(folder, "corners.csv", kCorners);
    write_file(folder, "none.csv", "x,y,z\n");
    write_file(folder, "far.csv", "x,y,z\n7,7,7\n");
    const std::string mesh = "builtin:cube:4";
    check_cells_refused(folder, 2, "the dual graph is written as .obj or .npz",
                        {mesh, "corners.csv", "-o", "no.csv", "--dual", "no.ply"});
    check_cells_refused(folder, 2, "xyz", {mesh, "corners.csv", "-o", "no.xyz"});
    check_cells_refused(folder, 2, "no.obj",
                        {mesh, "corners.csv", "-o", "no.obj", "--dual", "no.obj"});
    check_cells_refused(folder, 2, "corners.csv", {mesh, "corners.csv", "-o", "corners.csv"});
    check_cells_refused(folder, 3, "none.csv", {mesh, "none.csv", "-o", "no.csv"});
    check_cells_refused(folder, 3, "far.csv",
                        {mesh, "far.csv", "-o", "no.csv", "--dual", "no.obj"});
    check_cells_refused(folder, 3, "lacks.csv", {mesh, "lacks.csv", "-o", "no.csv"});
    const std::string large = "builtin:showpiece";
    REQUIRE(run(folder, {"sample", large, "-n", "100", "-o", "few.ply", "-q"}).status == 0);
    check_cells_refused(folder, 6, "give more with --memory",
                        {large, "few.ply", "-o", "no.csv", "--memory", "16M"});
}

} // namespace geodisk::test
