// The file of compiled pipelines: it is kept, and nothing that befalls it does harm.
#include <doctest/doctest.h>

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include <geodisk/context.hpp>

#include "owned/pipeline_file.hpp"
#include "unit/test_files.hpp"

using namespace geodisk;

namespace {

namespace fs = std::filesystem;

VkPhysicalDeviceProperties device_of_tests() {
    VkPhysicalDeviceProperties device{};
    device.vendorID = 1;
    device.deviceID = 2;
    device.driverVersion = 3;
    device.pipelineCacheUUID[5] = 4;
    return device;
}

/// Returns what a driver gives for the device: the header of Vulkan and `count` bytes.
std::vector<std::byte> contents_for(const VkPhysicalDeviceProperties& device, std::size_t count) {
    VkPipelineCacheHeaderVersionOne header{};
    header.headerSize = sizeof header;
    header.headerVersion = VK_PIPELINE_CACHE_HEADER_VERSION_ONE;
    header.vendorID = device.vendorID;
    header.deviceID = device.deviceID;
    std::memcpy(header.pipelineCacheUUID, device.pipelineCacheUUID, VK_UUID_SIZE);
    std::vector<std::byte> contents(sizeof header + count, std::byte{7});
    std::memcpy(contents.data(), &header, sizeof header);
    return contents;
}

void write_all(const fs::path& path, const std::string& bytes) {
    std::ofstream(path, std::ios::binary).write(bytes.data(), std::ssize(bytes));
}

std::size_t files_in(const fs::path& folder) {
    return static_cast<std::size_t>(std::distance(fs::recursive_directory_iterator(folder),
                                                  fs::recursive_directory_iterator()));
}

} // namespace

TEST_SUITE("pipeline file") {
    TEST_CASE("contents come back, and later ones replace them") {
        const tools::TemporaryFolder scratch;
        const VkPhysicalDeviceProperties device = device_of_tests();
        const PipelineFile file(scratch.path() / "made" / "for it", device);
        CHECK(file.load().empty());
        for (const std::size_t count : std::array<std::size_t, 3>{100, 0, 5000}) {
            const auto contents = contents_for(device, count);
            file.store(contents);
            CHECK(file.load() == contents);
        }
        CHECK(files_in(file.path().parent_path()) == 1);
    }

    TEST_CASE("a damaged file is ignored, and replaced") {
        const tools::TemporaryFolder scratch;
        const VkPhysicalDeviceProperties device = device_of_tests();
        const PipelineFile file(scratch.path(), device);
        const auto contents = contents_for(device, 40);
        file.store(contents);
        const std::string whole = tools::bytes_of(file.path());
        REQUIRE(whole.size() > contents.size());
        std::size_t accepted = 0;
        for (std::size_t i = 0; i < whole.size(); ++i) {
            std::string damaged = whole;
            damaged[i] = static_cast<char>(damaged[i] ^ 1);
            write_all(file.path(), damaged);
            accepted += std::size_t{!file.load().empty()};
            damaged = whole;
            damaged.resize(i);
            write_all(file.path(), damaged);
            accepted += std::size_t{!file.load().empty()};
        }
        CHECK(accepted == 0);
        file.store(contents);
        CHECK(file.load() == contents);
    }

    TEST_CASE("devices and drivers have files of their own, and take no other's") {
        const tools::TemporaryFolder scratch;
        const VkPhysicalDeviceProperties device = device_of_tests();
        const PipelineFile file(scratch.path(), device);
        std::array<VkPhysicalDeviceProperties, 4> others;
        others.fill(device);
        others[0].vendorID = 9;
        others[1].deviceID = 9;
        others[2].driverVersion = 9;
        others[3].pipelineCacheUUID[15] = 9;
        for (const VkPhysicalDeviceProperties& properties : others) {
            const PipelineFile other(scratch.path(), properties);
            CHECK(other.path() != file.path());
            other.store(contents_for(properties, 10));
            fs::copy_file(other.path(), file.path(), fs::copy_options::overwrite_existing);
            CHECK(file.load().empty());
        }
        // A driver that gives what Vulkan forbids to give back.
        file.store(contents_for(others[0], 10));
        CHECK(file.load().empty());
        file.store(contents_for(others[3], 10));
        CHECK(file.load().empty());
        std::vector<std::byte> late = contents_for(device, 10);
        for (const int version : {2, 0xff}) { // The second is beyond the values of the enumeration.
            late[4] = late[7] = std::byte(version);
            file.store(late);
            CHECK(file.load().empty());
        }
    }

    TEST_CASE("a folder that cannot be written is no error") {
        const tools::TemporaryFolder scratch;
        const fs::path taken = scratch.path() / "taken";
        write_all(taken, {'x'});
        const VkPhysicalDeviceProperties device = device_of_tests();
        const PipelineFile file(taken, device); // A file is in the way.
        file.store(contents_for(device, 10));
        CHECK(file.load().empty());
        const PipelineFile blocked(scratch.path(), device);
        fs::create_directories(blocked.path() / "full"); // A folder in place of the file.
        blocked.store(contents_for(device, 10));
        CHECK(blocked.load().empty());
        CHECK(files_in(scratch.path()) == 3); // No temporary file is left.
    }

    TEST_CASE("several may write and read at once") {
        const tools::TemporaryFolder scratch;
        const VkPhysicalDeviceProperties device = device_of_tests();
        const std::array contents = {contents_for(device, 20000), contents_for(device, 30000)};
        PipelineFile(scratch.path(), device).store(contents[0]);
        std::atomic<bool> is_over = false;
        std::atomic<std::size_t> torn = 0;
        {
            const std::jthread reader([&] {
                const PipelineFile file(scratch.path(), device);
                while (!is_over) {
                    const auto found = file.load();
                    torn += std::size_t{found != contents[0] && found != contents[1]};
                }
            });
            {
                std::vector<std::jthread> writers;
                for (const auto& own : contents) {
                    writers.emplace_back([&] {
                        for (int i = 0; i < 200; ++i) {
                            PipelineFile(scratch.path(), device).store(own);
                        }
                    });
                }
            }
            is_over = true;
        }
        CHECK(torn == 0);
        CHECK(files_in(scratch.path()) == 1);
    }

#ifndef _WIN32
    TEST_CASE("a context keeps pipelines only if asked to, and not with GEODISK_CACHE=off") {
        const tools::TemporaryFolder scratch;
        const char* const before = std::getenv("XDG_CACHE_HOME");
        const std::optional<std::string> old =
            before != nullptr ? std::optional<std::string>(before) : std::nullopt;
        ::setenv("XDG_CACHE_HOME", scratch.path().c_str(), 1);
        const auto has_cache = [](bool keeps) {
            ContextOptions options;
            options.keep_pipelines = keeps;
            const auto context = Context::create(options);
            REQUIRE(context);
            return context->device().pipeline_cache != VK_NULL_HANDLE;
        };
#ifndef __APPLE__
        CHECK_FALSE(has_cache(false));
        ::setenv("GEODISK_CACHE", "off", 1);
        CHECK_FALSE(cache_folder());
        CHECK_FALSE(has_cache(true));
        CHECK_FALSE(fs::exists(scratch.path() / "geodisk")); // Mesa may have a folder there.
        ::unsetenv("GEODISK_CACHE");
        REQUIRE(cache_folder() == scratch.path() / "geodisk");
        CHECK(has_cache(true));
        CHECK(files_in(*cache_folder()) == 1);
        for (const fs::directory_entry& entry : fs::directory_iterator(*cache_folder())) {
            const std::string whole = tools::bytes_of(entry.path());
            write_all(entry.path(), {'n', 'o', 'n', 'e'});
            CHECK(has_cache(true));
            CHECK(tools::bytes_of(entry.path()).size() == whole.size());
        }
#endif
        old ? ::setenv("XDG_CACHE_HOME", old->c_str(), 1) : ::unsetenv("XDG_CACHE_HOME");
    }
#endif
}
