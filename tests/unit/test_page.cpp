// Data that pages carry, as far as that needs no device.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include <glm/geometric.hpp>

#include <geodisk/mesh.hpp>

#include "picture/scene.hpp"
#include "picture/window_table.hpp"
#include "report/disk_data.hpp"
#include "report/front_end.hpp"
#include "report/page.hpp"
#include "report/page_array.hpp"
#include "report/sample_data.hpp"
#include "report/surface_data.hpp"
#include "shapes/builtin_shapes.hpp"
#include "support/base64.hpp"
#include "support/typed_array.hpp"
#include "unit/test_files.hpp"

namespace geodisk::tools {
namespace {

using report::PageArray;

/// As the page reads them.
std::vector<double> numbers_of(const PageArray& array) {
    return test::typed_numbers(array.type, array.bytes, array.count, array.low, array.high);
}

std::vector<double> numbers_of(const std::vector<PageArray>& arrays, const std::string& name) {
    for (const PageArray& array : arrays) {
        if (array.name == name) {
            return numbers_of(array);
        }
    }
    FAIL("there is no array " << name);
    return {};
}

} // namespace

TEST_CASE("base64 is that of RFC 4648") {
    using namespace std::literals;
    for (const auto& [bytes, text] :
         {std::pair(""sv, ""sv), std::pair("f"sv, "Zg=="sv), std::pair("fo"sv, "Zm8="sv),
          std::pair("foo"sv, "Zm9v"sv), std::pair("foobar"sv, "Zm9vYmFy"sv),
          std::pair("\xff\x00\xfb"sv, "/wD7"sv)}) {
        CHECK(report::base64_of(bytes) == text);
        CHECK(test::bytes_of_base64(text) == bytes);
    }
}

TEST_CASE("whole numbers take as few bytes as the largest does") {
    const auto type_for = [](std::uint32_t largest) {
        const std::vector<std::uint32_t> numbers = {0, largest, 7};
        const PageArray array = report::whole_numbers("a", numbers);
        CHECK(array.count == 3);
        CHECK(numbers_of(array) == std::vector<double>{0, 1.0 * largest, 7});
        return array.type;
    };
    CHECK(type_for(255) == "Uint8Array");
    CHECK(type_for(256) == "Uint16Array");
    CHECK(type_for(65535) == "Uint16Array");
    CHECK(type_for(65536) == "Uint32Array");
    CHECK(type_for(~0u) == "Uint32Array");
    CHECK(report::whole_numbers("a", {}).bytes.empty());
}

TEST_CASE("real numbers stay as they are, and rounded ones are near") {
    const std::vector<float> reals = {0, -1.5f, 1e-30f, 3.4e38f};
    CHECK(numbers_of(report::real_numbers("a", reals)) ==
          std::vector<double>(reals.begin(), reals.end()));
    for (const double unit : {1e-60, 1e60}) {
        const std::vector<double> wide = {0, 0.25 * unit, unit};
        CHECK(numbers_of(report::lengths("a", wide)) == wide);
    }
    CHECK(report::lengths("a", std::vector<double>{0, 1e-30, 1e30}).type == "Float32Array");
    std::vector<double> numbers = {-2, 3};
    for (int i = 0; i < 1000; ++i) {
        numbers.push_back(-2 + 5e-3 * i);
    }
    const std::vector<double> read = numbers_of(report::rounded_numbers("a", numbers, -2, 3));
    CHECK(read[0] == -2);
    CHECK(read[1] == 3);
    for (std::size_t i = 0; i < numbers.size(); ++i) {
        CHECK(std::abs(read[i] - numbers[i]) <= report::rounding_error(-2, 3) * (1 + 1e-9));
    }
}

TEST_CASE("JSON ends no script, whatever its strings hold") {
    const std::string text = report::in_script(R"({"a": "</script><!--<SCRIPT>", "b": 1})");
    CHECK_FALSE(contains(text, "<"));
    CHECK(contains(text, R"("\u003c/script>\u003c!--\u003cSCRIPT>")"));
}

TEST_CASE("corners are what they were, and share points where the surface is smooth") {
    for (const auto& [shape, resolution, points] :
         {std::tuple("cube", 1, 24u), std::tuple("icosphere", 3, 642u),
          std::tuple("moebius", 4, 0u)}) {
        const std::string name = shape; // Before Clang 16 lambdas capture no bindings.
        CAPTURE(name);
        const MeshFile mesh = make_builtin(name, resolution);
        const picture::Scene scene =
            picture::make_scene(mesh.positions, mesh.dimension, mesh.triangles);
        const auto arrays = report::surface_arrays(scene, mesh.triangles);
        const auto positions = numbers_of(arrays, "positions");
        const auto normals = numbers_of(arrays, "normals");
        const auto corners = numbers_of(arrays, "corners");
        REQUIRE(corners.size() == scene.corners.size());
        CHECK(positions.size() / 3 == normals.size() / 2);
        if (points > 0) {
            CHECK(positions.size() == 3 * points);
        }
        for (std::size_t i = 0; i < corners.size(); ++i) {
            const auto point = static_cast<std::size_t>(corners[i]);
            for (int axis = 0; axis < 3; ++axis) {
                CHECK(std::abs(positions[3 * point + static_cast<std::size_t>(axis)] -
                               scene.corner(i)[axis]) < 2e-5);
            }
            double x = normals[2 * point] / 65534 * 2 - 1;
            double y = normals[2 * point + 1] / 65534 * 2 - 1;
            const double z = 1 - std::abs(x) - std::abs(y);
            if (z < 0) {
                const double folded = (1 - std::abs(y)) * (x < 0 ? -1 : 1);
                y = (1 - std::abs(x)) * (y < 0 ? -1 : 1);
                x = folded;
            }
            const auto& corner = scene.corners[i];
            const glm::dvec3 normal(corner.normal_x, corner.normal_y, corner.normal_z);
            CHECK(glm::distance(glm::normalize(glm::dvec3(x, y, z)), normal) < 2e-4);
        }
    }
}

TEST_CASE("a face without area has no normal") {
    const std::vector<double> positions = {0, 0, 0, 1, 0, 0, 2, 0, 0};
    const std::vector<std::uint32_t> triangles = {0, 1, 2};
    const picture::Scene scene = picture::make_scene(positions, 3, triangles);
    for (const double part : numbers_of(report::surface_arrays(scene, triangles), "normals")) {
        CHECK(part == 65535);
    }
}

TEST_CASE("distances by what a page carries are those of the table, to a thousandth of a radius") {
    // Faces of one cell, and of many.
    for (const auto& [shape, resolution] : {std::pair("torus-knot", 6), std::pair("cube", 1)}) {
        const std::string name = shape;
        CAPTURE(name);
        const MeshFile file = make_builtin(name, resolution);
        const auto mesh = PreparedMesh::prepare({file.positions, file.triangles});
        REQUIRE(mesh);
        std::mt19937 random(7);
        const auto uniform = [&] { return std::generate_canonical<double, 53>(random); };
        std::vector<SurfaceDisk> disks;
        for (int i = 0; i < 60; ++i) {
            const auto face = static_cast<std::uint32_t>(random() % file.triangle_count());
            disks.push_back({face, uniform() / 2, uniform() / 2, 0.05 + 0.02 * uniform()});
        }
        const auto table = picture::make_window_table(*mesh, disks, 0.12, {});
        const report::DiskData data = report::disk_data(table);
        CHECK(data.scale.unit == table.unit);
        const auto x = numbers_of(data.arrays, "window_x"), y = numbers_of(data.arrays, "window_y");
        const auto sigmas = numbers_of(data.arrays, "window_sigmas");
        const auto left = numbers_of(data.arrays, "window_left");
        const auto right = numbers_of(data.arrays, "window_right");
        const auto owners = numbers_of(data.arrays, "window_samples");
        const auto counts = numbers_of(data.arrays, "cell_windows");
        const auto frames = numbers_of(data.arrays, "face_frames");
        REQUIRE(x.size() == table.windows.size());
        const auto sees = [&](double angle, double way_x, double way_y) {
            const double turn = (angle - 1) / 65534 * 2 * std::numbers::pi;
            return angle == 0 ||
                   std::cos(turn) * way_x + std::sin(turn) * way_y >= -data.scale.seam;
        };
        std::size_t first = 0, checked = 0;
        for (std::size_t f = 0; f < table.faces.size(); ++f) {
            const picture::FaceRec& face = table.faces[f];
            CHECK(frames[3 * f] == face.longest);
            CHECK(face.cells_per_unit == data.scale.cells_per_unit);
            for (std::uint32_t cell = 0; cell < face.columns * face.rows; ++cell) {
                const std::size_t start = table.starts[face.first_cell + cell];
                const auto end = start + static_cast<std::size_t>(counts[face.first_cell + cell]);
                CHECK(start == first);
                CHECK(end == table.starts[face.first_cell + cell + 1]);
                first = end;
                const std::uint32_t column = cell % face.columns, row = cell / face.columns;
                const double corner_x = column / data.scale.cells_per_unit;
                const double corner_y = row / data.scale.cells_per_unit;
                const double in_x = (uniform() + column) / data.scale.cells_per_unit;
                const double in_y = (uniform() + row) / data.scale.cells_per_unit;
                for (std::size_t w = start; w < end; ++w) {
                    const picture::WindowRec& window = table.windows[w];
                    CHECK(owners[w] == window.sample_index);
                    const double way_x = in_x - window.x, way_y = in_y - window.y;
                    const bool seen = window.left_x * way_x + window.left_y * way_y >= 0 &&
                                      window.right_x * way_x + window.right_y * way_y >= 0;
                    const double page_x = in_x - x[w] - corner_x, page_y = in_y - y[w] - corner_y;
                    const double exact = window.sigma + std::hypot(way_x, way_y);
                    const double radius = disks[window.sample_index].radius / table.unit;
                    if (seen && exact < radius) {
                        CHECK(sees(left[w], page_x, page_y));
                        CHECK(sees(right[w], page_x, page_y));
                        CHECK(std::abs(sigmas[w] + std::hypot(page_x, page_y) - exact) <
                              1e-3 * radius);
                        ++checked;
                    }
                }
            }
        }
        CHECK(first == x.size());
        CHECK(checked > 100);
    }
}

TEST_CASE("samples tell their nearest in mesh units, or themselves where there is none") {
    const std::vector<SurfaceDisk> disks = {{5, 0.25, 0.5, 2}, {6, 0, 0, 1}, {70000, 1, 0, 2}};
    const std::vector<analysis::Neighbor> neighbors = {{1, 1.5}, {0, 1.5}, {}};
    const auto arrays = report::sample_arrays({disks, {}}, neighbors);
    CHECK(numbers_of(arrays, "sample_faces") == std::vector<double>{5, 6, 70000});
    CHECK(numbers_of(arrays, "sample_weights") == std::vector<double>{0.25, 0.5, 0, 0, 1, 0});
    CHECK(numbers_of(arrays, "sample_radii") == std::vector<double>{2, 1, 2});
    CHECK(numbers_of(arrays, "sample_neighbors") == std::vector<double>{1, 0, 2});
    CHECK(numbers_of(arrays, "sample_distances") == std::vector<double>{4.5, 4.5, 0});
    const std::vector<SurfaceDisk> alike = {{5, 0.25, 0.5, 2}, {6, 0, 0, 2}};
    const auto same = report::sample_arrays({alike, {}}, std::span(neighbors).first(2));
    CHECK(numbers_of(same, "sample_radii") == std::vector<double>{2});
    CHECK(numbers_of(same, "sample_kinds") == std::vector<double>{0});
    // Distances of classes, not sums of radii.
    std::vector<SurfaceDisk> kinds = alike;
    kinds[0].kind = 1;
    kinds[1].kind = 2;
    const auto classes =
        report::sample_arrays({kinds, {2, {4, 3, 3, 4}}}, std::span(neighbors).first(2));
    CHECK(numbers_of(classes, "sample_kinds") == std::vector<double>{1, 2});
    CHECK(numbers_of(classes, "sample_distances") == std::vector<double>{4.5, 4.5});
}

TEST_CASE("a page is made of texts that are there, and ends no script too early") {
    if (!report::has_front_end()) {
        const auto error = error_of([] { report::require_front_end(); });
        REQUIRE(error);
        CHECK(contains(error->what(), "three.js"));
        return;
    }
    for (const char* const name :
         {"three.js", "orbit.js", "records.h", "colors.glsl", "scale_knots.h", "nearest.glsl",
          "data.js", "texts.js", "charts.js", "view.js", "page.js", "surface.vert", "surface.frag",
          "point.vert", "point.frag"}) {
        std::string text;
        for (const std::string_view piece : report::front_end_text(name)) {
            text += piece;
        }
        CAPTURE(name);
        CHECK(text.size() > 100);
        CHECK_FALSE(contains(text, "</script"));
        CHECK_FALSE(contains(text, "<!--"));
    }
    CHECK(report::front_end_text("nothing.js").empty());
}

} // namespace geodisk::tools
