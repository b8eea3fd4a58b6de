// Runs the GPU tests. They need a Vulkan device: without one they fail at once, rather than pass by
// doing nothing.
#define DOCTEST_CONFIG_IMPLEMENT
#include <doctest/doctest.h>

#include <cstdio>
#include <cstdlib>
#include <string>

#include "device_run.hpp"

namespace {

/// lavapipe of Mesa 25 with LLVM 19 crashes where LP_NATIVE_VECTOR_WIDTH asks for vectors of 128
/// bits, and computes nothing where it asks for 512; runs then end with an error. Other versions do
/// both.
bool is_width_broken(const std::string& driver) {
    const char* const width = std::getenv("LP_NATIVE_VECTOR_WIDTH");
    return width != nullptr && std::string(width) != "256" && driver.starts_with("Mesa 25.");
}

} // namespace

int main(int argc, char** argv) {
    const geodisk::DeviceReport& report = geodisk::test::shared_context().report();
    std::printf("device: %s (%s)\n", report.name.c_str(), report.driver_info.c_str());
    if (is_width_broken(report.driver_info)) {
        std::puts("skipped: this driver does not work with vectors of other widths than its own");
        return 0;
    }
    return doctest::Context(argc, argv).run();
}
