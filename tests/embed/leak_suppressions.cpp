// Under LeakSanitizer: leaves out the leaks of the validation layer and of lavapipe, which are not
// ours. What we fail to destroy is found by the validation layer instead.
#if defined(__SANITIZE_ADDRESS__)
#define GEODISK_LEAK_CHECK 1
#elif defined(__has_feature)
#if __has_feature(address_sanitizer)
#define GEODISK_LEAK_CHECK 1
#endif
#endif

#if defined(GEODISK_LEAK_CHECK) && defined(__linux__)
#include <initializer_list>

#include <dlfcn.h>

// The sanitizer's library looks it up, so it has to be visible.
extern "C" __attribute__((visibility("default"))) const char* __lsan_default_suppressions() {
    return "leak:libVkLayer_khronos_validation\n"
           "leak:libvulkan_lvp\n";
}

namespace {

// A leak is known by the name of its library, which has to be still loaded when the leaks are
// listed.
[[maybe_unused]] const bool kept_loaded = [] {
    for (const char* name : {"libVkLayer_khronos_validation.so", "libvulkan_lvp.so"})
        dlopen(name, RTLD_LAZY | RTLD_NODELETE);
    return true;
}();

} // namespace
#endif
