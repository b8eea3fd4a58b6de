// The C API gives what the C++ API gives.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include <geodisk/runner.hpp>

#include "c/api.hpp"
#include "device_run.hpp"

namespace geodisk::test {
namespace {

SampleSet expected(const Domain& domain) {
    Runner runner = expect(Runner::create(shared_context().device(), shared_context().queue()));
    return expect(runner.sample_and_wait(domain));
}

Placed placed_set(const SampleSet& set) {
    Placed result;
    for (const Sample& sample : set.samples) {
        result.faces.push_back(sample.face);
        result.weights.insert(result.weights.end(), sample.weights, sample.weights + 3);
    }
    return result;
}

const TestMesh& sampled_knot() {
    static const TestMesh kMesh = builtin("torus-knot", 8);
    return kMesh;
}

/// Number of samples of a class.
std::size_t count_of(const geodisk_mesh* mesh, const geodisk_surface_params& params,
                     std::uint32_t number) {
    const auto domain = owned<geodisk_domain>(
        [&](auto made, auto error) { return geodisk_domain_surface(mesh, &params, made, error); });
    const auto samples = sample(shared_sampler(), domain.get());
    std::vector<std::uint32_t> classes(geodisk_samples_count(samples.get()));
    REQUIRE(geodisk_samples_copy(samples.get(), GEODISK_CLASS, GEODISK_UINT32, classes.data(), 0,
                                 classes.size(), nullptr) == GEODISK_OK);
    return static_cast<std::size_t>(std::ranges::count(classes, number));
}

} // namespace

TEST_CASE("a surface has the samples that it has in C++") {
    const PreparedMesh prepared_mesh = prepared(sampled_knot());
    const double distance = distance_for_count(prepared_mesh, {}, 500);
    const SampleSet set =
        expected(expect(Domain::surface(prepared_mesh, {.min_distance = distance, .seed = 3})));

    const auto mesh = mesh_of(sampled_knot());
    double same_distance = 0;
    REQUIRE(geodisk_distance_for_count(mesh.get(), nullptr, nullptr, 500, &same_distance,
                                       nullptr) == GEODISK_OK);
    CHECK(same_distance == distance);
    const auto domain = surface_of(mesh.get(), distance, 3);
    const auto samples = sample(shared_sampler(), domain.get());
    CHECK(placed(samples.get()) == placed_set(set));

    // Positions follow from the weights.
    const std::vector<double> points = positions(samples.get());
    for (std::size_t i = 0; i < set.samples.size(); ++i) {
        for (std::size_t axis = 0; axis < 3; ++axis) {
            double sum = 0;
            for (std::size_t corner = 0; corner < 3; ++corner) {
                const std::size_t vertex =
                    sampled_knot().triangles[std::size_t{3} * set.samples[i].face + corner];
                sum += double{set.samples[i].weights[corner]} *
                       sampled_knot().positions[3 * vertex + axis];
            }
            REQUIRE(points[3 * i + axis] == sum);
        }
    }

    // All else that they have, into an interleaved array of floats.
    struct Instance {
        float position[3], normal[3], radius;
        std::uint32_t face;
    };
    std::vector<Instance> instances(set.samples.size());
    const auto copy = [&](geodisk_attribute attribute, geodisk_type type, void* to) {
        REQUIRE(geodisk_samples_copy(samples.get(), attribute, type, to, sizeof(Instance),
                                     instances.size(), nullptr) == GEODISK_OK);
    };
    copy(GEODISK_POSITION, GEODISK_FLOAT32, &instances[0].position);
    copy(GEODISK_NORMAL, GEODISK_FLOAT32, &instances[0].normal);
    copy(GEODISK_RADIUS, GEODISK_FLOAT32, &instances[0].radius);
    copy(GEODISK_FACE, GEODISK_UINT32, &instances[0].face);
    for (std::size_t i = 0; i < instances.size(); ++i) {
        const Instance& one = instances[i];
        REQUIRE(one.position[1] == static_cast<float>(points[3 * i + 1]));
        const float* const n = one.normal;
        REQUIRE(std::abs(n[0] * n[0] + n[1] * n[1] + n[2] * n[2] - 1) < 1e-6f);
        REQUIRE(one.radius == static_cast<float>(distance / 2));
        REQUIRE(one.face == set.samples[i].face);
    }

    auto report = sized<geodisk_report>();
    REQUIRE(geodisk_samples_report(samples.get(), &report, nullptr) == GEODISK_OK);
    CHECK(report.samples == set.samples.size());
    CHECK(report.candidates == set.report.candidates);
    CHECK(report.min_distance == distance);
    CHECK(report.rho > 0.65);
}

TEST_CASE("samples have classes") {
    const auto mesh = mesh_of(sampled_knot());
    std::vector<float> factors{1, 0.5f, 0.5f, 0.8f};
    auto params = sized<geodisk_surface_params>();
    params.min_distance = 0.5;
    params.class_factors = factors.data();
    params.class_count = 2;
    const auto domain = owned<geodisk_domain>([&](auto made, auto error) {
        return geodisk_domain_surface(mesh.get(), &params, made, error);
    });
    factors.assign(4, 0); // They are copied.
    const auto samples = sample(shared_sampler(), domain.get());
    const std::size_t count = geodisk_samples_count(samples.get());
    CHECK(geodisk_samples_width(samples.get(), GEODISK_CLASS) == 1);
    std::vector<std::uint32_t> classes(count);
    REQUIRE(geodisk_samples_copy(samples.get(), GEODISK_CLASS, GEODISK_UINT32, classes.data(), 0,
                                 count, nullptr) == GEODISK_OK);
    const auto first = std::ranges::count(classes, 0u), second = std::ranges::count(classes, 1u);
    CHECK(first > 10);
    CHECK(second > first);
    CHECK(static_cast<std::size_t>(first + second) == count);
    std::vector<double> radii(count);
    REQUIRE(geodisk_samples_copy(samples.get(), GEODISK_RADIUS, GEODISK_FLOAT64, radii.data(), 0,
                                 count, nullptr) == GEODISK_OK);
    for (std::size_t i = 0; i < count; ++i) {
        REQUIRE(radii[i] == doctest::Approx(classes[i] == 0 ? 0.25 : 0.2).epsilon(1e-6));
    }
    const auto plain = sample(shared_sampler(), surface_of(mesh.get(), 0.5, 0).get());
    CHECK(geodisk_samples_width(plain.get(), GEODISK_CLASS) == 0);

    // The second class nowhere, and the first out of the disk around its first sample.
    factors = {1, 0.5f, 0.5f, 0.8f};
    std::vector<float> shares(std::size_t{6} * sampled_knot().triangles.size() / 3, 1);
    std::fill(shares.begin() + static_cast<std::ptrdiff_t>(shares.size() / 2), shares.end(), 0.0f);
    params.class_shares = shares.data();
    CHECK(count_of(mesh.get(), params, 1) == 0);
    const std::size_t alone = count_of(mesh.get(), params, 0);
    CHECK(alone >= static_cast<std::size_t>(first));
    const geodisk_surface_point at{0, {0.5f, 0.25f, 0.25f}};
    const double radius = 1.5;
    std::uint8_t kept_out = 1;
    params.avoid = &at;
    params.avoid_radii = &radius;
    params.avoid_count = 1;
    params.avoid_classes = &kept_out;
    CHECK(count_of(mesh.get(), params, 0) == alone);
    kept_out = 255;
    CHECK(count_of(mesh.get(), params, 0) < alone);
    kept_out = 2;
    geodisk_domain* none = nullptr;
    CHECK(geodisk_domain_surface(mesh.get(), &params, &none, nullptr) == GEODISK_INVALID_ARGUMENT);
    params.avoid_count = 0;
    params.avoid_classes = nullptr;
    shares[0] = 2;
    CHECK(geodisk_domain_surface(mesh.get(), &params, &none, nullptr) == GEODISK_INVALID_ARGUMENT);
    params.class_count = 0;
    params.class_factors = nullptr;
    CHECK(geodisk_domain_surface(mesh.get(), &params, &none, nullptr) == GEODISK_INVALID_ARGUMENT);
    params.class_shares = nullptr;
    params.class_count = 2;
    params.class_factors = factors.data();
    factors.assign(4, 0);
    CHECK(geodisk_domain_surface(mesh.get(), &params, &none, nullptr) == GEODISK_INVALID_ARGUMENT);
    factors.assign(81, 1);
    for (const std::size_t wrong : {std::size_t{1}, std::size_t{9}}) {
        params.class_count = wrong;
        CHECK(geodisk_domain_surface(mesh.get(), &params, &none, nullptr) ==
              GEODISK_INVALID_ARGUMENT);
    }
    params.class_factors = nullptr;
    CHECK(geodisk_domain_surface(mesh.get(), &params, &none, nullptr) == GEODISK_INVALID_ARGUMENT);
}

TEST_CASE("features are sampled before the faces") {
    const auto mesh = mesh_of(builtin("cube", 4));
    auto params = sized<geodisk_surface_params>();
    params.min_distance = 0.1;
    std::size_t corners = 0;
    const auto domain = owned<geodisk_domain>([&](auto made, auto error) {
        return geodisk_domain_features(mesh.get(), &params, 30, &corners, made, error);
    });
    CHECK(corners == 8);
    const Placed first = placed(sample(shared_sampler(), domain.get()).get());
    std::vector<geodisk_surface_point> given;
    std::size_t of_corners = 0;
    for (std::size_t i = 0; i < first.faces.size(); ++i) {
        const float* const w = &first.weights[3 * i];
        given.push_back({first.faces[i], {w[0], w[1], w[2]}});
        const auto zeros = std::count(w, w + 3, 0.0f);
        CHECK(zeros >= 1);
        of_corners += zeros == 2 ? 1 : 0;
    }
    CHECK(of_corners == 8);
    CHECK(given.size() > 60);
    params.existing = given.data();
    params.existing_count = given.size();
    const auto faces = owned<geodisk_domain>([&](auto made, auto error) {
        return geodisk_domain_surface(mesh.get(), &params, made, error);
    });
    CHECK(geodisk_samples_count(sample(shared_sampler(), faces.get()).get()) > 300);

    geodisk_domain* none = nullptr;
    for (const double wrong : {0.0, 181.0}) {
        CHECK(geodisk_domain_features(mesh.get(), &params, wrong, nullptr, &none, nullptr) ==
              GEODISK_INVALID_ARGUMENT);
    }
    const auto smooth = mesh_of(builtin("icosphere", 3));
    CHECK(geodisk_domain_features(smooth.get(), &params, 60, &corners, &none, nullptr) ==
          GEODISK_OK);
    CHECK(none == nullptr);
    CHECK(corners == 0);
}

TEST_CASE("samples that are given come first, and are told") {
    const auto mesh = mesh_of(sampled_knot());
    const auto whole = sample(shared_sampler(), surface_of(mesh.get(), 0.2, 3).get());
    const Placed all = placed(whole.get());
    REQUIRE(all.faces.size() > 20);
    std::vector<geodisk_surface_point> given;
    for (std::size_t i = 0; i < 20; ++i) {
        const float* const w = &all.weights[3 * i];
        given.push_back({all.faces[i], {w[0], w[1], w[2]}});
    }
    auto params = sized<geodisk_surface_params>();
    params.min_distance = 0.2;
    params.seed = 3;
    params.existing = given.data();
    params.existing_count = given.size();
    const auto domain = owned<geodisk_domain>([&](auto made, auto error) {
        return geodisk_domain_surface(mesh.get(), &params, made, error);
    });
    given.clear(); // They are copied.
    const auto samples = sample(shared_sampler(), domain.get());
    CHECK(placed(samples.get()) == all);
    auto report = sized<geodisk_report>();
    REQUIRE(geodisk_samples_report(samples.get(), &report, nullptr) == GEODISK_OK);
    CHECK(report.existing == 20);
    const auto job = owned<geodisk_job>([&](auto made, auto error) {
        return geodisk_job_create(shared_device(), domain.get(), nullptr, made, error);
    });
    auto need = sized<geodisk_buffer_need>();
    REQUIRE(geodisk_job_need(job.get(), GEODISK_SAMPLES_BUFFER, &need, nullptr) == GEODISK_OK);
    CHECK(need.upload_bytes == 20 * sizeof(geodisk_sample_record));

    const geodisk_surface_point center{all.faces[0], {1, 0, 0}};
    const double radius = 1;
    params.existing_count = 0;
    params.avoid = &center;
    params.avoid_radii = &radius;
    params.avoid_count = 1;
    const auto around = owned<geodisk_domain>([&](auto made, auto error) {
        return geodisk_domain_surface(mesh.get(), &params, made, error);
    });
    CHECK(geodisk_samples_count(sample(shared_sampler(), around.get()).get()) < all.faces.size());
    params.avoid_radii = nullptr;
    geodisk_domain* no_radii = nullptr;
    CHECK(geodisk_domain_surface(mesh.get(), &params, &no_radii, nullptr) ==
          GEODISK_INVALID_ARGUMENT);
    params.avoid_count = 0;
    params.existing_count = 20;
    params.existing = nullptr;
    geodisk_domain* none = nullptr;
    CHECK(geodisk_domain_surface(mesh.get(), &params, &none, nullptr) == GEODISK_INVALID_ARGUMENT);
    CHECK(none == nullptr);
}

TEST_CASE("a maximal set is reported") {
    const auto mesh = mesh_of(sampled_knot());
    auto params = sized<geodisk_surface_params>();
    params.min_distance = 0.3;
    params.is_maximal = 1;
    const auto domain = owned<geodisk_domain>([&](auto made, auto error) {
        return geodisk_domain_surface(mesh.get(), &params, made, error);
    });
    const auto samples = sample(shared_sampler(), domain.get());
    auto report = sized<geodisk_report>();
    REQUIRE(geodisk_samples_report(samples.get(), &report, nullptr) == GEODISK_OK);
    CHECK(report.maximal_rounds > 0);
    CHECK(report.is_certified == 1);
    CHECK(report.maximal_cells > 0);
    CHECK(report.largest_gap == doctest::Approx(0.3 * (1 + 2 * report.guard)));
    const auto pool = sample(shared_sampler(), surface_of(mesh.get(), 0.3, 0).get());
    CHECK(geodisk_samples_count(samples.get()) > geodisk_samples_count(pool.get()));
    params.darts = 10;
    geodisk_domain* none = nullptr;
    CHECK(geodisk_domain_surface(mesh.get(), &params, &none, nullptr) == GEODISK_INVALID_ARGUMENT);
}

TEST_CASE("floats, short indices and strides are the mesh that they say") {
    const TestMesh mesh = builtin("cube", 1);
    struct Vertex {
        float color;
        float position[3];
    };
    std::vector<Vertex> vertices(mesh.positions.size() / 3);
    for (std::size_t i = 0; i < vertices.size(); ++i) {
        for (std::size_t axis = 0; axis < 3; ++axis) {
            vertices[i].position[axis] = static_cast<float>(mesh.positions[3 * i + axis]);
        }
    }
    std::vector<std::uint16_t> indices; // With one of something else behind each.
    for (const std::uint32_t index : mesh.triangles) {
        indices.push_back(static_cast<std::uint16_t>(index));
        indices.push_back(9999);
    }
    geodisk_mesh_params params = params_of(mesh);
    params.positions = &vertices[0].position;
    params.position_type = GEODISK_FLOAT32;
    params.position_stride = sizeof(Vertex);
    params.indices = indices.data();
    params.index_type = GEODISK_UINT16;
    params.index_stride = 4;
    const auto strided = owned<geodisk_mesh>([&](auto** made, geodisk_error* error) {
        return geodisk_mesh_create(&params, made, error);
    });
    const auto packed = mesh_of(mesh);
    const auto of = [](const Owned<geodisk_mesh>& one) {
        return sample(shared_sampler(), surface_of(one.get(), 0.3).get());
    };
    CHECK(placed(of(strided).get()) == placed(of(packed).get()));
    CHECK(positions(of(strided).get()) == positions(of(packed).get()));
}

TEST_CASE("radii vary, keys move candidates, and parts have samples of their own") {
    const auto mesh = mesh_of(sampled_knot());
    auto info = sized<geodisk_mesh_info>();
    REQUIRE(geodisk_mesh_describe(mesh.get(), &info, nullptr) == GEODISK_OK);
    CHECK(info.faces == sampled_knot().triangles.size() / 3);
    CHECK(info.dimension == 3);
    CHECK(info.components == 1);

    std::vector<float> factors(sampled_knot().positions.size() / 3);
    for (std::size_t i = 0; i < factors.size(); ++i) {
        factors[i] = 0.5f + 0.5f * static_cast<float>(i) / static_cast<float>(factors.size());
    }
    const auto radii = owned<geodisk_radii>([&](auto** made, geodisk_error* error) {
        return geodisk_radii_create(mesh.get(), factors.data(), GEODISK_FLOAT32, factors.size(),
                                    made, error);
    });
    auto params = sized<geodisk_surface_params>();
    REQUIRE(geodisk_distance_for_count(mesh.get(), radii.get(), nullptr, 300, &params.min_distance,
                                       nullptr) == GEODISK_OK);
    params.radii = radii.get();
    std::vector<std::uint32_t> keys;
    for (std::uint32_t face = 0; face < info.faces; ++face) {
        keys.push_back(1000000 - face);
    }
    params.face_keys = keys.data();
    const auto domain = owned<geodisk_domain>([&](auto** made, geodisk_error* error) {
        return geodisk_domain_surface(mesh.get(), &params, made, error);
    });

    const PreparedMesh prepared_mesh = prepared(sampled_knot());
    const RadiusField field = expect(
        RadiusField::prepare(prepared_mesh, std::vector<double>(factors.begin(), factors.end())));
    const SampleParams same{
        .min_distance = params.min_distance, .radii = &field, .face_keys = keys};
    const SampleSet set = expected(expect(Domain::surface(prepared_mesh, same)));
    const auto samples = sample(shared_sampler(), domain.get());
    CHECK(placed(samples.get()) == placed_set(set));
    std::vector<double> radius(set.samples.size());
    REQUIRE(geodisk_samples_copy(samples.get(), GEODISK_RADIUS, GEODISK_FLOAT64, radius.data(), 0,
                                 radius.size(), nullptr) == GEODISK_OK);
    for (std::size_t i = 0; i < radius.size(); ++i) {
        REQUIRE(radius[i] == field.factor_at(set.samples[i].face, set.samples[i].weights) *
                                 params.min_distance / 2);
    }

    std::vector<std::uint8_t> mask(info.faces, 0);
    std::fill_n(mask.begin(), info.faces / 3, std::uint8_t{1});
    params.face_mask = mask.data();
    const auto masked = owned<geodisk_domain>([&](auto** made, geodisk_error* error) {
        return geodisk_domain_surface(mesh.get(), &params, made, error);
    });
    SampleParams same_masked = same;
    same_masked.face_mask = mask;
    CHECK(placed(sample(shared_sampler(), masked.get()).get()) ==
          placed_set(expected(expect(Domain::surface(prepared_mesh, same_masked)))));
    double distance = 0;
    REQUIRE(geodisk_distance_for_count(mesh.get(), radii.get(), mask.data(), 300, &distance,
                                       nullptr) == GEODISK_OK);
    CHECK(distance == distance_for_count(prepared_mesh, same_masked, 300));
    CHECK(distance < params.min_distance);
    params.face_mask = nullptr;

    // The same surface twice, and one of another size.
    params.radii = nullptr;
    params.face_keys = nullptr;
    const TestMesh cube = builtin("cube", 1);
    const auto other = mesh_of(cube);
    auto parts = std::vector(2, sized<geodisk_surface_part>());
    parts[0].mesh = mesh.get();
    parts[0].params = &params;
    parts[1].mesh = other.get();
    auto on_cube = sized<geodisk_surface_params>();
    on_cube.min_distance = 0.3;
    parts[1].params = &on_cube;
    parts[1].scale = 2;
    const auto both = owned<geodisk_domain>([&](auto** made, geodisk_error* error) {
        return geodisk_domain_surfaces(parts.data(), 2, made, error);
    });
    const auto of_both = sample(shared_sampler(), both.get());
    const std::size_t count = geodisk_samples_count(of_both.get());
    std::vector<std::uint32_t> part(count);
    REQUIRE(geodisk_samples_copy(of_both.get(), GEODISK_PART, GEODISK_UINT32, part.data(), 0, count,
                                 nullptr) == GEODISK_OK);
    const Placed all = placed(of_both.get());
    Placed first;
    for (std::size_t i = 0; i < count; ++i) {
        REQUIRE(part[i] < 2);
        REQUIRE(all.faces[i] < (part[i] == 0 ? info.faces : 12));
        if (part[i] == 0) {
            first.faces.push_back(all.faces[i]);
            first.weights.insert(first.weights.end(), &all.weights[3 * i], &all.weights[3 * i] + 3);
        }
    }
    const auto alone =
        sample(shared_sampler(), surface_of(mesh.get(), params.min_distance, 0).get());
    CHECK(first == placed(alone.get()));
    CHECK(first.faces.size() < count);
}

TEST_CASE("other metrics and boxes") {
    const auto mesh = mesh_of(sampled_knot());
    const PreparedMesh prepared_mesh = prepared(sampled_knot());
    const MeshView view{sampled_knot().positions, sampled_knot().triangles};
    for (const auto& [metric, same] : {std::pair{GEODISK_EUCLIDEAN, Metric::euclidean},
                                       std::pair{GEODISK_APPROXIMATE, Metric::approximate}}) {
        auto params = sized<geodisk_surface_params>();
        params.min_distance = distance_for_count(prepared_mesh, {}, 300);
        params.metric = metric;
        const auto domain = owned<geodisk_domain>([&](auto** made, geodisk_error* error) {
            return geodisk_domain_surface(mesh.get(), &params, made, error);
        });
        const SampleSet set = expected(expect(Domain::surface_in_space(
            view, prepared_mesh, {.min_distance = params.min_distance}, same)));
        CHECK(placed(sample(shared_sampler(), domain.get()).get()) == placed_set(set));
    }

    const double sides[] = {1, 2, 1};
    auto box = sized<geodisk_box_params>();
    box.extents = sides;
    box.dimension = 3;
    box.is_periodic = 1;
    box.seed = 5;
    REQUIRE(geodisk_box_distance_for_count(&box, 400, &box.min_distance, nullptr) == GEODISK_OK);
    const auto domain = owned<geodisk_domain>(
        [&](auto** made, geodisk_error* error) { return geodisk_domain_box(&box, made, error); });
    BoxParams same;
    same.extents = {1, 2, 1};
    same.is_periodic = true;
    same.seed = 5;
    same.min_distance = distance_for_count(same, 400);
    const auto samples = sample(shared_sampler(), domain.get());
    CHECK(positions(samples.get()) == expected(expect(Domain::box(same))).points);
    CHECK(geodisk_samples_width(samples.get(), GEODISK_POSITION) == 3);
    CHECK(geodisk_samples_width(samples.get(), GEODISK_NORMAL) == 0);
    CHECK(geodisk_samples_width(samples.get(), GEODISK_FACE) == 0);
}

TEST_CASE("meshes of lengths, welded and saved ones") {
    // The surface of the cube, from lengths.
    const TestMesh cube = builtin("cube", 1);
    std::vector<double> lengths;
    for (std::size_t h = 0; h < cube.triangles.size(); ++h) {
        const std::size_t next = h % 3 == 2 ? h - 2 : h + 1;
        double square = 0;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const double d = cube.positions[std::size_t{3} * cube.triangles[next] + axis] -
                             cube.positions[std::size_t{3} * cube.triangles[h] + axis];
            square += d * d;
        }
        lengths.push_back(std::sqrt(square));
    }
    geodisk_mesh_params params = params_of(cube);
    params.positions = nullptr;
    params.edge_lengths = lengths.data();
    const auto create = [&](auto** made, geodisk_error* error) {
        return geodisk_mesh_create(&params, made, error);
    };
    const auto of_lengths = owned<geodisk_mesh>(create);
    const auto plain = mesh_of(cube);
    const auto set_of = [](const geodisk_mesh* mesh) {
        return placed(sample(shared_sampler(), surface_of(mesh, 0.3).get()).get());
    };
    CHECK(set_of(of_lengths.get()) == set_of(plain.get()));
    const auto bare = sample(shared_sampler(), surface_of(of_lengths.get(), 0.3).get());
    CHECK(geodisk_samples_width(bare.get(), GEODISK_POSITION) == 0);

    // A vertex for each corner.
    const TestMesh soup = soup_of(cube);
    params = params_of(soup);
    for (const std::int32_t weld : {0, 1}) { // Along seams, or by place.
        params.weld = weld;
        const auto joined = owned<geodisk_mesh>(create);
        CHECK(set_of(joined.get()) == set_of(plain.get()));
        auto info = sized<geodisk_mesh_info>();
        REQUIRE(geodisk_mesh_describe(joined.get(), &info, nullptr) == GEODISK_OK);
        CHECK(info.merged_vertices == 36 - 8);
        CHECK(info.joined_edges == (weld != 0 ? 0 : 36));
        CHECK(info.boundary_edges == 0);
    }
    params.weld = 0;
    params.keep_seams = 1;
    auto apart = sized<geodisk_mesh_info>();
    REQUIRE(geodisk_mesh_describe(owned<geodisk_mesh>(create).get(), &apart, nullptr) ==
            GEODISK_OK);
    CHECK(apart.joined_edges == 0);
    CHECK(apart.coinciding_border_edges == 36);
    CHECK(apart.components == 12);

    std::size_t size = 0;
    REQUIRE(geodisk_mesh_save(plain.get(), nullptr, 0, &size, nullptr) == GEODISK_OK);
    std::vector<unsigned char> bytes(size);
    REQUIRE(geodisk_mesh_save(plain.get(), bytes.data(), size, &size, nullptr) == GEODISK_OK);
    const auto loaded = owned<geodisk_mesh>([&](auto** made, geodisk_error* error) {
        return geodisk_mesh_load(bytes.data(), bytes.size(), made, error);
    });
    CHECK(set_of(loaded.get()) == set_of(plain.get()));
    bytes[size / 2] ^= 1;
    geodisk_mesh* none = nullptr;
    CHECK(geodisk_mesh_load(bytes.data(), bytes.size(), &none, nullptr) ==
          GEODISK_INVALID_ARGUMENT);
    CHECK(none == nullptr);
}

TEST_CASE("levels have distances and seeds of their own") {
    const auto mesh = mesh_of(sampled_knot());
    auto params = sized<geodisk_surface_params>();
    params.min_distance = 0.3;
    params.seed = 5;
    std::uint32_t levels = 0;
    REQUIRE(geodisk_level_count(mesh.get(), &params, 0, &levels, nullptr) == GEODISK_OK);
    CHECK(levels >= 2);
    double distance = 0;
    std::uint64_t seed = 0;
    for (std::uint32_t level = 0; level < levels; ++level) {
        REQUIRE(geodisk_level_params(&params, 0, levels, level, &distance, &seed, nullptr) ==
                GEODISK_OK);
        CHECK(distance == 0.3 * (1 << (levels - 1 - level)));
        CHECK((seed == 5) == (level == 0));
    }
    const auto fails = [&](double factor, std::uint32_t count, std::uint32_t level) {
        return geodisk_level_params(&params, factor, count, level, &distance, &seed, nullptr) ==
               GEODISK_INVALID_ARGUMENT;
    };
    CHECK(fails(1, 2, 0));
    CHECK(fails(9, 2, 0));
    CHECK(fails(2, 0, 0));
    CHECK(fails(2, 33, 0));
    CHECK(fails(2, 2, 2));
    CHECK(geodisk_level_params(&params, 2, 2, 0, nullptr, &seed, nullptr) ==
          GEODISK_INVALID_ARGUMENT);
    CHECK(geodisk_level_count(mesh.get(), &params, 1, &levels, nullptr) ==
          GEODISK_INVALID_ARGUMENT);
    CHECK(geodisk_level_count(nullptr, &params, 2, &levels, nullptr) == GEODISK_INVALID_ARGUMENT);
}

} // namespace geodisk::test
