// Surfaces beyond three coordinates, by edge lengths and lifted: sampled and verified.
#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <string>

#include "cli/command.hpp"
#include "files/samples/sample_file.hpp"

namespace geodisk::test {
namespace {

/// Samples and verifies with the same options and returns the samples.
tools::SampleFile check_passes(const TemporaryFolder& folder, const Arguments& surface) {
    const Outcome made =
        run(folder, joined(joined({"sample"}, surface), {"-o", "a.ply", "-n", "300"}));
    INFO(made.err);
    REQUIRE(made.status == 0);
    Arguments verify = joined({"verify"}, surface);
    verify.insert(verify.begin() + 2, "a.ply");
    const Outcome verified = run(folder, verify);
    INFO(verified.out, verified.err);
    CHECK(verified.status == 0);
    CHECK(contains(verified.out, "violations    0\n"));
    tools::SampleFile samples = tools::read_samples(folder / "a.ply");
    CHECK(samples.rows.size() > 200);
    return samples;
}

/// A tetrahedron of faces 3-4-5 in OBJ without vertices.
constexpr const char* kBare = "f 1 2 3\nf 1 4 2\nf 2 4 3\nf 3 4 1\n";
constexpr const char* kLengths = "1 2 3\n2 3 4\n1 3 5 # longest\n3 4 3.5\n1 4 4.5\n2 4 5\n";

} // namespace

TEST_CASE("shapes in R^4 are sampled, verified and written") {
    const TemporaryFolder folder;
    for (const std::string name : {"clifford-torus:20", "klein-bottle:12", "veronese:3"}) {
        INFO(name);
        const tools::SampleFile samples = check_passes(folder, {"builtin:" + name});
        CHECK(samples.dimension == 4);
        REQUIRE(run(folder, {"shapes", name, "-o", "mesh.ply"}).status == 0);
        const tools::SampleFile again = check_passes(folder, {"mesh.ply"});
        REQUIRE(again.rows.size() == samples.rows.size());
        CHECK(again.rows.back().face == samples.rows.back().face);
        CHECK(std::ranges::equal(again.rows.back().bary, samples.rows.back().bary));
    }
    check_fails(folder, 2, "three coordinates, and these samples have 4",
                {"sample", "builtin:veronese:2", "-o", "a.xyz", "-n", "9"});
    REQUIRE(run(folder, {"sample", "builtin:cube", "-o", "b.ply", "-n", "9"}).status == 0);
    check_fails(folder, 3,
                "its samples have 3 coordinates, the vertices of builtin:veronese:2 have 4",
                {"verify", "builtin:veronese:2", "b.ply"});
}

TEST_CASE("welding joins faces along open seams, and verify wants the same") {
    const TemporaryFolder folder;
    folder.write("mesh.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 0 0\nv 1 1 0.001\nv 0 1 0\n"
                             "f 1 2 3\nf 4 5 6\n");
    // The option takes no argument that follows it.
    Outcome made = run(folder, {"sample", "--weld=0.1%", "mesh.obj", "-o", "a.ply", "-n", "200"});
    INFO(made.err);
    REQUIRE(made.status == 0);
    CHECK(made.err.empty());
    CHECK(contains(made.out, "weld 0.1%\n"));
    CHECK(contains(made.out, "1 component, 4 boundary edges, 2 vertices joined to others, area"));
    CHECK(*tools::read_samples(folder / "a.ply").header.find("weld") == "0.1%");
    for (const Arguments& first :
         {Arguments{"sample", "--weld", "mesh.obj"}, {"sample", "mesh.obj"}}) {
        made = run(folder, joined(first, {"-o", "b.ply", "-n", "200", "--json", "b.json"}));
        REQUIRE(made.status == 0);
        CHECK(contains(made.err, first.size() == 3 ? "1 vertex joins faces" : "2 components"));
        CHECK(contains(bytes_of(folder / "b.json"), first.size() == 3
                                                        ? "\"merged_vertices\": 1,"
                                                        : "\"merged_vertices\": null,"));
    }
    const Outcome same =
        run(folder, {"verify", "mesh.obj", "a.ply", "--weld=0.1%", "--json", "v.json"});
    CHECK(same.status == 0);
    CHECK(contains(same.out, "weld 0.1%\n"));
    CHECK(contains(same.out, "2 vertices joined to others, area"));
    CHECK(contains(bytes_of(folder / "v.json"), "\"merged_vertices\": 2,"));
    CHECK(same.err.empty());
    CHECK(contains(run(folder, {"verify", "mesh.obj", "a.ply"}).err,
                   "made with --weld=0.1%, but this command"));
    CHECK(contains(run(folder, {"verify", "mesh.obj", "b.ply", "--weld=0.1%"}).err,
                   "made with no --lift, --weld, --keep-seams and --walls, but this command"));
    const Outcome moved = run(folder, {"transfer", "a.ply", "mesh.obj", "mesh.obj", "-o", "c.ply",
                                       "--weld-a=0.1%", "--weld-b=0.1%", "--json", "c.json"});
    CHECK(moved.status == 0);
    CHECK(contains(moved.out, "2 vertices joined to others, area"));
    CHECK(contains(bytes_of(folder / "c.json"), "\"merged_vertices\": 2,"));
    CHECK(run(folder,
              {"sample", "mesh.obj", "-o", "e.ply", "-n", "9", "--weld", "--metric", "euclidean"})
              .status == 0);
    check_fails(folder, 2, "--weld: 'x' is not a length",
                {"sample", "mesh.obj", "-o", "d.ply", "-n", "9", "--weld=x"});
}

TEST_CASE("seams of coinciding borders are joined, and verify wants the same") {
    const TemporaryFolder folder;
    // A box whose faces have vertices of their own, as where its normals are flat.
    constexpr const char* kFaces[] = {"000 010 110 100", "001 101 111 011", "000 100 101 001",
                                      "010 011 111 110", "000 001 011 010", "100 110 111 101"};
    std::string vertices, faces;
    int count = 0;
    for (const std::string face : kFaces) {
        faces += "f";
        for (std::size_t k = 0; k < face.size(); k += 4) {
            vertices += std::string("v ") + face[k] + ' ' + face[k + 1] + ' ' + face[k + 2] + '\n';
            faces += ' ' + std::to_string(++count);
        }
        faces += '\n';
    }
    folder.write("box.obj", vertices + faces);
    const Outcome made = run(folder, {"sample", "box.obj", "-o", "a.ply", "-d", "0.1"});
    CHECK(made.status == 0);
    CHECK(made.err.empty());
    CHECK(contains(made.out, "1 component, 24 edges joined along seams, area 6"));
    REQUIRE(run(folder, {"sample", "box.obj", "-o", "b.ply", "-d", "0.1", "--keep-seams"}).status ==
            0);
    const auto names_of_surface = [&](const char* samples) {
        const tools::SampleHeader header = tools::read_samples(folder / samples).header;
        return header.find("keep_seams") != nullptr;
    };
    CHECK_FALSE(names_of_surface("a.ply"));
    CHECK(names_of_surface("b.ply"));

    CHECK(run(folder, {"verify", "box.obj", "a.ply", "--weld"}).status == 0);
    const Outcome other = run(folder, {"verify", "box.obj", "b.ply"});
    CHECK(other.status == 1);
    CHECK(contains(other.err, "made with --keep-seams, but this command has other options"));
    const Outcome same = run(folder, {"verify", "box.obj", "b.ply", "--keep-seams"});
    CHECK(same.status == 0);
    CHECK(contains(same.out, "keep_seams yes\n"));
    CHECK(contains(same.err, "box.obj: 24 edges coincide but are not connected"));
    CHECK(contains(run(folder, {"verify", "box.obj", "a.ply", "--keep-seams"}).err,
                   "made with no --lift, --weld, --keep-seams and --walls, but this command"));
    CHECK(run(folder, {"transfer", "b.ply", "box.obj", "box.obj", "-o", "c.ply", "--keep-seams-a",
                       "--keep-seams-b"})
              .status == 0);
    check_fails(folder, 2, "--weld and --keep-seams contradict",
                {"sample", "box.obj", "-o", "d.ply", "-d", "0.1", "--keep-seams", "--weld"});
}

TEST_CASE("samples go over between poses whose seams are open in one of them") {
    const TemporaryFolder folder;
    const std::string faces = "f 1 2 3\nf 4 5 6\n";
    folder.write("closed.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 0 0\nv 1 1 0\nv 0 1 0\n" + faces);
    folder.write("open.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 0 1\nv 1 1 1\nv 0 1 1\n" + faces);
    REQUIRE(run(folder, {"sample", "closed.obj", "-o", "a.ply", "-n", "50"}).status == 0);
    CHECK(run(folder, {"transfer", "a.ply", "closed.obj", "open.obj", "-o", "b.ply"}).status == 0);
}

TEST_CASE("what differs on both sides of a seam counts as its mean") {
    const TemporaryFolder folder;
    const std::string head = "ply\nformat ascii 1.0\nelement vertex 6\nproperty float x\n"
                             "property float y\nproperty float z\nproperty float quality\n"
                             "element face 2\nproperty list uchar int vertex_indices\nend_header\n";
    const std::string faces = "3 0 1 2\n3 3 4 5\n";
    folder.write("seam.ply",
                 head + "0 0 0 1\n1 0 0 0\n1 1 0 0\n0 0 0 0\n1 1 0 3\n0 1 0 0\n" + faces);
    folder.write("mean.ply", head +
                                 "0 0 0 0.5\n1 0 0 0\n1 1 0 1.5\n0 0 0 0.5\n1 1 0 1.5\n"
                                 "0 1 0 0\n" +
                                 faces);
    const auto set_of = [&](const std::string& mesh) {
        REQUIRE(run(folder,
                    {"sample", mesh, "--lift", "attribute:quality:1", "-n", "50", "-o", "a.xyz"})
                    .status == 0);
        return bytes_of(folder / "a.xyz");
    };
    CHECK(set_of("seam.ply") == set_of("mean.ply"));
    // Also of factors in a file.
    folder.write("seam.txt", "1\n1\n0.5\n0.6\n1\n1\n");
    folder.write("mean.txt", "0.8\n1\n0.75\n0.8\n0.75\n1\n");
    const auto dense = [&](const std::string& values) {
        REQUIRE(run(folder, {"sample", "seam.ply", "--radius-factor", "file:" + values, "-d", "0.1",
                             "-o", "b.xyz"})
                    .status == 0);
        return bytes_of(folder / "b.xyz");
    };
    CHECK(dense("seam.txt") == dense("mean.txt"));
}

TEST_CASE("an STL file is a closed surface, by its places alone") {
    const TemporaryFolder folder;
    std::string facets = "solid tetrahedron\n";
    const char* const corners[] = {"0 0 0", "1 0 0", "0 1 0", "0 0 1"};
    for (const auto& [a, b, c] : {std::array{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}}) {
        facets += "facet normal 0 0 0\nouter loop\n";
        for (const int corner : {a, b, c}) {
            facets += std::string("vertex ") + corners[corner] + "\n";
        }
        facets += "endloop\nendfacet\n";
    }
    folder.write("mesh.stl", facets + "endsolid\n");
    const tools::SampleFile samples = check_passes(folder, {"mesh.stl"});
    CHECK(samples.header.find("weld") == nullptr); // As it is always done.
    const Outcome made =
        run(folder, {"sample", "mesh.stl", "-o", "b.ply", "-n", "99", "--weld=0.001"});
    check_fails(folder, 2, "--keep-seams needs numbers of vertices",
                {"sample", "mesh.stl", "-o", "c.ply", "-n", "99", "--keep-seams"});
    CHECK(made.err.empty());
    CHECK(contains(made.out, "4 triangles, 1 component, 8 vertices joined to others, area"));
}

TEST_CASE("shapes writes what it lists, where it can") {
    const TemporaryFolder folder;
    CHECK(contains(run(folder, {"shapes"}).out, "builtin:klein-bottle "));
    check_fails(folder, 2, "give --output", {"shapes", "cube"});
    check_fails(folder, 2, "no shape given", {"shapes", "-o", "a.ply"});
    check_fails(folder, 2, "unknown built-in shape 'kube'", {"shapes", "kube", "-o", "a.ply"});
    check_fails(folder, 2, ".ply only", {"shapes", "cube", "-o", "a.obj"});
    check_fails(folder, 4, "none/a.ply", {"shapes", "cube", "-o", "none/a.ply"});
}

TEST_CASE("coordinates beside an OBJ file make the surface") {
    const TemporaryFolder folder;
    folder.write("mesh.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\n" + std::string(kBare));
    folder.write("in4d.txt", "0 0 0 1\n1 0 0 0\n0 1 0 0\n0 0 1 0\n");
    const Arguments surface{"mesh.obj", "--coordinates", "in4d.txt"};
    CHECK(check_passes(folder, surface).dimension == 4);
    check_fails(
        folder, 2, "in4d.txt: the report would replace the mesh",
        joined(joined({"sample"}, surface), {"-n", "9", "-o", "a.ply", "--json", "in4d.txt"}));
    folder.write("short.txt", "0 0 0 1\n");
    check_fails(folder, 3, "short.txt: has the coordinates of 1 vertices, but mesh.obj has 4",
                {"sample", "mesh.obj", "--coordinates", "short.txt", "-n", "9", "-o", "a.ply"});
}

TEST_CASE("edge lengths alone make the surface") {
    const TemporaryFolder folder;
    folder.write("mesh.obj", kBare);
    folder.write("lengths.txt", kLengths);
    const Arguments surface{"mesh.obj", "--edge-lengths", "lengths.txt"};
    CHECK(check_passes(folder, surface).dimension == 0);
    const Outcome report =
        run(folder, joined(joined({"sample"}, surface), {"-n", "9", "-o", "a.csv", "--json", "-"}));
    CHECK(contains(report.out, "\"edge_lengths\": \"lengths.txt\""));
    CHECK(contains(report.out, "\"diagonal\": null"));
    const auto fails = [&](int status, const std::string& part, const Arguments& more) {
        check_fails(folder, status, part, joined(joined({"sample"}, surface), more));
    };
    fails(2, "these samples have none", {"-n", "9", "-o", "a.xyz"});
    fails(2, "no bounding box", {"-d", "1%", "-o", "a.csv"});
    fails(2, "--lift and --edge-lengths contradict",
          {"-n", "9", "-o", "a.csv", "--lift", "normals:1"});
    folder.write("lengths.txt", "1 2 3\n2 3 4\n1 3 9\n3 4 3.5\n1 4 4.5\n2 4 5\n");
    fails(3, "mesh.obj: face 0 violates the triangle inequality", {"-n", "9", "-o", "a.csv"});
}

TEST_CASE("a lift measures in the lifted surface and keeps the coordinates") {
    const TemporaryFolder folder;
    const Arguments lifted{"builtin:terrain:20", "--lift", "normals:0.2"};
    const tools::SampleFile samples = check_passes(folder, lifted);
    CHECK(samples.dimension == 3);
    // Without the lift other distances hold, and the user is told.
    const Outcome other = run(folder, {"verify", "builtin:terrain:20", "a.ply"});
    CHECK(other.status == 1);
    CHECK(contains(other.err,
                   "a.ply: made with --lift normals:0.2, but this command has other options"));
    CHECK_FALSE(contains(other.out, "off the mesh"));

    REQUIRE(run(folder, {"sample", "builtin:cube", "-o", "cube.ply", "-n", "9"}).status == 0);
    const auto fails = [&](int status, const std::string& part, const Arguments& lifts) {
        check_fails(folder, status, part,
                    joined({"sample", "builtin:cube", "-o", "b.ply", "-n", "9"}, lifts));
        check_fails(folder, status, part,
                    joined({"verify", "builtin:cube", "cube.ply", "-d", "1"}, lifts));
    };
    fails(2, "'normal:1' is not a lift", {"--lift", "normal:1"});
    fails(2, "'much' is not a finite weight", {"--lift", "normals:much"});
    fails(2, "makes 9 coordinates of 3", {"--lift", "normals:1", "--lift", "normals:1"});
    fails(3, "builtin:cube: has no attribute 'quality', or any other",
          {"--lift", "attribute:quality:1"});
}

TEST_CASE("faces turned over against each other are warned of before a lift by normals") {
    const TemporaryFolder folder;
    folder.write("mesh.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 1\nf 1 2 3\nf 1 4 3\n");
    const Outcome outcome =
        run(folder, {"sample", "mesh.obj", "-o", "a.ply", "-n", "9", "-q", "--lift", "normals:1"});
    CHECK(outcome.status == 0);
    CHECK(contains(outcome.err, "mesh.obj: 1 edge has faces turned over against each other"));
    CHECK(contains(run(folder, {"sample", "mesh.obj", "-o", "a.ply", "-n", "9", "-q"}).err,
                   "turned over against each other; distances do not depend on that"));
}

TEST_CASE("an attribute of a PLY file is a lift") {
    const TemporaryFolder folder;
    folder.write("mesh.ply", "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\n"
                             "property float y\nproperty float z\nproperty float quality\n"
                             "element face 2\nproperty list uchar int vertex_indices\nend_header\n"
                             "0 0 0 0\n1 0 0 0\n1 1 0 1\n0 1 0 1\n3 0 1 2\n3 0 2 3\n");
    const tools::SampleFile samples =
        check_passes(folder, {"mesh.ply", "--lift", "attribute:quality:3"});
    for (const tools::SampleRow& row : samples.rows) {
        CHECK(row.position[2] == 0);
    }
    // The lifted square is sqrt(10) high.
    const Outcome made = run(
        folder, {"sample", "mesh.ply", "--lift", "attribute:quality:3", "-n", "9", "-o", "a.ply"});
    CHECK(contains(made.out, "area 3.16228"));
    CHECK(contains(made.out, "lift attribute:quality:3"));
    check_fails(folder, 3, "no attribute 'speed'",
                {"sample", "mesh.ply", "--lift", "attribute:speed:3", "-n", "9", "-o", "b.ply"});
}

} // namespace geodisk::test
