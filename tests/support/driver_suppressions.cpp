// Under AddressSanitizer and ThreadSanitizer: leaves out the leaks and races of the validation
// layer and of drivers, which are not ours. What we fail to destroy is found by the validation
// layer instead.
#include "sanitizers.hpp"

#if (GEODISK_HAS_ADDRESS_SANITIZER || GEODISK_HAS_THREAD_SANITIZER) && defined(__linux__)
#include <initializer_list>

#include <dlfcn.h>

// The sanitizers' libraries look these up, so they have to be visible.
#define GEODISK_LOOKED_UP extern "C" __attribute__((visibility("default")))

// NOLINTBEGIN(bugprone-reserved-identifier): names of the sanitizers'.
GEODISK_LOOKED_UP const char* __lsan_default_suppressions() {
    return "leak:libVkLayer_khronos_validation\n"
           "leak:libvulkan_lvp\n"
           "leak:libvulkan_radeon\n";
}

// Suppresses a list that would follow what the program prints.
GEODISK_LOOKED_UP const char* __lsan_default_options() {
    return "print_suppressions=0";
}

// Suppresses what these libraries call. Our own accesses to what they share with us are still
// watched.
GEODISK_LOOKED_UP const char* __tsan_default_suppressions() {
    return "called_from_lib:libVkLayer_khronos_validation.so\n"
           "called_from_lib:libvulkan_lvp.so\n"
           // Libraries that lavapipe compiles with, and where that registers its functions.
           "called_from_lib:libLLVM\n"
           "called_from_lib:libgcc_s\n";
}
// NOLINTEND(bugprone-reserved-identifier)

namespace {

// A library is known by its name, and has to stay loaded for that.
[[maybe_unused]] const bool kKeptLoaded = [] {
    for (const char* name :
         {"libVkLayer_khronos_validation.so", "libvulkan_lvp.so", "libvulkan_radeon.so"}) {
        dlopen(name, RTLD_LAZY | RTLD_NODELETE);
    }
    return true;
}();

} // namespace
#endif
