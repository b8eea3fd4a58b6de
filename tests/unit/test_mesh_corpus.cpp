// The odd and broken files, and the real meshes where they are.
#include "files/meshes/mesh_file.hpp"
#include "geometry/surface_warnings.hpp"
#include "program/exact_text.hpp"

#include "mesh_facts.hpp"
#include "support/data_file.hpp"
#include "test_files.hpp"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <set>
#include <string>
#include <vector>

using namespace geodisk::tools;

namespace {

std::filesystem::path bad_file(const std::string& name) {
    return geodisk::test::data_file("bad/" + name).value();
}

std::string case_file(const std::string& name) {
    return geodisk::test::data_file("cases/" + name).value().string();
}

struct Expected {
    std::string name;
    std::string verdict;
    std::optional<std::size_t> vertices;
    std::optional<std::size_t> triangles;
    std::optional<double> area;
};

/// The table expected.tsv.
std::vector<Expected> expected_files() {
    std::ifstream file(bad_file("expected.tsv"));
    std::vector<Expected> files;
    std::string line;
    std::getline(file, line);
    while (std::getline(file, line)) {
        std::vector<std::string> cells(1);
        for (const char c : line) {
            if (c == '\t') {
                cells.emplace_back();
            } else {
                cells.back() += c;
            }
        }
        REQUIRE(cells.size() >= 5);
        files.push_back({cells[0], cells[1], parse_integer<std::size_t>(cells[2]),
                         parse_integer<std::size_t>(cells[3]), parse_real(cells[4])});
    }
    REQUIRE(files.size() > 100);
    return files;
}

void check_mesh(const Expected& expected, const MeshFile& mesh) {
    if (expected.verdict == "any" && !expected.vertices) {
        return; // A file that is cut, for which there may be a mesh or none.
    }
    CHECK(expected.vertices.value_or(0) == mesh.positions.size() / 3);
    if (expected.name != "warn_coincident_corner.obj") { // May keep or drop its flat faces.
        CHECK(expected.triangles.value_or(0) == taking_part(mesh));
    }
    if (expected.area) {
        CHECK(std::abs(total_area(mesh) - *expected.area) <= 1e-12 * *expected.area);
    }
}

/// Files of a verdict "warn" that are put right and told of in the report: seams, which are joined.
const std::set<std::string> kNothingToSay{"warn_unwelded.obj"};

/// Kind of the warning that a file is made for.
const std::map<std::string, std::string> kKinds{
    {"warn_zero_area_cap.obj", "zero_area_faces"},
    {"warn_repeated_index.obj", "repeated_vertices"},
    {"warn_coincident_corner.obj", "zero_area_faces"},
    {"warn_duplicate_faces.obj", "duplicate_faces"},
    {"warn_duplicate_flipped.obj", "duplicate_faces"},
    {"warn_nonmanifold_edge.obj", "nonmanifold_edges"},
    {"warn_bowtie_vertex.obj", "bow_tie_vertices"},
    {"warn_bowtie_closed.obj", "bow_tie_vertices"},
    {"warn_inconsistent_orientation.obj", "inconsistent_orientation"},
    {"warn_moebius.obj", "inconsistent_orientation"},
    {"warn_isolated_vertices.obj", "unused_vertices"},
    {"warn_isolated_nan.obj", "unused_not_finite"},
    {"warn_sliver_fan.obj", "slivers"},
    {"warn_nonplanar_quad.obj", "bent_polygons"},
    {"warn_far_from_origin.obj", "far_from_origin"},
    {"warn_bad_vt_index.obj", "bad_unused_index"},
    {"warn_two_components.obj", "components"},
    {"warn_trailing_data.ply", "trailing_data"},
    {"warn_ply_face_2_corners.ply", "small_faces"},
    {"any_truncated.obj", "small_faces"}};

/// All that a user is told of the mesh.
std::vector<MeshWarning> warnings_of(const MeshFile& mesh) {
    const geodisk::PreparedMesh prepared =
        take(geodisk::PreparedMesh::prepare({mesh.positions, mesh.triangles, mesh.dimension}));
    std::vector<MeshWarning> warnings = mesh.warnings;
    for (const MeshWarning& warning : surface_warnings(mesh, prepared)) {
        warnings.push_back(warning);
    }
    return warnings;
}

void check_warnings(const Expected& expected, const std::vector<MeshWarning>& warnings) {
    for (const MeshWarning& warning : warnings) {
        INFO(warning.message);
        CHECK(expected.verdict != "good");
        CHECK(warning.count > 0);
        CHECK_FALSE(contains(warning.message, "\n"));
    }
    if (expected.verdict == "warn") {
        CHECK(warnings.empty() == kNothingToSay.contains(expected.name));
    }
    if (const auto kind = kKinds.find(expected.name); kind != kKinds.end()) {
        CHECK(std::any_of(warnings.begin(), warnings.end(), [&](const MeshWarning& warning) {
            return warning.kind == kind->second;
        }));
    }
}

/// Reading must end in a mesh or a UserError, whatever the bytes.
void check_survives(const TemporaryFolder& folder, const std::string& extension,
                    std::string_view bytes) {
    const std::filesystem::path path = folder.write("mutated" + extension, bytes);
    try {
        const MeshFile mesh = read_mesh(path.string());
        CHECK_FALSE(mesh.triangles.empty());
    } catch (const UserError& error) {
        CHECK(error.code() == ExitCode::bad_input);
    }
}

} // namespace

TEST_CASE("odd and broken files get their expected verdict") {
    for (const Expected& expected : expected_files()) {
        CAPTURE(expected.name);
        const std::string path = bad_file(expected.name).string();
        MeshFile mesh;
        const std::optional<UserError> error = error_of([&] { mesh = read_mesh(path); });
        if (error) {
            INFO(error->what());
            CHECK((expected.verdict == "err" || expected.verdict == "any"));
            CHECK(error->code() == ExitCode::bad_input);
            CHECK(contains(error->what(), expected.name));
            CHECK_FALSE(contains(error->what(), "\n"));
            continue;
        }
        CHECK(expected.verdict != "err");
        check_mesh(expected, mesh);
        if (!expected.name.starts_with("any_huge_1e200")) { // Which is too large to prepare.
            check_warnings(expected, warnings_of(mesh));
        }
    }
}

TEST_CASE("files as other programs write them are read") {
    struct Case {
        const char* name;
        double area;
        const char* warning; ///< Kind of the only one, or "".
    };
    const double tetrahedron = 8 * std::sqrt(3.0);
    const Case cases[] = {
        {"bom.ply", 6, ""},
        {"g_meshopt.gltf", 6, "undecoded_view"},
        {"g_quant_u16.gltf", 6, ""},
        {"light_fault.gltf", tetrahedron, ""},
        {"techniques.gltf", tetrahedron, "ignored_extension"},
        {"indefinite_unused.obj", 0.5, "unused_not_finite"},
        {"nul_tail.obj", 0.5, "trailing_data"},
        {"off_glued.off", tetrahedron, "glued_header"},
        {"twice_named.ply", 0.5, ""},
    };
    for (const Case& one : cases) {
        CAPTURE(one.name);
        const MeshFile mesh = read_mesh(case_file(one.name));
        CHECK(total_area(mesh) == doctest::Approx(one.area).epsilon(1e-6));
        CHECK((mesh.warnings.empty() ? "" : mesh.warnings[0].kind) == one.warning);
        CHECK(mesh.warnings.size() <= 1);
    }
    check_fails(ExitCode::bad_input, "is UTF-16; save it as UTF-8",
                [] { read_mesh(case_file("utf16.obj")); });
    check_fails(ExitCode::bad_input, "is glTF 1.0; only 2.0 is read",
                [] { read_mesh(case_file("gltf1_asset.gltf")); });
    check_fails(ExitCode::bad_input, "is compressed by Draco", // And what it calls so is not.
                [] { read_mesh(case_file("draco.gltf")); });
}

TEST_CASE("files of VTK and nibabel are read as these mean them") {
    for (const std::string name : {"vtk_zlib.vtp", "vtk_raw.vtp", "vtk_binary.vtk", "vtk_grid.vtk",
                                   "nibabel.surf.gii", "nibabel.white"}) {
        CAPTURE(name);
        MeshSources sources;
        sources.mesh = case_file(name);
        sources.fields.all = true;
        const MeshFile mesh = read_mesh(sources);
        CHECK(mesh.positions == std::vector<double>{0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1});
        CHECK(mesh.triangles == std::vector<std::uint32_t>{0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3});
        CHECK(mesh.warnings.empty());
        for (const MeshField& field : mesh.fields) {
            CHECK(field.values == (field.name == "heat" ? std::vector<double>{1, 2, 3, 4.5}
                                                        : std::vector<double>{5, 6, 7, 8}));
        }
        CHECK(mesh.fields.size() == (name.starts_with("vtk") ? 2 : name.ends_with("gii") ? 1 : 0));
    }
}

TEST_CASE("compressed glTF files are read where the libraries are there") {
    // A cube of 8 vertices each.
    for (const char* const name : {"meshopt_cube.gltf", "meshopt_exponential.gltf",
                                   "draco_cube.gltf", "draco_sequential.gltf"}) {
        CAPTURE(name);
        MeshFile mesh;
        const auto error = error_of([&] { mesh = read_mesh(case_file(name)); });
        if (error) {
            CHECK(contains(error->what(), "which this build does not read"));
            continue;
        }
        CHECK(mesh.positions.size() == 24);
        CHECK(total_area(mesh) == doctest::Approx(6).epsilon(1e-4));
        CHECK(measure(mesh).is_closed_manifold());
    }
}

TEST_CASE("cut and altered files are read or refused") {
    const TemporaryFolder folder;
    std::uint32_t random = 12345;
    const auto next_random = [&random] { return random = random * 1664525u + 1013904223u; };
    for (const Expected& expected : expected_files()) {
        CAPTURE(expected.name);
        const std::filesystem::path path = bad_file(expected.name);
        const std::string bytes = bytes_of(path);
        if (bytes.empty() || bytes.size() > 4000) {
            continue;
        }
        const std::string extension = path.extension().string();
        for (std::size_t size = 0; size < bytes.size(); size += 97) {
            check_survives(folder, extension, std::string_view(bytes).substr(0, size));
        }
        for (int round = 0; round < 20; ++round) {
            std::string altered = bytes;
            for (int i = 0; i < 3; ++i) {
                altered[(next_random() >> 8) % altered.size()] =
                    static_cast<char>(next_random() >> 24);
            }
            check_survives(folder, extension, altered);
        }
    }
}

TEST_CASE("glTF files with altered data are read or refused") {
    constexpr std::string_view kDigits =
        "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    const TemporaryFolder folder;
    std::uint32_t random = 7;
    const auto next_random = [&random] { return (random = random * 1664525u + 1013904223u) >> 8; };
    for (const char* const name : {"meshopt_cube.gltf", "meshopt_exponential.gltf",
                                   "draco_cube.gltf", "draco_sequential.gltf"}) {
        CAPTURE(name);
        const std::string bytes = bytes_of(case_file(name));
        const std::size_t begin = bytes.find("base64,") + 7;
        const std::size_t size = bytes.find('"', begin) - begin;
        for (int round = 0; round < 200; ++round) {
            std::string altered = bytes;
            for (int i = 0; i < 2; ++i) {
                altered[begin + next_random() % size] = kDigits[next_random() % kDigits.size()];
            }
            check_survives(folder, ".gltf", altered);
        }
    }
}

TEST_CASE("the meshes have the documented numbers of vertices and triangles") {
    struct Size {
        const char* name;
        std::size_t vertices;
        std::size_t triangles;
    };
    constexpr Size kSizes[] = {
        {"armadillo_29k.obj", 14587, 29170},
        {"boot_40k.obj", 19931, 39906},
        {"bunny_144k.ply", 72002, 144000},
        {"bunny_14k.obj", 7002, 14000},
        {"bunny_1k4.obj", 702, 1400},
        {"bunny_69k.ply", 35947, 69451},
        {"cornell_box_multimaterial.obj", 76, 36},
        {"cycloidal_43k.ply", 21384, 43368},
        {"fandisk_13k.obj", 6475, 12946},
        {"gargoyle_52k.obj", 25953, 51902},
        {"human_man_14k.obj", 6890, 13776},
        {"human_neutral_21k.obj", 10475, 20908},
        {"human_woman_14k.obj", 6890, 13776},
        {"lucy_100k.ply", 49987, 99970},
        {"mountain_51k.obj", 25600, 50562},
        {"negative_indices.obj", 8, 12},
        {"rocker_arm_20k.obj", 10044, 20088},
        {"spot_pose_a_6k.obj", 2930, 5856},
        {"spot_pose_b_6k.obj", 2930, 5856},
        {"spot_quads_uv.obj", 188, 372},
        {"teapot_6k.obj", 3644, 6320},
        {"tray_4k5.ply", 2216, 4520},
    };
    for (const Size& size : kSizes) {
        CAPTURE(size.name);
        const auto path = geodisk::test::data_file(std::string("meshes/") + size.name);
        if (!path) {
            return;
        }
        const MeshFile mesh = read_mesh(path->string());
        CHECK(mesh.positions.size() / 3 == size.vertices);
        CHECK(mesh.triangles.size() / 3 == size.triangles);
        for (const MeshWarning& warning : mesh.warnings) {
            CHECK(warning.kind == "unused_vertices");
        }
    }
}
