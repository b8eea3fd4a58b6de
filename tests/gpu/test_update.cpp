// Samples that follow edits, against whole runs over the edited surfaces.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>
#include <optional>
#include <random>
#include <string>
#include <vector>

#include <geodisk/update.hpp>

#include "device_run.hpp"
#include "sets.hpp"
#include "support/meshes.hpp"
#include "support/radius_fields.hpp"

namespace geodisk::test {
namespace {

Runner& runner() {
    static Runner made =
        expect(Runner::create(shared_context().device(), shared_context().queue()));
    return made;
}

Points points_of(std::span<const Sample> samples) {
    SampleSet set;
    set.samples.assign(samples.begin(), samples.end());
    return test::points_of(set);
}

/// A surface that is edited, and its samples.
class Scene {
  public:
    Scene(TestMesh shape, double count, std::uint64_t seed, double least_factor = 1,
          bool has_density = false)
        : mesh(std::move(shape)), random_(static_cast<std::uint32_t>(seed)),
          factors(mesh.vertex_count(), 1.0), by_density(has_density) {
        if (least_factor < 1) {
            factors = wavy_factors(mesh, least_factor);
        }
        const PreparedMesh surface = prepare();
        params.seed = seed;
        params.min_distance = distance_for_count(effective_area(surface, params), count);
    }

    /// Samples the surface as it is, and begins to follow it.
    void begin() {
        const PreparedMesh surface = prepare();
        JobFrame frame = expect(frame_of(surface, params));
        frame.longest_edge += 2; // Room for edits.
        const SampleSet set = expect(runner().sample_and_wait(surface, params));
        updater.emplace(expect(Updater::create(mesh.view(), params, frame, set.samples)));
        CHECK(points_of(updater->samples()) == test::points_of(set));
    }

    /// Follows an edit of some faces, and checks the samples against whole runs.
    UpdateReport follow(const std::vector<std::uint32_t>& changed) {
        const PreparedMesh surface = prepare();
        const UpdateReport report = expect(updater->update(runner(), mesh.view(), params, changed));
        const Points points = points_of(updater->samples());
        const Domain whole = expect(Domain::surface(surface, params, updater->frame()));
        CHECK(points == test::points_of(expect(runner().sample_and_wait(whole))));
        if (++edits % 5 == 0) { // In its own frame as well: steps of tolerances are the same.
            CHECK(points == test::points_of(expect(runner().sample_and_wait(surface, params))));
        }
        return report;
    }

    std::uint32_t below(std::uint32_t end) {
        return static_cast<std::uint32_t>(std::uint64_t{random_()} * end >> 32);
    }
    double part() { return static_cast<double>(random_()) * 0x1p-32; }

    std::vector<std::uint32_t> faces_at(std::uint32_t vertex) const {
        std::vector<std::uint32_t> faces;
        for (std::uint32_t i = 0; i < mesh.triangles.size(); ++i) {
            if (mesh.triangles[i] == vertex && (faces.empty() || faces.back() != i / 3)) {
                faces.push_back(i / 3);
            }
        }
        return faces;
    }
    /// Returns the faces near a random place.
    std::vector<std::uint32_t> stroke(double radius) {
        const Vec3 center = mesh.vertex(mesh.triangles[3 * below(mesh.face_count())]);
        std::vector<std::uint32_t> faces;
        for (std::uint32_t f = 0; f < mesh.face_count(); ++f) {
            const Vec3 corner = mesh.corner(f, 0);
            if (std::hypot(corner.x - center.x, corner.y - center.y, corner.z - center.z) <
                radius) {
                faces.push_back(f);
            }
        }
        return faces;
    }

    // Edits. Each returns the faces that it changes.

    std::vector<std::uint32_t> move_vertex(double by) {
        const std::uint32_t vertex = mesh.triangles[below(3 * mesh.face_count())];
        for (std::size_t axis = 0; axis < mesh.dimension; ++axis) {
            mesh.positions[mesh.dimension * vertex + axis] += by * (2 * part() - 1);
        }
        return faces_at(vertex);
    }
    std::vector<std::uint32_t> remove_face() {
        const std::uint32_t face = below(mesh.face_count());
        mesh.triangles[3 * face + 1] = mesh.triangles[3 * face];
        return {face};
    }
    std::vector<std::uint32_t> split_face() {
        const std::uint32_t face = below(mesh.face_count());
        const std::uint32_t a = mesh.triangles[3 * face], b = mesh.triangles[3 * face + 1],
                            c = mesh.triangles[3 * face + 2];
        const auto center = mesh.vertex_count();
        for (std::size_t axis = 0; axis < mesh.dimension; ++axis) {
            mesh.positions.push_back((mesh.positions[mesh.dimension * a + axis] +
                                      mesh.positions[mesh.dimension * b + axis] +
                                      mesh.positions[mesh.dimension * c + axis]) /
                                     3);
        }
        factors.push_back(factors[a]);
        mesh.triangles[3 * face + 2] = center;
        mesh.add_triangle(b, c, center);
        mesh.add_triangle(c, a, center);
        add_to_fields(2);
        return {face};
    }
    std::vector<std::uint32_t> mask_stroke(double radius) {
        mask.resize(mesh.face_count(), 1);
        const auto faces = stroke(radius);
        const auto takes = static_cast<std::uint8_t>(below(2));
        for (const std::uint32_t face : faces) {
            mask[face] = takes;
        }
        return faces;
    }
    std::vector<std::uint32_t> radius_stroke(double radius) {
        std::vector<bool> is_changed(mesh.vertex_count(), false);
        const double factor = 0.4 + 0.6 * part();
        for (const std::uint32_t face : stroke(radius)) {
            is_changed[mesh.triangles[3 * face]] = true;
            factors[mesh.triangles[3 * face]] = factor;
        }
        std::vector<std::uint32_t> changed;
        for (std::uint32_t i = 0; i < mesh.triangles.size(); ++i) {
            if (is_changed[mesh.triangles[i]]) {
                changed.push_back(i / 3);
            }
        }
        return changed;
    }
    std::vector<std::uint32_t> change_given() {
        if (!given.empty() && below(2) == 0) {
            given.erase(given.begin() + below(static_cast<std::uint32_t>(given.size())));
            return {};
        }
        const std::uint32_t face = below(mesh.face_count());
        const std::uint32_t* const c = &mesh.triangles[3 * face];
        if (c[0] != c[1] && c[1] != c[2] && c[2] != c[0]) {
            given.push_back({face, {0.5f, 0.25f, 0.25f}});
        }
        return {};
    }

    TestMesh mesh;
    std::mt19937 random_;
    std::vector<double> factors;
    std::vector<std::uint8_t> mask;
    std::vector<std::uint32_t> keys;
    std::vector<Sample> given;
    bool by_density; ///< Densities are powers of the factors.
    SampleParams params;
    std::optional<RadiusField> radii;
    std::optional<Updater> updater;
    int edits = 0;

    /// Prepares the mesh, and brings the parameters up to date.
    PreparedMesh prepare() {
        PreparedMesh surface = prepared(mesh);
        if (std::ranges::any_of(factors, [](double g) { return g != 1; })) {
            radii =
                by_density ? density_field(surface, densities()) : radius_field(surface, factors);
            params.radii = &*radii;
        }
        params.face_mask = mask;
        params.face_keys = keys;
        // A given sample goes with its face.
        std::erase_if(given, [&](const Sample& sample) {
            const std::uint32_t* const c = &mesh.triangles[3 * sample.face];
            return c[0] == c[1] || c[1] == c[2] || c[2] == c[0];
        });
        params.given = given;
        return surface;
    }

  private:
    std::vector<double> densities() const {
        std::vector<double> result;
        for (const double factor : factors) {
            result.push_back(std::pow(factor, 8));
        }
        return result;
    }
    void add_to_fields(std::uint32_t faces) {
        if (!mask.empty()) {
            mask.resize(mesh.face_count(), 1);
        }
        for (; !keys.empty() && faces > 0; --faces) {
            keys.push_back(1000000 + mesh.face_count() - faces);
        }
    }
};

/// Follows random edits, with steps of these lengths.
void check_edits(Scene& scene, int edits) {
    scene.begin();
    const double distance = scene.params.min_distance;
    const double width = (scene.by_density ? 0.3 : 1.5) * distance; // Of strokes.
    for (int i = 0; i < edits; ++i) {
        CAPTURE(i);
        switch (scene.below(scene.radii ? 7 : 6)) {
        case 0:
        case 1:
            scene.follow(scene.move_vertex(0.3 * distance));
            break;
        case 2:
            scene.follow(scene.remove_face());
            break;
        case 3:
            scene.follow(scene.split_face());
            break;
        case 4:
            scene.follow(scene.mask_stroke(width));
            break;
        case 5:
            scene.follow(scene.change_given());
            break;
        default:
            scene.follow(scene.radius_stroke(width));
        }
    }
}

} // namespace

TEST_SUITE("update") {
    TEST_CASE("the samples are those of whole runs, over many edits") {
        Scene knot(builtin("torus-knot", 8), 800, 1);
        check_edits(knot, 25);
        Scene ball(builtin("icosphere", 4), 600, 2);
        check_edits(ball, 20);
        Scene keyed(builtin("torus-knot", 8), 500, 3);
        keyed.keys.resize(keyed.mesh.face_count());
        std::iota(keyed.keys.rbegin(), keyed.keys.rend(), 5u);
        check_edits(keyed, 15);
    }
    TEST_CASE("on surfaces with borders and edges of many faces") {
        Scene grid(flat_grid(30, 30, 1, 1), 700, 4);
        check_edits(grid, 20);
        Scene blocks(tetrahedra(3, 0.2), 700, 5);
        check_edits(blocks, 20);
        Scene moebius(builtin("moebius", 40), 400, 6);
        check_edits(moebius, 15);
    }
    TEST_CASE("with radii that vary") {
        Scene knot(builtin("torus-knot", 8), 800, 7, 0.4);
        check_edits(knot, 25);
        Scene ball(builtin("icosphere", 4), 600, 8, 0.1);
        check_edits(ball, 15);
        Scene dense(builtin("icosphere", 4), 600, 9, 0.4, true);
        check_edits(dense, 20);
    }
    TEST_CASE("an edit decides only what it can reach") {
        Scene ball(builtin("icosphere", 5), 3000, 11);
        ball.begin();
        const std::vector<Sample> before(ball.updater->samples().begin(),
                                         ball.updater->samples().end());
        const UpdateReport none = ball.follow({});
        CHECK(none.rounds == 0);
        CHECK(none.run.disks == 0);
        CHECK(points_of(before) == points_of(ball.updater->samples()));
        const UpdateReport same = ball.follow({7});
        CHECK(same.rounds == 1);
        CHECK(same.added + same.removed == 0);
        const UpdateReport moved = ball.follow(ball.move_vertex(0.2 * ball.params.min_distance));
        CHECK(moved.run.disks < 300);
        CHECK(moved.uploaded < ball.mesh.face_count() / 10);
        CHECK(moved.run.disks > 0);
    }

    TEST_CASE("a failed update changes nothing, and the next one includes it") {
        Scene ball(builtin("icosphere", 4), 800, 12);
        ball.begin();
        const Points before = points_of(ball.updater->samples());
        const auto changed = ball.move_vertex(0.3 * ball.params.min_distance);
        const TestMesh edited = ball.mesh;
        for (double& x : ball.mesh.positions) { // Far more than the frame has room for.
            x *= 1000;
        }
        const auto failed = ball.updater->update(runner(), ball.mesh.view(), ball.params, changed);
        REQUIRE_FALSE(failed);
        CHECK(failed.error().status == Status::invalid_argument);
        CHECK(points_of(ball.updater->samples()) == before);
        ball.mesh = edited;
        CHECK(ball.follow({}).rounds > 0);
    }

    TEST_CASE("wrong samples and jobs are refused") {
        Scene ball(builtin("icosphere", 3), 300, 13);
        const PreparedMesh surface = ball.prepare();
        const JobFrame frame = expect(frame_of(surface, ball.params));
        const std::vector<Sample> samples =
            expect(runner().sample_and_wait(surface, ball.params)).samples;
        const auto refusal_of = [&](const SampleParams& params, std::span<const Sample> set) {
            const auto made = Updater::create(ball.mesh.view(), params, frame, set);
            REQUIRE_FALSE(made);
            CHECK(made.error().status == Status::invalid_argument);
            return made.error().message;
        };
        const auto refused = [&](SampleParams params) { return refusal_of(params, samples); };
        const auto with = [&](const std::function<void(SampleParams&)>& change) {
            SampleParams params = ball.params;
            change(params);
            return params;
        };
        const std::string unknown =
            " is no candidate of its face: the samples are of another mesh, seed, minimum "
            "distance or pool ratio";
        CHECK(refused(with([](SampleParams& p) { p.seed = 99; })).ends_with(unknown));
        CHECK(refused(with([](SampleParams& p) {
                  p.min_distance *= 2;
              })).starts_with("the job frame is for another job: its minimum distance is"));
        std::vector<std::uint32_t> keys(ball.mesh.face_count());
        std::iota(keys.begin(), keys.end(), 1u);
        CHECK(refused(with([&](SampleParams& p) { p.face_keys = keys; })).ends_with(unknown));
        keys.pop_back();
        CHECK(refused(with([&](SampleParams& p) { p.face_keys = keys; })) ==
              "there are keys of 1279 faces for a mesh of 1280");
        CHECK(refused(with([](SampleParams& p) { p.throws = 500; })) ==
              "a number of darts cannot be updated; sample the surface again");
        CHECK(refused(with([](SampleParams& p) { p.stop_count = 500; })) ==
              "samples up to a count cannot be updated; sample the surface again");
        CHECK(refused(with([](SampleParams& p) { p.maximal = true; })) ==
              "a maximal set cannot be updated; sample the surface again");
        const float factors[4] = {1, 0.5f, 0.5f, 1};
        CHECK(refused(with([&](SampleParams& p) { p.class_factors = factors; })) ==
              "samples of classes cannot be updated; sample the surface again");
        const KeepOut avoided{samples[0], 1};
        CHECK(refused(with([&](SampleParams& p) {
                  p.avoid = {&avoided, 1};
              })) == "samples with points to avoid cannot be updated; sample the surface again");
        CHECK(refused(with([&](SampleParams& p) { p.given = std::span(samples).subspan(1, 2); })) ==
              "the samples must begin with the 2 given ones");
        std::vector<Sample> bad = samples;
        bad[5] = {1280, {1, 0, 0}};
        CHECK(refusal_of(ball.params, bad) == "sample 5 is in face 1280, but there are 1280");
        bad[5] = bad[3];
        CHECK(refusal_of(ball.params, bad).ends_with("are the same"));
        const SampleParams far = with([](SampleParams& p) { p.min_distance = 100; });
        const auto beyond = Updater::create(ball.mesh.view(), far, expect(frame_of(surface, far)),
                                            std::span(samples).first(1));
        REQUIRE_FALSE(beyond);
        CHECK(beyond.error().message == "the minimum distance exceeds the surface, so an edit may "
                                        "change all samples; sample the surface again");
    }

    TEST_CASE("edits of another job are refused") {
        Scene ball(builtin("icosphere", 3), 300, 14);
        ball.begin();
        const auto refusal_of = [&](const SampleParams& params,
                                    const std::vector<std::uint32_t>& changed = {}) {
            const auto made = ball.updater->update(runner(), ball.mesh.view(), params, changed);
            REQUIRE_FALSE(made);
            return made.error().message;
        };
        SampleParams params = ball.params;
        params.seed = 15;
        CHECK(refusal_of(params) == "the samples have the seed 14, not 15");
        params = ball.params;
        params.min_distance *= 0.9;
        CHECK(refusal_of(params).starts_with("the job frame is for another job"));
        params = ball.params;
        CHECK(refusal_of(params, {1280}) == "changed face 1280 does not exist");
        const Sample in_removed{3, {1, 0, 0}};
        params.given = {&in_removed, 1};
        const TestMesh whole = ball.mesh;
        ball.mesh.triangles[3 * 3 + 1] = ball.mesh.triangles[3 * 3];
        CHECK(refusal_of(params, {3}) == "given sample 0 is in face 3, which there is not");
        // A failed edit that is undone.
        ball.mesh = whole;
        ball.follow({});
        ball.mesh.triangles[3 * 3 + 1] = ball.mesh.triangles[3 * 3];
        ball.mesh.triangles.resize(ball.mesh.triangles.size() - 3);
        CHECK(refusal_of(ball.params) == "there are 1279 faces, fewer than the 1280 before; to "
                                         "remove one, let it name a vertex twice");
        ball.mesh = whole;
        ball.mesh.triangles[0] = 100000;
        CHECK(refusal_of(ball.params, {0}).starts_with("face 0"));
    }

    TEST_CASE("in faces much larger than disks, and disks much larger than faces") {
        Scene cube(builtin("cube", 4), 1500, 9);
        check_edits(cube, 10);
        Scene fine(builtin("icosphere", 5), 60, 10);
        check_edits(fine, 10);
    }
}

} // namespace geodisk::test
