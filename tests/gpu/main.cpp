// Runs the GPU tests. They need a Vulkan device: without one they fail at once, rather than pass by
// doing nothing.
#define DOCTEST_CONFIG_IMPLEMENT
#include <doctest/doctest.h>

#include <cstdio>

#include "device_run.hpp"

int main(int argc, char** argv) {
    const geodisk::DeviceReport& report = geodisk::test::shared_context().report();
    std::printf("device: %s (%s)\n", report.name.c_str(), report.driver_info.c_str());
    return doctest::Context(argc, argv).run();
}
