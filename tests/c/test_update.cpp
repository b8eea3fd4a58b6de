// Samples that follow edits by the C API are those of whole runs.
#include <doctest/doctest.h>

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <string>
#include <vector>

#include "c/api.hpp"

namespace geodisk::test {
namespace {

std::vector<geodisk_surface_point> points_of(const Placed& samples) {
    std::vector<geodisk_surface_point> points;
    for (std::size_t i = 0; i < samples.faces.size(); ++i) {
        const float* const w = &samples.weights[3 * i];
        points.push_back({samples.faces[i], {w[0], w[1], w[2]}});
    }
    return points;
}

geodisk_surface_params job_at(double min_distance) {
    auto params = sized<geodisk_surface_params>();
    params.min_distance = min_distance;
    params.seed = 4;
    return params;
}

Placed whole_run(const geodisk_mesh* mesh, const geodisk_surface_params& params,
                 const geodisk_job_frame* frame = nullptr) {
    const auto domain = owned<geodisk_domain>([&](geodisk_domain** made, geodisk_error* error) {
        return frame == nullptr
                   ? geodisk_domain_surface(mesh, &params, made, error)
                   : geodisk_domain_surface_in_frame(mesh, &params, frame, made, error);
    });
    return placed(sample(shared_sampler(), domain.get()).get());
}

Placed samples_of(geodisk_updater* updater) {
    return placed(owned<geodisk_samples>([&](geodisk_samples** made, geodisk_error* error) {
                      return geodisk_updater_samples(updater, made, error);
                  }).get());
}

geodisk_job_frame frame_of(geodisk_updater* updater) {
    geodisk_job_frame frame{};
    REQUIRE(geodisk_updater_frame(updater, &frame, nullptr) == GEODISK_OK);
    return frame;
}

Owned<geodisk_updater> begin(const geodisk_mesh* mesh, const geodisk_surface_params& params,
                             const std::vector<geodisk_surface_point>& samples) {
    return owned<geodisk_updater>([&](geodisk_updater** made, geodisk_error* error) {
        return geodisk_updater_create(mesh, &params, nullptr, samples.data(), samples.size(), made,
                                      error);
    });
}

} // namespace

TEST_CASE("painted masks and radii are followed") {
    const TestMesh shape = builtin("torus-knot", 8);
    const auto mesh = mesh_of(shape);
    std::vector<float> factors(shape.vertex_count(), 1.0f);
    const auto radii_of = [&] {
        return owned<geodisk_radii>([&](geodisk_radii** made, geodisk_error* error) {
            return geodisk_radii_create(mesh.get(), factors.data(), GEODISK_FLOAT32, factors.size(),
                                        made, error);
        });
    };
    auto radii = radii_of();
    std::vector<std::uint8_t> mask(shape.face_count(), 1);
    auto params = job_at(0.15);
    params.radii = radii.get();
    params.face_mask = mask.data();
    const Placed before = whole_run(mesh.get(), params);
    const Owned<geodisk_updater> updater = begin(mesh.get(), params, points_of(before));
    CHECK(samples_of(updater.get()) == before);

    std::vector<std::uint32_t> changed;
    for (std::uint32_t face = 100; face < 140; ++face) {
        mask[face] = 0;
        changed.push_back(face);
    }
    for (std::uint32_t face = 0; face < shape.face_count(); ++face) {
        for (std::uint32_t corner = 0; corner < 3; ++corner) {
            if (shape.triangles[3 * face + corner] < 30) {
                factors[shape.triangles[3 * face + corner]] = 0.5f;
                changed.push_back(face);
            }
        }
    }
    radii = radii_of();
    params.radii = radii.get();
    auto info = sized<geodisk_update_info>();
    REQUIRE(geodisk_update(updater.get(), shared_sampler(), mesh.get(), &params, changed.data(),
                           changed.size(), nullptr, nullptr, &info, nullptr) == GEODISK_OK);
    const geodisk_job_frame frame = frame_of(updater.get());
    CHECK(samples_of(updater.get()) == whole_run(mesh.get(), params, &frame));
    CHECK_FALSE(samples_of(updater.get()) == before);
    CHECK(info.rounds > 0);
    CHECK(info.added > 0);
    CHECK(info.removed > 0);
    CHECK(info.disks > 0);
    CHECK(info.faces < info.uploaded);
    CHECK(info.uploaded <= shape.face_count());

    // All that other samples tell is there as well.
    const auto samples = owned<geodisk_samples>([&](geodisk_samples** made, geodisk_error* error) {
        return geodisk_updater_samples(updater.get(), made, error);
    });
    CHECK(positions(samples.get()).size() == 3 * geodisk_samples_count(samples.get()));
    CHECK(geodisk_samples_width(samples.get(), GEODISK_CLASS) == 0);
    auto report = sized<geodisk_report>();
    REQUIRE(geodisk_samples_report(samples.get(), &report, nullptr) == GEODISK_OK);
    CHECK(report.samples == geodisk_samples_count(samples.get()));
    CHECK(report.disks == info.disks);
    CHECK(report.missing == 0);
}

TEST_CASE("an update as its page shows it") {
    TestMesh shape = builtin("icosphere", 3);
    const auto made = mesh_of(shape);
    const geodisk_mesh* const mesh = made.get();
    geodisk_sampler* const sampler = shared_sampler();
    const geodisk_surface_params params = job_at(0.1);
    const std::vector<geodisk_surface_point> listed = points_of(whole_run(mesh, params));
    const geodisk_surface_point* const points = listed.data();
    const std::size_t count = listed.size();
    std::vector<std::uint32_t> faces; // Those of the vertex 0.
    for (std::uint32_t corner = 0; corner < shape.triangles.size(); ++corner) {
        if (shape.triangles[corner] == 0) {
            faces.push_back(corner / 3);
        }
    }
    shape.positions[2] += 0.2;
    const auto made_after = mesh_of(shape);
    const geodisk_mesh* const edited = made_after.get();
    const std::uint32_t* const changed = faces.data();
    const std::size_t changed_count = faces.size();

    geodisk_error error = GEODISK_INIT(geodisk_error);
    geodisk_update_info info = GEODISK_INIT(geodisk_update_info);
    geodisk_updater* updater = NULL;
    geodisk_samples* samples = NULL;
    if (geodisk_updater_create(mesh, &params, NULL, points, count, &updater, &error) ||
        geodisk_update(updater, sampler, edited, &params, changed, changed_count, NULL, NULL, &info,
                       &error) ||
        geodisk_updater_samples(updater, &samples, &error)) {
        FAIL(error.message);
    }
    CHECK(geodisk_samples_count(samples) == count - info.removed + info.added);
    geodisk_samples_release(samples);
    geodisk_updater_release(updater);
}

TEST_CASE("an edited mesh is found out about, and existing samples are followed") {
    TestMesh shape = builtin("torus-knot", 8);
    const auto before = mesh_of(shape);
    const auto params = job_at(0.15);
    const Placed samples = whole_run(before.get(), params);
    shape.positions[3 * 40] += 0.05;
    const auto after = mesh_of(shape);
    const geodisk_surface_point given{200, {0.5f, 0.25f, 0.25f}};
    auto edited = params;
    edited.existing = &given;
    edited.existing_count = 1;
    const std::vector<geodisk_surface_point> points = points_of(samples);
    const auto updater = owned<geodisk_updater>([&](geodisk_updater** made, geodisk_error* error) {
        return geodisk_updater_create_edited(before.get(), &params, after.get(), &edited, nullptr,
                                             points.data(), points.size(), made, error);
    });
    REQUIRE(geodisk_update(updater.get(), shared_sampler(), after.get(), &edited, nullptr, 0,
                           nullptr, nullptr, nullptr, nullptr) == GEODISK_OK);
    const geodisk_job_frame frame = frame_of(updater.get());
    CHECK(samples_of(updater.get()) == whole_run(after.get(), edited, &frame));
    CHECK(samples_of(updater.get()).faces.front() == 200);
}

TEST_CASE("seams that edits open and close are followed on both sides") {
    const TestMesh knot = builtin("torus-knot", 8);
    TestMesh shape = soup_of(knot);
    std::vector<std::uint8_t> mask(shape.face_count(), 1);
    auto params = job_at(0.15);
    params.face_mask = mask.data();
    auto mesh = mesh_of(shape);
    const auto updater = begin(mesh.get(), params, points_of(whole_run(mesh.get(), params)));
    const auto follow = [&](std::uint32_t changed) {
        mesh = mesh_of(shape);
        REQUIRE(geodisk_update(updater.get(), shared_sampler(), mesh.get(), &params, &changed, 1,
                               nullptr, nullptr, nullptr, nullptr) == GEODISK_OK);
        const geodisk_job_frame frame = frame_of(updater.get());
        CHECK(samples_of(updater.get()) == whole_run(mesh.get(), params, &frame));
    };
    const std::uint32_t moved = 20; // Other faces are joined with its vertices, the lowest ones.
    const auto move = [&](double by) {
        for (std::uint32_t corner = 0; corner < 3; ++corner) {
            shape.positions[9 * moved + 3 * corner] += by;
        }
        follow(moved);
    };
    move(0.25);
    for (std::uint32_t face = 0; face < knot.face_count(); ++face) {
        const auto* const corners = &knot.triangles[3 * face];
        if (face != moved && std::find_first_of(corners, corners + 3, &knot.triangles[3 * moved],
                                                &knot.triangles[3 * moved] + 3) != corners + 3) {
            for (const bool takes : {false, true}) {
                mask[face] = takes ? 1 : 0;
                follow(face);
            }
        }
    }
    move(-0.25);
}

TEST_CASE("a sheet that comes to lie at another one joins it") {
    const TestMesh sheet = flat_grid(10, 10, 1, 1);
    const auto at = [&](double gap) { // Two sheets; the first one is this far from the second one.
        TestMesh both = sheet;
        for (std::uint32_t v = 0; v < sheet.vertex_count(); ++v) {
            both.positions[3 * v] -= 1 + gap;
        }
        both.positions.insert(both.positions.end(), sheet.positions.begin(), sheet.positions.end());
        for (const std::uint32_t vertex : sheet.triangles) {
            both.triangles.push_back(sheet.vertex_count() + vertex);
        }
        return both;
    };
    std::vector<std::uint32_t> changed(sheet.face_count());
    std::iota(changed.begin(), changed.end(), 0u);
    const auto params = job_at(0.08);
    const auto apart = mesh_of(at(0.5));
    const auto updater = begin(apart.get(), params, points_of(whole_run(apart.get(), params)));
    for (const double gap : {0.0, 0.5}) {
        const auto mesh = mesh_of(at(gap));
        REQUIRE(geodisk_update(updater.get(), shared_sampler(), mesh.get(), &params, changed.data(),
                               changed.size(), nullptr, nullptr, nullptr, nullptr) == GEODISK_OK);
        const geodisk_job_frame frame = frame_of(updater.get());
        CHECK(samples_of(updater.get()) == whole_run(mesh.get(), params, &frame));
    }
}

TEST_CASE("updates go by the frame of a plain run, and by another one where an edit needs it") {
    TestMesh shape = builtin("torus-knot", 3); // Its edges are many distances long.
    const auto before = mesh_of(shape);
    const auto params = job_at(0.03);
    geodisk_job_frame plain{};
    REQUIRE(geodisk_job_frame_of(before.get(), &params, &plain, nullptr) == GEODISK_OK);
    const Placed samples = whole_run(before.get(), params);
    const Owned<geodisk_updater> updater = begin(before.get(), params, points_of(samples));
    for (const double by : {0.001, 1.0}) {
        CAPTURE(by);
        shape.positions[3 * 20] += by;
        const auto after = mesh_of(shape);
        std::vector<std::uint32_t> changed;
        for (std::uint32_t i = 0; i < shape.triangles.size(); ++i) {
            if (shape.triangles[i] == 20) {
                changed.push_back(i / 3);
            }
        }
        REQUIRE(geodisk_update(updater.get(), shared_sampler(), after.get(), &params,
                               changed.data(), changed.size(), nullptr, nullptr, nullptr,
                               nullptr) == GEODISK_OK);
        const geodisk_job_frame frame = frame_of(updater.get());
        CHECK(samples_of(updater.get()) == whole_run(after.get(), params, &frame));
        if (by < 1) { // The frame of the plain run has room for this.
            CHECK(samples_of(updater.get()) == whole_run(after.get(), params, &plain));
        }
    }
}

TEST_CASE("updates that cannot be are refused") {
    const TestMesh shape = builtin("torus-knot", 8);
    const auto mesh = mesh_of(shape);
    const auto params = job_at(0.15);
    const std::vector<geodisk_surface_point> points = points_of(whole_run(mesh.get(), params));
    const auto refusal = [&](const geodisk_mesh* of, const geodisk_surface_params* job,
                             const geodisk_surface_point* samples, std::size_t count) {
        auto error = sized<geodisk_error>();
        geodisk_updater* made = nullptr;
        CHECK(geodisk_updater_create(of, job, nullptr, samples, count, &made, &error) ==
              GEODISK_INVALID_ARGUMENT);
        CHECK(made == nullptr);
        return std::string(error.message);
    };
    CHECK(refusal(nullptr, &params, points.data(), points.size()) == "mesh is NULL");
    CHECK(refusal(mesh.get(), nullptr, points.data(), points.size()) == "params is NULL");
    CHECK(refusal(mesh.get(), &params, nullptr, 3) == "samples is NULL");
    auto other = params;
    other.metric = GEODISK_EUCLIDEAN;
    CHECK(refusal(mesh.get(), &other, points.data(), points.size()) ==
          "params->metric: updates are for geodesic distances only");
    other = params;
    other.stop_count = 10;
    CHECK(refusal(mesh.get(), &other, points.data(), points.size()) ==
          "update and stop_count exclude each other: the last sample of a number may lie anywhere");
    other = params;
    other.seed = 5;
    CHECK(refusal(mesh.get(), &other, points.data(), points.size()).starts_with("sample "));
    const auto small = mesh_of(builtin("icosphere", 2));
    CHECK(refusal(small.get(), &params, points.data(), points.size()).starts_with("sample "));

    const Owned<geodisk_updater> updater = begin(mesh.get(), params, points);
    const Placed before = samples_of(updater.get());
    const auto failure = [&](geodisk_updater* of, const std::vector<std::uint32_t>& changed,
                             geodisk_progress_fn progress = nullptr) {
        auto error = sized<geodisk_error>();
        CHECK(geodisk_update(of, shared_sampler(), mesh.get(), &params, changed.data(),
                             changed.size(), progress, of, nullptr, &error) != GEODISK_OK);
        CHECK(samples_of(updater.get()) == before);
        return std::string(error.message);
    };
    CHECK(failure(nullptr, {}) == "updater is NULL");
    CHECK(failure(updater.get(), {shape.face_count()}) ==
          "changed face " + std::to_string(shape.face_count()) + " does not exist");
    CHECK(failure(updater.get(), {7}, [](void*, const geodisk_progress*) { return 1; }) ==
          "cancelled");
    // A callback cannot use the updater that calls it.
    CHECK(failure(updater.get(), {7}, [](void* of, const geodisk_progress*) {
              geodisk_job_frame frame{};
              return static_cast<std::int32_t>(
                  geodisk_updater_frame(static_cast<geodisk_updater*>(of), &frame, nullptr) ==
                  GEODISK_BUSY);
          }) == "cancelled");
    CHECK(geodisk_updater_samples(updater.get(), nullptr, nullptr) == GEODISK_INVALID_ARGUMENT);
    CHECK(geodisk_updater_frame(nullptr, nullptr, nullptr) == GEODISK_INVALID_ARGUMENT);
    geodisk_updater_release(nullptr);
}

} // namespace geodisk::test
