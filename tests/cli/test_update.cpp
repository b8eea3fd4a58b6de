// Samples that follow an edit of their mesh.
#include <doctest/doctest.h>

#include <cmath>
#include <fstream>
#include <string>

#include "cli/command.hpp"
#include "cli/json_file.hpp"

namespace geodisk::test {
namespace {

/// Writes a hilly square of 40 by 40 cells, with a bump of this height, as PLY.
void write_hills(const TemporaryFolder& folder, const std::string& name, double bump,
                 int columns = 40) {
    std::ofstream file(folder / name);
    file << "ply\nformat ascii 1.0\nelement vertex " << (columns + 1) * 41
         << "\nproperty double x\nproperty double y\nproperty double z\nelement face "
         << 2 * columns * 40 << "\nproperty list uchar int vertex_indices\nend_header\n";
    for (int y = 0; y <= 40; ++y) {
        for (int x = 0; x <= columns; ++x) {
            const bool is_bump = x == 20 && y == 20;
            file << x << ' ' << y << ' '
                 << std::sin(0.3 * x) * std::cos(0.2 * y) + (is_bump ? bump : 0) << '\n';
        }
    }
    for (int y = 0; y < 40; ++y) {
        for (int x = 0; x < columns; ++x) {
            const int a = y * (columns + 1) + x, c = a + columns + 1;
            file << "3 " << a << ' ' << a + 1 << ' ' << c + 1 << '\n';
            file << "3 " << a << ' ' << c + 1 << ' ' << c << '\n';
        }
    }
}

/// Returns what follows the header, which counts the candidates that were decided.
std::string rows_of(const TemporaryFolder& folder, const std::string& name) {
    const std::string bytes = bytes_of(folder / name);
    return bytes.substr(bytes.find("end_header"));
}

double disks_in(const TemporaryFolder& folder, const std::string& name) {
    return json_in(folder, name)["disks"].get<double>();
}

} // namespace

TEST_CASE("samples are updated to those of a whole run, and few disks are computed") {
    const TemporaryFolder folder;
    write_hills(folder, "old.ply", 0);
    write_hills(folder, "new.ply", 1);
    const Arguments job{"-d", "1.5", "--seed", "3"};
    REQUIRE(run(folder, joined({"sample", "old.ply", "-o", "a.ply"}, job)).status == 0);
    const Outcome updated = run(folder, joined({"sample", "new.ply", "-o", "b.ply", "--from",
                                                "old.ply", "--update", "a.ply", "--json", "b.json"},
                                               job));
    INFO(updated.out, updated.err);
    REQUIRE(updated.status == 0);
    REQUIRE(run(folder, joined({"sample", "new.ply", "-o", "c.ply", "--from", "old.ply", "--json",
                                "c.json"},
                               job))
                .status == 0);
    REQUIRE(run(folder, joined({"sample", "new.ply", "-o", "d.ply"}, job)).status == 0);
    CHECK(rows_of(folder, "b.ply") == rows_of(folder, "c.ply"));
    CHECK(rows_of(folder, "b.ply") == rows_of(folder, "d.ply"));
    CHECK(rows_of(folder, "b.ply") != rows_of(folder, "a.ply"));
    CHECK(disks_in(folder, "b.json") < disks_in(folder, "c.json") / 2);

    // Nothing has changed.
    REQUIRE(run(folder, joined({"sample", "old.ply", "-o", "e.ply", "--from", "old.ply", "--update",
                                "a.ply", "--json", "e.json"},
                               job))
                .status == 0);
    CHECK(rows_of(folder, "e.ply") == rows_of(folder, "a.ply"));
    CHECK(disks_in(folder, "e.json") == 0);
}

TEST_CASE("updates of other samples, meshes and kinds are refused") {
    const TemporaryFolder folder;
    write_hills(folder, "old.ply", 0);
    write_hills(folder, "new.ply", 1);
    REQUIRE(run(folder, {"sample", "old.ply", "-o", "a.ply", "-d", "3"}).status == 0);
    REQUIRE(run(folder, {"sample", "old.ply", "-o", "points.xyz", "-d", "3"}).status == 0);
    const auto refused = [&](int status, const std::string& part, const Arguments& more) {
        check_fails(folder, status, part, joined({"sample", "new.ply", "-o", "b.ply"}, more));
    };
    const Arguments edit{"--from", "old.ply", "--update", "a.ply"};
    refused(2, "--update needs the mesh of the samples; add --from OLD_MESH",
            {"-d", "3", "--update", "a.ply"});
    refused(3, "a.ply: has as its seed 0, not 9; give the options it was made with",
            joined(edit, {"-d", "3", "--seed", "9"}));
    refused(3, "a.ply: has as its minimum distance 3, not 2.9", joined(edit, {"-d", "2.9"}));
    refused(3, "a.ply: has as its pool_ratio none, not 10",
            joined(edit, {"-d", "3", "--pool-ratio", "10"}));
    refused(3, "a.ply: has as its mask none, not x<9", joined(edit, {"-d", "3", "--mask", "x<9"}));
    for (const Arguments& kind : {Arguments{"--maximal"}, Arguments{"--classes", "2"},
                                  Arguments{"--method", "darts", "--darts", "400"}}) {
        const Arguments make{"sample", "old.ply", "-o", "other.ply", "-d", "3"};
        const Outcome made = run(folder, joined(make, kind));
        INFO(made.err);
        REQUIRE(made.status == 0);
        refused(3, "has samples of --", {"-d", "3", "--from", "old.ply", "--update", "other.ply"});
    }
    folder.write("bare.csv", "x,y,z,face_index,bary_u,bary_v,bary_w\n0,0,0,0,1,0,0\n");
    refused(3, "does not say its seed and minimum distance",
            {"-d", "3", "--from", "old.ply", "--update", "bare.csv"});
    refused(2, "--from takes no --count; give --min-distance", joined(edit, {"-n", "50"}));
    refused(2, "--from takes no --maximal", joined(edit, {"-d", "3", "--maximal"}));
    refused(2, "--from takes no --avoid", joined(edit, {"-d", "3", "--avoid", "a.ply:1"}));
    refused(3, "has no faces and weights, so its samples cannot be updated",
            {"-d", "3", "--from", "old.ply", "--update", "points.xyz"});
}

} // namespace geodisk::test
