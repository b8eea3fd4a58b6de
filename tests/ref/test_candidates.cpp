// The stream of candidates, and the cells they are kept in.
#include <array>
#include <cmath>
#include <cstring>
#include <numeric>

#include <doctest/doctest.h>

#include "kernels/candidates.hpp"
#include "lib/rng.hpp"
#include "support/geodesic_query.hpp"

using namespace geodisk;
using namespace geodisk::test;

namespace {

/// Whether a chi-square sum over `freedom` degrees is within 5 standard deviations of its mean.
bool plausible(double chi_square, double freedom) {
    return std::abs(chi_square - freedom) < 5 * std::sqrt(2 * freedom);
}

double chi_square(const std::vector<double>& counts, const std::vector<double>& expected) {
    double sum = 0;
    for (std::size_t i = 0; i < counts.size(); ++i) {
        sum += (counts[i] - expected[i]) * (counts[i] - expected[i]) / expected[i];
    }
    return sum;
}

template <class Real>
bool in_its_cell(const ref::Surface<Real>& surface, const ref::Bins<Real>& bins, std::uint32_t f,
                 std::uint32_t cell, std::uint32_t place) {
    const ref::Grid grid = ref::face_grid(surface, f);
    if (bins.points[place].face != f) {
        return false;
    }
    if (grid.single()) {
        return true;
    }
    const auto at = ref::position_in(surface, grid.base, bins.points[place]);
    const std::uint32_t column = cell % grid.columns;
    const std::uint32_t row = cell / grid.columns;
    const auto within = [](Real x, std::uint32_t index, std::uint32_t count) {
        const Real scaled = 2 * x;
        const auto low = static_cast<Real>(index);
        return (index == 0 || scaled >= low) && (index + 1 == count || scaled < low + 1);
    };
    return within(at.x, column, grid.columns) && within(at.y, row, grid.rows);
}

/// Every point is in exactly one cell, its own, in rank order.
template <class Real>
void check_bins(const TestMesh& mesh, double min_distance, std::uint32_t count) {
    const PreparedMesh prepared_mesh = prepared(mesh);
    const ref::Surface<Real> surface(prepared_mesh, min_distance);
    const auto points = ref::draw_candidates<Real>(prepared_mesh.alias_columns(), 5, count);
    const ref::Bins<Real> bins(surface, points);
    REQUIRE(bins.order.size() == count);
    REQUIRE(bins.starts.front() == 0);
    REQUIRE(bins.starts.back() == count);
    REQUIRE(bins.starts.size() == std::size_t{bins.first_cell.back()} + 1);
    std::vector<int> seen(count, 0);
    for (std::uint32_t f = 0; f < surface.face_count(); ++f) {
        for (std::uint32_t cell = bins.first_cell[f]; cell < bins.first_cell[f + 1]; ++cell) {
            for (std::uint32_t place = bins.starts[cell]; place < bins.starts[cell + 1]; ++place) {
                ++seen[bins.order[place]];
                const auto& p = points[bins.order[place]];
                REQUIRE(bins.points[place].weight1 == p.weight1);
                REQUIRE(bins.points[place].weight2 == p.weight2);
                REQUIRE(in_its_cell(surface, bins, f, cell - bins.first_cell[f], place));
                const bool first = place == bins.starts[cell];
                REQUIRE((first || bins.order[place - 1] < bins.order[place]));
            }
        }
    }
    CHECK(seen == std::vector<int>(count, 1));
}

} // namespace

TEST_CASE("philox: known answers") {
    // kat_vectors of Random123: philox4x32-10 with counter and key 0. The stream's counter is
    // (index, 0, 0, 0), so of the published vectors only this one can be asked for.
    const std::array<std::uint32_t, 4> zero{0x6627e8d5, 0xe169c58d, 0xbc57ac4c, 0x9b00dbd8};
    CHECK(ref::philox(0, 0) == zero);
}

TEST_CASE("candidates: weights are exact, float and double twins equal") {
    const PreparedMesh mesh = prepared(builtin("icosphere", 2));
    for (const std::uint64_t seed : {std::uint64_t{0}, std::uint64_t{0x123456789abcdef0}}) {
        const auto real = ref::draw_candidates<double>(mesh.alias_columns(), seed, 100000);
        const auto twin = ref::draw_candidates<float>(mesh.alias_columns(), seed, 100000);
        for (std::size_t i = 0; i < real.size(); ++i) {
            const double w1 = real[i].weight1 * 0x1p24;
            const double w2 = real[i].weight2 * 0x1p24;
            REQUIRE(w1 == std::floor(w1));
            REQUIRE(w2 == std::floor(w2));
            REQUIRE(w1 >= 0);
            REQUIRE(w2 >= 0);
            REQUIRE(w1 + w2 < 0x1p24);
            REQUIRE(real[i].face == twin[i].face);
            REQUIRE(real[i].weight1 == static_cast<double>(twin[i].weight1));
            REQUIRE(real[i].weight2 == static_cast<double>(twin[i].weight2));
            // The first weight is exact in float as well.
            const float w0 = 1.0f - twin[i].weight1 - twin[i].weight2;
            REQUIRE(static_cast<double>(w0) == 1 - real[i].weight1 - real[i].weight2);
        }
        REQUIRE(ref::draw_candidate<double>(mesh.alias_columns(), seed, 77).weight1 ==
                real[77].weight1);
    }
}

TEST_CASE("candidates: uniform by area over the triangles") {
    for (const TestMesh& mesh : {builtin("torus-knot", 6), flat_obtuse_fan(40),
                                 flat_lines({0, 0.1, 0.11, 1}, {0, 0.5, 0.7, 1})}) {
        const PreparedMesh surface = prepared(mesh);
        const std::uint32_t count = 400 * mesh.face_count();
        std::vector<double> counts(mesh.face_count(), 0);
        std::vector<double> expected(mesh.face_count(), 0);
        for (const Point& p : random_points(surface, 1234, count)) {
            counts[p.face] += 1;
        }
        for (std::uint32_t f = 0; f < mesh.face_count(); ++f) {
            const HalfEdge& edge = surface.half_edges()[std::size_t{3} * f];
            const double area = 0.5 * edge.length * edge.apex_y;
            expected[f] = count * area / surface.statistics().area;
        }
        const double freedom = mesh.face_count() - 1.0;
        const double sum = chi_square(counts, expected);
        CHECK_MESSAGE(plausible(sum, freedom), "chi-square ", sum, " of ", freedom);
    }
}

TEST_CASE("candidates: uniform inside one triangle") {
    const TestMesh mesh{{0, 0, 0, 1, 0, 0, 0.2, 0.7, 0}, {0, 1, 2}};
    constexpr std::uint32_t kParts = 16; // 256 equal sub-triangles
    constexpr std::uint32_t kCount = 256000;
    std::vector<double> counts(kParts * kParts, 0);
    for (const Point& p : random_points(prepared(mesh), 99, kCount)) {
        const auto i = static_cast<std::uint32_t>(p.weight1 * kParts);
        const auto j = static_cast<std::uint32_t>(p.weight2 * kParts);
        const bool upper = p.weight1 * kParts - i + p.weight2 * kParts - j > 1;
        // Rows of 2 (kParts - i) - 1 triangles.
        counts[kParts * kParts - (kParts - i) * (kParts - i) + 2 * j + upper] += 1;
    }
    const std::vector<double> expected(counts.size(), 1000.0);
    const double sum = chi_square(counts, expected);
    CHECK_MESSAGE(plausible(sum, 255), "chi-square ", sum, " of 255");
}

TEST_CASE("bins: every point once, in its cell, in rank order") {
    check_bins<double>(flat_grid(1, 1, 1, 1), 0.03, 5000);
    check_bins<float>(flat_grid(1, 1, 1, 1), 0.03, 5000);
    check_bins<double>(builtin("torus-knot", 6), 0.05, 5000);
    check_bins<float>(builtin("torus-knot", 6), 0.05, 5000);
    check_bins<float>(flat_obtuse_fan(30), 0.1, 5000);
    check_bins<float>(flat_lines({0, 1e-7, 1}, {0, 0.5, 1}), 0.01, 5000);
}

TEST_CASE("bins: a disk finds every point within reach, however large the triangles") {
    // Every orientation of the longest edge against the edge a window enters through.
    const TestMesh shapes[] = {flat_grid(1, 1, 1, 1), flat_grid(1, 1, 1, 0.2), flat_obtuse_fan(1),
                               flat_lines({0, 0.37, 1}, {0, 0.2, 1})};
    for (const TestMesh& mesh : shapes) {
        for (const double reach : {0.01, 0.07, 0.5}) {
            const PreparedMesh surface = prepared(mesh);
            const std::vector<Point> points = random_points(surface, 3, 4000);
            const Tolerances t = tolerances_for(surface, reach, provided_chain(surface, reach));
            GeodesicQuery<float> query(surface, reach, points, t);
            for (std::size_t s = 0; s < 100; ++s) {
                const std::vector<double> found = query.from(points[s]);
                for (std::size_t i = 0; i < points.size(); ++i) {
                    const double straight =
                        length(mesh.position(points[s]) - mesh.position(points[i]));
                    REQUIRE((found[i] < kUnreachable || straight >= reach));
                    REQUIRE((found[i] == kUnreachable || straight <= reach * (1 + 2 * t.guard)));
                }
            }
        }
    }
}
