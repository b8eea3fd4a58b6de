// The C API on a device of the caller's.
#include <doctest/doctest.h>

#include "c/api.hpp"
#include "c/lent.hpp"
#include "embed/app_device.hpp"
#include "embed/arena.hpp"

namespace geodisk::test {

TEST_CASE("a borrowed device gives the same samples, and is left as it was") {
    AppDevice app;
    const DeviceRefs refs = app.refs();
    const QueueRef queue = app.queue();
    auto info = sized<geodisk_device_info>();
    const auto get = reinterpret_cast<void (*)(void)>(refs.get_instance_proc_addr);
    REQUIRE(geodisk_query_device(get, refs.instance, refs.physical_device, &info, nullptr) ==
            GEODISK_OK);
    CHECK(info.is_usable == 1);

    struct Locks {
        int held = 0, times = 0;
    } locks;
    geodisk_vulkan_device lent = lent_device(refs, queue);
    lent.lock_user = &locks;
    lent.lock = [](void* user) {
        ++static_cast<Locks*>(user)->held;
        ++static_cast<Locks*>(user)->times;
    };
    lent.unlock = [](void* user) { --static_cast<Locks*>(user)->held; };
    {
        const auto device = borrowed(lent);
        const auto sampler = owned<geodisk_sampler>([&](auto** made, geodisk_error* error) {
            return geodisk_sampler_create(device.get(), nullptr, made, error);
        });
        const TestMesh cube = builtin("cube", 1);
        const auto mesh = mesh_of(cube);
        const auto domain = surface_of(mesh.get(), 0.2);
        CHECK(placed(sample(sampler.get(), domain.get()).get()) ==
              placed(sample(shared_sampler(), domain.get()).get()));
    }
    CHECK(locks.held == 0);
    CHECK(locks.times > 0);
    app.destroy_device();
    CHECK(app.messages().empty());

    lent.unlock = nullptr;
    geodisk_device* none = nullptr;
    CHECK(geodisk_device_borrow(&lent, &none, nullptr) == GEODISK_INVALID_ARGUMENT);
    lent = lent_device(refs, queue);
    lent.free = [](void*, const geodisk_memory_grant*) {};
    CHECK(geodisk_device_borrow(&lent, &none, nullptr) == GEODISK_INVALID_ARGUMENT);
}

TEST_CASE("the memory of runs comes from the caller, and goes back") {
    AppDevice app;
    {
        Arena arena(app.refs());
        geodisk_vulkan_device lent = lent_device(app.refs(), app.queue());
        const MemoryHooks hooks = arena.hooks();
        lent.memory_user = const_cast<MemoryHooks*>(&hooks);
        lent.allocate = [](void* user, const geodisk_memory_request* request,
                           geodisk_memory_grant* grant) {
            MemoryRequest asked{handle_of<VkBuffer>(request->buffer),
                                {request->bytes, request->alignment, request->memory_types},
                                request->required,
                                request->preferred};
            MemoryGrant given;
            const auto& own = *static_cast<const MemoryHooks*>(user);
            const VkResult result = own.allocate(own.user, asked, given);
            grant->memory = number_of(given.memory);
            grant->offset = given.offset;
            grant->mapped = given.mapped;
            grant->allocation = given.allocation;
            return std::int32_t{result};
        };
        lent.free = [](void* user, const geodisk_memory_grant* grant) {
            const auto& own = *static_cast<const MemoryHooks*>(user);
            own.free(own.user, {handle_of<VkDeviceMemory>(grant->memory), grant->offset,
                                grant->mapped, grant->allocation});
        };
        const TestMesh cube = builtin("cube", 1);
        const auto mesh = mesh_of(cube);
        const auto domain = surface_of(mesh.get(), 0.2);
        const auto wanted = placed(sample(shared_sampler(), domain.get()).get());
        const auto device = borrowed(lent);
        const auto create = [&](auto** made, geodisk_error* error) {
            return geodisk_sampler_create(device.get(), nullptr, made, error);
        };
        {
            const auto sampler = owned<geodisk_sampler>(create);
            CHECK(placed(sample(sampler.get(), domain.get()).get()) == wanted);
            CHECK(!arena.alive.empty());
        }
        CHECK(arena.alive.empty());

        arena.fail_from = arena.asked + 1;
        auto error = sized<geodisk_error>();
        geodisk_sampler* refused = nullptr;
        geodisk_status status = geodisk_sampler_create(device.get(), nullptr, &refused, &error);
        if (status == GEODISK_OK) {
            geodisk_samples* none = nullptr;
            status = geodisk_sample(refused, domain.get(), nullptr, nullptr, &none, &error);
            CHECK(none == nullptr);
        }
        CHECK(status == GEODISK_OUT_OF_DEVICE_MEMORY);
        geodisk_sampler_release(refused);
        CHECK(arena.alive.empty());
    }
    app.destroy_device();
    CHECK(app.messages().empty());
}

} // namespace geodisk::test
