// Meshes cut along the borders of cells, beside Voronoi cells of the plane that are clipped by
// lines.
#include "geometry/cell_borders.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <random>
#include <span>
#include <utility>
#include <vector>

#include "geometry/mesh.hpp"

using namespace geodisk::tools;
using geodisk::Sample;

namespace {

using Point = std::array<double, 2>;

/// The unit square in so many cells of two triangles along each side, moved a little inside.
MeshFile square(int side) {
    MeshFile mesh;
    std::mt19937 random(5);
    std::uniform_real_distribution<double> any(-0.3, 0.3);
    for (int y = 0; y <= side; ++y) {
        for (int x = 0; x <= side; ++x) {
            const bool is_inside = x > 0 && y > 0 && x < side && y < side;
            const double dx = is_inside ? any(random) : 0, dy = is_inside ? any(random) : 0;
            mesh.positions.insert(mesh.positions.end(), {(x + dx) / side, (y + dy) / side, 0.0});
        }
    }
    for (int y = 0; y < side; ++y) {
        for (int x = 0; x < side; ++x) {
            const auto v = static_cast<std::uint32_t>(x + (side + 1) * y);
            const auto above = v + static_cast<std::uint32_t>(side) + 1;
            mesh.triangles.insert(mesh.triangles.end(), {v, v + 1, above + 1, v, above + 1, above});
        }
    }
    return mesh;
}

std::vector<Point> random_points(std::size_t count, std::uint32_t seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> any(0, 1);
    std::vector<Point> points(count);
    for (Point& point : points) {
        point = {any(random), any(random)};
    }
    return points;
}

double distance(const Point& a, const Point& b) {
    return std::hypot(a[0] - b[0], a[1] - b[1]);
}

std::uint32_t nearest_of(std::span<const Point> sites, const Point& point) {
    std::uint32_t best = 0;
    for (std::uint32_t i = 1; i < sites.size(); ++i) {
        best = distance(sites[i], point) < distance(sites[best], point) ? i : best;
    }
    return best;
}

/// Returns the area of the part of the unit square that is nearest to a site.
double cell_area(std::span<const Point> sites, std::size_t own) {
    std::vector<Point> polygon{{0, 0}, {1, 0}, {1, 1}, {0, 1}};
    for (std::size_t other = 0; other < sites.size(); ++other) {
        const auto side = [&](const Point& p) {
            return std::pow(distance(p, sites[own]), 2) - std::pow(distance(p, sites[other]), 2);
        };
        std::vector<Point> clipped;
        for (std::size_t i = 0; other != own && i < polygon.size(); ++i) {
            const Point &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
            const double from = side(a), to = side(b);
            if (from <= 0) {
                clipped.push_back(a);
            }
            if ((from <= 0) != (to <= 0)) {
                const double t = from / (from - to);
                clipped.push_back({a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1])});
            }
        }
        polygon = other == own ? polygon : clipped;
    }
    double area = 0;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const Point &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
        area += (a[0] * b[1] - a[1] * b[0]) / 2;
    }
    return area;
}

Point point_of(const CutCells& cells, std::uint32_t vertex) {
    return {cells.positions[3 * vertex], cells.positions[3 * vertex + 1]};
}

double area_of(const CutCells& cells, std::size_t triangle) {
    const auto& [a, b, c] = cells.triangles[triangle];
    const Point p = point_of(cells, a), q = point_of(cells, b), r = point_of(cells, c);
    return ((q[0] - p[0]) * (r[1] - p[1]) - (q[1] - p[1]) * (r[0] - p[0])) / 2;
}

CutCells cut(const MeshFile& mesh, std::span<const Point> sites,
             std::span<const std::uint8_t> mask = {}) {
    const double longest = 0.5 / std::sqrt(static_cast<double>(sites.size()));
    return cut_cells(mesh, mask, longest, [&](std::span<const Sample> points) {
        std::vector<std::uint32_t> found;
        for (const Sample& sample : points) {
            Point at{};
            for (std::size_t k = 0; k < 3; ++k) {
                const std::uint32_t v = mesh.triangles[3 * sample.face + k];
                at[0] += static_cast<double>(sample.weights[k]) * mesh.positions[3 * v];
                at[1] += static_cast<double>(sample.weights[k]) * mesh.positions[3 * v + 1];
            }
            found.push_back(nearest_of(sites, at));
        }
        return found;
    });
}

} // namespace

TEST_CASE("a mesh is cut along the borders of cells, whether it is finer or coarser than these") {
    for (const auto& [side, count] : {std::pair{1, 60}, {4, 20}, {30, 12}, {12, 300}}) {
        const int shown = side; // Lambdas of Clang 14 capture no bindings.
        CAPTURE(shown);
        const MeshFile mesh = square(side);
        const std::vector<Point> sites = random_points(static_cast<std::size_t>(count), 3);
        const CutCells cells = cut(mesh, sites);
        std::vector<double> areas(sites.size());
        std::map<std::array<std::uint32_t, 2>, int> edges;
        double wrong = 0;
        for (std::size_t t = 0; t < cells.triangles.size(); ++t) {
            const double area = area_of(cells, t);
            CHECK(area > -1e-12);
            areas[cells.samples[t]] += area;
            Point middle{};
            for (std::size_t k = 0; k < 3; ++k) {
                const std::uint32_t a = cells.triangles[t][k], b = cells.triangles[t][(k + 1) % 3];
                ++edges[{std::min(a, b), std::max(a, b)}];
                middle[0] += point_of(cells, a)[0] / 3;
                middle[1] += point_of(cells, a)[1] / 3;
            }
            wrong += nearest_of(sites, middle) != cells.samples[t] ? area : 0;
        }
        CHECK(wrong < 1e-3); // Beside places where three cells meet.
        double sum = 0;
        for (std::size_t i = 0; i < sites.size(); ++i) {
            CHECK(areas[i] == doctest::Approx(cell_area(sites, i)).epsilon(0.02));
            sum += areas[i];
        }
        CHECK(sum == doctest::Approx(1));
        // It is one sheet: each edge has two triangles, but for those along the border.
        double border = 0;
        for (const auto& [ends, triangles] : edges) {
            CHECK(triangles <= 2);
            border +=
                triangles == 1 ? distance(point_of(cells, ends[0]), point_of(cells, ends[1])) : 0;
        }
        CHECK(border == doctest::Approx(4));
        REQUIRE(cells.borders.size() > 20);
        double longest_miss = 0;
        for (const CutCells::Border& one : cells.borders) {
            CHECK(one.samples[0] < one.samples[1]);
            for (const std::uint32_t end : one.ends) {
                const Point at = point_of(cells, end);
                longest_miss =
                    std::max(longest_miss, std::abs(distance(at, sites[one.samples[0]]) -
                                                    distance(at, sites[one.samples[1]])));
            }
        }
        CHECK(longest_miss < 0.05 / std::sqrt(count)); // On edges far less.
    }
}

TEST_CASE("triangles that a mask leaves out, or that repeat a vertex, are in no cell") {
    MeshFile mesh = square(4);
    mesh.triangles[3] = mesh.triangles[4];
    std::vector<std::uint8_t> mask(mesh.triangle_count(), 1);
    mask[5] = mask[6] = 0;
    const CutCells cells = cut(mesh, random_points(9, 1), mask);
    double area = 0;
    for (std::size_t t = 0; t < cells.triangles.size(); ++t) {
        CHECK(cells.faces[t] != 1);
        CHECK(mask[cells.faces[t]] == 1);
        area += area_of(cells, t);
    }
    CHECK(area < 1 - 2.0 / 32);
    CHECK(area > 1 - 5.0 / 32);
}

TEST_CASE("one sample has the whole mesh, and no path to a sample is told") {
    const MeshFile mesh = square(2);
    const CutCells one = cut(mesh, random_points(1, 1));
    CHECK(one.borders.empty());
    CHECK(std::ranges::count(one.samples, 0u) == std::ssize(one.samples));
    const CutCells none = cut_cells(mesh, {}, 1, [](std::span<const Sample> points) {
        return std::vector<std::uint32_t>(points.size(), CutCells::kNone);
    });
    CHECK(none.triangles.size() == mesh.triangle_count());
    CHECK(std::ranges::count(none.samples, CutCells::kNone) == std::ssize(none.samples));
}
