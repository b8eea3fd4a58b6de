// Neighbours: exact distances from sources to what is near.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <string>
#include <vector>

#include <geodisk/farthest.hpp>
#include <geodisk/nearest.hpp>
#include <geodisk/neighbours.hpp>

#include "device_run.hpp"
#include "engine/neighbours/search_jobs.hpp"
#include "engine/neighbours/search_within.hpp"
#include "sets.hpp"
#include "support/geodesic_query.hpp"
#include "support/meshes.hpp"
#include "support/oracle_geodesic.hpp"

namespace geodisk::test {
namespace {

// Part of the distance asked for that a float result may be off, as the library promises.
constexpr double kPrecision = 1e-5;

Runner& shared_runner() {
    static Runner runner =
        expect(Runner::create(shared_context().device(), shared_context().queue()));
    return runner;
}

Neighbours found_by(const RunnerOptions& options, const PreparedMesh& mesh,
                    const NeighbourQuery& query) {
    Runner runner =
        expect(Runner::create(shared_context().device(), shared_context().queue(), options));
    return expect(find_neighbours(runner, mesh, query));
}

/// With the plan of the library, by a runner that is kept.
Neighbours found(const PreparedMesh& mesh, const NeighbourQuery& query) {
    return expect(find_neighbours(shared_runner(), mesh, query));
}

Error refusal(const PreparedMesh& mesh, const NeighbourQuery& query,
              const ProgressCallback& progress = {}) {
    Runner& runner = shared_runner();
    auto neighbours = find_neighbours(runner, mesh, query, progress);
    REQUIRE_FALSE(neighbours);
    // The runner stays usable.
    NeighbourQuery small;
    const std::vector<Sample> source{{0, {1, 0, 0}}};
    small.sources = source;
    small.within = std::sqrt(mesh.statistics().area);
    CHECK(find_neighbours(runner, mesh, small));
    return neighbours.error();
}

std::vector<Sample> samples_at_points(const std::vector<Point>& points) {
    std::vector<Sample> samples;
    for (const Point& p : points) {
        samples.push_back({p.face,
                           {static_cast<float>(1 - p.weight1 - p.weight2),
                            static_cast<float>(p.weight1), static_cast<float>(p.weight2)}});
    }
    return samples;
}

std::vector<Point> face_points_of(std::span<const Sample> samples) {
    std::vector<Point> points;
    for (const Sample& s : samples) {
        points.push_back({s.face, s.weights[1], s.weights[2]});
    }
    return points;
}

/// Checks the row of a source against distances to all targets.
void check_row(const Neighbours& lists, std::size_t source, double within,
               const std::vector<double>& distances, double error) {
    std::size_t at = lists.offsets[source];
    const std::size_t end = lists.offsets[source + 1];
    double worst = 0;
    std::size_t missing = 0, beyond = 0;
    for (std::uint32_t target = 0; target < distances.size(); ++target) {
        if (at < end && lists.indices[at] == target) {
            const double distance{lists.distances[at++]};
            worst = std::max(worst, std::abs(distance - distances[target]));
            beyond += distance > within;
        } else {
            missing += distances[target] <= within - error;
        }
    }
    CHECK(at == end);
    CHECK(worst <= error);
    CHECK(missing == 0);
    CHECK(beyond == 0);
}

/// Checks all rows against the twin in double precision.
void check_as_twin(const PreparedMesh& mesh, const NeighbourQuery& query,
                   const std::vector<Point>& targets, const Neighbours& lists) {
    REQUIRE(lists.offsets.size() == query.sources.size() + 1);
    CHECK(lists.offsets.front() == 0);
    CHECK(lists.offsets.back() == lists.indices.size());
    CHECK(lists.distances.size() == lists.indices.size());
    ref::Tolerances tolerances = tight_tolerances();
    tolerances.limit = 1.001f;
    GeodesicQuery<double> twin(mesh, query.within, targets, tolerances);
    const std::vector<Point> sources = face_points_of(query.sources);
    for (std::size_t i = 0; i < sources.size(); ++i) {
        check_row(lists, i, query.within, twin.from(sources[i]),
                  std::min(lists.error, kPrecision * query.within));
    }
}

/// Checks the neighbours of some vertices and random points, among vertices and points. Returns
/// those of the vertices.
Neighbours check_mesh(const PreparedMesh& mesh, double within) {
    std::vector<Sample> sources = expect(vertex_points(mesh)).points;
    REQUIRE(sources.size() == mesh.vertex_count());
    const std::vector<Point> vertices = face_points_of(sources);
    std::vector<Sample> some;
    for (std::size_t i = 0; i < sources.size();
         i += std::max<std::size_t>(1, sources.size() / 20)) {
        some.push_back(sources[i]);
    }
    const std::vector<Sample> points = samples_at_points(random_points(mesh, 7, 300));
    some.insert(some.end(), points.begin(), points.begin() + 20);
    NeighbourQuery query;
    query.sources = some;
    query.within = within;
    const Neighbours lists = found(mesh, query);
    check_as_twin(mesh, query, vertices, lists);
    CHECK(lists.error < 10 * kPrecision * within);
    query.kind = NeighbourKind::points;
    query.points = points;
    check_as_twin(mesh, query, face_points_of(points), found(mesh, query));
    return lists;
}

void check_same(const Neighbours& lists, const Neighbours& other) {
    CHECK(other.offsets == lists.offsets);
    CHECK(other.indices == lists.indices);
    CHECK(other.distances == lists.distances);
}

/// Checks that nothing changes where the mesh is searched in parts.
void check_in_parts(const PreparedMesh& mesh, const NeighbourQuery& query,
                    const Neighbours& lists) {
    Runner::Impl& runner = Runner::Impl::of(shared_runner());
    const SearchJobs jobs = expect(SearchJobs::create(mesh, query));
    for (const std::uint32_t parts : {2u, 5u}) {
        CAPTURE(parts);
        const Neighbours other = expect(
            runner.complete(search_in_parts(runner, mesh, query, jobs.frame(), parts), 0, {}));
        check_same(lists, other);
        CHECK(other.error <= 2 * lists.error);
    }
}

/// Checks that nothing changes with little memory, other kernels and few lanes, and in parts.
void check_narrow(const PreparedMesh& mesh, const NeighbourQuery& query, const Neighbours& lists) {
    RunnerOptions narrow;
    narrow.plan.slots = 16;
    narrow.plan.window_capacity = 8;
    narrow.plan.table_capacity = 16;
    narrow.plan.disks_by = DisksBy::groups;
    narrow.sampler.tuning.reads = Reads::storage;
    narrow.device_bytes = 4 << 20;
    check_same(lists, found_by(narrow, mesh, query));
    if (query.has_distances()) {
        check_in_parts(mesh, query, lists);
    }
}

} // namespace

TEST_SUITE("neighbours") {
    TEST_CASE("are those that the twin finds, at the same distances") {
        const PreparedMesh knot = prepared(builtin("torus-knot", 8));
        const double within = 3 * std::sqrt(knot.statistics().area / knot.vertex_count());
        check_mesh(knot, within);
        check_mesh(knot, 20 * within);
        for (const auto& [name, resolution] :
             {std::pair("cube", 4), std::pair("plate", 4), std::pair("moebius", 4),
              std::pair("icosphere", 3)}) {
            const PreparedMesh mesh = prepared(builtin(name, resolution));
            check_mesh(mesh, std::sqrt(mesh.statistics().area) / 5);
            check_mesh(mesh, 1000 * std::sqrt(mesh.statistics().area));
        }
        check_mesh(prepared(tetrahedra(2, 0.2)), 0.6);
    }

    TEST_CASE("lie at the distances that CGAL finds") {
        for (const auto& [name, resolution] :
             {std::pair("torus-knot", 4), std::pair("icosphere", 2), std::pair("plate", 3)}) {
            const TestMesh shape = builtin(name, resolution);
            const PreparedMesh mesh = prepared(shape);
            const std::vector<Sample> all = expect(vertex_points(mesh)).points;
            NeighbourQuery query;
            query.within = std::sqrt(mesh.statistics().area) / 3;
            query.sources = std::span(all).first(8);
            const Neighbours lists = found(mesh, query);
            GeodesicOracle oracle(shape);
            const std::vector<Point> targets = face_points_of(all);
            for (std::size_t i = 0; i < query.sources.size(); ++i) {
                check_row(lists, i, query.within, oracle.distances(targets[i], targets),
                          kPrecision * query.within);
            }
        }
    }

    TEST_CASE("do not depend on memory, kernels or lanes") {
        const PreparedMesh knot = prepared(builtin("torus-knot", 12));
        const std::vector<Sample> sources = expect(vertex_points(knot)).points;
        NeighbourQuery query;
        query.sources = sources;
        query.within = 3 * std::sqrt(knot.statistics().area / knot.vertex_count());
        const Neighbours lists = found(knot, query);
        CHECK(lists.indices.size() > 20 * sources.size());
        for (std::size_t i = 0; i < sources.size(); ++i) { // Each finds itself, and is found.
            const auto row =
                std::span(lists.indices)
                    .subspan(lists.offsets[i], lists.offsets[i + 1] - lists.offsets[i]);
            const auto own = std::ranges::lower_bound(row, i);
            REQUIRE((own != row.end() && *own == i));
            CHECK(lists.distances[static_cast<std::size_t>(&*own - lists.indices.data())] == 0);
        }
        check_narrow(knot, query, lists);
        query.kind = NeighbourKind::sources;
        check_narrow(knot, query, found(knot, query));
        query.within *= 4;
        query.sources = std::span(sources).first(50);
        check_narrow(knot, query, found(knot, query));
    }

    TEST_CASE("a mesh that the device cannot hold is searched in parts") {
        const PreparedMesh terrain = prepared(builtin("terrain", 250));
        const std::vector<Sample> sources = samples_at_points(random_points(terrain, 5, 2000));
        RunnerOptions little; // Less than the faces and their fans take.
        little.device_bytes = 12 << 20;
        NeighbourQuery query;
        query.sources = sources;
        query.within = 0.03;
        check_same(found(terrain, query), found_by(little, terrain, query));
        query.kind = NeighbourKind::sources;
        query.nearest = 6;
        query.within = 0;
        check_same(found(terrain, query), found_by(little, terrain, query));
        query.within = 100; // Each part has all of the surface around it.
        query.nearest = 0;
        Runner runner =
            expect(Runner::create(shared_context().device(), shared_context().queue(), little));
        const auto wide = find_neighbours(runner, terrain, query);
        REQUIRE_FALSE(wide);
        CHECK(wide.error().status == Status::out_of_device_memory);
        query.max_pairs = 100; // No memory helps.
        const auto many = find_neighbours(runner, terrain, query);
        REQUIRE_FALSE(many);
        CHECK(many.error().status == Status::job_too_large);
    }

    TEST_CASE("each source has a distance of its own") {
        const PreparedMesh knot = prepared(builtin("torus-knot", 8));
        const std::vector<Sample> sources = samples_at_points(random_points(knot, 3, 90));
        const double least = std::sqrt(knot.statistics().area / knot.vertex_count());
        std::vector<double> radii;
        for (std::size_t i = 0; i < sources.size(); ++i) {
            radii.push_back(least * (1 + static_cast<double>(i % 10)));
        }
        NeighbourQuery query;
        query.sources = sources;
        query.radii = radii;
        const Neighbours lists = found(knot, query);
        const std::vector<Point> vertices = face_points_of(expect(vertex_points(knot)).points);
        ref::Tolerances tolerances = tight_tolerances();
        GeodesicQuery<double> twin(knot, 11 * least, vertices, tolerances);
        for (std::size_t i = 0; i < sources.size(); ++i) {
            check_row(lists, i, radii[i], twin.from(face_points_of(sources)[i]),
                      kPrecision * 10 * least);
        }
        check_narrow(knot, query, lists);
    }

    TEST_CASE("other sources, and only the nearest") {
        const PreparedMesh knot = prepared(builtin("torus-knot", 8));
        const std::vector<Sample> sources = samples_at_points(random_points(knot, 5, 200));
        NeighbourQuery query;
        query.sources = sources;
        query.within = std::sqrt(knot.statistics().area) / 4;
        query.kind = NeighbourKind::sources;
        const Neighbours all = found(knot, query);
        query.nearest = 5;
        const Neighbours near = found(knot, query);
        CHECK(near.error < all.error);
        for (std::size_t i = 0; i < sources.size(); ++i) {
            std::vector<std::pair<float, std::uint32_t>> row, kept;
            for (std::size_t at = all.offsets[i]; at < all.offsets[i + 1]; ++at) {
                CHECK(all.indices[at] != i);
                row.emplace_back(all.distances[at], all.indices[at]);
            }
            for (std::size_t at = near.offsets[i]; at < near.offsets[i + 1]; ++at) {
                kept.emplace_back(near.distances[at], near.indices[at]);
            }
            std::ranges::sort(row);
            row.resize(std::min<std::size_t>(row.size(), 5));
            REQUIRE(row.size() == kept.size());
            for (std::size_t k = 0; k < row.size(); ++k) {
                CHECK(row[k].second == kept[k].second);
                CHECK(std::abs(row[k].first - kept[k].first) <= all.error);
            }
        }
        CHECK(near.report.windows < all.report.windows / 4);
        query.within = 0;
        const Neighbours alone = found(knot, query);
        CHECK(near.indices == alone.indices);
        CHECK(near.distances == alone.distances);
        CHECK(near.report.windows == alone.report.windows);

        // A distance that is short for the mesh cuts the lists too.
        query.within = 1e-6;
        CHECK(found(knot, query).indices.empty());

        // As many as there are within the distance, or within that of each source.
        query.within = std::sqrt(knot.statistics().area) / 20;
        query.nearest = 0;
        const Neighbours close = found(knot, query);
        query.nearest = 5;
        const Neighbours few = found(knot, query);
        std::vector<double> radii(sources.size(), query.within);
        radii[3] = 2 * query.within;
        query.radii = radii;
        const Neighbours own = found(knot, query);
        std::size_t lacking = 0;
        for (std::size_t i = 0; i < sources.size(); ++i) {
            const auto count = [&](const Neighbours& lists) {
                return lists.offsets[i + 1] - lists.offsets[i];
            };
            lacking += count(close) < 5;
            CHECK(count(few) == std::min<std::size_t>(count(close), 5));
            CHECK((i == 3 || count(own) == count(few)));
        }
        CHECK(lacking > 20);
        CHECK(lacking < sources.size());
    }

    TEST_CASE("the nearest ones, however far they are") {
        TestMesh two = builtin("icosphere", 2); // And another one, far away and without an end.
        const std::uint32_t first = two.vertex_count(), faces = two.face_count();
        for (std::uint32_t v = 0; v < first; ++v) {
            const Vec3 p = two.vertex(v);
            two.add_vertex({p.x + 9, p.y, p.z});
        }
        for (std::uint32_t f = 0; f < faces; ++f) {
            const std::size_t at = std::size_t{3} * f;
            two.add_triangle(two.triangles[at] + first, two.triangles[at + 1] + first,
                             two.triangles[at + 2] + first);
        }
        const PreparedMesh mesh = prepared(two);
        std::vector<Sample> points = samples_at_points(random_points(mesh, 5, 40));
        std::erase_if(points, [&](const Sample& s) { return s.face >= faces + 60; });
        const std::vector<Sample> sources = expect(vertex_points(mesh)).points;
        NeighbourQuery query;
        query.sources = sources;
        query.kind = NeighbourKind::points;
        query.points = points;
        query.nearest = 3;
        const Neighbours near = found(mesh, query);
        query.within = 100;
        const Neighbours all = found(mesh, query);
        CHECK(near.offsets == all.offsets);
        CHECK(near.indices == all.indices);
        CHECK(near.offsets.back() < 3 * sources.size()); // Fewer there.
        for (std::size_t i = 0; i < near.distances.size(); ++i) {
            CHECK(std::abs(near.distances[i] - all.distances[i]) < 1e-5);
        }
        query.within = 0;
        query.kind = NeighbourKind::sources;
        query.nearest = 500; // All others of their sphere.
        query.sources = points;
        const Neighbours others = found(mesh, query);
        const auto on_first = static_cast<std::uint64_t>(
            std::ranges::count_if(points, [&](const Sample& s) { return s.face < faces; }));
        const std::uint64_t on_second = points.size() - on_first;
        CHECK(others.indices.size() == on_first * (on_first - 1) + on_second * (on_second - 1));
        query.nearest = 0;
        CHECK(refusal(mesh, query).message.find("is not positive and finite") != std::string::npos);
    }

    TEST_CASE("what cannot be asked is refused") {
        const PreparedMesh cube = prepared(builtin("cube", 2));
        std::vector<Sample> sources = expect(vertex_points(cube)).points;
        NeighbourQuery good;
        good.sources = sources;
        good.within = 0.5;
        const auto message = [&](auto change) {
            NeighbourQuery query = good;
            change(query);
            const Error error = refusal(cube, query);
            CHECK(error.status == Status::invalid_argument);
            return error.message;
        };
        using Query = NeighbourQuery;
        CHECK(message([](Query& q) { q.sources = {}; }) == "there is no source");
        for (const double within : {0.0, -1.0, std::numeric_limits<double>::infinity(),
                                    std::numeric_limits<double>::quiet_NaN()}) {
            CHECK(message([&](Query& q) {
                      q.within = within;
                  }).find("which is not positive and finite") != std::string::npos);
        }
        std::vector<double> radii(sources.size() - 1, 1);
        CHECK(message([&](Query& q) { q.radii = radii; }) == "there are 25 radii for 26 sources");
        radii.push_back(0);
        CHECK(message([&](Query& q) { q.radii = radii; }) ==
              "the radius of source 25 is 0, which is not positive and finite");
        CHECK(message([](Query& q) { q.kind = NeighbourKind::points; }) ==
              "there is no point among which neighbours are");
        CHECK(message([](Query& q) {
                  q.within = 1e-5;
              }).find("the distance is too small for this mesh: its longest edge is") == 0);
        sources[3] = {1000, {1, 0, 0}};
        CHECK(message([](Query&) {}) == "source 3 is in face 1000, but there are 48");
        sources[3] = {0, {1, 1, 0}};
        CHECK(message([](Query&) {}) ==
              "source 3 has weights that are negative or do not sum to 1");
        sources[3] = {0, {1, 0, 0}};
        good.max_pairs = 100;
        good.within = 10;
        const Error too_many = refusal(cube, good);
        CHECK(too_many.status == Status::job_too_large);
        CHECK(too_many.message.find("about 676 pairs are to be expected, more than the 100") == 0);
        // The error comes before the search, of which nothing is heard.
        CHECK(refusal(cube, good, [](const Progress&) { return false; }).status ==
              Status::job_too_large);
        good.kind = NeighbourKind::sources;
        CHECK(refusal(cube, good).message.find("about 650 pairs are to be expected") == 0);
        good.nearest = 4;
        good.max_pairs = 103;
        CHECK(refusal(cube, good).message.find("about 104 pairs are to be expected") == 0);
        good.kind = NeighbourKind::vertices;
        good.nearest = 0;
        good.max_pairs = 676;
        CHECK(found(cube, good).indices.size() == 676);
        CHECK(refusal(cube, good, [](const Progress&) { return false; }).status ==
              Status::cancelled);
    }

    TEST_CASE("distances that no float holds are refused") {
        for (const double unit : {1e-60, 1e-12, 1e12, 1e39, 1e60}) {
            CAPTURE(unit);
            const bool is_right = unit == 1e-12 || unit == 1e12;
            TestMesh square = flat_grid(1, 1, 1, 1);
            for (double& coordinate : square.positions) {
                coordinate *= unit;
            }
            const PreparedMesh mesh = prepared(square);
            const std::vector<Sample> corners{{0, {1, 0, 0}}, {0, {0, 1, 0}}, {0, {0, 0, 1}}};
            NeighbourQuery query;
            query.sources = corners;
            query.kind = NeighbourKind::sources;
            query.within = 1.2 * unit;
            const auto check = [&](const auto& result) {
                REQUIRE(static_cast<bool>(result) == is_right);
                if (!is_right) {
                    CHECK(result.error().status == Status::mesh_rejected);
                    CHECK(result.error().message.ends_with("; rescale the mesh"));
                }
            };
            const auto pairs = find_neighbours(shared_runner(), mesh, query);
            check(pairs);
            query.within = 0;
            query.nearest = 2;
            const auto nearest = find_neighbours(shared_runner(), mesh, query);
            check(nearest);
            const auto order = farthest_order(shared_runner(), mesh, corners);
            check(order);
            const auto samples = NearestSamples::create(shared_runner(), mesh, corners);
            check(samples);
            if (is_right) {
                CHECK(pairs->indices.size() == 4);
                CHECK(double{pairs->distances[0]} == doctest::Approx(unit));
                CHECK(nearest->indices.size() == 6);
                CHECK(double{order->distances[1]} == doctest::Approx(std::sqrt(2.0) * unit));
                const auto found = expect(samples->of(std::vector<Sample>{{0, {0.75f, 0.25f, 0}}}));
                CHECK(double{found[0].distance} == doctest::Approx(unit / 4));
            }
        }
    }
}

} // namespace geodisk::test
