// The C API on a device of the caller's.
#include <doctest/doctest.h>

#include <cstring>

#include "c/api.hpp"
#include "embed/app_device.hpp"

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
    auto lent = sized<geodisk_vulkan_device>();
    lent.instance = refs.instance;
    lent.physical_device = refs.physical_device;
    lent.device = refs.device;
    lent.get_instance_proc_addr = get;
    lent.api_version = refs.api_version;
    lent.queue = queue.queue;
    lent.queue_family = queue.family;
    lent.lock_user = &locks;
    lent.lock = [](void* user) {
        ++static_cast<Locks*>(user)->held;
        ++static_cast<Locks*>(user)->times;
    };
    lent.unlock = [](void* user) { --static_cast<Locks*>(user)->held; };
    {
        const auto device = owned<geodisk_device>([&](auto** made, geodisk_error* error) {
            return geodisk_device_borrow(&lent, made, error);
        });
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
}

} // namespace geodisk::test
