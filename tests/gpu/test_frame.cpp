// Parts of a mesh in the frame of the whole, and meshes whose faces are renumbered.
#include <doctest/doctest.h>

#include <algorithm>
#include <vector>

#include <geodisk/domain.hpp>
#include <geodisk/job_frame.hpp>

#include "device_run.hpp"
#include "sets.hpp"
#include "support/meshes.hpp"

namespace geodisk::test {
namespace {

/// The faces from `first` to `end` of a mesh in reverse order, with their keys.
struct Part {
    std::vector<std::uint32_t> keys;
    PreparedMesh mesh;

    Part(const TestMesh& whole, std::uint32_t first, std::uint32_t end) {
        TestMesh shape;
        shape.positions = whole.positions;
        for (std::uint32_t f = end; f-- > first;) {
            keys.push_back(f);
            const std::uint32_t* const corners = &whole.triangles[std::size_t{3} * f];
            shape.add_triangle(corners[0], corners[1], corners[2]);
        }
        mesh = prepared(shape);
    }

    SampleParams params(SampleParams of_whole) const {
        of_whole.face_keys = keys;
        return of_whole;
    }
};

SampleSet run(const Domain& domain) {
    Context& context = shared_context();
    Runner runner = expect(Runner::create(context.device(), context.queue()));
    return expect(runner.sample_and_wait(domain));
}

/// With keys for faces.
Points by_key(const SampleSet& set, const std::vector<std::uint32_t>& keys) {
    Points points = points_of(set);
    for (SamplePoint& point : points) {
        point.face = keys[point.face];
    }
    return points;
}

} // namespace

TEST_SUITE("frame") {
    TEST_CASE("a part in the frame of the whole has the samples of the whole") {
        TestMesh shape = builtin("torus-knot", 8);
        const std::uint32_t cut = shape.face_count();
        const TestMesh ball = builtin("icosphere", 3);
        const std::uint32_t first_vertex = shape.vertex_count();
        for (const double x : ball.positions) {
            shape.positions.push_back(0.1 * x);
        }
        for (const std::uint32_t vertex : ball.triangles) {
            shape.triangles.push_back(first_vertex + vertex);
        }
        const PreparedMesh whole = prepared(shape);
        for (const double count : {2.0, 2000.0}) {
            const SampleParams params = params_for(whole, count, 3);
            const JobFrame frame =
                expect(frame_from_bytes(to_bytes(expect(frame_of(whole, params)))));
            const SampleSet all = run(expect(Domain::surface(whole, params, frame)));
            const Points points = points_of(all);
            CHECK(points == points_of(run(expect(Domain::surface(whole, params)))));
            const std::uint32_t end = shape.face_count();
            for (const auto& [first, last] : {std::pair{0u, cut}, std::pair{cut, end}}) {
                const Part part(shape, first, last);
                const SampleSet some =
                    run(expect(Domain::surface(part.mesh, part.params(params), frame)));
                Points expected;
                std::copy_if(points.begin(), points.end(), std::back_inserter(expected),
                             [first = first, last = last](const SamplePoint& p) {
                                 return p.face >= first && p.face < last;
                             });
                CHECK(by_key(some, part.keys) == expected);
                CHECK(some.report.guard == all.report.guard);
            }
        }
    }

    TEST_CASE("renumbered faces with keys have the same samples in the same order") {
        const TestMesh shape = builtin("icosphere", 3);
        const PreparedMesh mesh = prepared(shape);
        const Part renumbered(shape, 0, shape.face_count());
        const SampleParams params = params_for(mesh, 20000, 7);
        std::vector<std::uint32_t> keys(renumbered.keys.rbegin(), renumbered.keys.rend());
        SampleParams keyed = params;
        keyed.face_keys = keys;
        const Points points = by_key(sample(mesh, keyed), keys);
        CHECK(points.size() > 15000);
        CHECK(by_key(sample(renumbered.mesh, renumbered.params(params)), renumbered.keys) ==
              points);
    }
}

} // namespace geodisk::test
