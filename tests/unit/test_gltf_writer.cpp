// glTF files that are written, read back.
#include "files/mesh_file.hpp"
#include "files/output_file.hpp"
#include "files/sample_fields.hpp"

#include "test_files.hpp"

#include <string>
#include <vector>

using namespace geodisk::tools;

TEST_CASE("frames of samples are instances in glTF, which the reader places") {
    const TemporaryFolder folder;
    SampleRow row, moved;
    row.bary[0] = moved.bary[0] = 1;
    moved.position[0] = 1e9; // Floats are relative to the node.
    moved.position[1] = 4;
    const std::vector<SampleField> fields{
        {"color", {"red", "green", "blue"}, false, true, {1, 0, 0, 0, 1, 0}},
        {"frames", {"qx", "qy", "qz", "qw"}, false, false, {0, 0, 1, 0, 0, 0, 0, 1}, true}};
    for (const char* const name : {"a.glb", "a.gltf"}) {
        AtomicFile file(folder / name);
        write_samples(file, sample_target(folder / name), {{{"min_distance", "4"}}},
                      std::vector{row, moved}, 3, {{}, fields});
        file.commit();
        const MeshFile mesh = read_mesh((folder / name).string());
        REQUIRE(mesh.triangle_count() == 2);
        CHECK(mesh.positions[0] == doctest::Approx(-2)); // Turned by half a turn, scaled by 2.
        CHECK(mesh.positions[9] == doctest::Approx(1e9 + 2));
        CHECK(mesh.positions[10] == doctest::Approx(4));
    }
    CHECK(contains(bytes_of(folder / "a.gltf"), "COLOR_0"));
    const std::vector<SampleField> large{{"label", {"label"}, true, false, {16777217}}};
    AtomicFile file(folder / "b.glb");
    check_fails(ExitCode::usage, "the attribute 'label' has a 16777217", [&] {
        write_samples(file, sample_target(folder / "b.glb"), {}, std::vector{row}, 3, {{}, large});
    });
}
