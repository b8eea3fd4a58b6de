// glTF files that are written, read back.
#include "files/meshes/data_uri.hpp"
#include "files/meshes/mesh_file.hpp"
#include "files/output/output_file.hpp"
#include "files/samples/sample_fields.hpp"

#include "test_files.hpp"

#include <cmath>
#include <string>
#include <vector>

using namespace geodisk::tools;

TEST_CASE("a data URI holds bytes in base64") {
    const std::string begin = "data:application/octet-stream;base64,";
    const std::string bytes = "foob\xff\xfe";
    const char* const expected[] = {"", "Zg==", "Zm8=", "Zm9v", "Zm9vYg==", "Zm9vYv8=", "Zm9vYv/+"};
    for (std::size_t size = 0; size <= bytes.size(); ++size) {
        const std::string uri = data_uri(bytes.substr(0, size));
        CHECK(uri == begin + expected[size]);
        CHECK(data_of_uri(uri) == bytes.substr(0, size));
    }
}

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
    const std::vector<SampleField> grey{
        {"color", {"red", "green", "blue", "alpha"}, false, true, {0.5, 0.5, 0.5, 0.5}}};
    AtomicFile light(folder / "grey.gltf");
    write_samples(light, sample_target(folder / "grey.gltf"), {}, std::vector{row}, 3, {{}, grey});
    light.commit();
    const std::string text = bytes_of(folder / "grey.gltf");
    std::size_t encoded = 0;
    for (std::size_t at = text.find("0.214041"); at < text.size();
         at = text.find("0.214041", at + 1)) {
        ++encoded;
    }
    CHECK(encoded == 6); // As least and most of red, green and blue; alpha is no light.
    const std::vector<SampleField> large{{"label", {"label"}, true, false, {16777217}}};
    AtomicFile file(folder / "b.glb");
    check_fails(ExitCode::usage, "the attribute 'label' has a 16777217", [&] {
        write_samples(file, sample_target(folder / "b.glb"), {}, std::vector{row}, 3, {{}, large});
    });
}

TEST_CASE("each class of samples has nodes and shapes of its own in scenes") {
    const TemporaryFolder folder;
    std::vector<SampleRow> rows(3);
    const double radii[] = {3, 1, 3};
    for (std::size_t i = 0; i < rows.size(); ++i) {
        rows[i].bary[0] = 1;
        rows[i].position[0] = 10 * static_cast<double>(i);
        rows[i].radius = radii[i];
    }
    const std::vector<ExtraColumn> numbers{{"class", {2, 0, 2}}};
    const SampleField frames{
        "frames", {"qx", "qy", "qz", "qw"}, false, false, {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1},
        true};
    const auto written = [&](const char* name, const std::vector<SampleField>& fields) {
        AtomicFile file(folder / name);
        write_samples(file, sample_target(folder / name), {{{"min_distance", "6"}}}, rows, 3,
                      {numbers, fields});
        file.commit();
        return bytes_of(folder / name);
    };
    const std::string plain = written("a.gltf", {});
    CHECK(contains(plain, "\"Class0\""));
    CHECK(contains(plain, "\"Class2\""));
    CHECK_FALSE(contains(plain, "\"Class1\""));
    CHECK(contains(plain, "baseColorFactor"));
    const std::string turned = written("b.gltf", {frames});
    CHECK(contains(turned, "\"Class2Instances\""));
    const MeshFile mesh = read_mesh((folder / "b.gltf").string());
    REQUIRE(mesh.triangle_count() == 3); // Class 0 comes first.
    CHECK(mesh.positions[0] == doctest::Approx(10 + 1));
    CHECK(mesh.positions[9] == doctest::Approx(0 + 3));
    CHECK(mesh.positions[18] == doctest::Approx(20 + 3));
    // Samples with colours of their own keep these.
    const SampleField colours{
        "color", {"red", "green", "blue"}, false, true, std::vector<double>(9)};
    CHECK_FALSE(contains(written("c.gltf", {colours}), "baseColorFactor"));

    const std::string scene = written("a.usda", {});
    for (const char* const part :
         {"int[] protoIndices = [1, 0, 1]\n",
          "float3[] scales = [(3, 3, 3), (1, 1, 1), (3, 3, 3)]\n",
          "rel prototypes = [</Samples/Prototypes/Class0>, </Samples/Prototypes/Class2>]\n",
          "def Sphere \"Class0\"", "def Sphere \"Class2\"", "primvars:displayColor"}) {
        CAPTURE(part);
        CHECK(contains(scene, part));
    }
}

TEST_CASE("scenes have the axis that points up and the unit of the samples") {
    const TemporaryFolder folder;
    std::vector<SampleRow> rows(1);
    rows[0].bary[0] = 1;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        rows[0].position[axis] = 1e9 + static_cast<double>(axis); // Relative to the node.
    }
    const std::vector<SampleField> frames{
        {"frames", {"qx", "qy", "qz", "qw"}, false, false, {0, 0, 0, 1}, true}};
    const auto written = [&](const char* name, Up up, double metres) {
        AtomicFile file(folder / name);
        SampleTarget target = sample_target(folder / name);
        target.up = up;
        target.metres_per_unit = metres;
        write_samples(file, target, {{{"min_distance", "4"}}}, rows, 3, {{}, frames});
        file.commit();
        return bytes_of(folder / name);
    };
    // Centre of the triangle at the sample: where the axis that is up becomes y.
    const auto centre = [&](const char* name) {
        const MeshFile mesh = read_mesh((folder / name).string());
        REQUIRE(mesh.triangle_count() == 1);
        std::vector<double> sum(3, 0);
        for (std::size_t i = 0; i < 9; ++i) {
            sum[i % 3] += mesh.positions[i] / 3;
        }
        return sum;
    };
    const auto is_at = [](const std::vector<double>& point, double x, double y, double z) {
        return std::abs(point[0] - x) < 1e-3 && std::abs(point[1] - y) < 1e-3 &&
               std::abs(point[2] - z) < 1e-3;
    };
    written("y.gltf", Up::y, 1);
    CHECK(is_at(centre("y.gltf"), 1e9, 1e9 + 1, 1e9 + 2));
    written("z.gltf", Up::z, 1);
    CHECK(is_at(centre("z.gltf"), 1e9, 1e9 + 2, -1e9 - 1));
    written("x.glb", Up::x, 1);
    CHECK(is_at(centre("x.glb"), -1e9 - 1, 1e9, 1e9 + 2));
    written("mm.glb", Up::z, 0.001);
    CHECK(is_at(centre("mm.glb"), 1e6, 1e6 + 0.002, -1e6 - 0.001));

    const std::string z = written("z.usda", Up::z, 0.01);
    CHECK(contains(z, "upAxis = \"Z\"\n"));
    CHECK(contains(z, "metersPerUnit = 0.01\n"));
    CHECK_FALSE(contains(z, "rotate"));
    CHECK(contains(written("y.usda", Up::y, 1), "upAxis = \"Y\"\n"));
    const std::string x = written("x.usda", Up::x, 1);
    CHECK(contains(x, "upAxis = \"Z\"\n"));
    CHECK(contains(x, "float xformOp:rotateY = -90\n"));
    CHECK(contains(x, "[\"xformOp:rotateY\", \"xformOp:translate\"]"));
}
