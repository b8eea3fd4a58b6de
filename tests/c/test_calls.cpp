// Behaviour of the functions of the C API: wrong arguments, structs of other versions, several
// threads, and the lifetime of objects.
#include <doctest/doctest.h>

#include <cstring>
#include <string>
#include <thread>
#include <vector>

#include "c/api.hpp"

namespace geodisk::test {
namespace {

/// The status of a call and its message, which must be there unless it succeeds.
struct Outcome {
    geodisk_status status;
    std::string message;
};

template <class Call>
Outcome outcome(const Call& call) {
    auto error = sized<geodisk_error>();
    std::strcpy(error.message, "not written");
    const geodisk_status status = call(&error);
    CHECK(error.status == status);
    CHECK((std::strlen(error.message) == 0) == (status == GEODISK_OK));
    CHECK(std::string(error.message) != "not written");
    CHECK(call(nullptr) == status);
    return {status, error.message};
}

template <class Call>
void check_wrong(const std::string& part, const Call& call) {
    const Outcome found = outcome(call);
    INFO(found.message);
    CHECK(found.status == GEODISK_INVALID_ARGUMENT);
    CHECK(found.message.find(part) != std::string::npos);
}

const TestMesh& cube() {
    static const TestMesh kMesh = builtin("cube", 1);
    return kMesh;
}

} // namespace

TEST_CASE("wrong arguments are told of") {
    const auto mesh = mesh_of(cube());
    const auto domain = surface_of(mesh.get(), 0.3);
    const auto samples = sample(shared_sampler(), domain.get());
    geodisk_mesh* made = nullptr;
    geodisk_domain* made_domain = nullptr;
    geodisk_samples* made_samples = nullptr;
    geodisk_sampler* made_sampler = nullptr;
    geodisk_device* made_device = nullptr;
    geodisk_radii* made_radii = nullptr;

    const auto mesh_fails = [&](const std::string& part, const auto& change) {
        geodisk_mesh_params params = params_of(cube());
        change(params);
        check_wrong(part, [&](geodisk_error* e) { return geodisk_mesh_create(&params, &made, e); });
    };
    mesh_fails("struct_size", [](auto& p) { p.struct_size = 0; });
    mesh_fails("struct_size", [](auto& p) { p.struct_size -= 3; });
    mesh_fails("one of", [](auto& p) { p.positions = nullptr; });
    mesh_fails("indices is NULL", [](auto& p) { p.indices = nullptr; });
    mesh_fails("position_type", [](auto& p) { p.position_type = GEODISK_UINT16; });
    mesh_fails("index_type", [](auto& p) { p.index_type = GEODISK_FLOAT32; });
    mesh_fails("", [](auto& p) { p.dimension = 9; });
    mesh_fails("", [](auto& p) { p.position_stride = 8; });
    mesh_fails("aligned", [](auto& p) { p.position_stride = 25; });
    mesh_fails("aligned", [](auto& p) { p.index_stride = 3; });
    mesh_fails("face_count", [](auto& p) { p.face_count = SIZE_MAX; });
    mesh_fails("", [](auto& p) {
        p.weld = 1;
        p.weld_distance = -1;
    });
    mesh_fails("contradict", [](auto& p) { p.weld = p.keep_seams = 1; });
    mesh_fails("weld needs", [](auto& p) {
        static const double kLengths[36] = {};
        p.edge_lengths = kLengths;
        p.positions = nullptr;
        p.weld = 1;
    });
    check_wrong("params is NULL",
                [&](geodisk_error* e) { return geodisk_mesh_create(nullptr, &made, e); });
    const geodisk_mesh_params good = params_of(cube());
    check_wrong("mesh is NULL",
                [&](geodisk_error* e) { return geodisk_mesh_create(&good, nullptr, e); });

    // Errors of the mesh itself name the place.
    std::vector<std::uint32_t> indices = cube().triangles;
    indices[7] = 1000;
    geodisk_mesh_params bad = params_of(cube());
    bad.indices = indices.data();
    auto error = sized<geodisk_error>();
    CHECK(geodisk_mesh_create(&bad, &made, &error) == GEODISK_MESH_REJECTED);
    CHECK(error.element == 2);
    bad = good;
    bad.face_count = 0;
    CHECK(geodisk_mesh_create(&bad, &made, &error) == GEODISK_MESH_REJECTED);
    CHECK(error.element == GEODISK_NO_ELEMENT);
    CHECK(made == nullptr);

    auto params = sized<geodisk_surface_params>();
    const auto surface = [&](geodisk_error* e) {
        return geodisk_domain_surface(mesh.get(), &params, &made_domain, e);
    };
    check_wrong("", surface); // No distance.
    params.min_distance = 0.3;
    params.pool_ratio = 0.5;
    check_wrong("the pool ratio must be 1 to 10,000, not 0.5", surface);
    params.pool_ratio = 0;
    params.metric = 7;
    check_wrong("metric", surface);
    params.metric = 0;
    std::vector<double> factors(8, 1.0);
    const auto radii_of = [&](const geodisk_mesh* of) {
        return owned<geodisk_radii>([&](auto** object, geodisk_error* e) {
            return geodisk_radii_create(of, factors.data(), GEODISK_FLOAT64, 8, object, e);
        });
    };
    const auto other = mesh_of(cube());
    const auto radii = radii_of(other.get());
    params.radii = radii.get();
    check_wrong("another mesh", surface);
    params.radii = nullptr;
    double distance = 0;
    check_wrong("another mesh", [&](geodisk_error* e) {
        return geodisk_distance_for_count(mesh.get(), radii.get(), nullptr, 10, &distance, e);
    });
    check_wrong("count", [&](geodisk_error* e) {
        return geodisk_distance_for_count(mesh.get(), nullptr, nullptr, 0.0 / 1, &distance, e);
    });
    check_wrong("factors for", [&](geodisk_error* e) {
        return geodisk_radii_create(mesh.get(), factors.data(), GEODISK_FLOAT64, 9, &made_radii, e);
    });
    factors[3] = 2;
    CHECK(geodisk_radii_create(mesh.get(), factors.data(), GEODISK_FLOAT64, 8, &made_radii,
                               &error) == GEODISK_INVALID_ARGUMENT);
    CHECK(error.element == 3);
    check_wrong("densities for", [&](geodisk_error* e) {
        return geodisk_density_create(mesh.get(), factors.data(), GEODISK_FLOAT64, 9, &made_radii,
                                      e);
    });
    factors[3] = -2;
    CHECK(geodisk_density_create(mesh.get(), factors.data(), GEODISK_FLOAT64, 8, &made_radii,
                                 &error) == GEODISK_INVALID_ARGUMENT);
    CHECK(error.element == 3);
    factors[3] = 4;
    const auto density = owned<geodisk_radii>([&](auto** object, geodisk_error* e) {
        return geodisk_density_create(mesh.get(), factors.data(), GEODISK_FLOAT64, 8, object, e);
    });
    CHECK(geodisk_radii_min_factor(density.get()) == 0.5);
    CHECK(geodisk_radii_min_factor(nullptr) == 1);

    check_wrong("parts is empty", [&](geodisk_error* e) {
        return geodisk_domain_surfaces(nullptr, 0, &made_domain, e);
    });
    check_wrong("parts[0] is NULL", [&](geodisk_error* e) {
        return geodisk_domain_surfaces(nullptr, 2, &made_domain, e);
    });
    auto box = sized<geodisk_box_params>();
    const auto box_domain = [&](geodisk_error* e) {
        return geodisk_domain_box(&box, &made_domain, e);
    };
    check_wrong("extents is NULL", box_domain);
    const double sides[7] = {1, 1, 1, 1, 1, 1, 1};
    box.extents = sides;
    box.dimension = 7;
    check_wrong("dimension", box_domain);
    box.dimension = 2;
    check_wrong("", box_domain); // No distance.
    const double flat[2] = {1, 0};
    box.extents = flat;
    check_wrong("", [&](geodisk_error* e) {
        return geodisk_box_distance_for_count(&box, 100, &distance, e);
    });

    check_wrong("NULL", [&](geodisk_error* e) {
        return geodisk_sampler_create(nullptr, nullptr, &made_sampler, e);
    });
    auto options = sized<geodisk_sampler_options>();
    options.stall_seconds = -1;
    check_wrong("", [&](geodisk_error* e) {
        return geodisk_sampler_create(shared_device(), &options, &made_sampler, e);
    });
    check_wrong("sampler is NULL", [&](geodisk_error* e) {
        return geodisk_sample(nullptr, domain.get(), nullptr, nullptr, &made_samples, e);
    });
    check_wrong("NULL", [&](geodisk_error* e) {
        return geodisk_sample(shared_sampler(), nullptr, nullptr, nullptr, &made_samples, e);
    });
    check_wrong("no run in progress", [&](geodisk_error* e) {
        return geodisk_poll(shared_sampler(), 0, &made_samples, e);
    });

    std::vector<double> data(3 * geodisk_samples_count(samples.get()));
    const std::size_t count = geodisk_samples_count(samples.get());
    const auto copies_wrong = [&](const std::string& part, geodisk_attribute attribute,
                                  geodisk_type type, void* to, std::size_t stride,
                                  std::size_t capacity) {
        check_wrong(part, [&](geodisk_error* e) {
            return geodisk_samples_copy(samples.get(), attribute, type, to, stride, capacity, e);
        });
    };
    copies_wrong("no such attribute", 99, GEODISK_FLOAT64, data.data(), 0, count);
    copies_wrong("GEODISK_UINT32", GEODISK_FACE, GEODISK_FLOAT64, data.data(), 0, count);
    copies_wrong("GEODISK_FLOAT", GEODISK_POSITION, GEODISK_UINT32, data.data(), 0, count);
    copies_wrong("capacity", GEODISK_POSITION, GEODISK_FLOAT64, data.data(), 0, count - 1);
    copies_wrong("stride", GEODISK_POSITION, GEODISK_FLOAT64, data.data(), 16, count);
    copies_wrong("data is NULL", GEODISK_POSITION, GEODISK_FLOAT64, nullptr, 0, count);

    auto device_options = sized<geodisk_device_options>();
    device_options.device = "nowhere";
    const Outcome nowhere = outcome(
        [&](geodisk_error* e) { return geodisk_device_open(&device_options, &made_device, e); });
    CHECK(nowhere.status == GEODISK_NO_DEVICE);
    CHECK(nowhere.message.find("nowhere") != std::string::npos);
    auto lent = sized<geodisk_vulkan_device>();
    check_wrong("NULL",
                [&](geodisk_error* e) { return geodisk_device_borrow(&lent, &made_device, e); });

    // NULL where an object is asked about, and released.
    CHECK(geodisk_samples_count(nullptr) == 0);
    CHECK(geodisk_samples_width(nullptr, GEODISK_FACE) == 0);
    geodisk_cancel(nullptr);
    Release()(static_cast<geodisk_device*>(nullptr));
    Release()(static_cast<geodisk_mesh*>(nullptr));
    Release()(static_cast<geodisk_radii*>(nullptr));
    Release()(static_cast<geodisk_domain*>(nullptr));
    Release()(static_cast<geodisk_sampler*>(nullptr));
    Release()(static_cast<geodisk_samples*>(nullptr));
}

TEST_CASE("a surface in a frame") {
    const auto mesh = mesh_of(cube());
    auto params = sized<geodisk_surface_params>();
    params.min_distance = 0.3;
    params.seed = 1;
    geodisk_job_frame frame{};
    REQUIRE(geodisk_job_frame_of(mesh.get(), &params, &frame, nullptr) == GEODISK_OK);
    const auto framed = owned<geodisk_domain>([&](auto** made, geodisk_error* error) {
        return geodisk_domain_surface_in_frame(mesh.get(), &params, &frame, made, error);
    });
    CHECK(placed(sample(shared_sampler(), framed.get()).get()) ==
          placed(sample(shared_sampler(), surface_of(mesh.get(), 0.3).get()).get()));

    geodisk_domain* domain = nullptr;
    const auto make = [&](geodisk_error* error) {
        return geodisk_domain_surface_in_frame(mesh.get(), &params, &frame, &domain, error);
    };
    params.min_distance = 0.4;
    check_wrong("for another job", make);
    params.metric = GEODISK_EUCLIDEAN;
    check_wrong("geodesic distances only", make);
    params.metric = GEODISK_GEODESIC;
    frame.bytes[20] ^= 1;
    check_wrong("is damaged", make);
    check_wrong("frame is NULL", [&](geodisk_error* error) {
        return geodisk_job_frame_of(mesh.get(), &params, nullptr, error);
    });
    check_wrong("frame is NULL", [&](geodisk_error* error) {
        return geodisk_domain_surface_in_frame(mesh.get(), &params, nullptr, &domain, error);
    });
}

TEST_CASE("structs of older and later versions") {
    const auto mesh = mesh_of(cube());
    // An older one ends early; what it lacks is 0, whatever lies behind it.
    auto params = sized<geodisk_surface_params>();
    params.min_distance = 0.3;
    params.seed = 1;
    params.metric = 99;
    params.struct_size = offsetof(geodisk_surface_params, face_keys);
    const auto older = owned<geodisk_domain>([&](auto** made, geodisk_error* error) {
        return geodisk_domain_surface(mesh.get(), &params, made, error);
    });
    CHECK(placed(sample(shared_sampler(), older.get()).get()) ==
          placed(sample(shared_sampler(), surface_of(mesh.get(), 0.3).get()).get()));

    struct Later {
        geodisk_surface_params known;
        std::uint64_t unknown;
    };
    Later later{};
    later.known.struct_size = sizeof later;
    later.known.min_distance = 0.3;
    geodisk_domain* domain = nullptr;
    REQUIRE(geodisk_domain_surface(mesh.get(), &later.known, &domain, nullptr) == GEODISK_OK);
    geodisk_domain_release(domain);
    later.unknown = 1;
    check_wrong("lacks", [&](geodisk_error* error) {
        return geodisk_domain_surface(mesh.get(), &later.known, &domain, error);
    });

    // Output ends where the caller's struct does.
    auto info = sized<geodisk_mesh_info>();
    info.struct_size = offsetof(geodisk_mesh_info, faces);
    info.faces = 77;
    REQUIRE(geodisk_mesh_describe(mesh.get(), &info, nullptr) == GEODISK_OK);
    CHECK(info.vertices == 8);
    CHECK(info.faces == 77);
    geodisk_error none{};
    std::strcpy(none.message, "as it was");
    CHECK(geodisk_mesh_create(nullptr, nullptr, &none) == GEODISK_INVALID_ARGUMENT);
    CHECK(std::string(none.message) == "as it was");
}

TEST_CASE("objects live as long as others need them") {
    auto device = owned<geodisk_device>([](auto** made, geodisk_error* error) {
        return geodisk_device_open(nullptr, made, error);
    });
    auto sampler = owned<geodisk_sampler>([&](auto** made, geodisk_error* error) {
        return geodisk_sampler_create(device.get(), nullptr, made, error);
    });
    device.reset();
    auto mesh = mesh_of(cube());
    auto domain = surface_of(mesh.get(), 0.3);
    mesh.reset();
    REQUIRE(geodisk_start(sampler.get(), domain.get(), nullptr) == GEODISK_OK);
    domain.reset();
    geodisk_samples* polled = nullptr;
    while (polled == nullptr) {
        REQUIRE(geodisk_poll(sampler.get(), 1000, &polled, nullptr) == GEODISK_OK);
    }
    sampler.reset();
    const Owned<geodisk_samples> samples(polled);
    const auto again = mesh_of(cube());
    CHECK(positions(samples.get()) ==
          positions(sample(shared_sampler(), surface_of(again.get(), 0.3).get()).get()));

    // One that was started is ended by its release.
    auto other = owned<geodisk_sampler>([&](auto** made, geodisk_error* error) {
        return geodisk_sampler_create(shared_device(), nullptr, made, error);
    });
    REQUIRE(geodisk_start(other.get(), surface_of(again.get(), 0.001).get(), nullptr) ==
            GEODISK_OK);
}

TEST_CASE("runs are watched, cancelled, and one at a time") {
    const TestMesh knot = builtin("torus-knot", 8);
    const auto mesh = mesh_of(knot);
    double distance = 0;
    REQUIRE(geodisk_distance_for_count(mesh.get(), nullptr, nullptr, 3000, &distance, nullptr) ==
            GEODISK_OK);
    const auto domain = surface_of(mesh.get(), distance);
    const auto sampler = owned<geodisk_sampler>([&](auto** made, geodisk_error* error) {
        return geodisk_sampler_create(shared_device(), nullptr, made, error);
    });

    struct Watch {
        geodisk_sampler* sampler;
        const geodisk_domain* domain;
        int calls = 0, stop_at = -1;
        geodisk_status within = GEODISK_OK, beside = GEODISK_OK;
        std::uint32_t accepted = 0;
    } watch{sampler.get(), domain.get()};
    const auto told = [](void* user, const geodisk_progress* progress) -> std::int32_t {
        Watch& one = *static_cast<Watch*>(user);
        one.accepted = progress->accepted;
        if (one.calls++ == 0) {
            // Neither this thread nor another gets the sampler meanwhile.
            geodisk_samples* none = nullptr;
            one.within = geodisk_sample(one.sampler, one.domain, nullptr, nullptr, &none, nullptr);
            std::thread([&] { one.beside = geodisk_sampler_trim(one.sampler, nullptr); }).join();
        }
        return one.calls == one.stop_at ? 1 : 0;
    };
    geodisk_samples* samples = nullptr;
    REQUIRE(geodisk_sample(sampler.get(), domain.get(), told, &watch, &samples, nullptr) ==
            GEODISK_OK);
    const Owned<geodisk_samples> all(samples);
    CHECK(watch.calls > 1);
    CHECK(watch.within == GEODISK_BUSY);
    CHECK(watch.beside == GEODISK_BUSY);
    CHECK(watch.accepted <= geodisk_samples_count(all.get()));

    // Stopped by the callback, and from another thread; the sampler goes on to work.
    watch.calls = 1;
    watch.stop_at = 2;
    samples = nullptr;
    CHECK(geodisk_sample(sampler.get(), domain.get(), told, &watch, &samples, nullptr) ==
          GEODISK_CANCELLED);
    CHECK(samples == nullptr);
    const auto cancels = [](void* user, const geodisk_progress*) -> std::int32_t {
        geodisk_cancel(static_cast<geodisk_sampler*>(user));
        return 0;
    };
    CHECK(geodisk_sample(sampler.get(), domain.get(), cancels, sampler.get(), &samples, nullptr) ==
          GEODISK_CANCELLED);

    REQUIRE(geodisk_start(sampler.get(), domain.get(), nullptr) == GEODISK_OK);
    CHECK(geodisk_start(sampler.get(), domain.get(), nullptr) == GEODISK_BUSY);
    auto so_far = sized<geodisk_progress>();
    while (so_far.candidates == 0) {
        REQUIRE(geodisk_poll(sampler.get(), 1000, &samples, nullptr) == GEODISK_OK);
        REQUIRE(samples == nullptr);
        REQUIRE(geodisk_sampler_progress(sampler.get(), &so_far, nullptr) == GEODISK_OK);
    }
    CHECK(so_far.accepted <= geodisk_samples_count(all.get()));
    CHECK(geodisk_sampler_trim(sampler.get(), nullptr) == GEODISK_BUSY);
    geodisk_cancel(sampler.get());
    geodisk_status status = GEODISK_OK;
    while (status == GEODISK_OK && samples == nullptr) {
        status = geodisk_poll(sampler.get(), 1000, &samples, nullptr);
    }
    CHECK(status == GEODISK_CANCELLED);
    REQUIRE(geodisk_sampler_progress(sampler.get(), &so_far, nullptr) == GEODISK_OK);
    CHECK(so_far.candidates == 0);
    CHECK(placed(sample(sampler.get(), domain.get()).get()) == placed(all.get()));
}

TEST_CASE("devices are told of") {
    std::size_t count = 0;
    REQUIRE(geodisk_list_devices(nullptr, 0, &count, nullptr) == GEODISK_OK);
    REQUIRE(count >= 1);
    std::vector<geodisk_device_info> infos(count);
    infos[0].struct_size = sizeof infos[0];
    REQUIRE(geodisk_list_devices(infos.data(), count, &count, nullptr) == GEODISK_OK);
    for (const geodisk_device_info& info : infos) {
        CHECK(info.struct_size == sizeof info);
        CHECK(std::strlen(info.name) > 0);
        CHECK((std::strlen(info.reasons) == 0) == (info.is_usable != 0));
    }
    auto info = sized<geodisk_device_info>();
    REQUIRE(geodisk_device_describe(shared_device(), &info, nullptr) == GEODISK_OK);
    CHECK(info.is_usable == 1);
    CHECK(info.compute_queue_family != GEODISK_NO_QUEUE_FAMILY);
    CHECK(std::string(geodisk_status_name(GEODISK_BUSY)) == "busy");
    CHECK(std::string(geodisk_status_name(5)) == "unknown");
    CHECK(std::string(geodisk_version()) == GEODISK_TEST_VERSION);
}

} // namespace geodisk::test
