// Lines and edges that samples avoid along their whole length.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <string>
#include <vector>

#include "cli/command.hpp"
#include "cli/json_file.hpp"
#include "files/samples/sample_file.hpp"

namespace geodisk::test {
namespace {

constexpr double kRadius = 0.1, kWidest = kRadius * 17 / 16;

/// A square of 5 x 5 vertices, and if it is folded as many above its right side.
std::string grid_text(bool is_folded) {
    std::string text;
    const int columns = is_folded ? 9 : 5;
    for (int i = 0; i < columns; ++i) {
        for (int k = 0; k < 5; ++k) {
            text += "v " + std::to_string(std::min(i, 4) / 4.0) + ' ' + std::to_string(k / 4.0) +
                    ' ' + std::to_string(std::max(0, i - 4) / 4.0) + '\n';
        }
    }
    for (int i = 0; i + 1 < columns; ++i) {
        for (int k = 1; k < 5; ++k) {
            const int at = 5 * i + k;
            text += "f " + std::to_string(at) + ' ' + std::to_string(at + 5) + ' ' +
                    std::to_string(at + 6) + ' ' + std::to_string(at + 1) + '\n';
        }
    }
    return text;
}

/// A place of the grid that is laid flat.
struct Flat {
    double u, v;
    explicit Flat(const tools::SampleRow& row)
        : u(row.position[0] + row.position[2]), v(row.position[1]) {}
    /// Returns the distance from the line at v = 0.5 from u = 0.1 to `end`.
    double from_road(double end) const { return std::hypot(u - std::clamp(u, 0.1, end), v - 0.5); }
};

/// Returns the places of the samples that avoid something.
std::vector<Flat> avoiding(const TemporaryFolder& folder, const std::string& mesh,
                           const std::string& avoid, double distance = 0.02) {
    const Outcome made = run(
        folder, {"sample", mesh, "-o", "a.csv", "-d", std::to_string(distance), "--avoid", avoid});
    INFO(made.out, made.err);
    REQUIRE(made.status == 0);
    const Outcome verified = run(folder, {"verify", mesh, "a.csv", "--avoid", avoid});
    INFO(verified.out, verified.err);
    REQUIRE(verified.status == 0);
    std::vector<Flat> places;
    for (const tools::SampleRow& row : tools::read_samples(folder / "a.csv").rows) {
        places.emplace_back(row);
    }
    return places;
}

/// Checks that samples are no nearer than the radius, and not much farther everywhere.
template <typename Distance>
void check_distances(const std::vector<Flat>& places, const Distance& distance) {
    double nearest = 1;
    for (const Flat& place : places) {
        REQUIRE(distance(place) >= kRadius);
        nearest = std::min(nearest, distance(place));
    }
    CHECK(nearest < kWidest + 0.003);
}

} // namespace

TEST_CASE("lines of every format are avoided along their whole length") {
    const TemporaryFolder folder;
    folder.write("grid.obj", grid_text(false));
    folder.write("road.obj", "v 0.1 0.5 0\nv 0.9 0.5 0\nl 1/7 -1\n");
    folder.write("road.off", "OFF\n# a road\n2 1 0\n0.1 0.5 0\n0.9 0.5 0\n2 0 1\n");
    folder.write("road.ply", "ply\nformat ascii 1.0\nelement vertex 2\nproperty double x\n"
                             "property double y\nproperty double z\nelement edge 1\n"
                             "property int vertex1\nproperty int vertex2\nend_header\n"
                             "0.1 0.5 0\n0.9 0.5 0\n0 1\n");
    folder.write("road.csv", "line,x,y,z,width\n7,0.1,0.5,0,0.1\n7,0.9,0.5,0,0.1\n");
    std::vector<std::size_t> counts;
    for (const std::string road :
         {"road.obj:0.1", "road.off:0.1", "road.ply:0.1", "road.csv:0.1", "road.csv:width"}) {
        CAPTURE(road);
        const std::vector<Flat> places = avoiding(folder, "grid.obj", road);
        check_distances(places, [](const Flat& place) { return place.from_road(0.9); });
        counts.push_back(places.size());
    }
    CHECK(std::ranges::count(counts, counts[0]) == 5);

    REQUIRE(run(folder, {"sample", "grid.obj", "-o", "free.csv", "-d", "0.05"}).status == 0);
    const Outcome found = run(
        folder, {"verify", "grid.obj", "free.csv", "--avoid", "road.obj:0.1", "--json", "v.json"});
    CHECK(found.status == 1);
    CHECK(contains(found.out, "avoided       2 points, lines of length 0.8; "));
    CHECK(contains(found.out, " from a line\n"));
    std::size_t within = 0;
    const tools::SampleFile free = tools::read_samples(folder / "free.csv");
    for (const tools::SampleRow& row : free.rows) {
        within += Flat(row).from_road(0.9) < kRadius;
    }
    CHECK(json_in(folder, "v.json")["avoided"]["intrusions"]["count"] >= within);
}

TEST_CASE("lines of glTF are avoided along their whole length, where nodes place them") {
    const TemporaryFolder folder;
    folder.write("grid.obj", grid_text(false));
    folder.write("road.obj", "v 0.1 0.5 0\nv 0.9 0.5 0\nl 1 \\\n2\n");
    // Two floats per axis: a line from 0 to 1 along x, which its node shortens and moves.
    const std::string bytes("\0\0\0\0\0\0\0\0\0\0\0\0\0\0\x80\x3f\0\0\0\0\0\0\0\0", 24);
    folder.write("road.bin", bytes);
    const std::string text =
        R"({"asset": {"version": "2.0"}, "nodes": [{"mesh": 0, "scale": [0.8, 1, 1],)"
        R"("translation": [0.1, 0.5, 0]}], "meshes": [{"primitives": [)"
        R"({"attributes": {"POSITION": 0}, "mode": 3}]}], "accessors": [{"bufferView": 0,)"
        R"("componentType": 5126, "count": 2, "type": "VEC3"}], "bufferViews": [{"buffer": 0,)"
        R"("byteLength": 24}], "buffers": [{"byteLength": 24, "uri": ")";
    folder.write("road.gltf", text + "road.bin\"}]}");
    const std::vector<Flat> places = avoiding(folder, "grid.obj", "road.gltf:0.1");
    check_distances(places, [](const Flat& place) { return place.from_road(0.9); });
    CHECK(places.size() == avoiding(folder, "grid.obj", "road.obj:0.1").size());
    check_fails(folder, 3, "road.gltf: has no columns, so none of the name width",
                {"sample", "grid.obj", "-o", "b.csv", "-d", "0.1", "--avoid", "road.gltf:width"});
    // Buffers outside of its folder are read on request.
    std::filesystem::create_directory(folder / "below");
    folder.write("below/far.gltf", text + "../road.bin\"}]}");
    std::vector<std::string> arguments{"sample", "grid.obj", "-o",      "b.csv",
                                       "-d",     "0.1",      "--avoid", "below/far.gltf:0.1"};
    check_fails(folder, 3, "add --allow-outside", arguments);
    arguments.emplace_back("--allow-outside");
    CHECK(run(folder, arguments).status == 0);
}

TEST_CASE("a line over a fold is avoided on both sides, and one beside the surface is refused") {
    const TemporaryFolder folder;
    folder.write("fold.obj", grid_text(true));
    folder.write("road.csv", "x,y,z,line\n0.1,0.5,0,0\n1,0.5,0,0\n1,0.5,0.6,0\n");
    check_distances(avoiding(folder, "fold.obj", "road.csv:0.1"),
                    [](const Flat& place) { return place.from_road(1.6); });
    folder.write("short.csv", "x,y,z,line\n0.1,0.5,0,0\n1,0.5,0.6,0\n");
    check_fails(folder, 3, "short.csv: a line leaves fold.obj",
                {"sample", "fold.obj", "-o", "b.csv", "-d", "0.1", "--avoid", "short.csv:0.1"});
    // Radii in a column vary along a line.
    folder.write("taper.csv", "x,y,z,line,r\n0.1,0.5,0,0,0.05\n0.9,0.5,0,0,0.2\n");
    for (const Flat& place : avoiding(folder, "fold.obj", "taper.csv:r")) {
        for (double u = 0.1; u < 0.9; u += 0.01) {
            REQUIRE(std::hypot(place.u - u, place.v - 0.5) >= 0.05 + 0.15 * (u - 0.1) / 0.8);
        }
    }
}

TEST_CASE("borders and creases of the mesh are avoided") {
    const TemporaryFolder folder;
    folder.write("grid.obj", grid_text(false));
    folder.write("fold.obj", grid_text(true));
    check_distances(avoiding(folder, "grid.obj", "border:0.1"), [](const Flat& place) {
        return std::min({place.u, 1 - place.u, place.v, 1 - place.v});
    });
    check_distances(avoiding(folder, "fold.obj", "creases:0.1"),
                    [](const Flat& place) { return std::abs(place.u - 1); });
    const Outcome closed = run(
        folder, {"sample", "builtin:cube", "-o", "b.csv", "-d", "0.5", "--avoid", "border:0.1"});
    CHECK(closed.status == 0);
    CHECK(contains(closed.err, "has no border to avoid"));
    check_fails(folder, 2, "--avoid: border takes a length, not 'size'; for a file of that name",
                {"sample", "grid.obj", "-o", "c.csv", "-d", "0.1", "--avoid", "border:size"});
    folder.write("bad.obj", "v 0 0 0\nl 1 2\n");
    check_fails(folder, 3, "line 2: '2' is not one of the 1 vertex before it",
                {"sample", "grid.obj", "-o", "c.csv", "-d", "0.1", "--avoid", "bad.obj:0.1"});
}

} // namespace geodisk::test
