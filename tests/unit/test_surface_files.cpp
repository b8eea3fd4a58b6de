// Meshes with more than three coordinates, sidecar files, lifts, and samples of such meshes.
#include "files/meshes/mesh_file.hpp"
#include "files/samples/sample_file.hpp"
#include "geometry/lift.hpp"
#include "test_files.hpp"

#include <cmath>

using namespace geodisk::tools;

namespace {

constexpr std::string_view kSurfaceObj = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3\nf 1 3 4\n";
constexpr std::string_view kBareObj = "f 1 2 3\nf 1 3 4\n";

/// Two triangles with the given vertex properties and values.
std::string surface_ply_with(std::string_view properties, std::string_view values) {
    return "ply\nformat ascii 1.0\nelement vertex 4\n" + std::string(properties) +
           "element face 2\nproperty list uchar int vertex_indices\nend_header\n" +
           std::string(values) + "3 0 1 2\n3 0 2 3\n";
}

std::string numbered(int count) {
    std::string properties;
    for (int i = 0; i < count; ++i) {
        properties += "property double x" + std::to_string(i) + "\n";
    }
    return properties;
}

/// A mesh file with its sidecars, "" for none.
MeshFile mesh_of(std::string_view name, std::string_view bytes, std::string_view coordinates,
                 std::string_view lengths, const std::vector<std::string>& attributes = {}) {
    const TemporaryFolder folder;
    MeshSources sources;
    sources.mesh = folder.write(name, bytes).string();
    if (!coordinates.empty()) {
        sources.coordinates = folder.write("coordinates.txt", coordinates).string();
    }
    if (!lengths.empty()) {
        sources.edge_lengths = folder.write("lengths.txt", lengths).string();
    }
    sources.fields.numbers = attributes;
    return read_mesh(sources);
}

void coordinates_fail(std::string_view coordinates, std::string_view part) {
    CAPTURE(coordinates);
    check_fails(ExitCode::bad_input, part, [&] { mesh_of("a.obj", kSurfaceObj, coordinates, ""); });
}

void lengths_fail(std::string_view lengths, std::string_view part) {
    CAPTURE(lengths);
    check_fails(ExitCode::bad_input, part, [&] { mesh_of("a.obj", kBareObj, "", lengths); });
}

const std::vector<double> kSquare4{0, 0, 0, 5, 1, 0, 0, 5, 1, 1, 0, 5, 0, 1, 0, 5};
constexpr std::string_view kLines4 = "0 0 0 5\n1 0 0 5\n1 1 0 5\n0 1 0 5\n";
constexpr std::string_view kLengths = "1 2 3\n2 3 4\n1 3 5\n3 4 3\n1 4 4\n";

SampleRow row_of(std::uint32_t dimension) {
    SampleRow row;
    for (std::size_t axis = 0; axis < dimension; ++axis) {
        row.position[axis] = 0.5 + static_cast<double>(axis);
    }
    row.face = 3;
    row.bary[0] = 1;
    return row;
}

} // namespace

TEST_CASE("a dropped triangle has no say in the normals of a lift") {
    const MeshFile mesh = mesh_of("a.obj",
                                  "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 9 9 9\n"
                                  "f 1 1 4\nf 1 2 3\nf 3 2 1\n",
                                  "", "");
    const std::vector<Lift> lifts{{"", 2}};
    const LiftedPositions lifted = lifted_positions("a.obj", mesh, lifts);
    CHECK(std::vector(lifted.positions.begin(), lifted.positions.begin() + 6) ==
          std::vector<double>{0, 0, 0, 0, 0, 2});
}

TEST_CASE("PLY vertices may have x0 to x7") {
    const MeshFile mesh = mesh_of("a.ply", surface_ply_with(numbered(4), kLines4), "", "");
    CHECK(mesh.dimension == 4);
    CHECK(mesh.positions == kSquare4);
    CHECK(mesh.triangles == std::vector<std::uint32_t>{0, 1, 2, 0, 2, 3});
    // They count, not x y z beside them.
    const std::string both = "property float x\nproperty float y\nproperty float z\n" + numbered(4);
    CHECK(mesh_of("a.ply",
                  surface_ply_with(both,
                                   "9 9 9 0 0 0 5\n9 9 9 1 0 0 5\n9 9 9 1 1 0 5\n9 9 9 0 1 0 5\n"),
                  "", "")
              .positions == kSquare4);
    const std::string zeros = "0 0 0 0 0 0 0 0\n";
    CHECK(
        mesh_of("a.ply",
                surface_ply_with(numbered(8), zeros + "1 0 0 0 0 0 0 0\n0 0 0 0 0 0 0 1\n" + zeros),
                "", "")
            .dimension == 8);
    const auto fails = [](const std::string& properties, std::string_view part) {
        check_fails(ExitCode::bad_input, part,
                    [&] { mesh_of("a.ply", surface_ply_with(properties, ""), "", ""); });
    };
    fails(numbered(2), "has properties x0 to x1");
    fails(numbered(9), "3 to 8 coordinates");
    fails(numbered(3) + "property double x4\n", "a property x4 but no x3");
    check_fails(ExitCode::bad_input, "record 2: the coordinates are not finite", [] {
        mesh_of("a.ply", surface_ply_with(numbered(4), "0 0 0 5\n1 0 0 5\n1 1 0 inf\n0 1 0 5\n"),
                "", "");
    });
}

TEST_CASE("polygons in R^4 are split in their plane") {
    // An L in a plane that is square to none of the axes.
    const double l[6][2] = {{0, 0}, {2, 0}, {2, 1}, {1, 1}, {1, 2}, {0, 2}};
    std::string coordinates;
    for (const auto& [u, v] : l) {
        for (const double x : {u, v, u + v, u - v}) {
            coordinates += std::to_string(x) + " ";
        }
        coordinates += "\n";
    }
    const MeshFile mesh = mesh_of("a.obj",
                                  "v 0 0 0\nv 0 0 0\nv 0 0 0\nv 0 0 0\nv 0 0 0\nv 0 0 0\n"
                                  "f 4 5 6 1 2 3\n",
                                  coordinates, "");
    REQUIRE(mesh.triangles.size() == 12);
    double area = 0;
    for (std::size_t i = 0; i < 12; i += 3) {
        const auto& a = l[mesh.triangles[i]];
        const auto& b = l[mesh.triangles[i + 1]];
        const auto& c = l[mesh.triangles[i + 2]];
        area += std::abs((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])) / 2;
    }
    CHECK(area == doctest::Approx(3)); // No part twice, none outside.
}

TEST_CASE("a sidecar file gives the coordinates of an OBJ file, with or without its own") {
    const std::string commented = "# four of them\n\n" + std::string(kLines4) + "  # the end\r\n";
    for (const std::string_view obj : {kSurfaceObj, kBareObj}) {
        const MeshFile mesh = mesh_of("a.obj", obj, commented, "");
        CHECK(mesh.dimension == 4);
        CHECK(mesh.positions == kSquare4);
    }
    coordinates_fail("0 0\n", "coordinates.txt: line 1: has 2 numbers");
    coordinates_fail("0 0 0 0 0 0 0 0 0\n", "3 to 8 coordinates");
    coordinates_fail("0 0 0 5\n\n1 0 0\n", "line 3: has 3 numbers instead of 4");
    coordinates_fail("0 0 0 five\n", "line 1: 'five' is not a number");
    coordinates_fail("0 0 0 nan\n", "line 1: 'nan' is not finite");
    coordinates_fail("# none\n", "has no coordinates");
    coordinates_fail("0 0 0 5\n1 0 0 5\n", "has the coordinates of 2 vertices");
    check_fails(ExitCode::bad_input, "line 2: vertex index 4 is out of range, the file has 3",
                [] { mesh_of("a.obj", kBareObj, "0 0 0\n1 0 0\n1 1 0\n", ""); });
    check_fails(ExitCode::usage, "contradict",
                [] { mesh_of("a.obj", kSurfaceObj, kLines4, kLengths); });
    check_fails(ExitCode::usage, "builtin:cube is complete", [] {
        read_mesh({"builtin:cube", "", "a.txt", "", {}});
    });
}

TEST_CASE("a sidecar file gives the lengths of edges") {
    const std::vector<double> expected{3, 4, 5, 5, 3, 4};
    const MeshFile bare = mesh_of("a.obj", kBareObj, "", kLengths);
    CHECK(bare.positions.empty());
    CHECK(bare.lengths == expected);
    CHECK(bare.warnings.empty());
    // Coordinates are kept but do not matter, not even if all are equal; PLY counts from 0.
    const std::string flat = "property float x\nproperty float y\nproperty float z\n";
    const MeshFile ply = mesh_of("a.ply", surface_ply_with(flat, "0 0 0\n0 0 0\n0 0 0\n0 0 0\n"),
                                 "", "0 1 3 # first\n2 1 4\n2 0 5\n3 2 3\n3 0 4\n2 0 5\n7 8 1\n");
    CHECK(ply.lengths == expected);
    CHECK(ply.positions.size() == 12);
    REQUIRE(ply.warnings.size() == 1);
    CHECK(ply.warnings[0].message == "1 length of an edge that no face has ignored");
    CHECK(mesh_of("a.ply", surface_ply_with("property float quality\n", "1\n2\n3\n4\n"), "",
                  "0 1 3\n2 1 4\n2 0 5\n3 2 3\n3 0 4\n")
              .positions.empty());

    lengths_fail("1 2\n", "lengths.txt: line 1: an edge reads");
    lengths_fail("1 2 3 4\n", "line 1: an edge reads");
    lengths_fail("0 1 3\n", "line 1: '0' is not a vertex; they are numbered from 1");
    lengths_fail("1 x 3\n", "'x' is not a vertex");
    lengths_fail("1 2 long\n", "line 1: 'long' is not a number");
    lengths_fail("1 2 inf\n", "line 1: 'inf' is not finite");
    lengths_fail("1 2 0\n", "line 1: edge 1-2 has a length that is not positive");
    lengths_fail("1 2 3\n2 1 3.5\n", "line 2: edge 2-1 has another length than in line 1");
    lengths_fail("1 2 3\n2 3 4\n", "has no length for edge 3-1");
    check_fails(ExitCode::bad_input, "line 5: has 4 corners; with edge lengths", [] {
        mesh_of("a.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\n", "", kLengths);
    });
    check_fails(ExitCode::bad_input, "vertex index 4000000000 is out of range", [] {
        mesh_of("a.ply",
                "ply\nformat ascii 1.0\nelement vertex 0\nelement face 1\n"
                "property list uchar uint vertex_indices\nend_header\n3 0 1 4000000000\n",
                "", "0 1 1\n");
    });

    const MeshFile dropped = mesh_of("a.obj", "f 1 2 3\nf 3 2 1\nf 2 2 4\nf 1 3 4\n", "", kLengths);
    CHECK(dropped.lengths == std::vector<double>{3, 4, 5, 0, 0, 0, 0, 0, 0, 5, 3, 4});
}

TEST_CASE("lifts are read strictly") {
    CHECK(parse_lift("--lift", "normals:0.25").weight == 0.25);
    CHECK(parse_lift("--lift", "normals:0.25").attribute.empty());
    CHECK(parse_lift("--lift", "attribute:a:b:-2e1").attribute == "a:b");
    CHECK(parse_lift("--lift", "attribute:a:b:-2e1").weight == -20);
    for (const char* text : {"", "normals", "normal:1", "attribute:1", "attribute::1", "x:1"}) {
        check_fails(ExitCode::usage, "is not a lift", [&] { parse_lift("--lift", text); });
    }
    for (const char* text :
         {"normals:", "normals:nan", "normals:inf", "attribute:a:1e999", "normals:0,5"}) {
        check_fails(ExitCode::usage, "is not a finite weight", [&] { parse_lift("--lift", text); });
    }
}

TEST_CASE("a lift appends weighted normals and attributes") {
    const std::string properties =
        "property float x\nproperty float y\nproperty float z\nproperty float quality\n"
        "property list uchar int tags\n";
    const std::string ply =
        surface_ply_with(properties, "0 0 0 1 0\n1 0 0 2 0\n1 1 0 3 0\n0 1 0 4 0\n");
    const MeshFile mesh = mesh_of("a.ply", ply, "", "", {"quality"});
    CHECK(mesh.number("quality").values == std::vector<double>{1, 2, 3, 4});
    const std::vector<Lift> lifts{{"quality", 0.5}, {"", 2}};
    CHECK(lift_attributes(lifts) == std::vector<std::string>{"quality"});
    const LiftedPositions lifted = lifted_positions("a.ply", mesh, lifts);
    CHECK(lifted.dimension == 7);
    CHECK(lifted.positions == std::vector<double>{0, 0, 0, 0.5, 0, 0, 2, 1, 0, 0, 1,   0, 0, 2,
                                                  1, 1, 0, 1.5, 0, 0, 2, 0, 1, 0, 2.0, 0, 0, 2});

    const auto fails = [&](ExitCode code, std::string_view part, const MeshFile& of,
                           const std::vector<Lift>& by) {
        check_fails(code, part, [&] { lifted_positions("a.ply", of, by); });
    };
    fails(ExitCode::usage, "makes 9 coordinates of 3", mesh, {{"", 1}, {"", 1}});
    MeshFile not_finite = mesh;
    not_finite.numbers[0].values[2] = NAN;
    fails(ExitCode::bad_input, "record 2: 'quality' is not finite", not_finite, {{"quality", 1}});
    fails(ExitCode::usage, "needs a mesh with 3 coordinates; a.ply has 4",
          mesh_of("a.obj", kSurfaceObj, kLines4, ""), {{"", 1}});
    MeshFile twice = mesh;
    twice.triangles = {0, 1, 2, 0, 2, 1};
    fails(ExitCode::bad_input, "vertex 0 (from 0) has no normal", twice, {{"", 1}});

    check_fails(ExitCode::bad_input, "a.ply: has no attribute 'colour'; it has",
                [&] { mesh_of("a.ply", ply, "", "", {"colour"}); });
    check_fails(ExitCode::bad_input, "has no attribute 'tags'",
                [&] { mesh_of("a.ply", ply, "", "", {"tags"}); });
    check_fails(ExitCode::bad_input, "a.obj: has no attribute 'quality', or any other",
                [] { mesh_of("a.obj", kSurfaceObj, "", "", {"quality"}); });
    check_fails(ExitCode::bad_input, "has 4 values of 'quality' for 5 vertices", [&] {
        MeshFile longer = mesh;
        longer.positions.resize(15);
        lifted_positions("a.ply", longer, std::vector<Lift>{{"quality", 1}});
    });
}

TEST_CASE("normals are weighted by angle, so that how faces are split does not matter") {
    // The corner of a cube, one side split in two at it.
    const MeshFile mesh = mesh_of("a.obj",
                                  "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nv 1 1 0\n"
                                  "f 1 2 5\nf 1 5 3\nf 1 3 4\nf 1 4 2\n",
                                  "", "");
    const LiftedPositions lifted = lifted_positions("a", mesh, std::vector<Lift>{{"", 1}});
    for (std::size_t axis = 3; axis < 6; ++axis) {
        CHECK(lifted.positions[axis] == doctest::Approx(std::sqrt(1.0 / 3)));
    }
}

TEST_CASE("written shapes read back exactly") {
    for (const char* name : {"builtin:klein-bottle:5", "builtin:veronese:1", "builtin:cube:2"}) {
        CAPTURE(name);
        const TemporaryFolder folder;
        const MeshFile mesh = read_mesh(name);
        write_mesh(folder / "a.ply", mesh);
        const MeshFile read = read_mesh((folder / "a.ply").string());
        CHECK(read.dimension == mesh.dimension);
        CHECK(read.positions == mesh.positions);
        CHECK(read.triangles == mesh.triangles);
        CHECK(contains(bytes_of(folder / "a.ply"), "property double x\n"));
        check_fails(ExitCode::usage, ".ply only", [&] { write_mesh(folder / "a.obj", mesh); });
    }
}

TEST_CASE("samples keep as many coordinates as their mesh has") {
    const TemporaryFolder folder;
    for (const std::uint32_t dimension : {0u, 3u, 4u, 8u}) {
        const std::vector<SampleRow> rows{row_of(dimension), SampleRow{}};
        for (const char* name : {"a.ply", "a.csv"}) {
            CAPTURE(name);
            CAPTURE(dimension);
            write_samples(folder / name, {}, rows, false, dimension);
            const SampleFile read = read_samples(folder / name);
            CHECK(read.dimension == dimension);
            REQUIRE(read.rows.size() == 2);
            for (std::size_t axis = 0; axis < 8; ++axis) {
                CHECK(read.rows[0].position[axis] == rows[0].position[axis]);
            }
            CHECK(read.rows[0].face == 3);
        }
        if (dimension != 3) {
            check_fails(ExitCode::usage, "an .xyz file holds three coordinates",
                        [&] { write_samples(folder / "a.xyz", {}, rows, false, dimension); });
        }
    }
    write_samples(folder / "b.csv", {}, std::vector<SampleRow>{row_of(4)}, false, 4);
    CHECK(bytes_of(folder / "b.csv") ==
          "x0,x1,x2,x3,face_index,bary_u,bary_v,bary_w\n0.5,1.5,2.5,3.5,3,1,0,0\n");
    write_samples(folder / "b.csv", {}, std::vector<SampleRow>{row_of(0)}, false, 0);
    CHECK(bytes_of(folder / "b.csv") == "face_index,bary_u,bary_v,bary_w\n3,1,0,0\n");
    write_samples(folder / "b.ply", {}, std::vector<SampleRow>{row_of(4)}, true, 4);
    CHECK(
        contains(bytes_of(folder / "b.ply"), "double y\nproperty double z\nproperty double x0\n"));
    CHECK(contains(bytes_of(folder / "b.ply"), "\n0.5 1.5 2.5 0.5 1.5 2.5 3.5 3 1 0 0\n"));
    check_fails(ExitCode::bad_input, "no column z", [&] {
        read_samples(folder.write("c.csv", "x,y,face_index,bary_u,bary_v,bary_w\n"));
    });
    check_fails(ExitCode::bad_input, "no column x2", [&] {
        read_samples(folder.write("c.csv", "x0,x1,face_index,bary_u,bary_v,bary_w\n"));
    });
}
