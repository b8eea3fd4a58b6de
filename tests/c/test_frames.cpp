// Samples in the frames of an engine in C.
#include <doctest/doctest.h>

#include <cstring>
#include <string>
#include <vector>

#include <vulkan/vulkan_core.h>

#include "c/api.hpp"
#include "c/lent.hpp"
#include "device_run.hpp"
#include "embed/workshop.hpp"

namespace geodisk::test {
namespace {

Owned<geodisk_domain> knot(std::uint64_t seed) {
    const auto mesh = mesh_of(builtin("torus-knot", 8));
    double distance = 0;
    REQUIRE(geodisk_distance_for_count(mesh.get(), nullptr, nullptr, 200, &distance, nullptr) ==
            GEODISK_OK);
    return surface_of(mesh.get(), distance, seed);
}

Owned<geodisk_frame_sampler> frames_of(const geodisk_device* device, const geodisk_domain* domain) {
    auto options = sized<geodisk_frame_options>();
    options.frames = 3;
    return owned<geodisk_frame_sampler>([&](auto** made, geodisk_error* error) {
        return geodisk_frame_sampler_create(device, domain, &options, made, error);
    });
}

geodisk_frame_samples described(const Owned<geodisk_frame_sampler>& frames) {
    auto samples = sized<geodisk_frame_samples>();
    REQUIRE(geodisk_frame_sampler_describe(frames.get(), &samples, nullptr) == GEODISK_OK);
    return samples;
}

std::vector<geodisk_placed_record> read(Workshop& workshop, const geodisk_frame_samples& samples) {
    const VkDeviceSize bytes = samples.ready * sizeof(geodisk_placed_record);
    workshop.frame(0, [&](VkCommandBuffer commands) {
        workshop.record_download(
            commands, {handle_of<VkBuffer>(samples.buffer), samples.placed_offset, bytes}, bytes);
    });
    std::vector<geodisk_placed_record> records(samples.ready);
    std::memcpy(records.data(), workshop.download_bytes().data(), bytes);
    return records;
}

/// The faces and weights are those of samples by geodisk_sample.
void check_set(Workshop& workshop, const geodisk_frame_samples& samples,
               const geodisk_domain* domain) {
    REQUIRE(samples.is_complete == 1);
    Placed found;
    for (const geodisk_placed_record& p : read(workshop, samples)) {
        found.faces.push_back(p.face);
        found.weights.insert(found.weights.end(),
                             {1.0f - p.weight1 - p.weight2, p.weight1, p.weight2});
    }
    CHECK(found == placed(sample(shared_sampler(), domain).get()));
}

} // namespace

TEST_CASE("frames in C: recorded, waited for, and begun again with another seed") {
    const auto device = borrowed(lent_device(shared_context().device(), shared_context().queue()));
    const auto domain = knot(1);
    Workshop workshop(shared_context());
    workshop.cut({});
    const auto frames = frames_of(device.get(), domain.get());
    CHECK(described(frames).is_complete == 0);
    std::int32_t is_complete = 0;
    for (std::uint32_t frame = 0; is_complete == 0; ++frame) {
        REQUIRE(frame < 10'000);
        workshop.frame(frame, [&](VkCommandBuffer commands) {
            REQUIRE(geodisk_frame_sampler_record(frames.get(), commands, &is_complete, nullptr) ==
                    GEODISK_OK);
        });
    }
    check_set(workshop, described(frames), domain.get());

    REQUIRE(geodisk_frame_sampler_set_seed(frames.get(), 9, nullptr) == GEODISK_OK);
    CHECK(described(frames).ready == 0);
    const auto sampler = owned<geodisk_sampler>([&](auto** made, geodisk_error* error) {
        return geodisk_sampler_create(device.get(), nullptr, made, error);
    });
    REQUIRE(geodisk_frame_sampler_wait(frames.get(), sampler.get(), nullptr) == GEODISK_OK);
    check_set(workshop, described(frames), knot(9).get());
}

TEST_CASE("frames in C sample what requests ask for, or name the field that they cannot") {
    const auto device = borrowed(lent_device(shared_context().device(), shared_context().queue()));
    const auto mesh = mesh_of(builtin("torus-knot", 8));
    auto params = sized<geodisk_surface_params>();
    params.seed = 1;
    REQUIRE(geodisk_distance_for_count(mesh.get(), nullptr, nullptr, 200, &params.min_distance,
                                       nullptr) == GEODISK_OK);
    auto request = sized<geodisk_request>();
    request.params = &params;
    auto on_mesh = sized<geodisk_mesh_request>();
    on_mesh.mesh = mesh.get();
    on_mesh.request = &request;
    const auto create = [&](geodisk_frame_sampler** made, geodisk_error* error) {
        return geodisk_frame_sampler_create_requests(device.get(), &on_mesh, 1, nullptr, made,
                                                     error);
    };
    const auto frames = owned<geodisk_frame_sampler>(create);
    const auto sampler = owned<geodisk_sampler>([&](auto** made, geodisk_error* error) {
        return geodisk_sampler_create(device.get(), nullptr, made, error);
    });
    REQUIRE(geodisk_frame_sampler_wait(frames.get(), sampler.get(), nullptr) == GEODISK_OK);
    Workshop workshop(shared_context());
    workshop.cut({});
    check_set(workshop, described(frames), knot(1).get());

    request.order = GEODISK_ORDER_PROGRESSIVE;
    geodisk_frame_sampler* made = nullptr;
    auto error = sized<geodisk_error>();
    CHECK(create(&made, &error) == GEODISK_INVALID_ARGUMENT);
    CHECK(std::string(error.message).starts_with("frames and progressive exclude each other"));
    CHECK(made == nullptr);
}

TEST_CASE("frames in C refuse NULL, boxes and options that cannot be") {
    const auto device = borrowed(lent_device(shared_context().device(), shared_context().queue()));
    const auto domain = knot(1);
    geodisk_frame_sampler* made = nullptr;
    const auto create = [&](const geodisk_frame_options* options) {
        return geodisk_frame_sampler_create(device.get(), domain.get(), options, &made, nullptr);
    };
    auto options = sized<geodisk_frame_options>();
    options.frames = 17;
    CHECK(create(&options) == GEODISK_INVALID_ARGUMENT);
    CHECK(geodisk_frame_sampler_create(nullptr, domain.get(), nullptr, &made, nullptr) ==
          GEODISK_INVALID_ARGUMENT);
    CHECK(geodisk_frame_sampler_create(device.get(), nullptr, nullptr, &made, nullptr) ==
          GEODISK_INVALID_ARGUMENT);
    CHECK(made == nullptr);
    CHECK(geodisk_frame_sampler_record(nullptr, nullptr, nullptr, nullptr) ==
          GEODISK_INVALID_ARGUMENT);
    const auto frames = frames_of(device.get(), domain.get());
    CHECK(geodisk_frame_sampler_record(frames.get(), nullptr, nullptr, nullptr) ==
          GEODISK_INVALID_ARGUMENT);
    CHECK(geodisk_frame_sampler_wait(frames.get(), nullptr, nullptr) == GEODISK_INVALID_ARGUMENT);
    CHECK(geodisk_frame_sampler_describe(frames.get(), nullptr, nullptr) ==
          GEODISK_INVALID_ARGUMENT);
    geodisk_frame_sampler_release(nullptr);
}

} // namespace geodisk::test
