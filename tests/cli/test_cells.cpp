// `geodisk cells`: areas, the dual graph, and what it refuses.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <numeric>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

#include <nlohmann/json.hpp>

#include "cli/command.hpp"
#include "files/meshes/mesh_file.hpp"
#include "geometry/vec.hpp"

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

std::vector<std::string> cells_of(const std::string& line) {
    std::istringstream text(line);
    std::vector<std::string> cells;
    for (std::string cell; std::getline(text, cell, ',');) {
        cells.push_back(cell);
    }
    return cells;
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

TEST_CASE("cells: the dual mesh carries attributes") {
    const TemporaryFolder folder;
    // Two triangles with colours and texture coordinates that follow x, a label and a height.
    write_file(
        folder, "square.obj",
        "v 0 0 0 0 0 0\nv 1 0 0 1 0 0\nv 1 1 0 1 0 0\nv 0 1 0 0 0 0\nvt 0 0\nvt 1 0\nvt 1 1\n"
        "vt 0 1\nf 1/1 2/2 3/3 4/4\n");
    write_file(
        folder, "square.ply",
        "ply\nformat ascii 1.0\nelement vertex 4\nproperty double x\nproperty double y\n"
        "property double z\nproperty uchar red\nproperty uchar green\nproperty uchar blue\n"
        "property float height\nproperty int label\nelement face 1\n"
        "property list uchar int vertex_indices\nend_header\n"
        "0 0 0 0 0 0 0 3\n1 0 0 255 0 0 2 3\n1 1 0 255 0 0 2 3\n0 1 0 0 0 0 0 3\n4 0 1 2 3\n");
    write_file(folder, "points.csv",
               "x,y,z\n0.2,0.2,0\n0.8,0.2,0\n0.8,0.8,0\n0.2,0.8,0\n0.5,0.5,0\n");
    const auto cells = [&](const char* mesh, const char* out, const char* dual, const char* names) {
        const Outcome outcome = run(folder, {"cells", mesh, "points.csv", "-o", out, "--dual", dual,
                                             "--attributes", names, "-q"});
        INFO(outcome.err);
        REQUIRE(outcome.status == 0);
    };
    cells("square.obj", "a.csv", "dual.obj", "color,uv");
    CHECK(contains(bytes_of(folder / "a.csv"), ",area,red,green,blue,u,v\n"));
    CHECK(contains(bytes_of(folder / "a.csv"), "# attributes: color,uv\n"));
    const std::string dual = bytes_of(folder / "dual.obj");
    CHECK(std::ranges::count(lines_of(dual).front(), ' ') == 6); // With a colour.
    CHECK(contains(dual, "\nvt 0.5 0.5\n"));
    CHECK(contains(dual, "/5\n"));
    cells("square.ply", "b.csv", "dual.ply", "all");
    cells("square.ply", "c.csv", "dual.npz", "all");
    CHECK(contains(bytes_of(folder / "dual.npz"), "height.npy"));
    // The dual is a mesh with these attributes.
    cells("square.ply", "e.csv", "dual.vtp", "all");
    for (const std::string file : {"dual.ply", "dual.vtp"}) {
        const Outcome sampled =
            run(folder, {"sample", file, "-d", "0.1", "--attributes", "all", "-o", file + ".csv"});
        INFO(sampled.err);
        REQUIRE(sampled.status == 0);
        const std::vector<std::string> lines = lines_of(bytes_of(folder / (file + ".csv")));
        const auto head =
            std::ranges::find_if(lines, [](const auto& line) { return line[0] != '#'; });
        CHECK(head->ends_with(",red,green,blue,height,label"));
        for (auto line = head + 1; line != lines.end(); ++line) {
            const double x = std::stod(*line);
            const std::vector<std::string> cut = cells_of(*line);
            CHECK(std::abs(std::stod(cut[cut.size() - 5]) - x) < 0.01);
            CHECK(std::abs(std::stod(cut[cut.size() - 2]) - 2 * x) < 1e-5);
            CHECK(cut.back() == "3");
        }
    }
    write_file(folder, "area.ply",
               "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
               "property float z\nproperty float area\nproperty float heat\nelement face 1\n"
               "property list uchar int vertex_indices\nend_header\n"
               "0 0 0 1 2\n1 0 0 1 2\n0 1 0 1 2\n3 0 1 2\n");
    write_file(folder, "corner.csv", "x,y,z\n0.2,0.2,0\n0.5,0.3,0\n");
    const Outcome all =
        run(folder, {"cells", "area.ply", "corner.csv", "-o", "d.csv", "--attributes", "all"});
    CHECK(all.status == 0);
    CHECK(contains(all.err, "the attribute 'area' has the name of a column"));
    CHECK(contains(bytes_of(folder / "d.csv"), ",area,heat\n"));
    check_cells_refused(folder, 2, "area is the column of the areas of cells",
                        {"area.ply", "corner.csv", "-o", "no.csv", "--attributes", "area"});
    check_cells_refused(
        folder, 2, "--dual: .obj has no attribute 'height', just color and uv",
        {"square.ply", "points.csv", "-o", "no.csv", "--dual", "no.obj", "--attributes", "height"});
    check_cells_refused(folder, 3, "has no attribute 'weight'",
                        {"square.ply", "points.csv", "-o", "no.csv", "--attributes", "weight"});
}

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
    check_cells_refused(folder, 2, "the dual graph is written as .obj, .ply, .vtp or .npz",
                        {mesh, "corners.csv", "-o", "no.csv", "--dual", "no.stl"});
    check_cells_refused(folder, 3, "has no face that --mask allows, so no cell has an area: 'z' is",
                        {mesh, "corners.csv", "-o", "no.csv", "--mask", "z>9"});
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
    // A slow device says first how long the search takes.
    const Outcome short_of_memory =
        run(folder, {"cells", large, "few.ply", "-o", "no.csv", "--memory", "16M"});
    CHECK(short_of_memory.status == 6);
    CHECK(contains(short_of_memory.err, "give more with --memory"));
    CHECK_FALSE(std::filesystem::exists(folder / "no.csv"));
}

/// Returns the area of the triangles of a mesh that have each number of an attribute.
std::vector<double> areas_by_number(const std::string& path, std::size_t count) {
    tools::MeshSources sources;
    sources.mesh = path;
    sources.fields.numbers = {"sample"};
    const tools::MeshFile mesh = tools::read_mesh(sources);
    const tools::MeshField& number = mesh.number("sample");
    std::vector<double> areas(count);
    for (std::size_t t = 0; t < mesh.triangle_count(); ++t) {
        const auto corner = [&](std::size_t k) {
            return tools::point_at(mesh.positions, mesh.triangles[3 * t + k]);
        };
        const tools::Vec3 normal = cross(corner(1) - corner(0), corner(2) - corner(0));
        areas[static_cast<std::size_t>(number.values[mesh.value_index(number, 3 * t)])] +=
            length(normal) / 2;
    }
    return areas;
}

TEST_CASE("cells as geometry have the areas of cells, and outlines are lines between them") {
    const TemporaryFolder folder;
    REQUIRE(run(folder, {"sample", "builtin:cube:3", "-n", "40", "-o", "a.csv", "-q"}).status == 0);
    for (const char* const format : {"vtp", "ply", "obj"}) {
        CAPTURE(format);
        const std::string split = std::string("cells.") + format,
                          lines = std::string("lines.") + format;
        const Outcome made = run(folder, {"cells", "builtin:cube:3", "a.csv", "-o", "areas.csv",
                                          "--split", split, "--outlines", lines});
        INFO(made.err);
        REQUIRE(made.status == 0);
        CHECK(contains(made.out, "split mesh    " + split));
        CHECK(contains(made.out, "outlines      " + lines));
        const std::vector<double> areas =
            last_column(tools::bytes_of(folder / "areas.csv"), "area");
        if (std::string_view(format) != "obj") {
            const auto found = areas_by_number((folder / split).string(), areas.size());
            for (std::size_t i = 0; i < areas.size(); ++i) {
                CHECK(found[i] == doctest::Approx(areas[i]).epsilon(0.01));
            }
        }
    }
    // Each is of use: a cell to sample on, and borders to keep away from.
    CHECK(run(folder,
              {"sample", "cells.obj", "-d", "0.05", "-o", "b.csv", "--only", "group:sample_7"})
              .status == 0);
    CHECK(run(folder, {"sample", "cells.vtp", "-d", "0.05", "-o", "c.csv", "--mask", "sample=7"})
              .status == 0);
    CHECK(run(folder, {"sample", "builtin:cube:3", "-d", "0.05", "-o", "d.csv", "--avoid",
                       "lines.obj:0.02"})
              .status == 0);
    check_cells_refused(folder, 2, "no.stl: meshes of cells are written as .obj, .ply or .vtp",
                        {"builtin:cube", "a.csv", "-o", "no.csv", "--split", "no.stl"});
    check_cells_refused(folder, 2, "no.npz: outlines of cells are written as .obj, .ply or .vtp",
                        {"builtin:cube", "a.csv", "-o", "no.csv", "--outlines", "no.npz"});
    check_cells_refused(
        folder, 2, "no.obj",
        {"builtin:cube:3", "a.csv", "-o", "no.csv", "--outlines", "no.obj", "--split", "no.obj"});
}

TEST_CASE("cells give vertices labels beside areas, or nothing is written") {
    const TemporaryFolder folder;
    write_file(folder, "corners.csv", kCorners);
    const Outcome made = run(folder, {"cells", "builtin:cube", "corners.csv", "-o", "a.csv",
                                      "--labels", "a.label.gii", "--json", "a.json"});
    INFO(made.err);
    REQUIRE(made.status == 0);
    CHECK(contains(made.out, "labels file   a.label.gii\n"));
    std::ifstream report(folder / "a.json");
    CHECK(Json::parse(report)["labels"] == "a.label.gii");
    CHECK(contains(tools::bytes_of(folder / "a.label.gii"), ">sample 7</Label>"));
    check_cells_refused(folder, 2, "no.obj: labels of vertices are written as *.label.gii",
                        {"builtin:cube", "corners.csv", "-o", "no.csv", "--labels", "no.obj"});
    check_cells_refused(
        folder, 4, "none/a.label.gii",
        {"builtin:cube", "corners.csv", "-o", "no.csv", "--labels", "none/a.label.gii"});
}

} // namespace geodisk::test
