// Farthest-point order: each sample is the farthest from those before it.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <utility>
#include <vector>

#include <geodisk/farthest.hpp>
#include <geodisk/neighbours.hpp>
#include <geodisk/request.hpp>

#include "device_run.hpp"
#include "engine/run/runner_impl.hpp"
#include "mesh/edge_paths.hpp"
#include "support/geodesic_query.hpp"
#include "support/meshes.hpp"

namespace geodisk::test {
namespace {

constexpr double kInfinite = std::numeric_limits<double>::infinity();
// Part of the size of the mesh that a distance may be off.
constexpr double kFarthestPrecision = 1e-6;

std::vector<Sample> samples_on(const PreparedMesh& mesh, std::uint64_t seed, std::uint32_t count) {
    std::vector<Sample> samples;
    for (const Point& p : random_points(mesh, seed, count)) {
        samples.push_back({p.face,
                           {static_cast<float>(1 - p.weight1 - p.weight2),
                            static_cast<float>(p.weight1), static_cast<float>(p.weight2)}});
    }
    return samples;
}

Runner& farthest_runner() {
    static Runner runner =
        expect(Runner::create(shared_context().device(), shared_context().queue()));
    return runner;
}

FarthestOrder ordered(const PreparedMesh& mesh, std::span<const Sample> samples,
                      const FarthestParams& params = {}) {
    return expect(farthest_order(farthest_runner(), mesh, samples, params));
}

/// Goes on greedily in the order found after existing samples, by distances of the twin in double
/// precision. Returns how many samples come where another one would, since rounding makes no
/// difference between them.
std::size_t check_greedy(const PreparedMesh& mesh, const std::vector<Sample>& samples,
                         const FarthestOrder& order, std::size_t existing = 1) {
    std::vector<Point> points;
    for (const Sample& s : samples) {
        points.push_back({s.face, s.weights[1], s.weights[2]});
    }
    const double size = 4 * std::sqrt(mesh.statistics().area);
    GeodesicQuery<double> twin(mesh, size, points, tight_tolerances());
    std::vector<double> distances(samples.size(), kInfinite);
    std::size_t others = 0;
    for (std::size_t k = 0; k < order.indices.size(); ++k) {
        const std::uint32_t chosen = order.indices[k];
        const auto farthest = std::ranges::max_element(distances);
        const double error = kFarthestPrecision * size;
        REQUIRE(distances[chosen] >= 0); // Not chosen before.
        if (k >= existing) {
            CHECK((distances[chosen] == *farthest || distances[chosen] >= *farthest - error));
            CHECK((distances[chosen] == order.distances[k] ||
                   std::abs(distances[chosen] - double{order.distances[k]}) <= error));
            others += farthest - distances.begin() != chosen;
        } else {
            CHECK(std::isinf(order.distances[k]));
        }
        const std::vector<double> from = twin.from(points[chosen]);
        for (std::size_t i = 0; i < distances.size(); ++i) {
            distances[i] = std::min(distances[i], from[i]);
        }
        distances[chosen] = -1;
    }
    const double cover = std::max(0.0, *std::ranges::max_element(distances));
    CHECK((cover == order.cover ||
           std::abs(cover - double{order.cover}) <= kFarthestPrecision * size));
    CHECK(std::ranges::is_sorted(order.distances, std::greater<>()));
    return others;
}

TestMesh twice(const TestMesh& mesh, double apart) {
    TestMesh both = mesh;
    for (std::uint32_t v = 0; v < mesh.vertex_count(); ++v) {
        const Vec3 p = mesh.vertex(v);
        both.add_vertex({p.x + apart, p.y, p.z});
    }
    for (std::size_t at = 0; at < mesh.triangles.size(); at += 3) {
        const std::uint32_t first = mesh.vertex_count();
        both.add_triangle(mesh.triangles[at] + first, mesh.triangles[at + 1] + first,
                          mesh.triangles[at + 2] + first);
    }
    return both;
}

Error farthest_refusal(const PreparedMesh& mesh, std::span<const Sample> samples,
                       const FarthestParams& params = {}, const ProgressCallback& progress = {}) {
    auto order = farthest_order(farthest_runner(), mesh, samples, params, progress);
    REQUIRE_FALSE(order);
    return order.error();
}

} // namespace

TEST_SUITE("farthest") {
    TEST_CASE("each sample is the farthest from those before it") {
        for (const auto& [name, resolution] :
             {std::pair("torus-knot", 8), std::pair("plate", 4), std::pair("moebius", 4),
              std::pair("icosphere", 3)}) {
            const PreparedMesh mesh = prepared(builtin(name, resolution));
            const std::vector<Sample> samples = samples_on(mesh, 5, 150);
            const FarthestOrder order = ordered(mesh, samples);
            REQUIRE(order.indices.size() == samples.size());
            CHECK(order.indices[0] == 0);
            CHECK(check_greedy(mesh, samples, order) <= 2);
            CHECK(order.searches < 20); // Not one for each.
            CHECK(order.report.disks >= samples.size());
        }
        const PreparedMesh mesh = prepared(tetrahedra(2, 0.2)); // Edges of many faces.
        const std::vector<Sample> samples = samples_on(mesh, 2, 60);
        CHECK(check_greedy(mesh, samples, ordered(mesh, samples)) <= 2);
    }

    TEST_CASE("the first ones of an order are the order of so many") {
        const PreparedMesh mesh = prepared(builtin("torus-knot", 8));
        const std::vector<Sample> samples = samples_on(mesh, 9, 200);
        const FarthestOrder all = ordered(mesh, samples);
        const FarthestOrder some = ordered(mesh, samples, {40});
        CHECK(some.indices == std::vector(all.indices.begin(), all.indices.begin() + 40));
        CHECK(std::abs(some.cover - all.distances[40]) <= some.error);
        CHECK(check_greedy(mesh, samples, some) == 0);
        CHECK(all.cover == 0);
        CHECK(some.report.disks < all.report.disks);
    }

    TEST_CASE("an order goes on from existing samples, and begins with any") {
        for (const auto& [name, resolution] : {std::pair("torus-knot", 8), std::pair("plate", 4)}) {
            const PreparedMesh mesh = prepared(builtin(name, resolution));
            const std::vector<Sample> samples = samples_on(mesh, 6, 120);
            for (const std::uint32_t existing : {1U, 9U, 60U, 120U}) {
                const FarthestOrder order = ordered(mesh, samples, {0, 0, existing});
                REQUIRE(order.indices.size() == samples.size());
                CHECK(std::ranges::is_sorted(std::span(order.indices).first(existing)));
                CHECK(order.indices[existing - 1] == existing - 1);
                CHECK(check_greedy(mesh, samples, order, existing) <= 2);
                CHECK(order.searches < 20);
            }
            CHECK(ordered(mesh, samples, {0, 0, 1}).indices == ordered(mesh, samples).indices);
            const FarthestOrder few = ordered(mesh, samples, {30, 0, 9});
            const FarthestOrder all = ordered(mesh, samples, {0, 0, 9});
            CHECK(few.indices == std::vector(all.indices.begin(), all.indices.begin() + 30));
            CHECK(std::abs(few.cover - all.distances[30]) <= few.error);
            const FarthestOrder other = ordered(mesh, samples, {0, 77});
            CHECK(other.indices[0] == 77);
            CHECK(check_greedy(mesh, samples, other) <= 2);
        }
        // Two of four parts have existing samples.
        const PreparedMesh mesh = prepared(twice(twice(builtin("icosphere", 2), 3), 20));
        std::vector<Sample> samples = samples_on(mesh, 3, 60);
        std::ranges::sort(samples, {}, &Sample::face);
        const FarthestOrder order = ordered(mesh, samples, {0, 0, 20});
        check_greedy(mesh, samples, order, 20);
        const FarthestOrder start = ordered(mesh, samples, {0, 31});
        CHECK(start.indices[0] == 31);
        check_greedy(mesh, samples, start);
    }

    TEST_CASE("orders from where there is no sample are refused") {
        const PreparedMesh mesh = prepared(builtin("cube", 2));
        const std::vector<Sample> samples = samples_on(mesh, 6, 5);
        CHECK(farthest_refusal(mesh, samples, {0, 5}).message ==
              "start is 5, but there are 5 samples, counted from 0");
        CHECK(farthest_refusal(mesh, samples, {0, 1, 1}).message ==
              "start and existing exclude each other: existing samples come first");
        CHECK(farthest_refusal(mesh, samples, {0, 0, 6}).message ==
              "6 samples are existing ones, more than 5 to choose");
        CHECK(farthest_refusal(mesh, samples, {2, 0, 3}).message ==
              "3 samples are existing ones, more than 2 to choose");
    }

    TEST_CASE("parts that no path leads to come first") {
        const TestMesh one = builtin("icosphere", 2);
        const PreparedMesh mesh = prepared(twice(twice(one, 3), 20));
        std::vector<Sample> samples = samples_on(mesh, 3, 60);
        std::ranges::sort(samples, {}, &Sample::face); // Those of each part together.
        std::rotate(samples.begin(), samples.begin() + 20, samples.end());
        const FarthestOrder order = ordered(mesh, samples);
        for (std::size_t k = 0; k < order.indices.size(); ++k) {
            CHECK(std::isinf(order.distances[k]) == (k < 4));
        }
        CHECK(std::is_sorted(order.indices.begin(), order.indices.begin() + 4));
        check_greedy(mesh, samples, order);
        const FarthestOrder three = ordered(mesh, samples, {3});
        CHECK(std::isinf(three.cover));
    }

    TEST_CASE("samples at one place come last, the lower one first") {
        const PreparedMesh mesh = prepared(builtin("cube", 2));
        std::vector<Sample> samples = samples_on(mesh, 3, 20);
        const std::vector<Sample> again = samples;
        samples.insert(samples.end(), again.begin(), again.end());
        const FarthestOrder order = ordered(mesh, samples);
        for (std::size_t k = 20; k < 40; ++k) {
            CHECK(order.distances[k] == 0);
            CHECK(order.indices[k] == k);
        }
        check_greedy(mesh, samples, order);
        const std::vector<Sample> same(5, samples[3]);
        CHECK(ordered(mesh, same).indices == std::vector<std::uint32_t>{0, 1, 2, 3, 4});
    }

    TEST_CASE("one sample, and as many as there are") {
        const PreparedMesh mesh = prepared(builtin("cube", 2));
        const std::vector<Sample> samples = samples_on(mesh, 3, 3);
        const FarthestOrder one = ordered(mesh, std::span(samples).first(1));
        CHECK(one.indices == std::vector<std::uint32_t>{0});
        CHECK(std::isinf(one.distances[0]));
        CHECK(one.cover == 0);
        CHECK(ordered(mesh, samples, {3}).indices == ordered(mesh, samples).indices);
    }

    TEST_CASE("does not depend on memory, kernels or lanes") {
        const PreparedMesh mesh = prepared(builtin("torus-knot", 8));
        const std::vector<Sample> samples = samples_on(mesh, 5, 300);
        const FarthestOrder order = ordered(mesh, samples);
        RunnerOptions narrow;
        narrow.plan.slots = 16;
        narrow.plan.window_capacity = 8;
        narrow.plan.table_capacity = 16;
        narrow.plan.disks_by = DisksBy::groups;
        narrow.sampler.tuning.reads = Reads::storage;
        narrow.device_bytes = 4 << 20;
        Runner runner =
            expect(Runner::create(shared_context().device(), shared_context().queue(), narrow));
        const FarthestOrder other = expect(farthest_order(runner, mesh, samples));
        CHECK(other.indices == order.indices);
        CHECK(other.distances == order.distances);
    }

    TEST_CASE("tells how far it is, and stops") {
        const PreparedMesh mesh = prepared(builtin("torus-knot", 8));
        const std::vector<Sample> samples = samples_on(mesh, 5, 50);
        std::uint32_t last = 0;
        const auto heard = [&](const Progress& now) {
            CHECK(now.candidates == 30);
            CHECK(now.decided >= last);
            CHECK(now.decided <= 30);
            last = now.decided;
            return true;
        };
        CHECK(farthest_order(farthest_runner(), mesh, samples, {30}, heard));
        CHECK(last > 20);
        const Error error =
            farthest_refusal(mesh, samples, {}, [](const Progress&) { return false; });
        CHECK(error.status == Status::cancelled);
    }

    TEST_CASE("a mesh whose faces the device cannot bind at once is refused before it is sampled") {
        const auto& limits = Runner::Impl::of(farthest_runner()).engine().report.limits;
        if (limits.max_storage_buffer_range > 128u << 20) {
            return; // No mesh of this size is too large.
        }
        const PreparedMesh mesh = prepared(builtin("terrain", 1030));
        SampleRequest request;
        request.params.min_distance = 0.1;
        request.order = SampleOrder::farthest;
        bool has_begun = false;
        const auto found = geodisk::sample(farthest_runner(), mesh, request, [&](const Progress&) {
            has_begun = true;
            return true;
        });
        REQUIRE_FALSE(found);
        CHECK(found.error().status == Status::job_too_large);
        CHECK(found.error().message.starts_with("the farthest order takes all 2121800 faces"));
        CHECK_FALSE(has_begun);
    }

    TEST_CASE("vertices are no farther than their bounds, and not much nearer") {
        const PreparedMesh meshes[] = {
            prepared(builtin("torus-knot", 8)), prepared(builtin("plate", 4)),
            prepared(twice(builtin("icosphere", 2), 3)), prepared(tetrahedra(2, 0.2))};
        for (const PreparedMesh& mesh : meshes) {
            const double size = 4 * std::sqrt(mesh.statistics().area);
            std::vector<Sample> points = samples_on(mesh, 5, 40);
            std::erase_if(points, [](const Sample& s) { return s.face % 3 == 0; });
            std::vector<float> distances(points.size());
            for (std::size_t i = 0; i < points.size(); ++i) {
                distances[i] = 0.01f * static_cast<float>(size) * static_cast<float>(i % 5);
            }
            NeighbourQuery query;
            query.sources = points;
            query.within = size;
            const Neighbours found = expect(find_neighbours(farthest_runner(), mesh, query));
            std::vector<double> least(mesh.vertex_count(), kInfinite);
            for (std::size_t i = 0; i < points.size(); ++i) {
                for (std::size_t at = found.offsets[i]; at < found.offsets[i + 1]; ++at) {
                    double& own = least[found.indices[at]];
                    own = std::min(own, double{distances[i]} + double{found.distances[at]});
                }
            }
            EdgePaths paths(mesh);
            for (std::size_t i = 0; i < points.size(); ++i) {
                paths.begin_at(points[i], distances[i]);
            }
            const std::vector<double>& bounds = paths.lengths();
            REQUIRE(bounds.size() == least.size());
            double most = 0;
            for (std::size_t v = 0; v < bounds.size(); ++v) {
                REQUIRE(std::isinf(bounds[v]) == std::isinf(least[v]));
                if (!std::isinf(least[v])) {
                    CHECK(bounds[v] >= least[v] - found.error);
                    most = std::max(most, bounds[v] - least[v]);
                }
            }
            CHECK(most < 0.1 * size);
        }
    }

    TEST_CASE("disks end where samples before are nearer") {
        const PreparedMesh mesh = prepared(builtin("icosphere", 5));
        const std::vector<Sample> samples = samples_on(mesh, 5, 200);
        NeighbourQuery query;
        query.sources = std::span(samples).first(1);
        query.within = 4;
        const auto whole = expect(find_neighbours(farthest_runner(), mesh, query)).report.windows;
        const FarthestOrder order = ordered(mesh, samples);
        CHECK(order.report.windows < 6 * whole);
        CHECK(order.report.disks == samples.size());
    }

    TEST_CASE("what is no sample is refused") {
        const PreparedMesh cube = prepared(builtin("cube", 2));
        std::vector<Sample> samples = samples_on(cube, 3, 3);
        CHECK(farthest_refusal(cube, {}).message == "there is no sample to put in order");
        CHECK(farthest_refusal(cube, samples, {4}).message ==
              "there are 3 samples, fewer than 4 to choose");
        samples[1].face = 48;
        CHECK(farthest_refusal(cube, samples).message ==
              "sample 1 is in face 48, but there are 48");
        CHECK(farthest_refusal(cube, samples).status == Status::invalid_argument);
    }
}

} // namespace geodisk::test
