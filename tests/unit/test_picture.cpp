// Parts that pictures are made of, as far as that needs no device.
#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/vec4.hpp>

#include "picture/picture.hpp"
#include "picture/png.hpp"
#include "picture/scene.hpp"
#include "picture/view.hpp"
#include "shapes/builtin_shapes.hpp"
#include "unit/test_files.hpp"

namespace geodisk::tools {
namespace {

using picture::Camera;
using picture::Scene;
using picture::View;

Scene scene_of(const std::string& shape, std::optional<int> resolution = {}) {
    const MeshFile mesh = make_builtin(shape, resolution);
    return picture::make_scene(mesh.positions, mesh.dimension, mesh.triangles);
}

glm::dvec4 in_clip(const glm::mat4& to_clip, glm::dvec3 point) {
    return glm::dmat4(to_clip) * glm::dvec4(point, 1);
}

} // namespace

TEST_CASE("everything is in the picture, which it fills") {
    for (const auto& [name, resolution] :
         {std::pair("showpiece", 60), std::pair("terrain", 8), std::pair("cube", 1),
          std::pair("klein-bottle", 12), std::pair("spike", 12)}) {
        const std::string shape = name; // Before Clang 16 lambdas capture no bindings.
        CAPTURE(shape);
        const Scene scene = scene_of(shape, resolution);
        for (const View view : {View{0, 0}, View{30, 20}, View{-120, -90}, View{200, 65}}) {
            for (const Up up : {Up::x, Up::y, Up::z}) {
                for (const double aspect : {0.4, 1.0, 1.8}) {
                    const Camera camera = make_camera(scene, view, up, aspect);
                    double widest = 0;
                    for (std::size_t i = 0; i < scene.corners.size(); ++i) {
                        const glm::dvec4 at = in_clip(camera.to_clip, scene.corner(i));
                        REQUIRE(at.w > 0);
                        REQUIRE(at.z >= 0);
                        REQUIRE(at.z <= at.w);
                        widest = std::max({widest, std::abs(at.x) / at.w, std::abs(at.y) / at.w});
                    }
                    CHECK(widest == doctest::Approx(0.94).epsilon(0.01));
                }
            }
        }
    }
}

TEST_CASE("views are what their names say") {
    const std::vector<double> positions = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1};
    const std::vector<std::uint32_t> triangles = {0, 1, 2, 0, 1, 3, 0, 2, 3};
    const Scene scene = picture::make_scene(positions, 3, triangles);
    // In the corner of the second and third triangle: where x, y and z point.
    const auto on_screen = [&](const char* name, Up up) {
        const View view = *picture::parse_view("--view", name);
        const Camera camera = make_camera(scene, view, up, 1);
        const auto place = [&](std::size_t corner) {
            const glm::dvec4 at = in_clip(camera.to_clip, scene.corner(corner));
            return glm::dvec3(at) / at.w;
        };
        const glm::dvec3 origin = place(0);
        return std::vector<glm::dvec3>{place(1) - origin, place(2) - origin, place(5) - origin};
    };
    {
        const auto axes = on_screen("front", Up::y); // x to the right, y up, z to the eye.
        CHECK(axes[0].x > 0.5);
        CHECK(axes[1].y < -0.5);
        CHECK(axes[2].z < 0);
    }
    {
        const auto axes = on_screen("right", Up::y); // From +x: z goes to the left.
        CHECK(axes[0].z < 0);
        CHECK(axes[2].x < -0.5);
    }
    {
        const auto axes = on_screen("top", Up::y); // z comes down.
        CHECK(axes[1].z < 0);
        CHECK(axes[2].y > 0.5);
        CHECK(axes[0].x > 0.5);
    }
    {
        const auto axes = on_screen("front", Up::z); // y goes away.
        CHECK(axes[0].x > 0.5);
        CHECK(axes[2].y < -0.5);
        CHECK(axes[1].z > 0);
    }
    CHECK_FALSE(picture::parse_view("--view", "auto").has_value());
    CHECK(picture::parse_view("--view", "30, -20")->elevation == -20);
    for (const std::string bad : {"", "up", "30", "30,100", "a,b", "30,20,10"}) {
        CAPTURE(bad);
        const auto error = error_of([&] { picture::parse_view("--view", bad); });
        REQUIRE(error);
        CHECK(error->code() == ExitCode::usage);
        CHECK(contains(error->what(), "--view"));
    }
}

TEST_CASE("a crop shows its part of the picture") {
    const Camera camera = make_camera(scene_of("cube", 1), {30, 20}, Up::y, 1.5);
    const glm::mat4 part = picture::crop(camera.to_clip, 0.25, 0.5, 0.5, 0.125);
    const glm::dvec3 point(0.3, -0.2, 0.4);
    const glm::dvec4 whole = in_clip(camera.to_clip, point), cropped = in_clip(part, point);
    const auto from_corner = [](double x) { return (x + 1) / 2; };
    CHECK(from_corner(cropped.x / cropped.w) ==
          doctest::Approx((from_corner(whole.x / whole.w) - 0.25) / 0.5).epsilon(1e-5));
    CHECK(from_corner(cropped.y / cropped.w) ==
          doctest::Approx((from_corner(whole.y / whole.w) - 0.5) / 0.125).epsilon(1e-5));
    CHECK(cropped.z / cropped.w == doctest::Approx(whole.z / whole.w).epsilon(1e-5));
}

TEST_CASE("scenes are of one size, with smooth normals but at creases") {
    const Scene cube = scene_of("cube", 4);
    for (const auto& corner : cube.corners) {
        const float largest = std::max(
            {std::abs(corner.normal_x), std::abs(corner.normal_y), std::abs(corner.normal_z)});
        CHECK(largest == doctest::Approx(1)); // Along an axis: not smoothed over edges.
    }
    const Scene sphere = scene_of("icosphere", 3);
    for (std::size_t i = 0; i < sphere.corners.size(); ++i) {
        const auto& corner = sphere.corners[i];
        const glm::dvec3 at = sphere.corner(i);
        CHECK(glm::length(at) <= 1.0001);
        CHECK(glm::dot(at, glm::dvec3(corner.normal_x, corner.normal_y, corner.normal_z)) > 0.995);
    }
    // A one-sided strip is as smooth as any: what is next to each other shows one normal, on
    // either side.
    const MeshFile strip = make_builtin("moebius", 4);
    const Scene moebius = picture::make_scene(strip.positions, 3, strip.triangles);
    std::vector<glm::vec3> normals(strip.positions.size() / 3);
    for (std::size_t i = 0; i < moebius.corners.size(); ++i) {
        const auto& corner = moebius.corners[i];
        const glm::vec3 normal(corner.normal_x, corner.normal_y, corner.normal_z);
        glm::vec3& known = normals[strip.triangles[i]];
        if (glm::length(known) > 0) {
            CHECK(std::abs(glm::dot(known, normal)) > 0.99);
        }
        known = normal;
    }
}

TEST_CASE("surfaces of four dimensions are shown in perspective, at any scale") {
    // The stereographic projection of a torus: the circles of its last coordinates, far and near.
    MeshFile torus = make_builtin("clifford-torus", 24);
    const Scene scene = picture::make_scene(torus.positions, torus.dimension, torus.triangles);
    double inner = 10, outer = 0;
    for (std::size_t i = 0; i < scene.corners.size(); ++i) {
        const double around = std::hypot(scene.corner(i).x, scene.corner(i).y);
        inner = std::min(inner, around);
        outer = std::max(outer, around);
    }
    CHECK(inner > 0.2);
    CHECK(outer > 1.5 * inner);
    for (double& x : torus.positions) {
        x = x * 1e30 + 1e32;
    }
    const Scene large = picture::make_scene(torus.positions, torus.dimension, torus.triangles);
    for (std::size_t i = 0; i < scene.corners.size(); ++i) {
        CHECK(glm::distance(large.corner(i), scene.corner(i)) < 1e-4);
    }
}

TEST_CASE("terrain stands on its x-y plane, other things on x-z") {
    CHECK(picture::likely_up(scene_of("terrain", 8)) == Up::z);
    CHECK(picture::likely_up(scene_of("cube", 1)) == Up::y);
}

TEST_CASE("what stands on a face is shown upright, however flat it is") {
    // A pyramid on the plane of the two other axes, `height` high and as deep as `depth`.
    const auto pyramid = [](int up, double height, double depth) {
        const int right = up == 2 ? 0 : 2 - up, back = 3 - up - right;
        const auto corner = [&](double x, double y, double z) {
            std::array<double, 3> p{};
            p[static_cast<std::size_t>(right)] = x;
            p[static_cast<std::size_t>(back)] = y;
            p[static_cast<std::size_t>(up)] = z;
            return p;
        };
        std::vector<double> positions;
        for (const auto& p : {corner(0, 0, 0), corner(1, 0, 0), corner(1, depth, 0),
                              corner(0, depth, 0), corner(0.5, depth / 2, height)}) {
            positions.insert(positions.end(), p.begin(), p.end());
        }
        const std::vector<std::uint32_t> triangles = {0, 2, 1, 0, 3, 2, 0, 1, 4,
                                                      1, 2, 4, 2, 3, 4, 3, 0, 4};
        return picture::likely_up(picture::make_scene(positions, 3, triangles));
    };
    CHECK(pyramid(1, 1.7, 0.3) == Up::y); // Flat along z, as a body is that stands.
    CHECK(pyramid(2, 1.7, 0.3) == Up::z);
    CHECK(pyramid(2, 0.2, 1) == Up::z);
    CHECK(pyramid(1, 0.2, 1) == Up::y);
}

TEST_CASE("colours and styles are read, and others refused") {
    CHECK(picture::parse_background("--background", "ff8000").green == 128);
    CHECK(picture::parse_background("--background", "FF8000").red == 255);
    CHECK(picture::parse_background("--background", "transparent").alpha == 0);
    CHECK(picture::parse_style("--style", "voronoi") == picture::Style::voronoi);
    CHECK(error_of([] { picture::parse_background("--background", "#ffffff"); }));
    CHECK(error_of([] { picture::parse_background("--background", "12345g"); }));
    CHECK(error_of([] { picture::parse_style("--style", "Disks"); }));
    CHECK(error_of([] { picture::parse_up("--up", "w"); }));
}

TEST_CASE("PNG files begin as such, with or without alpha") {
    const TemporaryFolder folder;
    picture::Pixels pixels{20, 10, std::vector<std::uint8_t>(800, 255)};
    const auto written = [&](const char* name) {
        AtomicFile file(Path(folder / name));
        picture::write_png(file, pixels);
        file.commit();
        return bytes_of(folder / name);
    };
    const std::string opaque = written("a.png");
    CHECK(opaque.substr(1, 3) == "PNG");
    CHECK(opaque[19] == 20); // Width and height, then bits and the type of colours.
    CHECK(opaque[23] == 10);
    CHECK(opaque[25] == 2);
    pixels.rgba[3] = 254;
    CHECK(written("b.png")[25] == 6);
}

} // namespace geodisk::tools
