// Context: choosing a device, owning it, and failing in words.
#include <doctest/doctest.h>

#include <algorithm>
#include <cstdlib>
#include <string>
#include <thread>
#include <utility>

#include <geodisk/context.hpp>
#include <geodisk/sampler.hpp>

#include "fake_driver.hpp"
#include "owned/context_access.hpp"
#include "support/device_abilities.hpp"
#include "vk/dispatch.hpp"

using namespace geodisk;

namespace {

constexpr const char* kHexDigits = "0123456789abcdef";

bool names(const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
}

std::string in_capitals(std::string text) {
    for (char& c : text) {
        c = c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c;
    }
    return text;
}

/// On the device that a context takes by itself.
Context create_plain_context() {
    Result<Context> context = Context::create();
    REQUIRE(context);
    return std::move(context).value();
}

ContextOptions on_device(std::string name) {
    ContextOptions options;
    options.device = std::move(name);
    return options;
}

DeviceReport report_of(const char* name, VkPhysicalDeviceType type) {
    DeviceReport report;
    report.name = name;
    report.type = type;
    return report;
}

/// Submits nothing and waits for it: the least that shows a device and queue to work.
VkResult submit_and_wait(const Context& context) {
    const DeviceRefs refs = context.device();
    const Result<DeviceTable> vk = load_device_table(refs);
    REQUIRE(vk);
    VkFenceCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_FENCE_CREATE_INFO;
    VkFence fence = VK_NULL_HANDLE;
    REQUIRE(vk->vkCreateFence(refs.device, &info, nullptr, &fence) == VK_SUCCESS);
    const QueueRef queue = context.queue();
    queue.lock(queue.lock_user);
    const VkResult submitted = vk->vkQueueSubmit(queue.queue, 0, nullptr, fence);
    queue.unlock(queue.lock_user);
    REQUIRE(submitted == VK_SUCCESS);
    const VkResult result = vk->vkWaitForFences(refs.device, 1, &fence, VK_TRUE, 10'000'000'000u);
    vk->vkDestroyFence(refs.device, fence, nullptr);
    return result;
}

} // namespace

TEST_CASE("a context is chosen by a part of the name") {
    const Context taken = create_plain_context();
    const std::string& name = taken.report().name;
    for (const std::string& part : {name, name.substr(0, 4), in_capitals(name)}) {
        CAPTURE(part);
        const Result<Context> context = Context::create(on_device(part));
        REQUIRE(context);
        const DeviceReport& report = context->report();
        CHECK(report.name == name);
        CHECK(report.uuid == taken.report().uuid);
        CHECK(report.usable());
        CHECK(context->device().api_version == VK_API_VERSION_1_1);
        CHECK(context->queue().family == report.compute_queue_family);
        CHECK(context->validation_message_count() == 0);
        CHECK(submit_and_wait(*context) == VK_SUCCESS);
    }
}

TEST_CASE("lavapipe is found by its device's name and known for what it does") {
    const Result<Context> context = Context::create(on_device("LLVMpipe"));
    if (!context) {
        MESSAGE("skipped: this machine has no lavapipe");
        return;
    }
    const DeviceReport& report = context->report();
    CHECK(names(report.name, "llvmpipe"));
    if (std::getenv("GEODISK_TEST_AS_GPU") == nullptr) { // tests/support/weak_driver.cpp
        CHECK(report.type == VK_PHYSICAL_DEVICE_TYPE_CPU);
    }
    CHECK(test::is_lavapipe(report));
    CHECK(report.rounds_natively);
}

TEST_CASE("a context is chosen by index and by UUID") {
    const Result<Context> first = Context::create(on_device("0"));
    REQUIRE(first);
    std::string uuid;
    for (const std::uint8_t byte : first->report().uuid) {
        uuid += kHexDigits[byte >> 4];
        uuid += kHexDigits[byte & 15];
    }
    const Result<Context> same = Context::create(on_device(uuid));
    REQUIRE(same);
    CHECK(same->report().uuid == first->report().uuid);
}

TEST_CASE("a name that matches no device is answered with the list of devices") {
    const auto list = list_devices();
    REQUIRE(list);
    for (const char* name : {"no such device", "99", "00000000-0000-0000-0000-000000000001"}) {
        CAPTURE(name);
        const Result<Context> context = Context::create(on_device(name));
        REQUIRE_FALSE(context);
        CHECK(context.error().status == Status::no_device);
        CHECK(names(context.error().message, name));
        for (const DeviceReport& report : *list) {
            CHECK(names(context.error().message, report.name));
        }
    }
}

TEST_CASE("two contexts are independent of each other") {
    Result<Context> first = Context::create();
    Result<Context> second = Context::create();
    REQUIRE(first);
    REQUIRE(second);
    CHECK(first->device().device != second->device().device);
    CHECK(first->device().instance != second->device().instance);
    CHECK(submit_and_wait(*first) == VK_SUCCESS);
    first = Error{}; // Destroys the first context.
    CHECK(submit_and_wait(*second) == VK_SUCCESS);
}

TEST_CASE("a context keeps its handles when moved") {
    Context created = create_plain_context();
    const VkDevice device = created.device().device;
    Context moved = std::move(created);
    CHECK(moved.device().device == device);
    moved = create_plain_context();
    CHECK(moved.device().device != VK_NULL_HANDLE);
    CHECK(submit_and_wait(moved) == VK_SUCCESS);
}

TEST_CASE("the lock of the queue excludes other threads") {
    const Context context = create_plain_context();
    int counter = 0;
    const auto work = [&] {
        const QueueRef queue = context.queue();
        for (int i = 0; i < 10'000; ++i) {
            queue.lock(queue.lock_user);
            ++counter;
            queue.unlock(queue.lock_user);
        }
    };
    std::thread other(work);
    work();
    other.join();
    CHECK(counter == 20'000);
}

TEST_CASE("the best usable device is preferred") {
    std::vector<DeviceReport> reports{
        report_of("cpu", VK_PHYSICAL_DEVICE_TYPE_CPU),
        report_of("virtual", VK_PHYSICAL_DEVICE_TYPE_VIRTUAL_GPU),
        report_of("integrated", VK_PHYSICAL_DEVICE_TYPE_INTEGRATED_GPU),
        report_of("discrete A", VK_PHYSICAL_DEVICE_TYPE_DISCRETE_GPU),
        report_of("discrete B", VK_PHYSICAL_DEVICE_TYPE_DISCRETE_GPU),
    };
    CHECK(select_device(reports, "").value() == 3);
    reports[3].reasons_against = {"too old"};
    CHECK(select_device(reports, "").value() == 4);
    CHECK(select_device(reports, "discrete").value() == 4);
    reports[4].reasons_against = {"too small"};
    CHECK(select_device(reports, "").value() == 2);
    reports[2].reasons_against = {"too slow"};
    CHECK(select_device(reports, "").value() == 1);
    reports[1].reasons_against = {"too virtual"};
    CHECK(select_device(reports, "").value() == 0);
}

TEST_CASE("an explicit choice of an unusable device is refused with every reason") {
    std::vector<DeviceReport> reports{
        report_of("good", VK_PHYSICAL_DEVICE_TYPE_CPU),
        report_of("bad", VK_PHYSICAL_DEVICE_TYPE_DISCRETE_GPU),
    };
    reports[1].reasons_against = {"first reason", "second reason"};
    for (const char* name : {"bad", "1"}) {
        const Result<std::size_t> chosen = select_device(reports, name);
        REQUIRE_FALSE(chosen);
        CHECK(chosen.error().status == Status::device_lacks);
        CHECK(names(chosen.error().message, "first reason"));
        CHECK(names(chosen.error().message, "second reason"));
    }
}

TEST_CASE("a number of 100 and more that is no index is looked for in the names") {
    std::vector<DeviceReport> reports{
        report_of("Radeon 780M", VK_PHYSICAL_DEVICE_TYPE_INTEGRATED_GPU),
        report_of("GeForce RTX 4090", VK_PHYSICAL_DEVICE_TYPE_DISCRETE_GPU),
        report_of("llvmpipe (LLVM 15.0.6, 256 bits)", VK_PHYSICAL_DEVICE_TYPE_CPU),
    };
    reports[0].uuid[0] = 0xAB;
    CHECK(select_device(reports, "4090").value() == 1);
    CHECK(select_device(reports, "780").value() == 0);
    CHECK(select_device(reports, "0").value() == 0);
    CHECK(select_device(reports, "1").value() == 1);
    CHECK(select_device(reports, "AB000000-0000-0000-0000-000000000000").value() == 0);
    CHECK(select_device(reports, "ab000000000000000000000000000000").value() == 0);
    CHECK(select_device(reports, "-1").error().status == Status::no_device);
    CHECK(select_device(reports, "256").value() == 2);
    for (const char* const index : {"3", "5", "15", "25", "99"}) {
        CHECK(select_device(reports, index).error().status == Status::no_device);
    }
    CHECK(select_device({}, "").error().status == Status::no_device);
    CHECK(select_device({}, "0").error().status == Status::no_device);
}

TEST_CASE("a missing loader is reported with a hint") {
    const Result<Loader> loader = Loader::open("no-such-vulkan-loader");
    REQUIRE_FALSE(loader);
    CHECK(loader.error().status == Status::no_device);
    CHECK(names(loader.error().message, "no-such-vulkan-loader"));
    CHECK(names(loader.error().message, "install"));
}

#if defined(__linux__)
TEST_CASE("a library that is no Vulkan loader is refused") {
    const Result<Loader> loader = Loader::open("libm.so.6");
    REQUIRE_FALSE(loader);
    CHECK(loader.error().status == Status::no_device);
}
#endif

TEST_CASE("a queue that draws is given or refused") {
    test::FakeDriver driver;
    ContextOptions options;
    options.graphics = true;
    SUBCASE("the device has one") {
        driver.edit_queue_families = [](auto& families) {
            families = {families.front()};
            families.front().queueFlags = VK_QUEUE_COMPUTE_BIT | VK_QUEUE_GRAPHICS_BIT;
        };
        const Result<Context> context = ContextAccess::create(driver.loader(), options);
        REQUIRE(context);
        CHECK(context->queue().family == context->report().graphics_queue_family);
        CHECK(submit_and_wait(*context) == VK_SUCCESS);
    }
    SUBCASE("it has none") {
        driver.edit_queue_families = [](auto& families) {
            for (VkQueueFamilyProperties& family : families)
                family.queueFlags = VK_QUEUE_COMPUTE_BIT;
        };
        const Result<Context> context = ContextAccess::create(driver.loader(), options);
        REQUIRE_FALSE(context);
        CHECK(context.error().status == Status::device_lacks);
        CHECK(names(context.error().message, "no queue family for graphics and compute"));
        CHECK(driver.live_instances() == 0);
        CHECK(ContextAccess::create(driver.loader(), {})); // To sample it will do.
    }
}

TEST_CASE("a machine without a working driver is reported with a hint") {
    test::FakeDriver driver;
    SUBCASE("no driver at all") {
        driver.failing["vkCreateInstance"] = VK_ERROR_INCOMPATIBLE_DRIVER;
    }
    SUBCASE("a driver that cannot initialize") {
        driver.failing["vkEnumeratePhysicalDevices"] = VK_ERROR_INITIALIZATION_FAILED;
    }
    SUBCASE("a driver without a device") {
        driver.hide_devices = true;
    }
    SUBCASE("a loader of Vulkan 1.0") {
        driver.missing = {"vkEnumerateInstanceVersion"};
    }
    SUBCASE("a loader that reaches no driver") {
        driver.answer_1_0 = true;
    }

    const Result<Context> context = ContextAccess::create(driver.loader(), {});
    REQUIRE_FALSE(context);
    CHECK(context.error().status == Status::no_device);
    CHECK((names(context.error().message, "install") || names(context.error().message, "update")));
    const auto list = ContextAccess::list(driver.loader());
    REQUIRE_FALSE(list);
    CHECK(list.error().status == Status::no_device);
    CHECK(driver.live_instances() == 0);
}

TEST_CASE("a failure of device creation keeps its code and leaks nothing") {
    test::FakeDriver driver;
    Status expected = Status::ok;
    SUBCASE("out of memory") {
        driver.failing["vkCreateDevice"] = VK_ERROR_OUT_OF_DEVICE_MEMORY;
        expected = Status::out_of_device_memory;
    }
    SUBCASE("lost") {
        driver.failing["vkCreateDevice"] = VK_ERROR_DEVICE_LOST;
        expected = Status::device_lost;
    }
    SUBCASE("incomplete device") {
        driver.missing = {"vkGetDeviceQueue"};
        expected = Status::device_lacks;
    }
    SUBCASE("incomplete instance") {
        driver.missing = {"vkGetPhysicalDeviceMemoryProperties"};
        expected = Status::device_lacks;
    }
    const Result<Context> context = ContextAccess::create(driver.loader(), {});
    REQUIRE_FALSE(context);
    CHECK(context.error().status == expected);
    CHECK(driver.live_instances() == 0);
    CHECK(driver.live_devices() == 0);
}

TEST_CASE("a context destroys what it created") {
    test::FakeDriver driver;
    {
        const Result<Context> context = ContextAccess::create(driver.loader(), {});
        REQUIRE(context);
        CHECK(driver.live_instances() == 1);
        CHECK(driver.live_devices() == 1);
    }
    CHECK(driver.live_instances() == 0);
    CHECK(driver.live_devices() == 0);
}

TEST_CASE("kernels are reported on where the driver can, else refused by name") {
    ContextOptions options;
    options.pipeline_statistics = true;
    const Result<Context> context = Context::create(options);
    if (!context) {
        CHECK(context.error().status == Status::device_lacks);
        CHECK(names(context.error().message, "VK_KHR_pipeline_executable_properties"));
        return;
    }
    const Result<Sampler> sampler = Sampler::create(context->device());
    REQUIRE(sampler);
    const auto reports = sampler->report_kernels();
    REQUIRE(reports);
    CHECK(reports->size() > 50);
}

TEST_CASE("kernels are not reported on unless statistics are on") {
    const Context context = create_plain_context();
    const Result<Sampler> sampler = Sampler::create(context.device());
    REQUIRE(sampler);
    const auto reports = sampler->report_kernels();
    REQUIRE_FALSE(reports);
    CHECK(reports.error().status == Status::invalid_argument);
    CHECK(names(reports.error().message, "pipeline_statistics"));
}

TEST_CASE("the list of devices holds the one that a context takes") {
    const Context context = create_plain_context();
    const auto list = list_devices();
    REQUIRE(list);
    CHECK(std::any_of(list->begin(), list->end(), [&](const DeviceReport& report) {
        return report.uuid == context.report().uuid && report.usable();
    }));
}
