#include "geometry/polygon_triangulation.hpp"

#include "geometry/vec.hpp"
#include "mesh_facts.hpp"

#include <doctest/doctest.h>

#include <functional>
#include <numbers>
#include <random>

using namespace geodisk::tools;

namespace {

using Placement = std::function<Vec3(double x, double y)>;

const Placement kFlat = [](double x, double y) { return Vec3{x, y, 0}; };

/// The polygon with corners x y, x y ... placed in space, as a triangulated mesh.
MeshFile triangulated(const std::vector<double>& outline, const Placement& place = kFlat) {
    MeshFile mesh;
    std::vector<std::uint32_t> corners;
    for (std::size_t i = 0; i < outline.size(); i += 2) {
        const Vec3 p = place(outline[i], outline[i + 1]);
        mesh.positions.insert(mesh.positions.end(), {p.x, p.y, p.z});
        corners.push_back(static_cast<std::uint32_t>(i / 2));
    }
    triangulate_polygon(mesh.positions, corners, mesh.triangles);
    return mesh;
}

double outline_area(const std::vector<double>& outline) {
    double twice = 0;
    const std::size_t size = outline.size();
    for (std::size_t i = 0; i < size; i += 2) {
        const std::size_t next = (i + 2) % size;
        twice += outline[i] * outline[next + 1] - outline[next] * outline[i + 1];
    }
    return twice / 2;
}

double signed_area(const MeshFile& mesh, std::size_t triangle) {
    const std::uint32_t* corner = &mesh.triangles[3 * triangle];
    const Vec3 a = position_at(mesh, corner[0]);
    return cross(position_at(mesh, corner[1]) - a, position_at(mesh, corner[2]) - a).z / 2;
}

/// Triangles that all turn the polygon's way and add up to its area cover it and nothing else.
void check_covers(const std::vector<double>& outline, double tolerance = 1e-13) {
    const MeshFile mesh = triangulated(outline);
    const double area = outline_area(outline);
    REQUIRE(mesh.triangles.size() == 3 * (outline.size() / 2 - 2));
    double sum = 0;
    for (std::size_t t = 0; t < mesh.triangles.size() / 3; ++t) {
        const double part = signed_area(mesh, t);
        CHECK(part * area > 0);
        sum += part;
    }
    CHECK(std::abs(sum - area) <= tolerance * std::abs(area));
}

const std::vector<double> kL{0, 0, 2, 0, 2, 1, 0.75, 1, 0.75, 1.6, 0, 1.6};

} // namespace

TEST_CASE("a triangle stays as it is and less than one vanishes") {
    CHECK(triangulated({0, 0, 1, 0, 0, 1}).triangles == std::vector<std::uint32_t>{0, 1, 2});
    CHECK(triangulated({0, 0, 1, 0}).triangles.empty());
    CHECK(triangulated({}).triangles.empty());
}

TEST_CASE("convex polygons become fans in order") {
    CHECK(triangulated({0, 0, 1, 0, 1, 1, 0, 1}).triangles ==
          std::vector<std::uint32_t>{0, 1, 2, 0, 2, 3});
    std::vector<double> circle;
    for (int i = 0; i < 1000; ++i) {
        const double angle = 2e-3 * std::numbers::pi * i;
        circle.insert(circle.end(), {std::cos(angle), std::sin(angle)});
    }
    check_covers(circle);
}

TEST_CASE("an L is covered from every first corner, both ways round and in every plane") {
    const Placement placements[] = {kFlat,
                                    [](double x, double y) {
                                        return Vec3{0, x, y};
                                    },
                                    [](double x, double y) {
                                        return Vec3{y, 5, x};
                                    },
                                    [](double x, double y) {
                                        return Vec3{x + y, x - 2 * y, 3 * x + 1};
                                    }};
    std::vector<double> outline = kL;
    for (int first = 0; first < 6; ++first) {
        std::rotate(outline.begin(), outline.begin() + 2, outline.end());
        std::vector<double> reversed;
        for (std::size_t i = outline.size(); i > 0; i -= 2) {
            reversed.insert(reversed.end(), {outline[i - 2], outline[i - 1]});
        }
        for (const std::vector<double>& turned : {outline, reversed}) {
            check_covers(turned);
            for (const Placement& place : placements) {
                const double scale =
                    length(cross(place(1, 0) - place(0, 0), place(0, 1) - place(0, 0)));
                const double area = scale * std::abs(outline_area(turned));
                CHECK(total_area(triangulated(turned, place)) == doctest::Approx(area));
            }
        }
    }
}

TEST_CASE("corners on straight edges make no flat triangles") {
    check_covers({0, 0, 0.5, 0, 1, 0, 1, 0.5, 1, 1, 0.5, 1, 0, 1, 0, 0.5});
    check_covers({0, 0, 1, 0, 2, 0, 3, 0, 3, 1});
}

TEST_CASE("combs and random stars are covered") {
    std::vector<double> comb{40, 2, 0, 2};
    for (int tooth = 0; tooth < 40; ++tooth) {
        const double x = tooth;
        comb.insert(comb.end(), {x, 0, x + 0.5, 1.9});
    }
    comb.insert(comb.end(), {40, 0});
    check_covers(comb);

    std::mt19937 random(7);
    for (int round = 0; round < 200; ++round) {
        std::vector<double> star;
        const int count = round == 0 ? 3000 : 4 + round % 40;
        for (int i = 0; i < count; ++i) {
            const double radius = 0.05 + static_cast<double>(random() % 1000) / 1000;
            const double angle = 2 * std::numbers::pi * i / count;
            star.insert(star.end(), {radius * std::cos(angle), radius * std::sin(angle)});
        }
        CAPTURE(round);
        check_covers(star, 1e-12);
    }
}

TEST_CASE("a bridge to a hole is followed twice") {
    // A 3 x 3 square with a 1 x 1 hole, joined by a cut from corner (0, 0) to (1, 1).
    const std::vector<double> keyhole{0, 0, 3, 0, 3, 3, 0, 3, 0, 0, 1, 1, 1, 2, 2, 2, 2, 1, 1, 1};
    CHECK(total_area(triangulated(keyhole)) == doctest::Approx(8));
}

TEST_CASE("scale does not matter") {
    for (const double scale : {1e-300, 1e-30, 1e30, 1e200, 1e307}) {
        const auto place = [scale](double x, double y) { return Vec3{scale * x, scale * y, 0}; };
        CHECK(triangulated(kL, place).triangles == triangulated(kL).triangles);
    }
}

TEST_CASE("bent, crossing and collapsed polygons still give their triangles") {
    const MeshFile bent = triangulated({0, 0, 1, 0, 1, 1, 0, 1}, [](double x, double y) {
        return Vec3{x, y, x * y};
    });
    CHECK(bent.triangles.size() == 6);
    CHECK(triangulated({0, 0, 1, 1, 1, 0, 0, 1}).triangles.size() == 6);
    CHECK(triangulated({2, 2, 2, 2, 2, 2, 2, 2, 2, 2}).triangles.size() == 9);
    CHECK(triangulated({0, 0, 1, 1, 2, 2, 3, 3, 4, 4}).triangles.size() == 9);
}
