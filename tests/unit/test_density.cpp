// Sources of radii that vary: images, texture coordinates, values of vertices and curvature; and
// the radius of samples in files.
#include "files/images/image.hpp"
#include "files/meshes/mesh_file.hpp"
#include "files/meshes/sidecar_files.hpp"
#include "files/samples/sample_file.hpp"
#include "geometry/mean_curvature.hpp"
#include "geometry/vertex_uvs.hpp"
#include "jpeg_bytes.hpp"
#include "png_bytes.hpp"
#include "shapes/builtin_shapes.hpp"
#include "test_files.hpp"

#include <algorithm>
#include <array>
#include <cmath>

using namespace geodisk::tools;

namespace {

/// Two rows of three pixels.
const std::string kImage = png_bytes(3, 2, std::string_view("\x00\x33\x66\x99\xcc\xff", 6));

const std::string kJpeg = jpeg_bytes();

MeshFile mesh_with_uvs(std::string_view name, std::string_view bytes) {
    const TemporaryFolder folder;
    MeshSources sources;
    sources.mesh = folder.write(name, bytes).string();
    sources.fields.uvs = true;
    return read_mesh(sources);
}

void uvs_fail(std::string_view name, std::string_view bytes, std::string_view part) {
    CAPTURE(bytes);
    check_fails(ExitCode::bad_input, part, [&] { mesh_with_uvs(name, bytes); });
}

std::string ply_with(std::string_view properties, std::string_view values) {
    return "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
           "property float z\n" +
           std::string(properties) +
           "element face 1\nproperty list uchar int vertex_indices\nend_header\n" +
           std::string(values) + "3 0 1 2\n";
}

MeshFile flat_mesh(std::vector<double> positions, std::vector<std::uint32_t> triangles) {
    MeshFile mesh;
    mesh.positions = std::move(positions);
    mesh.triangles = std::move(triangles);
    return mesh;
}

} // namespace

TEST_CASE("grey images are bilinear and repeat") {
    const TemporaryFolder folder;
    const GreyImage image(folder.write("a.png", kImage));
    // At the centres of pixels; v = 0 is the lower edge.
    const double values[2][3] = {{0.6, 0.8, 1}, {0, 0.2, 0.4}}; // From below.
    for (int row = 0; row < 2; ++row) {
        for (int column = 0; column < 3; ++column) {
            const double u = (column + 0.5) / 3, v = (row + 0.5) / 2;
            CHECK(image.at(u, v) == doctest::Approx(values[row][column]).epsilon(1e-12));
            CHECK(image.at(u - 2, v + 5) == doctest::Approx(values[row][column]).epsilon(1e-12));
        }
    }
    CHECK(image.at(1.0 / 3, 0.25) == doctest::Approx(0.7));
    CHECK(image.at(0.5, 0.5) == doctest::Approx(0.5));
    // Half-way from the last column to the first, and from the lower row to the upper one.
    CHECK(image.at(0, 0.25) == doctest::Approx(0.8));
    CHECK(image.at(1, 0.25) == doctest::Approx(0.8));
    CHECK(image.at(0.5, 0) == doctest::Approx(0.5));
    CHECK(image.at(-1e-18, 1 - 1e-17) == doctest::Approx(0.5));
}

TEST_CASE("colours become luminance, other depths grey") {
    const TemporaryFolder folder;
    const GreyImage green(folder.write("a.png", png_bytes(1, 1, "\x10\xff\x20", 8, 2)));
    CHECK(green.at(0.5, 0.5) == doctest::Approx(0.62).epsilon(0.02));
    const GreyImage deep(
        folder.write("b.png", png_bytes(1, 1, std::string_view("\x80\x01", 2), 16)));
    CHECK(deep.at(0.5, 0.5) == doctest::Approx(32769.0 / 65535).epsilon(1e-12));
}

TEST_CASE("what is no image is refused") {
    const TemporaryFolder folder;
    const auto fails = [&](const std::filesystem::path& path, std::string_view part) {
        check_fails(ExitCode::bad_input, part, [&] { const GreyImage image(path); });
    };
    fails(folder / "none.png", "no such file");
    fails(folder.write("empty.png", ""), "is no PNG, JPEG, WebP, TGA or BMP image");
    fails(folder.write("text.png", "v 0 0 0\n"), "is no PNG, JPEG, WebP, TGA or BMP image");
    fails(folder.write("a.pgm", "P5 1 1 255 a"), "is no PNG, JPEG, WebP, TGA or BMP image");
    for (std::size_t size = 4; size < kImage.size(); ++size) {
        fails(folder.write("cut.png", std::string_view(kImage).substr(0, size)),
              "cannot be read as a PNG image: ");
    }
    for (std::size_t size = 2; size < kJpeg.size() - 2; ++size) {
        CAPTURE(size);
        fails(folder.write("cut.jpg", std::string_view(kJpeg).substr(0, size)),
              "cannot be read as a JPEG image: ");
    }
    // The size that its header claims takes 12 GB.
    std::string huge = png_bytes(3, 2, std::string(6, 'x'));
    const std::string size =
        big_endian(100000) + big_endian(60000) + std::string("\x08\0\0\0\0", 5);
    huge.replace(8, 25, png_chunk("IHDR", size));
    fails(folder.write("huge.png", huge), "it has more than 2^26 pixels");
}

TEST_CASE("JPEG images are read") {
    const TemporaryFolder folder;
    const GreyImage image(folder.write("a.jpg", kJpeg));
    CHECK(image.at(0.25, 0.5) == doctest::Approx(0.25).epsilon(0.05));
    CHECK(image.at(0.75, 0.5) == doctest::Approx(0.75).epsilon(0.05));
}

TEST_CASE("JPEG images of inks, WebP, TGA and BMP images have the colours of others") {
    const TemporaryFolder folder;
    // Red and green above blue and yellow, as blue, green and red.
    const std::string above("\0\0\xff\0\xff\0", 6), below("\xff\0\0\0\xff\xff", 6);
    const std::string header("\0\0\2\0\0\0\0\0\0\0\0\0\2\0\2\0\x18\x20", 18);
    const std::string tga = header + above + below;
    const auto turned = [](const std::string& row) { return row.substr(3) + row.substr(0, 3); };
    std::string mirrored = header + turned(above) + turned(below);
    mirrored[17] = 0x30;                                       // From right to left.
    std::string packed = header + "\1" + above + "\1" + below; // Runs of two pixels.
    packed[2] = 10;
    packed += std::string("\0\0\0\0\0\0\0\0TRUEVISION-XFILE.\0", 26);
    const std::string bmp =
        std::string("BM\x46\0\0\0\0\0\0\0\x36\0\0\0\x28\0\0\0\2\0\0\0\2\0\0\0\1\0\x18\0", 30) +
        std::string(24, '\0') + below + std::string(2, '\0') + above + std::string(2, '\0');
    const std::string webp("RIFF\x36\0\0\0WEBPVP8L\x2a\0\0\0\x2f\x07\xc0\x01\0\x1f\x20\x10\x48"
                           "\xda\x1f\x7a\x8d\xf9\x17\x10\x14\xf9\x3f\xda\xfc\x07\x5f\x24\x40\x41"
                           "\xdb\x36\x4c\x49\x96\x64\x49\xbe\x0d\x44\x44\xff\xc3\xfc\xd0\x07",
                           62);
    for (const std::filesystem::path& path :
         {folder.write("a.jpg", cmyk_jpeg_bytes()), folder.write("a.webp", webp),
          folder.write("a.TGA", tga), folder.write("a.image", packed), folder.write("a.bmp", bmp),
          folder.write("b.tga", mirrored)}) {
        CAPTURE(path);
        const ColourImage image(path);
        const auto check = [&](double u, double v, const std::array<double, 3>& expected) {
            for (std::size_t k = 0; k < 3; ++k) {
                CHECK(image.at(u, v)[k] == doctest::Approx(expected[k]).epsilon(0.01).scale(1));
            }
        };
        check(0.25, 0.75, {1, 0, 0});
        check(0.75, 0.75, {0, 1, 0});
        check(0.25, 0.25, {0, 0, 1});
        check(0.75, 0.25, {1, 1, 0});
        CHECK(GreyImage(path).at(0.75, 0.75) == doctest::Approx(150.0 / 256).epsilon(0.02));
    }
    const auto fails = [&](const std::string& bytes, std::string_view part) {
        const std::filesystem::path path = folder.write("b.png", bytes);
        check_fails(ExitCode::bad_input, part, [&] { GreyImage{path}; });
    };
    fails(webp.substr(0, 40), "cannot be read as a WebP image");
    for (std::size_t size = 2; size < bmp.size() - 2; ++size) {
        CAPTURE(size);
        fails(bmp.substr(0, size), "cannot be read as a TGA or BMP image: ");
    }
    std::string empty = bmp;
    empty[18] = 0;
    fails(empty, "it has no pixels");
    std::string old = bmp;
    old[14] = 12;
    old[24] = 8;
    fails(old, "its palette is that of OS/2");
    std::string offset = tga;
    offset[1] = 1;
    offset[3] = 5;
    check_fails(ExitCode::bad_input, "its colour map does not begin at 0",
                [&] { GreyImage{folder.write("c.tga", offset)}; });
    for (const std::string& whole : {tga, packed.substr(0, 32)}) {
        for (std::size_t size = 0; size < whole.size(); ++size) {
            CAPTURE(size);
            const std::filesystem::path path = folder.write("b.tga", whole.substr(0, size));
            check_fails(ExitCode::bad_input,
                        "cannot be read as a TGA or BMP image: ", [&] { GreyImage{path}; });
        }
    }
    fails("DDS |", "is a DDS image, which is not read; convert it to PNG, JPEG or WebP");
}

TEST_CASE("texture coordinates of OBJ files belong to corners") {
    // A seam: vertex 1 has two, and vertex 3 the same one twice.
    const MeshFile mesh = mesh_with_uvs("a.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n"
                                                 "vt 0 0\nvt 0.5 0.25 7\nvt 1 -1\n"
                                                 "f 1/1 2/2/1 3/3\nvt 2e-1 .5\nf 1/-1 3/3 4/1\n");
    const std::vector<VertexUv> want{
        {0, 0, 0}, {0, 0.2, 0.5}, {1, 0.5, 0.25}, {2, 1, -1}, {3, 0, 0}};
    CHECK(vertex_uvs(mesh) == want);
    const std::string start = "v 0 0 0\nv 1 0 0\nv 1 1 0\nvt 0 0\n";
    uvs_fail("a.obj", start + "f 1/1 2 3/1\n", "line 5: vertex 2 has no texture coordinates");
    uvs_fail("a.obj", start + "f 1/1 2//1 3/1\n", "line 5: vertex 2 has no texture coordinates");
    uvs_fail("a.obj", start + "f 1/1 2/2 3/1\n", "line 5: texture index 2 is out of range");
    uvs_fail("a.obj", start + "f 1/1 2/-2 3/1\n", "line 5: texture index -2 is out of range");
    uvs_fail("a.obj", start + "vt 1\nf 1/1 2/1 3/1\n",
             "line 5: texture coordinates are two numbers");
    uvs_fail("a.obj", start + "vt 1 nan\nf 1/1 2/1 3/1\n", "line 5: 'nan' is not a finite number");
    // Who does not ask is not bothered.
    const TemporaryFolder folder;
    CHECK(!read_mesh(folder.write("b.obj", start + "vt x\nf 1/1 2/9 3\n").string()).texture_uvs);
}

TEST_CASE("texture coordinates of PLY files belong to vertices") {
    for (const std::string names : {"s t", "u v", "texture_u texture_v"}) {
        CAPTURE(names);
        const std::size_t blank = names.find(' ');
        const std::string properties = "property float " + names.substr(0, blank) +
                                       "\nproperty float " + names.substr(blank + 1) + "\n";
        const MeshFile mesh = mesh_with_uvs(
            "a.ply", ply_with(properties, "0 0 0 0.5 1\n1 0 0 0 0\n0 1 0 0.25 0.75\n"));
        const std::vector<VertexUv> want{{0, 0.5, 1}, {1, 0, 0}, {2, 0.25, 0.75}};
        CHECK(vertex_uvs(mesh) == want);
    }
    uvs_fail("a.ply", ply_with("property float s\n", "0 0 0 1\n1 0 0 1\n0 1 0 1\n"),
             "has no texture coordinates");
    uvs_fail(
        "a.ply",
        ply_with("property float s\nproperty float t\n", "0 0 0 1 1\n1 0 0 inf 0\n0 1 0 1 1\n"),
        "element face, record 0: 'uv' is not finite");
    MeshSources sources;
    sources.mesh = "builtin:cube";
    sources.fields.uvs = true;
    check_fails(ExitCode::bad_input, "builtin:cube: has no texture coordinates",
                [&] { read_mesh(sources); });
}

TEST_CASE("files of values have one to a line") {
    const TemporaryFolder folder;
    CHECK(read_values(folder.write("a.txt", "# g\n0.5\n\n 1 # one\r\n2e-1"), 3).values ==
          std::vector<double>{0.5, 1, 0.2});
    const auto fails = [&](std::string_view bytes, std::string_view part) {
        check_fails(ExitCode::bad_input, part,
                    [&] { read_values(folder.write("b.txt", bytes), 3); });
    };
    fails("1\n0.5 1\n", "line 2: has 2 numbers instead of one");
    fails("1\nx\n", "line 2: 'x' is not a number");
    fails("nan\n", "line 1: 'nan' is not finite");
}

TEST_CASE("the mean curvature of a sphere is one over its radius") {
    for (const double radius : {1.0, 1e-6, 1e6}) {
        MeshFile sphere = make_builtin("icosphere", 4);
        for (double& x : sphere.positions) {
            x *= radius;
        }
        for (const double curvature : mean_curvatures(sphere)) {
            REQUIRE(curvature * radius == doctest::Approx(1).epsilon(0.05));
        }
        // It is as curved as on average everywhere.
        for (const double factor : curvature_factors(sphere)) {
            REQUIRE(factor == doctest::Approx(0.5).epsilon(0.05));
        }
    }
}

TEST_CASE("flat surfaces have no curvature, not at their borders either") {
    const MeshFile sheet = make_builtin("unfolded-sheet", 8);
    for (const double curvature : mean_curvatures(sheet)) {
        REQUIRE(std::abs(curvature) < 1e-9);
    }
    for (const double factor : curvature_factors(sheet)) {
        REQUIRE(factor == 1);
    }
    // No vertex is inside.
    const MeshFile triangle = flat_mesh({0, 0, 0, 1, 0, 0, 0, 1, 0, 9, 9, 9}, {0, 1, 2});
    CHECK(curvature_factors(triangle) == std::vector<double>(4, 1.0));
}

TEST_CASE("edges are curved and faces are not") {
    const MeshFile cube = make_builtin("cube", 8);
    const auto ends = std::minmax_element(cube.positions.begin(), cube.positions.end());
    const std::vector<double> curvatures = mean_curvatures(cube);
    const std::vector<double> factors = curvature_factors(cube);
    for (std::size_t v = 0; v < curvatures.size(); ++v) {
        const auto on_edge =
            std::count_if(&cube.positions[3 * v], &cube.positions[3 * v] + 3,
                          [&](double x) { return x == *ends.first || x == *ends.second; });
        CAPTURE(v);
        REQUIRE((curvatures[v] > 1) == (on_edge >= 2));
        REQUIRE((factors[v] == doctest::Approx(1)) == (on_edge < 2));
        REQUIRE(factors[v] > 0);
    }
}

TEST_CASE("curvature is finite on any mesh") {
    // A flat face, a needle, three faces on an edge and a vertex of no face.
    const MeshFile mesh =
        flat_mesh({0, 0, 0, 1, 0, 0, 0.5, 0, 0, 0.5, 1e-12, 0, 0.5, 1, 1, 0.5, -1, 1, 9, 9, 9},
                  {0, 1, 2, 0, 1, 3, 0, 1, 4, 0, 1, 5, 0, 4, 5});
    for (const double curvature : mean_curvatures(mesh)) {
        CHECK(std::isfinite(curvature));
    }
    for (const double factor : curvature_factors(mesh)) {
        CHECK(factor > 0);
        CHECK(factor <= 1);
    }
    const MeshFile torus = make_builtin("clifford-torus", 40);
    for (const double curvature : mean_curvatures(torus)) {
        REQUIRE(curvature == doctest::Approx(std::sqrt(0.5)).epsilon(0.01));
    }
}

TEST_CASE("the radius of samples is written and read") {
    const TemporaryFolder folder;
    std::vector<SampleRow> rows(2);
    rows[0].bary[0] = rows[1].bary[0] = 1;
    rows[0].radius = 0.1;
    rows[1].radius = 1.0 / 3;
    CHECK(has_radii(rows));
    for (const auto& [name, is_ascii] :
         {std::pair{"a.ply", false}, {"b.ply", true}, {"c.csv", false}}) {
        const auto& shown = name; // Before Clang 16 lambdas capture no bindings.
        CAPTURE(shown);
        write_samples(folder / name, {}, rows, is_ascii);
        const SampleFile read = read_samples(folder / name);
        REQUIRE(read.rows.size() == 2);
        CHECK(read.rows[0].radius == 0.1);
        CHECK(read.rows[1].radius == 1.0 / 3);
    }
    CHECK(contains(bytes_of(folder / "a.ply"), "property float bary_w\nproperty double radius\n"));
    CHECK(contains(bytes_of(folder / "c.csv"), ",bary_w,radius\n"));
    rows[0].radius = rows[1].radius = 0;
    write_samples(folder / "d.csv", {}, rows, false);
    CHECK_FALSE(contains(bytes_of(folder / "d.csv"), "radius"));
    for (const std::string_view bad : {"0", "-1", "inf"}) {
        folder.write("e.csv",
                     "face_index,bary_u,bary_v,bary_w,radius\n0,1,0,0," + std::string(bad) + "\n");
        check_fails(ExitCode::bad_input, "line 2: radius is out of range",
                    [&] { read_samples(folder / "e.csv"); });
    }
}
