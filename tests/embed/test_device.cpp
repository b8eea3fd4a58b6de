// query_device and the function tables: every shortcoming is named.
#include <doctest/doctest.h>

#include <algorithm>
#include <new>
#include <stdexcept>
#include <string>
#include <utility>

#include <geodisk/context.hpp>
#include <geodisk/sampler.hpp>

#include "fake_driver.hpp"
#include "owned/context_access.hpp"
#include "support/device_abilities.hpp"
#include "support/guard.hpp"
#include "vk/dispatch.hpp"
#include "vk/result.hpp"

using namespace geodisk;

namespace {

/// On the device that a context takes by itself.
Context create_context() {
    Result<Context> context = Context::create();
    REQUIRE(context);
    return std::move(context).value();
}

/// Queries the context's device as `driver` shows it.
Result<DeviceReport> query(const test::FakeDriver& driver, const Context& context) {
    const DeviceRefs refs = context.device();
    return query_device(driver.loader().get_instance_proc_addr(), refs.instance,
                        refs.physical_device);
}

bool contains(const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
}

int count_of(const DeviceReport& report, const std::string& part) {
    return static_cast<int>(
        std::count_if(report.reasons_against.begin(), report.reasons_against.end(),
                      [&](const std::string& reason) { return contains(reason, part); }));
}

/// One below each requirement.
void weaken(VkPhysicalDeviceProperties& properties) {
    VkPhysicalDeviceLimits& limits = properties.limits;
    limits.maxPerStageDescriptorStorageBuffers = 7;
    limits.maxStorageBufferRange = (1u << 27) - 1;
    limits.maxComputeWorkGroupInvocations = 127;
    limits.maxComputeWorkGroupSize[0] = 126;
    limits.maxPushConstantsSize = 124;
    limits.maxComputeSharedMemorySize = 16383;
}

/// Exactly what is required.
void reduce_to_floor(VkPhysicalDeviceProperties& properties) {
    properties.apiVersion = VK_API_VERSION_1_1;
    VkPhysicalDeviceLimits& limits = properties.limits;
    limits.maxPerStageDescriptorStorageBuffers = 8;
    limits.maxStorageBufferRange = 1u << 27;
    limits.maxComputeWorkGroupInvocations = 128;
    limits.maxComputeWorkGroupSize[0] = 128;
    limits.maxPushConstantsSize = 128;
    limits.maxComputeSharedMemorySize = 16384;
}

VkQueueFamilyProperties family_of(VkQueueFlags flags, std::uint32_t timestamp_bits) {
    VkQueueFamilyProperties family{};
    family.queueFlags = flags;
    family.queueCount = 1;
    family.timestampValidBits = timestamp_bits;
    return family;
}

} // namespace

TEST_CASE("a weak device is reported with every reason") {
    const Context context = create_context();
    test::FakeDriver driver;
    driver.edit_properties = weaken;
    driver.edit_queue_families = [](auto& families) {
        for (VkQueueFamilyProperties& family : families)
            family.queueFlags = VK_QUEUE_TRANSFER_BIT;
    };
    const Result<DeviceReport> report = query(driver, context);
    REQUIRE(report);
    CHECK_FALSE(report->usable());
    CHECK_FALSE(report->compute_queue_family.has_value());
    CHECK_FALSE(report->graphics_queue_family.has_value());
    CHECK(report->reasons_against.size() == 7);
    for (const char* part :
         {"maxPerStageDescriptorStorageBuffers is 7, at least 8",
          "maxStorageBufferRange is 134217727", "maxComputeWorkGroupInvocations is 127",
          "maxComputeWorkGroupSize[0] is 126", "maxPushConstantsSize is 124",
          "maxComputeSharedMemorySize is 16383", "no queue family"}) {
        CAPTURE(part);
        CHECK(count_of(*report, part) == 1);
    }
}

TEST_CASE("a context on a weak device is refused with every reason") {
    const std::string taken = create_context().report().name;
    const std::string first = list_devices().value().front().name;
    test::FakeDriver driver;
    driver.edit_properties = weaken;
    const std::pair<std::string, std::string> choices[] = {
        {"", taken}, {taken, taken}, {"0", first}};
    for (const auto& [name, refused] : choices) {
        const auto& shown = name; // Before Clang 16 lambdas capture no bindings.
        CAPTURE(shown);
        ContextOptions options;
        options.device = name;
        const Result<Context> context = ContextAccess::create(driver.loader(), options);
        REQUIRE_FALSE(context);
        CHECK(context.error().status == Status::device_lacks);
        CHECK(contains(context.error().message, refused));
        CHECK(contains(context.error().message, "maxPerStageDescriptorStorageBuffers is 7"));
        CHECK(contains(context.error().message, "maxComputeSharedMemorySize is 16383"));
        CHECK(driver.live_instances() == 0);
    }
    const auto list = ContextAccess::list(driver.loader());
    REQUIRE(list); // The list shows what cannot be used, too.
    CHECK_FALSE(list->front().usable());
}

TEST_CASE("a device that just meets the requirements is usable") {
    const Context context = create_context();
    test::FakeDriver driver;
    driver.edit_properties = reduce_to_floor;
    const Result<DeviceReport> report = query(driver, context);
    REQUIRE(report);
    CHECK(report->reasons_against.empty());
    // Found through the extension, without Vulkan 1.2.
    CHECK(report->driver_id == context.report().driver_id);
    CHECK(report->rounds_natively == context.report().rounds_natively);
    CHECK(report->limits.subgroup_size == context.report().limits.subgroup_size);
}

TEST_CASE("texel buffers that reach less far than storage buffers are not used") {
    const Context context = create_context();
    test::FakeDriver driver;
    driver.edit_properties = [](VkPhysicalDeviceProperties& properties) {
        properties.limits.maxTexelBufferElements = properties.limits.maxStorageBufferRange / 4 - 1;
    };
    DeviceRefs refs = context.device();
    refs.get_instance_proc_addr = &test::FakeDriver::get_instance_proc_addr;
    CHECK(Sampler::create(refs));
    SamplerOptions options;
    options.tuning.reads = Reads::texels;
    const Result<Sampler> refused = Sampler::create(refs, options);
    REQUIRE_FALSE(refused);
    CHECK(refused.error().status == Status::device_lacks);
    const std::uint64_t least = context.report().limits.max_storage_buffer_range / 4;
    CHECK(contains(refused.error().message, "maxTexelBufferElements is " +
                                                std::to_string(least - 1) + ", at least " +
                                                std::to_string(least)));
}

TEST_CASE("a sampler reads and rounds in every way that its device has") {
    const Context context = create_context();
    for (const Reads reads : test::reads_of(context.report())) {
        for (const Rounding rounding : test::roundings_of(context.report())) {
            CAPTURE(to_string(reads));
            CAPTURE(static_cast<int>(rounding));
            SamplerOptions options;
            options.tuning.reads = reads;
            options.rounding = rounding;
            CHECK(Sampler::create(context.device(), options));
        }
    }
}

TEST_CASE("a device of Vulkan 1.0 is not asked what it cannot answer") {
    const Context context = create_context();
    test::FakeDriver driver;
    driver.edit_properties = [](VkPhysicalDeviceProperties& properties) {
        properties.apiVersion = VK_MAKE_API_VERSION(0, 1, 0, 65);
    };
    const Result<DeviceReport> report = query(driver, context);
    REQUIRE(report);
    REQUIRE(report->reasons_against.size() == 1);
    CHECK(contains(report->reasons_against[0], "apiVersion is 1.0, at least 1.1 is needed"));
    CHECK(report->driver_name.empty());
    CHECK_FALSE(report->rounds_natively);
}

TEST_CASE("a device name without its terminator stays within its field") {
    const Context context = create_context();
    test::FakeDriver driver;
    driver.edit_properties = [](VkPhysicalDeviceProperties& properties) {
        std::fill(std::begin(properties.deviceName), std::end(properties.deviceName), 'x');
    };
    const Result<DeviceReport> report = query(driver, context);
    REQUIRE(report);
    CHECK(report->name.size() == VK_MAX_PHYSICAL_DEVICE_NAME_SIZE);
}

TEST_CASE("a compute family without graphics is preferred") {
    constexpr VkQueueFlags kBoth = VK_QUEUE_GRAPHICS_BIT | VK_QUEUE_COMPUTE_BIT;
    const Context context = create_context();
    test::FakeDriver driver;
    std::vector<VkQueueFamilyProperties> families;
    std::uint32_t expected = 0;
    std::uint32_t expected_bits = 0;
    SUBCASE("it comes second") {
        families = {family_of(kBoth, 64), family_of(VK_QUEUE_COMPUTE_BIT, 36),
                    family_of(VK_QUEUE_COMPUTE_BIT, 0)};
        expected = 1;
        expected_bits = 36;
    }
    SUBCASE("it comes first") {
        families = {family_of(VK_QUEUE_COMPUTE_BIT, 0), family_of(kBoth, 64)};
    }
    SUBCASE("there is none") {
        families = {family_of(VK_QUEUE_TRANSFER_BIT, 8), family_of(kBoth, 64),
                    family_of(kBoth, 48)};
        expected = 1;
        expected_bits = 64;
    }
    SUBCASE("it holds no queue") {
        families = {family_of(kBoth, 64), family_of(VK_QUEUE_COMPUTE_BIT, 36)};
        families[1].queueCount = 0;
        expected_bits = 64;
    }
    driver.edit_queue_families = [&](auto& all) { all = families; };
    const Result<DeviceReport> report = query(driver, context);
    REQUIRE(report);
    CHECK(report->compute_queue_family == expected);
    CHECK(report->timestamp_valid_bits == expected_bits);
    const auto drawing = std::find_if(families.begin(), families.end(), [](const auto& family) {
        return (family.queueFlags & kBoth) == kBoth;
    });
    CHECK(report->graphics_queue_family == static_cast<std::uint32_t>(drawing - families.begin()));
}

TEST_CASE("each missing function is named") {
    const Context context = create_context();
    test::FakeDriver driver;
    DeviceRefs refs = context.device();
    refs.get_instance_proc_addr = driver.loader().get_instance_proc_addr();
    REQUIRE(load_device_table(refs));
    REQUIRE(load_query_table(refs));
    REQUIRE(load_instance_table(refs.get_instance_proc_addr, refs.instance));
    REQUIRE(load_owner_table(refs.get_instance_proc_addr, refs.instance));

    const auto check_error = [](const Error& error, const char* name) {
        CAPTURE(name);
        CHECK(error.status == Status::device_lacks);
        CHECK(contains(error.message, std::string(" ") + name + " "));
    };
#define GEODISK_CHECK_DEVICE(name)                                                                 \
    driver.missing = {#name};                                                                      \
    check_error(load_device_table(refs).error(), #name);
    GEODISK_DEVICE_FUNCTIONS(GEODISK_CHECK_DEVICE)
#undef GEODISK_CHECK_DEVICE
#define GEODISK_CHECK_QUERY(name)                                                                  \
    driver.missing = {#name};                                                                      \
    check_error(load_query_table(refs).error(), #name);
    GEODISK_QUERY_FUNCTIONS(GEODISK_CHECK_QUERY)
#undef GEODISK_CHECK_QUERY
#define GEODISK_CHECK_INSTANCE(name)                                                               \
    driver.missing = {#name};                                                                      \
    check_error(load_instance_table(refs.get_instance_proc_addr, refs.instance).error(), #name);
    GEODISK_INSTANCE_FUNCTIONS(GEODISK_CHECK_INSTANCE)
#undef GEODISK_CHECK_INSTANCE
#define GEODISK_CHECK_OWNER(name)                                                                  \
    driver.missing = {#name};                                                                      \
    check_error(load_owner_table(refs.get_instance_proc_addr, refs.instance).error(), #name);
    GEODISK_OWNER_FUNCTIONS(GEODISK_CHECK_OWNER)
#undef GEODISK_CHECK_OWNER
}

TEST_CASE("null arguments are refused by name") {
    const Context context = create_context();
    const DeviceRefs good = context.device();
    const auto message_of = [](const DeviceRefs& refs) {
        const Result<DeviceTable> table = load_device_table(refs);
        REQUIRE_FALSE(table);
        CHECK(table.error().status == Status::invalid_argument);
        return table.error().message;
    };
    DeviceRefs bad = good;
    bad.instance = VK_NULL_HANDLE;
    CHECK(contains(message_of(bad), "DeviceRefs::instance"));
    bad = good;
    bad.physical_device = VK_NULL_HANDLE;
    CHECK(contains(message_of(bad), "DeviceRefs::physical_device"));
    bad = good;
    bad.device = VK_NULL_HANDLE;
    CHECK(contains(message_of(bad), "DeviceRefs::device"));
    bad = good;
    bad.get_instance_proc_addr = nullptr;
    CHECK(contains(message_of(bad), "DeviceRefs::get_instance_proc_addr"));
    bad = good;
    MemoryHooks hooks{nullptr, nullptr, [](void*, const MemoryGrant&) {}};
    bad.memory_hooks = &hooks;
    CHECK(contains(message_of(bad), "MemoryHooks::allocate"));
    hooks = {nullptr, [](void*, const MemoryRequest&, MemoryGrant&) { return VK_SUCCESS; },
             nullptr};
    CHECK(contains(message_of(bad), "MemoryHooks::free"));
    bad = good;
    bad.api_version = VK_API_VERSION_1_0;
    CHECK(load_device_table(bad).error().status == Status::device_lacks);

    const auto get = good.get_instance_proc_addr;
    for (const auto& report : {query_device(nullptr, good.instance, good.physical_device),
                               query_device(get, VK_NULL_HANDLE, good.physical_device),
                               query_device(get, good.instance, VK_NULL_HANDLE)}) {
        REQUIRE_FALSE(report);
        CHECK(report.error().status == Status::invalid_argument);
    }
}

TEST_CASE("no exception passes the boundary") {
    const auto thrown = [](auto exception) {
        return guarded([&]() -> Result<Done> { throw exception; }).error().status;
    };
    CHECK(thrown(std::bad_alloc()) == Status::out_of_host_memory);
    CHECK(thrown(std::length_error("")) == Status::out_of_host_memory);
    CHECK(thrown(std::runtime_error("")) == Status::internal);
    CHECK(thrown(0) == Status::internal);
}

TEST_CASE("a Vulkan result becomes a status and keeps its code") {
    const Error error = vk_error("vkQueueSubmit", VK_ERROR_DEVICE_LOST);
    CHECK(error.status == Status::device_lost);
    CHECK(error.vk_result == VK_ERROR_DEVICE_LOST);
    CHECK(error.message == "vkQueueSubmit failed with VK_ERROR_DEVICE_LOST");
    CHECK(status_of(VK_SUCCESS) == Status::ok);
    CHECK(status_of(VK_ERROR_OUT_OF_HOST_MEMORY) == Status::out_of_host_memory);
    CHECK(status_of(VK_ERROR_FRAGMENTED_POOL) == Status::out_of_device_memory);
    CHECK(status_of(static_cast<VkResult>(-12345)) == Status::internal);
}
