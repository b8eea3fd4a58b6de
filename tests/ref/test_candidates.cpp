// The candidates of faces, the pools they make, and the cells they are kept in.
#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <tuple>

#include <doctest/doctest.h>

#include "kernels/candidates.hpp"
#include "kernels/poisson.hpp"
#include "kernels/pool.hpp"
#include "lib/frame.hpp"
#include "lib/rng.hpp"
#include "ref/chi_square.hpp"
#include "ref/dart_check.hpp"
#include "support/geodesic_query.hpp"
#include "support/radius_fields.hpp"

using namespace geodisk;
using namespace geodisk::test;

namespace {

double face_area(const PreparedMesh& mesh, std::uint32_t face) {
    const HalfEdge& edge = mesh.half_edges()[std::size_t{3} * face];
    return 0.5 * edge.length * edge.apex_y;
}

template <class Real>
ref::Pool<Real> pool_of(const PreparedMesh& mesh, const SampleParams& params) {
    return ref::draw_pool(ref::Surface<Real>(mesh, params), params);
}

template <class Real>
std::vector<ref::FacePoint<Real>> converted(const std::vector<Point>& points) {
    std::vector<ref::FacePoint<Real>> result;
    result.reserve(points.size());
    for (const Point& p : points) {
        result.push_back({p.face, static_cast<Real>(p.weight1), static_cast<Real>(p.weight2)});
    }
    return result;
}

template <class Real>
bool in_its_cell(const ref::Surface<Real>& surface, const ref::Bins<Real>& bins, std::uint32_t f,
                 std::uint32_t cell, std::uint32_t place) {
    const ref::Grid& grid = bins.grids[f];
    if (bins.points[place].face != f) {
        return false;
    }
    if (grid.single()) {
        return true;
    }
    const auto at = ref::position_in(surface, grid.base, bins.points[place]);
    const std::uint32_t column = cell % grid.columns;
    const std::uint32_t row = cell / grid.columns;
    const Real per_unit = surface.cells_per_unit(f);
    const auto within = [per_unit](Real x, std::uint32_t index, std::uint32_t count) {
        const Real scaled = per_unit * x;
        const auto low = static_cast<Real>(index);
        return (index == 0 || scaled >= low) && (index + 1 == count || scaled < low + 1);
    };
    return within(at.x, column, grid.columns) && within(at.y, row, grid.rows);
}

/// Every place is in its cell.
template <class Real>
void check_cells(const ref::Surface<Real>& surface, const ref::Bins<Real>& bins) {
    REQUIRE(bins.starts.front() == 0);
    REQUIRE(bins.starts.back() == bins.points.size());
    std::uint32_t first = 0;
    for (std::uint32_t f = 0; f < surface.face_count(); ++f) {
        REQUIRE(bins.grids[f].first_cell == first);
        for (std::uint32_t k = 0; k < bins.grids[f].cells(); ++k) {
            for (std::uint32_t place = bins.starts[first + k]; place < bins.starts[first + k + 1];
                 ++place) {
                REQUIRE(in_its_cell(surface, bins, f, k, place));
            }
        }
        first += bins.grids[f].cells();
    }
    REQUIRE(bins.starts.size() == std::size_t{first} + 1);
}

/// Every point is in exactly one cell, its own, and those of a cell in the order given.
template <class Real>
void check_bins(const TestMesh& mesh, double min_distance, std::uint32_t count) {
    const PreparedMesh prepared_mesh = prepared(mesh);
    const ref::Surface<Real> surface(prepared_mesh, min_distance);
    const auto points = converted<Real>(random_points(prepared_mesh, 5, count));
    const ref::Bins<Real> bins(surface, points);
    check_cells(surface, bins);
    std::vector<int> seen(count, 0);
    for (std::uint32_t place = 0; place < count; ++place) {
        ++seen[bins.order[place]];
        const auto& p = points[bins.order[place]];
        REQUIRE(bins.points[place].weight1 == p.weight1);
        REQUIRE(bins.points[place].weight2 == p.weight2);
    }
    CHECK(seen == std::vector<int>(count, 1));
    for (std::size_t cell = 0; cell + 1 < bins.starts.size(); ++cell) {
        CHECK(std::is_sorted(bins.order.begin() + bins.starts[cell],
                             bins.order.begin() + bins.starts[cell + 1]));
    }
}

/// Returns what dart order goes by.
template <class Real>
auto key_of(const ref::Pool<Real>& pool, std::uint32_t rank) {
    const auto p = pool.candidate(rank);
    return std::tuple(pool.word(rank), p.face, p.weight1, p.weight2);
}

/// A pool holds what each face has, in cells and in dart order.
template <class Real>
void check_pool(const PreparedMesh& mesh, const SampleParams& params) {
    const ref::Surface<Real> surface(mesh, params);
    const ref::Pool<Real> pool = ref::draw_pool(surface, params);
    check_cells(surface, pool.bins);
    std::vector<std::tuple<std::uint32_t, std::uint32_t, Real, Real>> expected, found;
    for (std::uint32_t stage = 0; stage < surface.frame.stages.pool_stages(); ++stage) {
        const auto counts = ref::count_candidates(surface, params, stage);
        for (std::uint32_t face = 0; face < mesh.face_count(); ++face) {
            std::vector<ref::FacePoint<Real>> points(counts[face]);
            std::vector<std::uint32_t> priorities(counts[face]);
            ref::draw_candidates<Real>(surface, params, face, stage, points, priorities);
            for (std::size_t k = 0; k < points.size(); ++k) {
                REQUIRE(priorities[k] < 1u << 28);
                expected.emplace_back(stage << 28 | priorities[k], face, points[k].weight1,
                                      points[k].weight2);
            }
        }
    }
    std::sort(expected.begin(), expected.end());
    for (std::uint32_t rank = 0; rank < pool.size(); ++rank) {
        found.push_back(key_of(pool, rank));
    }
    CHECK(found == expected);
    const std::vector<std::uint32_t> ranks = pool.ranks();
    for (std::uint32_t place = 0; place < pool.size(); ++place) {
        REQUIRE(pool.places[ranks[place]] == place);
    }
}

} // namespace

TEST_CASE("philox: known answers") {
    // kat_vectors of Random123 for philox4x32-10: counter and key 0, all ones, and digits of pi.
    using Words = std::array<std::uint32_t, 4>;
    CHECK(ref::philox(0, {0, 0, 0, 0}) == Words{0x6627e8d5, 0xe169c58d, 0xbc57ac4c, 0x9b00dbd8});
    CHECK(ref::philox(~std::uint64_t{0}, {~0u, ~0u, ~0u, ~0u}) ==
          Words{0x408f276d, 0x41c83b0e, 0xa20bc7c6, 0x6d5451fd});
    CHECK(ref::philox(0x299f31d0a4093822, {0x243f6a88, 0x85a308d3, 0x13198a2e, 0x03707344}) ==
          Words{0xd16cfe09, 0x94fdcceb, 0x5001e420, 0x24126ea1});
}

TEST_CASE("candidates: those of a face by hand") {
    const PreparedMesh mesh = prepared(flat_grid(2, 1, 2, 1));
    SampleParams params = params_for(mesh, 41, 0x123456789abcdef0); // 51.25 to a face and stage.
    const std::vector<std::uint32_t> keys{5, 17, 0xdeadbeef, 3};
    params.face_keys = keys;
    const ref::Surface<float> surface(mesh, params);
    const float area = static_cast<float>(0.5 / params.min_distance / params.min_distance);
    const float intensity = ref::frame_of(mesh, params).intensity(3);
    const auto words = ref::philox(params.seed, {keys[2], 0, 3, 0xffffffff});
    const std::uint32_t count = ref::count_candidates(surface, params, 3)[2];
    CHECK(count == ref::poisson(intensity * area, words[0], words[1]));
    REQUIRE(count > 20);
    std::vector<ref::FacePoint<float>> points(count);
    std::vector<std::uint32_t> priorities(count);
    ref::draw_candidates<float>(surface, params, 2, 3, points, priorities);
    for (std::uint32_t k = 0; k < count; ++k) {
        const auto random = ref::philox(params.seed, {keys[2], k, 3, 0});
        CHECK(priorities[k] == random[0] / 16);
        const double alpha = ((random[2] >> 9) + 0.5) * 0x1p-23;
        const double beta = ((random[3] >> 9) + 0.5) * 0x1p-23;
        CHECK(points[k].face == 2);
        CHECK(std::abs(static_cast<double>(points[k].weight1) - std::sqrt(alpha) * (1 - beta)) <
              0x1p-22);
        CHECK(std::abs(static_cast<double>(points[k].weight2) - std::sqrt(alpha) * beta) < 0x1p-22);
    }
}

TEST_CASE("candidates: weights are exact, float and double twins equal") {
    const PreparedMesh mesh = prepared(builtin("icosphere", 2));
    for (const std::uint64_t seed : {std::uint64_t{0}, std::uint64_t{0x123456789abcdef0}}) {
        const SampleParams params = params_for(mesh, 5000, seed);
        const auto real = pool_of<double>(mesh, params);
        const auto twin = pool_of<float>(mesh, params);
        REQUIRE(real.size() == twin.size());
        for (std::uint32_t rank = 0; rank < real.size(); ++rank) {
            const auto a = real.candidate(rank);
            const auto b = twin.candidate(rank);
            const double w1 = a.weight1 * 0x1p24;
            const double w2 = a.weight2 * 0x1p24;
            REQUIRE(w1 == std::floor(w1));
            REQUIRE(w2 == std::floor(w2));
            REQUIRE(w1 >= 0);
            REQUIRE(w2 >= 0);
            REQUIRE(w1 + w2 < 0x1p24);
            REQUIRE(a.face == b.face);
            REQUIRE(a.weight1 == static_cast<double>(b.weight1));
            REQUIRE(a.weight2 == static_cast<double>(b.weight2));
            REQUIRE(real.word(rank) == twin.word(rank));
            // The first weight is exact in float as well.
            const float w0 = 1.0f - b.weight1 - b.weight2;
            REQUIRE(static_cast<double>(w0) == 1 - a.weight1 - a.weight2);
        }
    }
}

TEST_CASE("candidates: uniform by area over the triangles") {
    for (const TestMesh& mesh : {builtin("torus-knot", 6), flat_obtuse_fan(40),
                                 flat_lines({0, 0.1, 0.11, 1}, {0, 0.5, 0.7, 1})}) {
        const PreparedMesh surface = prepared(mesh);
        // 100 candidates to a face and stage.
        SampleParams params = params_for(surface, 20.0 * mesh.face_count());
        std::vector<double> counts(mesh.face_count(), 0);
        std::vector<double> expected(mesh.face_count(), 0);
        for (params.seed = 0; params.seed < 40; ++params.seed) {
            const ref::Surface<double> of(surface, params);
            for (std::uint32_t stage = 0; stage < 4; ++stage) {
                const auto drawn = ref::count_candidates(of, params, stage);
                const double mean = of.frame.stages.expected(stage);
                for (std::uint32_t f = 0; f < mesh.face_count(); ++f) {
                    counts[f] += drawn[f];
                    expected[f] += mean * face_area(surface, f) / surface.statistics().area;
                }
            }
        }
        check_chi_square(counts, expected, mesh.face_count());
    }
}

TEST_CASE("candidates: uniform inside a triangle, in every stage") {
    const TestMesh mesh{{0, 0, 0, 1, 0, 0, 0.2, 0.7, 0}, {0, 1, 2}};
    const PreparedMesh surface = prepared(mesh);
    constexpr std::size_t kParts = 16; // 256 equal sub-triangles
    const SampleParams params = params_for(surface, 50000, 99);
    const auto pool = pool_of<double>(surface, params);
    std::vector<std::vector<double>> counts(4, std::vector<double>(kParts * kParts, 0));
    for (std::uint32_t rank = 0; rank < pool.size(); ++rank) {
        const Point p = pool.candidate(rank);
        const auto i = static_cast<std::uint32_t>(p.weight1 * kParts);
        const auto j = static_cast<std::uint32_t>(p.weight2 * kParts);
        const bool upper = p.weight1 * kParts - i + p.weight2 * kParts - j > 1;
        // Rows of 2 (kParts - i) - 1 triangles.
        counts[pool.word(rank) >> 28]
              [kParts * kParts - (kParts - i) * (kParts - i) + std::size_t{2} * j + upper] += 1;
    }
    for (const std::vector<double>& stage : counts) {
        const double total = std::accumulate(stage.begin(), stage.end(), 0.0);
        check_chi_square(stage, std::vector(stage.size(), total / (kParts * kParts)), 255);
    }
}

TEST_CASE("candidates: numbers of faces and stages are independent") {
    const TestMesh mesh = flat_grid(4, 4, 1, 1);
    const PreparedMesh surface = prepared(mesh);
    constexpr std::size_t kSeeds = 4000;
    SampleParams params = params_for(surface, 32); // Five candidates to a face and stage.
    const std::size_t cells = std::size_t{4} * mesh.face_count();
    std::vector<std::vector<double>> counts(cells);
    double mean = 0;
    for (params.seed = 0; params.seed < kSeeds; ++params.seed) {
        const ref::Surface<double> of(surface, params);
        for (std::uint32_t stage = 0; stage < 4; ++stage) {
            const auto drawn = ref::count_candidates(of, params, stage);
            mean = of.frame.stages.expected(stage) / mesh.face_count();
            for (std::uint32_t f = 0; f < mesh.face_count(); ++f) {
                counts[stage * mesh.face_count() + f].push_back(drawn[f]);
            }
        }
    }
    // Each correlation is normal with variance 1 / kSeeds, and there are 8,128 of them.
    double worst = 0, sum = 0;
    for (std::size_t a = 0; a < cells; ++a) {
        for (std::size_t b = 0; b < a; ++b) {
            double product = 0;
            for (std::size_t s = 0; s < kSeeds; ++s) {
                product += (counts[a][s] - mean) * (counts[b][s] - mean);
            }
            const double correlation = product / mean / std::sqrt(kSeeds);
            worst = std::max(worst, std::abs(correlation));
            sum += correlation * correlation;
        }
    }
    const double pairs = static_cast<double>(cells * (cells - 1)) / 2;
    CHECK(worst < 5);
    CHECK_MESSAGE(is_plausible(sum, pairs), "sum of squares ", sum, " of ", pairs);
}

TEST_CASE("candidates: their order has nothing to do with their place") {
    const TestMesh mesh = flat_irregular(8, 3);
    const PreparedMesh surface = prepared(mesh);
    const auto pool = pool_of<double>(surface, params_for(surface, 20000, 7));
    // Parts of the square against parts of a stage, and the place of one against the next one's.
    constexpr std::size_t kParts = 8, kTimes = 16;
    std::vector<double> counts(kParts * kParts * kTimes, 0), next(kParts * kParts * 16, 0);
    std::size_t last = 0;
    std::array<double, kTimes> per_time{};
    for (std::uint32_t rank = 0; rank < pool.size(); ++rank) {
        const Vec3 at = mesh.position(pool.candidate(rank));
        const auto part = static_cast<std::size_t>(at.x * kParts) * kParts +
                          static_cast<std::size_t>(at.y * kParts);
        const std::size_t time = (pool.word(rank) & 0xfffffff) >> 24;
        counts[part * kTimes + time] += 1;
        per_time[time] += 1;
        next[part * 16 + last] += 1;
        last = static_cast<std::size_t>(at.x * 4) * 4 + static_cast<std::size_t>(at.y * 4);
    }
    const double all = pool.size();
    std::vector<double> expected;
    for (std::size_t part = 0; part < kParts * kParts; ++part) {
        for (std::size_t time = 0; time < kTimes; ++time) {
            expected.push_back(per_time[time] / (kParts * kParts));
        }
    }
    check_chi_square(counts, expected, (kParts * kParts - 1.0) * kTimes);
    check_chi_square(next, std::vector(next.size(), all / static_cast<double>(next.size())),
                     static_cast<double>(next.size()) - 1);
    check_chi_square({per_time.begin(), per_time.end()}, std::vector(kTimes, all / kTimes),
                     kTimes - 1);
}

TEST_CASE("candidates: a face without area has none") {
    const TestMesh mesh{{0, 0, 0, 1, 0, 0, 0, 1, 0, 0.5, 0, 0}, {0, 1, 2, 0, 3, 1, 3, 3, 2}};
    const PreparedMesh surface = prepared(mesh);
    const SampleParams params = params_for(surface, 1000);
    const auto counts = ref::count_candidates(ref::Surface<float>(surface, params), params, 0);
    CHECK(counts[0] > 4000);
    CHECK(counts[1] == 0);
    CHECK(counts[2] == 0);
}

TEST_CASE("pools: each face's candidates, in cells and in dart order") {
    for (const TestMesh& mesh : {flat_grid(1, 1, 1, 1), builtin("torus-knot", 6)}) {
        const PreparedMesh surface = prepared(mesh);
        for (const double count : {1.0, 50.0, 2000.0}) {
            SampleParams params = params_for(surface, count, 5);
            check_pool<double>(surface, params);
            check_pool<float>(surface, params);
            params.pool_ratio = 71; // 15 stages.
            check_pool<float>(surface, params);
            const RadiusField field = radius_field(surface, wavy_factors(mesh, 0.1));
            params.radii = &field;
            check_pool<float>(surface, params);
        }
    }
}

TEST_CASE("pools: candidates of one priority come by face and place") {
    // 2^21 candidates of a stage have about 2^13 pairs with one priority of 2^28.
    const PreparedMesh surface = prepared(flat_grid(1, 1, 1, 1));
    const auto pool = pool_of<float>(surface, params_for(surface, 420000, 3));
    std::uint32_t pairs = 0, wrong = 0;
    for (std::uint32_t rank = 1; rank < pool.size(); ++rank) {
        wrong += key_of(pool, rank - 1) > key_of(pool, rank);
        pairs += pool.word(rank - 1) == pool.word(rank);
    }
    CHECK(wrong == 0);
    CHECK(pairs > 4 * 7500);
    CHECK(pairs < 4 * 9000);
}

TEST_CASE("pools: the first darts of a job, and the stages they come in") {
    const PreparedMesh surface = prepared(builtin("torus-knot", 6));
    SampleParams params = params_for(surface, 300, 3);
    params.darts = 100'000;
    const ref::Surface<double> of(surface, params);
    const auto all = ref::draw_stages(of, params, 0, 7);
    REQUIRE(all.size() > 100'000);
    for (const std::uint32_t wanted : {1u, 1500u, 20'000u, 100'000u}) {
        params.darts = wanted;
        const auto darts = ref::draw_pool(of, params);
        REQUIRE(darts.size() == wanted);
        check_cells(of, darts.bins);
        for (std::uint32_t rank = 0; rank < wanted; ++rank) {
            REQUIRE(key_of(darts, rank) == key_of(all, rank));
        }
    }
    // Stages drawn by themselves count from their first.
    const auto later = ref::draw_stages(of, params, 2, 3);
    const std::uint32_t before = ref::draw_stages(of, params, 0, 2).size();
    for (std::uint32_t rank = 0; rank < later.size(); ++rank) {
        REQUIRE(later.word(rank) + (2u << 28) == all.word(before + rank));
        REQUIRE(later.candidate(rank).weight1 == all.candidate(before + rank).weight1);
    }
    // A pool of few samples has many stages of 64.
    params = params_for(surface, 1, 3);
    params.darts = 1'000'000;
    CHECK(pool_of<float>(surface, params).size() == 1'000'000);
}

TEST_CASE("pools: a larger one begins with a smaller one, and so do darts") {
    const PreparedMesh surface = prepared(builtin("torus-knot", 6));
    SampleParams params = params_for(surface, 300, 3);
    params.pool_ratio = 40;
    const auto largest = pool_of<float>(surface, params);
    const auto check_begin = [&](const ref::Pool<float>& pool, std::uint32_t count) {
        REQUIRE(count > 1000);
        REQUIRE(pool.size() >= count);
        for (std::uint32_t rank = 0; rank < count; ++rank) {
            REQUIRE(key_of(pool, rank) == key_of(largest, rank));
        }
    };
    for (const double ratio : {5.0, 10.0, 20.0}) {
        params.pool_ratio = ratio;
        const auto pool = pool_of<float>(surface, params);
        check_begin(pool, pool.size());
    }
    // Only the first stage of darts is as dense as those of a pool.
    const ref::Surface<float> of(surface, params);
    const std::uint32_t first = ref::draw_stages(of, params, 0, 1).size();
    params.darts = 10'000;
    check_begin(ref::draw_pool(of, params), first);
}

TEST_CASE("bins: every point once, in its cell, in the order given") {
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
            const ref::Tolerances t = ref::frame_of(surface, reach).tolerances();
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

TEST_CASE("stages of darts begin small enough and double") {
    for (const double samples : {1.0, 1000.0, 1.6e6, 1.7e6, 4e9}) {
        CAPTURE(samples);
        const Stages stages{samples, 0, 100};
        CHECK(stages.expected(0) <= 0x1p23);
        CHECK(stages.expected(0) >= std::min(5 * samples, 0x1p22));
        for (std::uint32_t stage = 1; stage < 40; ++stage) {
            const double step = stages.per_sample(stage) / stages.per_sample(stage - 1);
            CHECK((step == 1 || step == 2 || stages.expected(stage - 1) == 64));
            CHECK(stages.expected(stage) <= 0x1p23);
        }
    }
    CHECK(Stages{1.6e6, 0, 100}.per_sample(0) == 5);
    CHECK(Stages{1.7e6, 0, 100}.per_sample(0) == 2.5);
}
