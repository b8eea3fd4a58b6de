// Parts of a mesh that the disk of one point to avoid covers.
#include "files/meshes/mesh_file.hpp"
#include "geometry/covered_parts.hpp"
#include "test_files.hpp"

#include <string>
#include <vector>

using namespace geodisk;
using namespace geodisk::tools;

namespace {

/// A point in the middle of a face, with a radius.
KeepOut around(std::uint32_t face, double radius) {
    return {{face, {0.5f, 0.25f, 0.25f}}, radius};
}

PreparedMesh prepared_faces(const std::string& faces) {
    const TemporaryFolder folder;
    const std::string vertices = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\nv 2 0 0\nv 5 0 0\nv 6 0 0\n"
                                 "v 5 1 0\nv -1 0 0\nv -1 -1 0\n";
    const MeshFile mesh = read_mesh(folder.write("a.obj", vertices + faces).string());
    return take(PreparedMesh::prepare({mesh.positions, mesh.triangles}));
}

} // namespace

TEST_CASE("a radius beyond the mesh covers it, and one point is enough") {
    const PreparedMesh mesh = prepared_faces("f 1 2 3\nf 3 2 4\nf 4 2 5\n");
    CoveredParts covered = covered_parts(mesh, std::vector{around(0, 0.5), around(2, 1e30)});
    CHECK(covered.cover_all(mesh, {}));
    REQUIRE(covered.needed.size() == 1);
    CHECK(covered.needed[0].center.face == 2);

    covered = covered_parts(mesh, std::vector{around(0, 0.5), around(2, 0.8)});
    CHECK_FALSE(covered.cover_all(mesh, {}));
    CHECK(covered.faces.empty());
    CHECK(covered.needed.size() == 2);
    CHECK_FALSE(covered_parts(mesh, {}).cover_all(mesh, {}));
}

TEST_CASE("parts are covered one by one, and a mask may leave just those") {
    const PreparedMesh mesh = prepared_faces("f 1 2 3\nf 3 2 4\nf 6 7 8\nf 1 1 2\n");
    const CoveredParts covered =
        covered_parts(mesh, std::vector{around(0, 9.0), around(1, 9.0), around(2, 0.1)});
    CHECK(covered.faces == std::vector<std::uint8_t>{1, 1, 0, 0});
    CHECK(covered.needed.size() == 2); // One of the two on the first part.
    CHECK_FALSE(covered.cover_all(mesh, {}));
    CHECK(covered.cover_all(mesh, std::vector<std::uint8_t>{1, 0, 0, 1}));
    CHECK_FALSE(covered.cover_all(mesh, std::vector<std::uint8_t>{0, 0, 1, 0}));
}

TEST_CASE("a part that touches another in a vertex counts as covered with it alone") {
    const PreparedMesh mesh = prepared_faces("f 1 2 3\nf 1 9 10\n");
    const CoveredParts covered = covered_parts(mesh, std::vector{around(0, 9.0), around(0, 0.1)});
    CHECK(covered.faces.empty());
    CHECK(covered.needed.size() == 2);
}
