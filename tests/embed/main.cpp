// Runs the embedding tests. They need a Vulkan device: without one they fail at once, rather than
// pass by doing nothing.
#define DOCTEST_CONFIG_IMPLEMENT
#include <doctest/doctest.h>

#include <cstdio>

#include <geodisk/context.hpp>

int main(int argc, char** argv) {
    const auto devices = geodisk::list_devices();
    if (!devices) {
        std::fprintf(stderr, "the tests need a Vulkan device: %s\n",
                     devices.error().message.c_str());
        return 1;
    }
    for (const geodisk::DeviceReport& report : *devices)
        std::printf("device: %s (%s)\n", report.name.c_str(), report.driver_info.c_str());
    return doctest::Context(argc, argv).run();
}
