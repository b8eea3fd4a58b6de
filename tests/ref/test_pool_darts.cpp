// Methods that choose samples from a pool on a surface: spacing by brute force, maximality where it
// is promised, and the sets that must be equal.
#include <algorithm>
#include <array>
#include <cmath>

#include <doctest/doctest.h>

#include "baselines/geodesic_disks.hpp"
#include "baselines/phase_groups.hpp"
#include "baselines/pool_darts.hpp"
#include "baselines/space_disks.hpp"
#include "ref/dart_check.hpp"

using namespace geodisk;
using namespace geodisk::test;

namespace {

/// Pairs of a pool that are closer than the limit, asked one disk at a time with everything wanted.
class Conflicts {
  public:
    explicit Conflicts(ref::DiskQuery& disks) : lists_(disks.size()) {
        const std::vector<std::uint8_t> all(disks.size(), 1);
        for (std::uint32_t rank = 0; rank < disks.size(); ++rank) {
            disks.find(rank, all, lists_[rank]);
            std::sort(lists_[rank].begin(), lists_[rank].end());
        }
    }

    /// Decided once, from the lower rank's disk.
    bool holds(std::uint32_t a, std::uint32_t b) const {
        return std::binary_search(lists_[std::min(a, b)].begin(), lists_[std::min(a, b)].end(),
                                  std::max(a, b));
    }
    const std::vector<std::uint32_t>& of(std::uint32_t rank) const { return lists_[rank]; }

  private:
    std::vector<std::vector<std::uint32_t>> lists_;
};

/// No pair conflicts, and no candidate is listed twice.
void check_apart(const Conflicts& conflicts, std::vector<std::uint32_t> accepted) {
    std::sort(accepted.begin(), accepted.end());
    CHECK(std::adjacent_find(accepted.begin(), accepted.end()) == accepted.end());
    std::size_t close = 0;
    for (std::size_t i = 0; i < accepted.size(); ++i) {
        for (std::size_t j = 0; j < i; ++j) {
            close += conflicts.holds(accepted[i], accepted[j]) ? 1u : 0u;
        }
    }
    CHECK(close == 0);
}

/// Candidates that conflict with no accepted one.
std::size_t gaps(const Conflicts& conflicts, const std::vector<std::uint32_t>& accepted,
                 std::uint32_t count) {
    std::vector<bool> covered(count, false);
    for (const std::uint32_t rank : accepted) {
        covered[rank] = true;
        for (const std::uint32_t other : conflicts.of(rank)) {
            covered[other] = true;
        }
    }
    return static_cast<std::size_t>(std::count(covered.begin(), covered.end(), false));
}

/// A surface, a pool on it, and what sequential dart throwing makes of it.
struct PoolScene {
    TestMesh mesh;
    PreparedMesh prepared_mesh;
    Darts darts;
    std::vector<ref::OrientedPoint> points;
    std::vector<Vec3> positions;

    PoolScene(const TestMesh& of, double count) : mesh(of), prepared_mesh(prepared(of)) {
        darts = thrown<double>(prepared_mesh, params_for(prepared_mesh, count));
        points = ref::oriented_points(mesh.view(), darts.pool);
        for (const ref::OrientedPoint& point : points) {
            positions.push_back(point.position);
        }
    }
};

void check_methods(const PoolScene& scene, ref::DiskQuery& disks) {
    const auto count = static_cast<std::uint32_t>(scene.darts.pool.size());
    const Conflicts conflicts(disks);
    const auto brute = ref::throw_brute_force(
        count, [&](std::uint32_t i, std::uint32_t j) { return conflicts.holds(i, j); });
    CHECK(ref::throw_in_order(disks) == brute);
    check_apart(conflicts, brute);
    CHECK(gaps(conflicts, brute, count) == 0);

    const auto eliminated = ref::eliminate_pool(disks, 3);
    check_apart(conflicts, eliminated);
    CHECK(gaps(conflicts, eliminated, count) == 0);
    CHECK(eliminated == ref::eliminate_pool(disks, 3));
    CHECK(eliminated != ref::eliminate_pool(disks, 4));

    const ref::PhaseGroups phases(scene.positions, scene.darts.min_distance);
    const auto all = phases.throw_darts(disks, count);
    check_apart(conflicts, all);
    CHECK(gaps(conflicts, all, count) == 0);
    CHECK(all == phases.throw_darts(disks, count));
    const auto few = phases.throw_darts(disks, 1);
    check_apart(conflicts, few);
    CHECK(gaps(conflicts, few, count) > 0);
    CHECK(phases.throw_darts(disks, 0).empty());
}

} // namespace

TEST_CASE("pool darts: exact disks") {
    const PoolScene scenes[] = {
        PoolScene(builtin("icosphere", 2), 60), PoolScene(builtin("cube", 1), 60),
        PoolScene(builtin("torus-knot", 6), 60), PoolScene(two_sided_square(), 60)};
    for (const PoolScene& scene : scenes) {
        ref::GeodesicDisks disks(scene.prepared_mesh, scene.darts.min_distance, scene.darts.pool,
                                 scene.darts.tolerances);
        check_methods(scene, disks);
        CHECK(ref::throw_in_order(disks) == scene.darts.ranks);
        // By distances that are not those of the disks.
        std::vector<Point> samples;
        for (const std::uint32_t rank : ref::eliminate_pool(disks, 3)) {
            samples.push_back(scene.darts.pool[rank]);
        }
        check_spacing(scene.mesh, samples, scene.darts.min_distance);
    }
}

TEST_CASE("pool darts: disks by straight lines and by the closed form") {
    const PoolScene scenes[] = {PoolScene(builtin("icosphere", 3), 60),
                                PoolScene(builtin("plate", 4), 60)};
    for (const PoolScene& scene : scenes) {
        for (const auto length : {ref::straight_length, ref::curve_length}) {
            ref::SpaceDisks disks(scene.points, scene.darts.min_distance, length);
            check_methods(scene, disks);
        }
    }
}

TEST_CASE("pool darts: straight lines see through a thin plate, and no farther than they reach") {
    const PoolScene scene(builtin("plate", 4), 60);
    const auto of = [&](std::uint32_t rank) { return scene.positions[rank]; };
    ref::SpaceDisks disks(scene.points, scene.darts.min_distance, ref::straight_length);
    const auto brute = ref::throw_brute_force(disks.size(), [&](std::uint32_t i, std::uint32_t j) {
        return std::hypot(of(i)[0] - of(j)[0], of(i)[1] - of(j)[1], of(i)[2] - of(j)[2]) <
               scene.darts.min_distance;
    });
    const auto straight = ref::throw_in_order(disks);
    CHECK(straight == brute);
    // Both sides together have about as many as one has.
    CHECK(straight.size() < 0.7 * static_cast<double>(scene.darts.ranks.size()));
    CHECK(straight.size() > 0.4 * static_cast<double>(scene.darts.ranks.size()));
}

TEST_CASE("phase groups: darts of different cells of a group cannot conflict") {
    const PoolScene scene(builtin("icosphere", 2), 60);
    ref::GeodesicDisks disks(scene.prepared_mesh, scene.darts.min_distance, scene.darts.pool,
                             scene.darts.tolerances);
    const Conflicts conflicts(disks);
    const double side = scene.darts.min_distance / std::sqrt(3.0);
    const auto cell_of = [&](std::uint32_t rank) {
        std::array<int, 3> cell{};
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const double x = scene.positions[rank][static_cast<int>(axis)];
            cell[axis] = static_cast<int>(std::floor(x / side));
        }
        return cell;
    };
    std::size_t conflicting = 0;
    for (std::uint32_t rank = 0; rank < disks.size(); ++rank) {
        const auto here = cell_of(rank);
        for (const std::uint32_t other : conflicts.of(rank)) {
            const auto there = cell_of(other);
            bool is_same_group = here != there;
            for (std::size_t axis = 0; axis < 3; ++axis) {
                is_same_group = is_same_group && (here[axis] - there[axis]) % 3 == 0;
            }
            conflicting += is_same_group ? 1u : 0u;
        }
    }
    CHECK(conflicting == 0);
}

TEST_CASE("brute force: by straight distances on a plane") {
    const PoolScene scene(flat_grid(3, 2, 1, 1), 80);
    const double limit = scene.darts.tolerances.limit * scene.darts.min_distance;
    const auto brute = ref::throw_brute_force(
        static_cast<std::uint32_t>(scene.darts.pool.size()), [&](std::uint32_t i, std::uint32_t j) {
            return length(scene.mesh.position(scene.darts.pool[i]) -
                          scene.mesh.position(scene.darts.pool[j])) < limit;
        });
    CHECK(brute == scene.darts.ranks);
}

TEST_CASE("curve length: exact on planes and spheres, never below the straight line") {
    const ref::OrientedPoint flat[] = {{{0, 0, 0}, {0, 0, 1}}, {{3, 4, 0}, {0, 0, 1}}};
    CHECK(ref::curve_length(flat[0], flat[1]) == doctest::Approx(5).epsilon(1e-12));
    CHECK(ref::curve_length(flat[0], flat[0]) == 0);
    for (const double angle : {1e-9, 1e-5, 0.1, 1.0, 3.0}) {
        const Vec3 there{std::sin(angle), std::cos(angle), 0};
        const ref::OrientedPoint sphere[] = {{{0, 1, 0}, {0, 1, 0}}, {there, there}};
        CHECK(ref::curve_length(sphere[0], sphere[1]) == doctest::Approx(angle).epsilon(1e-6));
    }
    const PoolScene scene(builtin("torus-knot", 6), 30);
    for (std::size_t i = 0; i < 100; ++i) {
        const ref::OrientedPoint& a = scene.points[i];
        const ref::OrientedPoint& b = scene.points[i + 100];
        const double straight = length(a.position - b.position);
        CHECK(ref::curve_length(a, b) >= straight * (1 - 1e-12));
        CHECK(ref::curve_length(a, b) == doctest::Approx(ref::curve_length(b, a)));
    }
}

TEST_CASE("oriented points: positions and normals of a sphere") {
    const TestMesh mesh = builtin("icosphere", 4);
    const std::vector<Point> points = random_points(prepared(mesh), 1, 200);
    const auto oriented = ref::oriented_points(mesh.view(), points);
    for (std::size_t i = 0; i < points.size(); ++i) {
        const Vec3 at = mesh.position(points[i]);
        const auto& [position, normal] = oriented[i];
        CHECK(length(position - at) < 1e-15);
        CHECK(dot(normal, at) / length(at) > 0.999);
    }
}
