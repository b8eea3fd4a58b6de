#include "owned/loader.hpp"

#include <span>
#include <string>
#include <utility>

#if defined(_WIN32)
#define WIN32_LEAN_AND_MEAN
#include <windows.h>
#else
#include <dlfcn.h>
#endif

#include "support/guard.hpp"

namespace geodisk {
namespace {

#if defined(_WIN32)
constexpr const char* kLibraryNames[] = {"vulkan-1.dll"};
constexpr const char* kHint = "install a current driver of the graphics card";
#elif defined(__APPLE__)
constexpr const char* kLibraryNames[] = {"libvulkan.1.dylib", "libvulkan.dylib",
                                         "libMoltenVK.dylib"};
constexpr const char* kHint = "install MoltenVK or the Vulkan SDK";
#else
constexpr const char* kLibraryNames[] = {"libvulkan.so.1", "libvulkan.so"};
constexpr const char* kHint = "install it (Debian and Ubuntu: libvulkan1 and, without a graphics "
                              "card, mesa-vulkan-drivers)";
#endif

#if defined(_WIN32)
void* open_library(const char* name) noexcept {
    return reinterpret_cast<void*>(LoadLibraryA(name));
}

void close_library(void* library) noexcept {
    FreeLibrary(static_cast<HMODULE>(library));
}

PFN_vkVoidFunction find_function(void* library, const char* name) noexcept {
    return reinterpret_cast<PFN_vkVoidFunction>(
        GetProcAddress(static_cast<HMODULE>(library), name));
}
#else
void* open_library(const char* name) noexcept {
    return dlopen(name, RTLD_NOW | RTLD_LOCAL);
}

void close_library(void* library) noexcept {
    dlclose(library);
}

PFN_vkVoidFunction find_function(void* library, const char* name) noexcept {
    return reinterpret_cast<PFN_vkVoidFunction>(dlsym(library, name));
}
#endif

} // namespace

Result<Loader> Loader::open(const char* path) noexcept {
    return guarded([&]() -> Result<Loader> {
        const std::span<const char* const> names =
            path != nullptr ? std::span<const char* const>(&path, 1) : kLibraryNames;
        for (const char* name : names) {
            void* library = open_library(name);
            if (library == nullptr)
                continue;
            const auto function = reinterpret_cast<PFN_vkGetInstanceProcAddr>(
                find_function(library, "vkGetInstanceProcAddr"));
            Loader loader(library, function);
            if (function != nullptr)
                return loader;
        }
        return Error{Status::no_device, std::string("the Vulkan loader ") + names.front() +
                                            " cannot be opened; " + kHint};
    });
}

Loader::Loader(Loader&& other) noexcept
    : library_(std::exchange(other.library_, nullptr)),
      get_instance_proc_addr_(std::exchange(other.get_instance_proc_addr_, nullptr)) {}

Loader& Loader::operator=(Loader&& other) noexcept {
    std::swap(library_, other.library_);
    std::swap(get_instance_proc_addr_, other.get_instance_proc_addr_);
    return *this;
}

Loader::~Loader() {
    if (library_ != nullptr)
        close_library(library_);
}

} // namespace geodisk
