// Runs the tests of the C API. They need a Vulkan device: without one they fail at once, rather
// than pass by doing nothing.
#define DOCTEST_CONFIG_IMPLEMENT
#include <doctest/doctest.h>

#include <cstddef>
#include <cstdio>

#include <geodisk/geodisk.h>

int main(int argc, char** argv) {
    geodisk_error error{};
    error.struct_size = sizeof error;
    std::size_t count = 0;
    if (geodisk_list_devices(nullptr, 0, &count, &error) != GEODISK_OK) {
        std::fprintf(stderr, "the tests need a Vulkan device: %s\n", error.message);
        return 1;
    }
    return doctest::Context(argc, argv).run();
}
