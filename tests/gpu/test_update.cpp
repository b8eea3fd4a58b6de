// Samples that follow edits, against whole runs over the edited surfaces.
#include <doctest/doctest.h>

#include <cmath>
#include <functional>
#include <numeric>
#include <string>
#include <vector>

#include <geodisk/update.hpp>

#include "device_run.hpp"
#include "edited_scene.hpp"
#include "sets.hpp"
#include "support/meshes.hpp"

namespace geodisk::test {
namespace {

/// A torus of 320 faces.
TestMesh coarse_torus() {
    constexpr std::uint32_t kRows = 20, kColumns = 8;
    TestMesh mesh;
    for (std::uint32_t i = 0; i < kRows; ++i) {
        for (std::uint32_t k = 0; k < kColumns; ++k) {
            const double a = 0.31415926 * i, b = 0.78539816 * k, r = 1 + 0.4 * std::cos(b);
            mesh.add_vertex({r * std::cos(a), r * std::sin(a), 0.4 * std::sin(b)});
        }
    }
    for (std::uint32_t i = 0; i < kRows; ++i) {
        for (std::uint32_t k = 0; k < kColumns; ++k) {
            const auto at = [&](std::uint32_t row, std::uint32_t column) {
                return row % kRows * kColumns + column % kColumns;
            };
            mesh.add_triangle(at(i, k), at(i + 1, k), at(i + 1, k + 1));
            mesh.add_triangle(at(i, k), at(i + 1, k + 1), at(i, k + 1));
        }
    }
    return mesh;
}

/// A sheet of 20,000 faces, and disks of up to a twentieth of its width.
Scene sheet_with(const std::function<double(Vec3)>& factor, std::uint64_t seed) {
    Scene sheet(flat_grid(100, 100, 1, 1), 3000, seed, 1.0 / 8);
    for (std::uint32_t v = 0; v < sheet.mesh.vertex_count(); ++v) {
        sheet.factors[v] = factor(sheet.mesh.vertex(v));
    }
    sheet.params.min_distance = 0.05;
    return sheet;
}

/// Follows random edits, with steps of these lengths.
void check_edits(Scene& scene, int edits) {
    scene.begin();
    const double distance = scene.params.min_distance;
    const double width = (scene.by_density ? 0.3 : 1.5) * distance; // Of strokes.
    for (int i = 0; i < edits; ++i) {
        CAPTURE(i);
        switch (scene.below(scene.radii ? 8 : 7)) {
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
            scene.follow(scene.change_existing());
            break;
        case 6:
            scene.follow(scene.change_avoided(6 * distance));
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
    TEST_CASE("seams that edits open and close") {
        Scene knot(soup_of(builtin("torus-knot", 8)), 800, 11);
        knot.begin();
        const std::vector<double> closed = knot.mesh.positions;
        for (const std::uint32_t face : {900u, 20u}) {
            for (std::uint32_t corner = 0; corner < 3; ++corner) {
                knot.mesh.positions[9 * face + 3 * corner] += 0.01;
            }
            knot.follow({face});
        }
        CHECK(knot.prepare().statistics().boundary_edges == 12);
        knot.mesh.positions = closed;
        knot.follow({900, 20});
        CHECK(knot.prepare().statistics().boundary_edges == 0);

        // Two sheets. The first one comes to lie at the second one, whose vertices have higher
        // numbers.
        TestMesh both = flat_grid(10, 10, 1, 1);
        const std::uint32_t vertices = both.vertex_count(), faces = both.face_count();
        for (std::uint32_t v = 0; v < vertices; ++v) {
            both.add_vertex(both.vertex(v));
        }
        for (std::uint32_t i = 0; i < 3 * faces; ++i) {
            both.triangles.push_back(both.triangles[i] + vertices);
        }
        both.keep_seams = false;
        const auto place = [&](TestMesh& mesh, double gap) {
            for (std::uint32_t v = 0; v < vertices; ++v) {
                mesh.positions[3 * v] = mesh.positions[3 * (vertices + v)] - 1 - gap;
            }
        };
        place(both, 0.5);
        Scene sheets(both, 300, 12);
        sheets.begin();
        std::vector<std::uint32_t> moved(faces);
        std::iota(moved.begin(), moved.end(), 0u);
        for (const double gap : {0.0, 0.5}) {
            place(sheets.mesh, gap);
            sheets.follow(moved);
            CHECK(sheets.prepare().statistics().components == (gap == 0 ? 1 : 2));
        }
    }
    TEST_CASE("with radii that vary") {
        Scene knot(builtin("torus-knot", 8), 800, 7, 0.4);
        check_edits(knot, 25);
        Scene ball(builtin("icosphere", 4), 600, 8, 0.1);
        check_edits(ball, 15);
        Scene dense(builtin("icosphere", 4), 600, 9, 0.4, true);
        check_edits(dense, 20);
    }
    TEST_CASE("with radii over a wide range") {
        const std::function<double(Vec3)> fields[] = {
            [](Vec3 at) { return std::clamp(at.x, 1.0 / 32, 1.0); }, // Slow.
            [](Vec3 at) { return std::fmod(at.x, 0.25) < 0.125 ? 1 : 1.0 / 8; },
            [](Vec3 at) { // Large ones stand alone.
                return std::fmod(at.x, 0.2) < 0.01 && std::fmod(at.y, 0.2) < 0.01 ? 1 : 1.0 / 8;
            }};
        for (std::size_t i = 0; i < std::size(fields); ++i) {
            CAPTURE(i);
            Scene grid = sheet_with(fields[i], 41 + i);
            check_edits(grid, 12);
        }
    }
    TEST_CASE("an edit where radii are small reaches no farther than they ask for") {
        Scene grid = sheet_with([](Vec3 at) { return std::clamp(at.x, 1.0 / 32, 1.0); }, 44);
        grid.begin();
        const auto edited_at = [&](std::uint32_t column) {
            const std::uint32_t vertex = 50 * 101 + column;
            grid.mesh.positions[3 * vertex + 2] += 0.002;
            return grid.follow(grid.faces_at(vertex)).uploaded;
        };
        const std::uint32_t wide = edited_at(90), narrow = edited_at(6);
        CAPTURE(wide);
        CAPTURE(narrow);
        CHECK(narrow < wide / 4);
    }
    TEST_CASE("in the frame of a plain run, whatever its guard") {
        // Edges are so long that a frame for longer ones has another guard.
        for (const std::uint32_t seed : {21u, 22u}) {
            Scene scene(coarse_torus(), 11000, seed, 0.5);
            scene.begin();
            CHECK(scene.updater->frame().longest_edge > 9);
            scene.follow_both([&] { return scene.move_vertex(0.01); });
        }
        Scene sides(builtin("cube", 1), 5000, 23);
        sides.begin();
        sides.follow_both([&] { return sides.move_vertex(0.01); });
    }
    TEST_CASE("edits that need another frame decide all, and the next ones what they can reach") {
        for (const double least : {1.0, 0.4}) {
            Scene ball(builtin("icosphere", 3), 1000, 23, least);
            ball.begin();
            const double distance = ball.params.min_distance;
            const JobFrame first = ball.updater->frame();
            const UpdateReport longer =
                ball.follow_both([&] { return ball.add_flap(9.5 * distance); });
            CHECK(longer.faces == ball.mesh.face_count());
            CHECK(longer.added > 0);
            CHECK_FALSE(decide_alike(first, ball.updater->frame()));
            const JobFrame second = ball.updater->frame();
            const UpdateReport within =
                ball.follow_both([&] { return ball.add_flap(5 * distance); });
            CHECK(within.faces < ball.mesh.face_count());
            CHECK(second == ball.updater->frame());
        }
        // Edges of three faces.
        Scene plain(builtin("icosphere", 3), 200, 24);
        plain.begin();
        const JobFrame frame = plain.updater->frame();
        plain.follow_both([&] { return plain.add_flap(0.01); });
        CHECK(frame.splits_once);
        CHECK_FALSE(plain.updater->frame().splits_once);
        // Farther than single precision resolves.
        TestMesh far = plain.mesh;
        for (double& x : far.positions) {
            x *= 1e5;
        }
        const auto failed = plain.updater->update(runner(), far.view(), plain.params, {{0}});
        REQUIRE_FALSE(failed);
        CHECK(failed.error().message.starts_with("the minimum distance is too small for this"));
    }
    TEST_CASE("copies of faces, and faces without area") {
        Scene ball(builtin("icosphere", 3), 400, 25);
        ball.begin();
        CHECK(ball.follow_both([&] { return ball.copy_face(); }).rounds == 1);
        for (const double height : {0.0, 1e-17, 1e-15, 1e-9}) {
            CAPTURE(height);
            ball.follow_both([&] { return ball.add_island(0.01, height); });
        }
        // A copy is alone with the face that it is of.
        Scene single(TestMesh{{0, 0, 0, 1, 0, 0, 0, 1, 0}, {0, 1, 2}}, 100, 26);
        single.begin();
        single.follow_both([&] { return single.copy_face(); });
        single.follow_both([&]() -> std::vector<std::uint32_t> {
            single.mesh.add_triangle(0, 0, 1);
            return {};
        });
    }
    TEST_CASE("over edits of all kinds") {
        for (const std::uint32_t seed : {31u, 32u, 33u, 34u}) {
            CAPTURE(seed);
            Scene scene(builtin("torus-knot", 5), 500, seed, seed % 2 == 0 ? 0.3 : 1);
            if (seed == 33) {
                scene.keys.resize(scene.mesh.face_count());
                std::iota(scene.keys.rbegin(), scene.keys.rend(), 5u);
            }
            scene.begin();
            const double distance = scene.params.min_distance;
            const std::function<std::vector<std::uint32_t>()> kinds[] = {
                [&] { return scene.move_vertex(0.3 * distance); },
                [&] { return scene.move_vertex(4 * distance); },
                [&] { return scene.remove_face(); },
                [&] { return scene.split_face(); },
                [&] { return scene.mask_stroke(1.5 * distance); },
                [&] { return scene.change_existing(); },
                [&] { return scene.change_avoided(6 * distance); },
                [&] { return scene.copy_face(); },
                [&] { return scene.add_flap(2 * distance); },
                [&] { return scene.add_cap(); },
                [&] { return scene.add_island(distance, 1e-17); },
                [&] { return scene.radius_stroke(1.5 * distance); }};
            const auto count = static_cast<std::uint32_t>(std::size(kinds));
            for (int i = 0; i < 12; ++i) {
                CAPTURE(i);
                scene.follow_both(kinds[scene.below(scene.radii ? count : count - 1)]);
            }
        }
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

    TEST_CASE("faces that have other numbers after the edit are found by their keys") {
        for (const bool has_keys : {true, false}) {
            const auto make = [has_keys] {
                Scene scene(builtin("torus-knot", 8), 800, 16, has_keys ? 0.4 : 1);
                if (has_keys) {
                    scene.keys.resize(scene.mesh.face_count());
                    std::iota(scene.keys.rbegin(), scene.keys.rend(), 5u);
                }
                scene.existing.push_back({50, {0.5f, 0.25f, 0.25f}});
                scene.existing.push_back({900, {0.5f, 0.25f, 0.25f}});
                return scene;
            };
            Scene before = make();
            const PreparedMesh surface = before.prepare();
            const JobFrame frame = expect(frame_of(surface, before.params));
            const SampleSet set = expect(runner().sample_and_wait(surface, before.params));
            Scene after = make();
            after.move_vertex(0.1 * before.params.min_distance);
            if (has_keys) { // Faces and vertices are gone, and all are in another order.
                after.reverse_without(100, 130);
                after.existing.assign({{after.mesh.face_count() - 1 - 50, {0.5f, 0.25f, 0.25f}}});
            }
            const PreparedMesh edited = after.prepare();
            Updater updater =
                expect(Updater::create({before.mesh.view(), before.params},
                                       {after.mesh.view(), after.params}, frame, set.samples));
            const UpdateReport report =
                expect(updater.update(runner(), after.mesh.view(), after.params, {}));
            CHECK(report.faces < after.mesh.face_count() / 2);
            const Domain whole = expect(Domain::surface(edited, after.params, updater.frame()));
            CHECK(points_of(updater.samples()) ==
                  test::points_of(expect(runner().sample_and_wait(whole))));
        }
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
        CHECK(refused(with([](SampleParams& p) { p.darts = 500; })) ==
              "update and darts exclude each other: the last dart of a number may lie anywhere");
        CHECK(refused(with([](SampleParams& p) { p.stop_count = 500; })) ==
              "update and stop_count exclude each other: the last sample of a number may lie "
              "anywhere");
        CHECK(refused(with([](SampleParams& p) { p.maximal = true; })) ==
              "update and maximal exclude each other: gaps are filled from all over the surface");
        const float factors[4] = {1, 0.5f, 0.5f, 1};
        CHECK(refused(with([&](SampleParams& p) { p.class_factors = factors; })) ==
              "update and class_factors exclude each other: an update knows no classes");
        CHECK(refused(with([&](SampleParams& p) {
                  p.existing = std::span(samples).subspan(1, 2);
              })) == "the samples must begin with the 2 existing ones");
        std::vector<Sample> bad = samples;
        bad[5] = {1280, {1, 0, 0}};
        CHECK(refusal_of(ball.params, bad) == "sample 5 is in face 1280, but there are 1280");
        bad[5] = samples[5];
        bad[7].weights[1] += 0x1p-10f;
        bad[7].weights[0] -= 0x1p-10f;
        CHECK(refusal_of(ball.params, bad) == "sample 7" + unknown);
        // The edited surface may have lost the faces of its first samples.
        TestMesh edited = ball.mesh;
        for (std::uint32_t i = 0; i < 6; ++i) {
            const std::uint32_t face = samples[i].face;
            if (face != bad[7].face) {
                edited.triangles[3 * face + 1] = edited.triangles[3 * face];
            }
        }
        const auto of_edit = Updater::create({ball.mesh.view(), ball.params},
                                             {edited.view(), ball.params}, frame, bad);
        REQUIRE_FALSE(of_edit);
        CHECK(of_edit.error().message == "sample 7" + unknown);
        bad = samples;
        bad[5] = bad[3];
        CHECK(refusal_of(ball.params, bad).ends_with("are the same"));
        const SampleParams far = with([](SampleParams& p) { p.min_distance = 100; });
        const auto beyond = Updater::create(ball.mesh.view(), far, expect(frame_of(surface, far)),
                                            std::span(samples).first(1));
        REQUIRE_FALSE(beyond);
        CHECK(beyond.error().message == "the minimum distance exceeds the surface, so an edit may "
                                        "change all samples; sample the surface again");
    }

    TEST_CASE("an update as its page shows it") {
        TestMesh shape = builtin("icosphere", 3);
        const MeshView mesh = shape.view();
        std::vector<double>& positions = shape.positions;
        std::vector<std::uint32_t> changed; // Faces of the vertex 0.
        for (std::uint32_t corner = 0; corner < shape.triangles.size(); ++corner) {
            if (shape.triangles[corner] == 0) {
                changed.push_back(corner / 3);
            }
        }
        Runner& runner = test::runner();
        const SampleParams params{.min_distance = 0.1, .seed = 7};

        const PreparedMesh prepared = expect(PreparedMesh::prepare(mesh));
        const JobFrame frame = expect(frame_of(prepared, params));
        const SampleSet before = expect(runner.sample_and_wait(prepared, params));
        Updater updater = expect(Updater::create(mesh, params, frame, before.samples));

        positions[2] += 0.2; // An edit of vertex 0: `changed` lists its faces.
        const UpdateReport report = expect(updater.update(runner, mesh, params, changed));
        const std::span<const Sample> after = updater.samples();

        CHECK(after.size() == before.samples.size() - report.removed + report.added);
        CHECK(report.removed + report.added > 0);
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
        params.existing = {&in_removed, 1};
        const TestMesh whole = ball.mesh;
        ball.mesh.triangles[3 * 3 + 1] = ball.mesh.triangles[3 * 3];
        CHECK(refusal_of(params, {3}) == "existing sample 0 is in face 3, which there is not");
        params.existing = {};
        KeepOut avoided{{1280, {1, 0, 0}}, 1};
        params.avoid = {&avoided, 1};
        CHECK(refusal_of(params) == "point to avoid 0 is in face 1280, which there is not");
        avoided = {{5, {1, 0, 0}}, std::nan("")};
        CHECK(refusal_of(params).starts_with("point to avoid 0 has the radius "));
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
