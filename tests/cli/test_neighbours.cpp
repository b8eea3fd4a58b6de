// `geodisk neighbours`: files, sources, targets, and what it refuses.
#include <doctest/doctest.h>

#include <array>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iomanip>
#include <sstream>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "cli/command.hpp"

namespace geodisk::test {
namespace {

using Json = nlohmann::json;
using Arguments = std::vector<std::string>;

/// The file with distances of five digits.
std::string rounded(const std::string& csv) {
    std::istringstream in(csv);
    std::ostringstream out;
    out << std::setprecision(5);
    std::string line;
    std::getline(in, line);
    out << line << '\n';
    for (std::uint32_t source = 0, target = 0; in >> source;) {
        char comma = 0;
        double distance = 0;
        in >> comma >> target >> comma >> distance;
        out << source << ',' << target << ',' << distance << '\n';
    }
    return out.str();
}

std::string found(const TemporaryFolder& folder, Arguments arguments) {
    arguments.insert(arguments.begin(), "neighbours");
    arguments.insert(arguments.end(), {"-o", "near.csv", "--json", "near.json"});
    const Outcome outcome = run(folder, arguments);
    INFO(outcome.err);
    REQUIRE(outcome.status == 0);
    return rounded(bytes_of(folder / "near.csv"));
}

void check_refused(const TemporaryFolder& folder, int status, const std::string& message,
                   Arguments arguments) {
    arguments.insert(arguments.begin(), "neighbours");
    arguments.insert(arguments.end(), {"-o", "no.csv", "--json", "no.json"});
    check_fails(folder, status, message, arguments);
    CHECK_FALSE(std::filesystem::exists(folder / "no.csv"));
    CHECK_FALSE(std::filesystem::exists(folder / "no.json"));
}

void write(const TemporaryFolder& folder, const char* name, const std::string& text) {
    std::ofstream(folder / name) << text;
}

/// The unit square as two triangles that share an edge, or have its vertices twice.
const char* const kSquare = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3\nf 1 3 4\n";
const char* const kSplitSquare = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 0 0\nv 1 1 0\nv 0 1 0\nv 9 9 9\n"
                                 "f 1 2 3\nf 4 5 6\n";

} // namespace

TEST_CASE("neighbours of vertices, points and each other") {
    const TemporaryFolder folder;
    write(folder, "square.obj", kSquare);
    CHECK(found(folder, {"square.obj", "--within", "1.1"}) ==
          "source,target,distance\n0,0,0\n0,1,1\n0,3,1\n1,0,1\n1,1,0\n1,2,1\n2,1,1\n2,2,0\n2,3,1\n"
          "3,0,1\n3,2,1\n3,3,0\n");
    CHECK(found(folder, {"square.obj", "--within", "1.1", "--vertices", "3, 0-1", "--among",
                         "sources"}) == "source,target,distance\n3,0,1\n0,3,1\n0,1,1\n1,0,1\n");
    // The four corners of the top, each with two others a side away.
    CHECK(lines_of(found(folder, {"builtin:cube:1", "--within", "1.1", "--mask", "z>=0.5",
                                  "--among", "sources"}))
              .size() == 9);
    write(folder, "some.txt", "\xEF\xBB\xBF# vertices\r\n3,\n 0-1 # two\n");
    CHECK(found(folder, {"square.obj", "--within", "1.1", "--vertices", "@some.txt", "--among",
                         "sources"}) == "source,target,distance\n3,0,1\n0,3,1\n0,1,1\n1,0,1\n");
    write(folder, "points.csv", "x,y,z,reach\n0.5,0.25,0,0.3\n0,1,0,2\n");
    CHECK(found(folder, {"square.obj", "points.csv", "--within", "reach"}) ==
          "source,target,distance\n1,0,1\n1,1,1.4142\n1,2,1\n1,3,0\n");
    CHECK(found(folder, {"square.obj", "points.csv", "--within", "2", "--nearest", "1"}) ==
          "source,target,distance\n0,0,0.55902\n1,3,0\n");
    CHECK(found(folder, {"square.obj", "--within", "0.6", "--among", "points.csv"}) ==
          "source,target,distance\n0,0,0.55902\n1,0,0.55902\n3,1,0\n");
    CHECK(found(folder, {"square.obj", "--among", "points.csv", "--nearest", "1"}) ==
          "source,target,distance\n0,0,0.55902\n1,0,0.55902\n2,0,0.90139\n3,1,0\n");
    CHECK(found(folder, {"square.obj", "--within", "0.6", "--among", "points.csv"}) ==
          "source,target,distance\n0,0,0.55902\n1,0,0.55902\n3,1,0\n");
    const Json report = Json::parse(bytes_of(folder / "near.json"));
    CHECK(report["sources"]["kind"] == "vertices");
    CHECK(report["sources"]["count"] == 4);
    CHECK(report["targets"] == "points");
    CHECK(report["pairs"] == 3);
    CHECK(report["per_source"]["least"] == 0);
    CHECK(report["per_source"]["most"] == 1);
    CHECK(report["error"] < 1e-5);
    CHECK(report["output"] == "near.csv");
}

TEST_CASE("where seams are joined, neighbours name all vertices of the file") {
    const TemporaryFolder folder;
    write(folder, "split.obj", kSplitSquare);
    CHECK(found(folder, {"split.obj", "--within", "1.1", "--vertices", "1,3"}) ==
          "source,target,distance\n1,0,1\n1,1,0\n1,2,1\n1,3,1\n1,4,1\n"
          "3,0,0\n3,1,1\n3,3,0\n3,5,1\n");
    CHECK(found(folder, {"split.obj", "--within", "0.1"}) ==
          "source,target,distance\n0,0,0\n0,3,0\n1,1,0\n2,2,0\n2,4,0\n3,0,0\n3,3,0\n"
          "4,2,0\n4,4,0\n5,5,0\n");
    CHECK(found(folder, {"split.obj", "--within", "2", "--vertices", "0", "--nearest", "3"}) ==
          "source,target,distance\n0,0,0\n0,1,1\n0,5,1\n"); // A place counts once.
    CHECK(found(folder, {"split.obj", "--within", "2", "--vertices", "0", "--keep-seams"}) ==
          "source,target,distance\n0,0,0\n0,1,1\n0,2,1.4142\n");
    const auto message = [&](const char* vertex) {
        const Outcome outcome = run(folder, {"neighbours", "split.obj", "--within", "1",
                                             "--vertices", vertex, "-o", "no.csv"});
        CHECK(outcome.status == 2);
        CHECK_FALSE(std::filesystem::exists(folder / "no.csv"));
        return outcome.err;
    };
    CHECK(message("6").find("--vertices: no face uses vertex 6") != std::string::npos);
    CHECK(message("0-4000000000").find("there is no vertex 4000000000") != std::string::npos);
    CHECK(message("7").find("there is no vertex 7, since the mesh has 7") != std::string::npos);
}

TEST_CASE("the nearest vertices are places, however the file repeats them") {
    const TemporaryFolder folder;
    const std::vector<std::array<int, 3>> faces{{0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4},
                                                {1, 0, 5}, {2, 1, 5}, {3, 2, 5}, {0, 3, 5}};
    const char* const places[] = {"1 0 0", "0 1 0", "-1 0 0", "0 -1 0", "0 0 1", "0 0 -1"};
    std::string shared, flat, stl = "solid o\n", shared_faces, flat_faces;
    for (const char* const place : places) {
        shared += std::string("v ") + place + '\n';
    }
    int last = 0;
    for (const auto& face : faces) {
        stl += "facet normal 0 0 0\nouter loop\n";
        shared_faces += 'f', flat_faces += 'f';
        for (const int corner : face) {
            flat += std::string("v ") + places[corner] + '\n';
            stl += std::string("vertex ") + places[corner] + '\n';
            shared_faces += ' ' + std::to_string(corner + 1);
            flat_faces += ' ' + std::to_string(++last);
        }
        shared_faces += '\n', flat_faces += '\n';
        stl += "endloop\nendfacet\n";
    }
    write(folder, "octa.obj", shared + shared_faces);
    write(folder, "flat.obj", flat + flat_faces);
    write(folder, "octa.stl", stl + "endsolid o\n");
    const std::string own = "source,target,distance\n0,0,0\n0,1,1.4142\n0,3,1.4142\n0,4,1.4142\n"
                            "0,5,1.4142\n";
    CHECK(found(folder, {"octa.obj", "--nearest", "5", "--vertices", "0"}) == own);
    // STL numbers places as they come: 1 0 0, 0 1 0, 0 0 1, -1 0 0, 0 -1 0, 0 0 -1.
    CHECK(found(folder, {"octa.stl", "--nearest", "5", "--vertices", "0"}) ==
          "source,target,distance\n0,0,0\n0,1,1.4142\n0,2,1.4142\n0,4,1.4142\n0,5,1.4142\n");
    CHECK(found(folder, {"flat.obj", "--nearest", "5", "--vertices", "10"}) ==
          "source,target,distance\n10,0,0\n10,1,1.4142\n10,2,1.4142\n10,7,1.4142\n"
          "10,14,1.4142\n");
    CHECK(found(folder, {"flat.obj", "--nearest", "2", "--among", "sources"}) ==
          "source,target,distance\n0,1,1.4142\n0,2,1.4142\n1,0,1.4142\n1,2,1.4142\n"
          "2,0,1.4142\n2,1,1.4142\n4,1,1.4142\n4,2,1.4142\n7,0,1.4142\n7,2,1.4142\n"
          "14,0,1.4142\n14,1,1.4142\n");
    CHECK(contains(
        run(folder, {"neighbours", "octa.stl", "--nearest", "1", "--vertices", "6", "-o", "no.csv"})
            .err,
        "there is no vertex 6, since the mesh has 6"));
}

TEST_CASE("neighbours go to archives and streams") {
    const TemporaryFolder folder;
    const Outcome outcome = run(folder, {"neighbours", "builtin:cube:4", "--within", "20%", "-o",
                                         "near.npz", "--memory", "64M"});
    CHECK(outcome.status == 0);
    CHECK(outcome.out.find("neighbours") != std::string::npos);
    const std::string npz = bytes_of(folder / "near.npz");
    CHECK(npz.starts_with("PK"));
    for (const char* const name : {"sources.npy", "offsets.npy", "targets.npy", "distances.npy"}) {
        CHECK(npz.find(name) != std::string::npos);
    }
    write(folder, "square.obj", kSquare);
    const Outcome streamed = run(folder, {"neighbours", "square.obj", "--within", "0.5", "-o", "-",
                                          "--format", "csv", "-q"});
    CHECK(streamed.status == 0);
    CHECK(streamed.out == "source,target,distance\n0,0,0\n1,1,0\n2,2,0\n3,3,0\n");
}

TEST_CASE("neighbours within the disk that holds an area") {
    const TemporaryFolder folder;
    const auto found = [&](const char* within) {
        REQUIRE(run(folder, {"neighbours", "builtin:icosphere:4", "--vertices", "0,99", "--within",
                             within, "-o", "near.csv"})
                    .status == 0);
        return std::ssize(lines_of(bytes_of(folder / "near.csv"))) - 1;
    };
    // 2,562 vertices, which are spread evenly; twice.
    CHECK(found("area:10%") == doctest::Approx(2 * 256).epsilon(0.06));
    CHECK(found("area:6.283") == doctest::Approx(2 * 1281).epsilon(0.03));
    CHECK(found("area:200%") == 2 * 2562);
}

TEST_CASE("neighbours that cannot be found are refused, and no file is left") {
    const TemporaryFolder folder;
    write(folder, "square.obj", kSquare);
    write(folder, "points.csv", "x,y,z,reach\n0.5,0.25,0,0\n0,1,0,2\n");
    write(folder, "far.csv", "x,y,z\n0.5,0.25,7\n");
    write(folder, "none.csv", "x,y,z\n");
    const auto refused = [&](int status, const std::string& message, Arguments more) {
        more.insert(more.begin(), "square.obj");
        check_refused(folder, status, message, more);
    };
    refused(2, "give --within", {});
    refused(2, "--within: 'reach' is no length", {"--within", "reach"});
    for (const char* const length : {"inf", "nan", "1e999", "-1", "0"}) {
        refused(2, "is not a positive, finite length", {"--within", length});
    }
    for (const char* const area : {"area:0", "area:x", "area:-1%", "area:inf"}) {
        refused(2, "' is no positive, finite area", {"--within", area});
    }
    refused(2, "the distance is too small for this mesh", {"--within", "1e-5"});
    refused(2, "--vertices: 'x' is neither", {"--within", "1", "--vertices", "x"});
    write(folder, "wrong.txt", "1\n2 x\n");
    refused(3, "wrong.txt: line 2: 'x' is neither", {"--within", "1", "--vertices", "@wrong.txt"});
    write(folder, "empty.txt", "# none\n");
    refused(3, "empty.txt: names no vertex", {"--within", "1", "--vertices", "@empty.txt"});
    refused(3, "gone.txt", {"--within", "1", "--vertices", "@gone.txt"});
    refused(2, "--vertices: '3-1' is neither", {"--within", "1", "--vertices", "3-1"});
    refused(3, "so there are no sources to find neighbours of",
            {"--within", "1", "--mask", "x>=9"});
    refused(2, "--mask: all sources are given by --vertices",
            {"--within", "1", "--vertices", "1", "--mask", "x>=0"});
    refused(2, "--only: all sources are given by POINTS",
            {"points.csv", "--within", "1", "--only", "part:0"});
    refused(2, "--vertices contradicts POINTS", {"points.csv", "--within", "1", "--vertices", "1"});
    refused(2, "--nearest", {"--within", "1", "--nearest", "0"});
    refused(3, "points.csv: point 0: its reach is 0", {"points.csv", "--within", "reach"});
    refused(3, "width", {"points.csv", "--within", "width"});
    refused(3, "far.csv", {"far.csv", "--within", "1"});
    refused(3, "none.csv: has no points", {"none.csv", "--within", "1"});
    refused(3, "missing.csv", {"--within", "1", "--among", "missing.csv"});
    refused(6, "about 16 pairs are to be expected", {"--within", "9", "--most-pairs", "15"});
    for (const char* const output : {"-", "out"}) {
        check_fails(folder, 2,
                    output + std::string(": neighbours are written as .npz or .csv; give --format"),
                    {"neighbours", "square.obj", "--within", "1", "-o", output});
    }
    check_fails(folder, 2, "--format: 'ply': neighbours are written as .npz or .csv",
                {"neighbours", "square.obj", "--within", "1", "-o", "a.npz", "--format", "ply"});
    check_fails(folder, 2, "neighbours are written as .npz or .csv",
                {"neighbours", "square.obj", "--within", "1", "-o", "near.ply"});
    check_fails(
        folder, 2, "square.obj",
        {"neighbours", "square.obj", "--within", "1", "-o", "square.obj", "--format", "csv"});
    check_fails(folder, 2, "points.csv",
                {"neighbours", "square.obj", "points.csv", "--within", "1", "-o", "points.csv"});
}

} // namespace geodisk::test
