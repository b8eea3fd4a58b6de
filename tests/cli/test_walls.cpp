// Walls that no path crosses: sampled, verified, measured and refused.
#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <filesystem>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "cli/command.hpp"
#include "files/meshes/sidecar_files.hpp"
#include "files/samples/sample_file.hpp"

namespace geodisk::test {
namespace {

/// Returns an OBJ of the square from (0, 0) to (8, 8), of cells of two triangles. Cells from
/// x = 4 to 5 but for the topmost one are of the material "wall", and come last or not at all.
std::string rooms(bool has_walls) {
    constexpr int kSide = 8;
    std::string floor = "usemtl floor\n", wall = "usemtl wall\n", text;
    for (int y = 0; y <= kSide; ++y) {
        for (int x = 0; x <= kSide; ++x) {
            text += "v " + std::to_string(x) + " " + std::to_string(y) + " 0\n";
        }
    }
    for (int y = 0; y < kSide; ++y) {
        for (int x = 0; x < kSide; ++x) {
            const int v = 1 + x + (kSide + 1) * y;
            std::string& cells = x == 4 && y + 1 < kSide ? wall : floor;
            for (const auto& [a, b, c] : {std::array{v, v + 1, v + 10}, {v, v + 10, v + 9}}) {
                cells += "f " + std::to_string(a) + " " + std::to_string(b) + " " +
                         std::to_string(c) + "\n";
            }
        }
    }
    return text + floor + (has_walls ? wall : "");
}

/// Returns lines of edges from (4, 0) to (4, `end`), as numbers of vertices in OBJ.
std::string column_of_edges(int end) {
    std::string text = "# a cut\n";
    for (int y = 0; y < end; ++y) {
        text += std::to_string(5 + 9 * y) + " " + std::to_string(14 + 9 * y) + "\n";
    }
    return text;
}

void check_equal(const TemporaryFolder& folder, const char* a, const char* b) {
    const auto first = tools::read_samples(folder / a), second = tools::read_samples(folder / b);
    REQUIRE(first.rows.size() == second.rows.size());
    REQUIRE(first.rows.size() > 10);
    for (std::size_t i = 0; i < first.rows.size(); ++i) {
        CHECK(first.rows[i].face == second.rows[i].face);
        CHECK(std::ranges::equal(first.rows[i].bary, second.rows[i].bary));
    }
}

TEST_CASE("samples of a mesh with walls are those of the mesh without these faces") {
    const TemporaryFolder folder;
    folder.write("with.obj", rooms(true));
    folder.write("without.obj", rooms(false));
    const Arguments walls{"--walls", "material:wall"};
    for (const Arguments& how : {Arguments{"-d", "0.9"}, {"-n", "60"}, {"-d", "1", "--maximal"}}) {
        CAPTURE(how[0]);
        const Outcome made =
            run(folder, joined(joined({"sample", "with.obj", "-o", "a.csv"}, how), walls));
        INFO(made.err);
        REQUIRE(made.status == 0);
        REQUIRE(run(folder, joined({"sample", "without.obj", "-o", "b.csv"}, how)).status == 0);
        check_equal(folder, "a.csv", "b.csv");
        CHECK(run(folder, joined({"verify", "with.obj", "a.csv", "-q"}, walls)).status == 0);
    }
    const Outcome other = run(folder, {"verify", "with.obj", "a.csv"});
    CHECK(
        contains(other.err, "made with --walls material:wall, but this command has other options"));
    // Equal cells, neighbours and analyses; bake goes the same way.
    for (const auto& [command, file] : {std::pair{"cells", ".csv"}, {"neighbours", ".csv"}}) {
        const bool has_cells = std::string(command) == "cells";
        const Arguments how = has_cells ? Arguments{} : Arguments{"--within", "3"};
        for (const auto& [mesh, out, options] :
             {std::tuple{"with.obj", "c", walls}, {"without.obj", "d", Arguments{}}}) {
            const Arguments what{command,      mesh, "b.csv", "-o", std::string(out) + file,
                                 "--no-header"};
            const Arguments plain{command, mesh, "b.csv", "-o", std::string(out) + file};
            const Outcome done =
                run(folder, joined(joined(has_cells ? what : plain, how), options));
            INFO(done.err);
            REQUIRE(done.status == 0);
        }
        CHECK(bytes_of(folder / (std::string("c") + file)) ==
              bytes_of(folder / (std::string("d") + file)));
    }
}

TEST_CASE("walls by values, by creases and by edges of a file") {
    const TemporaryFolder folder;
    folder.write("a.obj", rooms(true));
    folder.write("cut.txt", column_of_edges(8));
    // Walls add up, in any order and given twice.
    const auto rows_of = [&](const Arguments& walls) {
        const Outcome made =
            run(folder,
                joined({"sample", "a.obj", "-d", "1", "--no-header", "--format", "csv", "-o", "-"},
                       walls));
        INFO(made.err);
        CHECK(made.status == 0);
        return made.out;
    };
    const std::string two = rows_of({"--walls", "x<2.5", "--walls", "edges:cut.txt"});
    CHECK(rows_of({"--walls", "edges:cut.txt", "--walls", "x<1.5", "--walls", "x<2.5", "--walls",
                   "x<1.5"}) == two);
    const auto parts = [&](const Arguments& walls, const char* expected) {
        CAPTURE(walls[1]);
        const Outcome made = run(
            folder, joined({"sample", "a.obj", "-d", "1", "-o", "a.csv", "--json", "-"}, walls));
        INFO(made.err);
        REQUIRE(made.status == 0);
        CHECK(contains(made.out, expected));
        CHECK(run(folder, joined({"verify", "a.obj", "a.csv", "-q"}, walls)).status == 0);
    };
    parts({"--walls", "material:floor"}, "\"components\": 1,");
    parts({"--walls", "edges:cut.txt"}, "\"components\": 2,");
    parts({"--walls", "edges:cut.txt", "--walls", "y<4"}, "\"components\": 2,");
    REQUIRE(run(folder, {"sample", "builtin:cube:4", "-d", "0.2", "-o", "a.ply", "--walls",
                         "creases:45", "--columns", "part"})
                .status == 0);
    CHECK(contains(run(folder, {"verify", "builtin:cube:4", "a.ply", "--walls", "creases:45",
                                "--json", "-", "-q"})
                       .out,
                   "\"components\": 6,"));
}

TEST_CASE("vertices on both sides of a wall count once, by the nearer side") {
    const TemporaryFolder folder;
    folder.write("a.obj", rooms(true));
    folder.write("cut.txt", column_of_edges(7));
    const Arguments walls{"--walls", "edges:cut.txt"};
    // Vertex 3 is at (3, 0), vertex 5 at (5, 0), behind the wall that ends at (4, 7).
    REQUIRE(run(folder, joined({"distances", "a.obj", "--vertices", "3", "-o", "d.csv"}, walls))
                .status == 0);
    const std::vector<std::string> lines = lines_of(bytes_of(folder / "d.csv"));
    CHECK(lines.size() == 1 + 81);
    CHECK(std::ranges::count(lines, "4,1,3") == 1);
    CHECK(std::ranges::any_of(lines, [](const std::string& line) {
        return line.starts_with("5,14.1421356237") && line.ends_with(",3");
    }));
    REQUIRE(run(folder,
                joined({"neighbours", "a.obj", "--vertices", "3", "--within", "2.1", "-o", "n.csv"},
                       walls))
                .status == 0);
    const std::string near = bytes_of(folder / "n.csv");
    CHECK(contains(near, "3,4,1\n"));
    CHECK_FALSE(contains(near, "3,5,"));
    const std::vector<std::string> pairs = lines_of(near);
    REQUIRE(pairs.size() > 5);
    for (const std::string& pair : pairs) {
        CHECK(std::ranges::count(pairs, pair) == 1);
    }
    check_fails(folder, 2, "there is no vertex 81",
                joined({"distances", "a.obj", "--vertices", "81", "-o", "e.csv"}, walls));
    // Values of a file are those of its vertices.
    std::string factors;
    for (int v = 0; v < 81; ++v) {
        factors += v % 9 < 5 ? "1\n" : "0.5\n";
    }
    folder.write("factors.txt", factors);
    const Arguments density{"--radius-factor", "file:factors.txt"};
    REQUIRE(
        run(folder, joined(joined({"sample", "a.obj", "-d", "1", "-o", "f.csv"}, density), walls))
            .status == 0);
    CHECK(run(folder, joined({"verify", "a.obj", "f.csv", "-q"}, walls)).status == 0);
}

TEST_CASE("samples follow an edit of a mesh with walls") {
    const TemporaryFolder folder;
    folder.write("a.obj", rooms(true));
    std::string edited = rooms(true);
    edited.replace(edited.find("v 1 1 0"), 7, "v 1.2 1.1 0");
    folder.write("b.obj", edited);
    const Arguments walls{"--walls", "material:wall"};
    const Arguments how = joined({"-d", "0.7"}, walls);
    REQUIRE(run(folder, joined({"sample", "a.obj", "-o", "a.ply"}, how)).status == 0);
    REQUIRE(
        run(folder, joined({"sample", "b.obj", "-o", "b.ply", "--from", "a.obj"}, how)).status ==
        0);
    REQUIRE(
        run(folder,
            joined({"sample", "b.obj", "-o", "c.ply", "--from", "a.obj", "--update", "a.ply"}, how))
            .status == 0);
    check_equal(folder, "b.ply", "c.ply");
    check_fails(
        folder, 3, "has as its walls material:wall, not none",
        {"sample", "b.obj", "-o", "d.ply", "--from", "a.obj", "--update", "a.ply", "-d", "0.7"});
}

TEST_CASE("samples of other walls, masks and radii than their files give now are not updated") {
    const TemporaryFolder folder;
    folder.write("a.obj", rooms(true));
    std::string some, more, ones, factors, moved = rooms(true);
    moved.replace(moved.find("v 3 3 0"), 7, "v 3 3 1e-7");
    for (int v = 0; v < 81; ++v) {
        some += v % 9 < 5 ? "1\n" : "0\n";
        more += v % 9 < 8 ? "1\n" : "0\n";
        ones += "1\n";
        factors += v == 0 ? "0.9\n" : "1\n";
    }
    // Option, its value, and the content of the file at first and later.
    const std::tuple<const char*, const char*, std::string, std::string> cases[] = {
        {"--walls", "edges:f.txt", column_of_edges(7), column_of_edges(2)},
        {"--mask", "file:f.txt", some, more},
        {"--radius-factor", "file:f.txt", factors, ones}};
    for (const auto& [name, value, first, then] : cases) {
        const std::string option = name;
        CAPTURE(option);
        const Arguments how{"-d", "0.7", name, value};
        const Arguments update =
            joined({"sample", "a.obj", "-o", "b.csv", "--from", "a.obj", "--update", "a.csv"}, how);
        folder.write("f.txt", first);
        REQUIRE(run(folder, joined({"sample", "a.obj", "-o", "a.csv"}, how)).status == 0);
        CHECK(run(folder, update).status == 0);
        folder.write("f.txt", then);
        std::filesystem::remove(folder / "b.csv");
        check_fails(folder, 3, "was made with other walls, another mask or other radii", update);
        folder.write("f.txt", first);
        folder.write("a.obj", moved);
        check_fails(folder, 3, "or on another mesh", update);
        folder.write("a.obj", rooms(true));
    }
}

TEST_CASE("labels of vertices on a wall are those of their nearest side") {
    const TemporaryFolder folder;
    folder.write("a.obj", rooms(true));
    folder.write("cut.txt", column_of_edges(7));
    const Arguments walls{"--walls", "edges:cut.txt"};
    REQUIRE(run(folder, joined({"sample", "a.obj", "-d", "1.7", "-o", "a.csv"}, walls)).status ==
            0);
    REQUIRE(
        run(folder,
            joined({"cells", "a.obj", "a.csv", "-o", "b.csv", "--labels", "a.label.gii"}, walls))
            .status == 0);
    REQUIRE(run(folder, joined({"distances", "a.obj", "a.csv", "-o", "d.csv"}, walls)).status == 0);
    const std::vector<double> labels = tools::read_values(folder / "a.label.gii", 81).values;
    const std::vector<std::string> lines = lines_of(bytes_of(folder / "d.csv"));
    REQUIRE(labels.size() == 81);
    for (std::size_t v = 0; v < labels.size(); ++v) {
        CAPTURE(v);
        CHECK(lines[v + 1].ends_with(',' + std::to_string(static_cast<int>(labels[v]) - 1)));
    }
}

TEST_CASE("samples move to another pose with the walls of both, and are told without them") {
    const TemporaryFolder folder;
    folder.write("a.obj", rooms(true));
    const Arguments walls{"--walls", "material:wall"};
    REQUIRE(run(folder, joined({"sample", "a.obj", "-d", "0.8", "-o", "a.csv"}, walls)).status ==
            0);
    const Outcome with =
        run(folder, joined({"transfer", "a.csv", "a.obj", "a.obj", "-o", "b.csv"}, walls));
    CHECK(with.status == 0);
    CHECK_FALSE(contains(with.err, "made with --walls"));
    CHECK(contains(bytes_of(folder / "b.csv"), "# walls: material:wall"));
    const Outcome without = run(folder, {"transfer", "a.csv", "a.obj", "a.obj", "-o", "c.csv"});
    CHECK(without.status == 0);
    CHECK(contains(without.err, "made with --walls material:wall; give the same"));
}

TEST_CASE("walls that cannot be are refused") {
    const TemporaryFolder folder;
    folder.write("a.obj", rooms(true));
    folder.write("none.txt", "1 2\n1 21\n");
    folder.write("three.txt", "1 2 3\n");
    folder.write("zero.txt", "0 1\n");
    folder.write("empty.txt", "# nothing\n");
    const auto refuses = [&](int status, const char* part, const char* wall) {
        CAPTURE(wall);
        check_fails(folder, status, part,
                    {"sample", "a.obj", "-d", "1", "-o", "a.csv", "--walls", wall});
    };
    refuses(2, "'bricks' is none of material:NAME, group:NAME, node:NAME, part:N", "bricks");
    refuses(2, "has no angle of 1 to 180 degrees", "creases:0.5");
    refuses(2, "--walls: 'z>' is not PROPERTY<VALUE", "z>");
    refuses(2, "--walls x5: the mesh has 3 coordinates per vertex", "x5>1");
    refuses(3, "no face is of material:brick, as --walls requests", "material:brick");
    refuses(3, "a.obj: --walls takes no face: 'z' is from ", "z>1");
    refuses(3, "a.obj: every face is a wall", "z<1");
    refuses(3, "has no creases for --walls", "creases");
    refuses(3, "none.txt: line 2: no face has an edge 1-21", "edges:none.txt");
    refuses(3, "three.txt: line 1: an edge reads 'VERTEX VERTEX'", "edges:three.txt");
    refuses(3, "zero.txt: line 1: '0' is not a vertex; they are numbered from 1", "edges:zero.txt");
    refuses(3, "empty.txt: has no edges", "edges:empty.txt");
    refuses(3, "absent.txt", "edges:absent.txt");
    folder.write("a.stl", "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\n"
                          "vertex 0 1 0\nendloop\nendfacet\nendsolid\n");
    check_fails(folder, 2, "--walls edges:zero.txt needs numbers of vertices, which a.stl has not",
                {"sample", "a.stl", "-d", "1", "-o", "a.csv", "--walls", "edges:zero.txt"});
    check_fails(folder, 2, "takes no --walls",
                {"sample", "a.obj", "-d", "1", "-o", "a.csv", "--walls", "material:wall",
                 "--metric", "euclidean"});
}

} // namespace
} // namespace geodisk::test
