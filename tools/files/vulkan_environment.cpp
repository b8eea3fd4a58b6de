#include "files/vulkan_environment.hpp"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <filesystem>
#include <iterator>
#include <string_view>
#include <system_error>

#include <nlohmann/json.hpp>

#include "files/input_file.hpp"
#include "program/human_text.hpp"
#include "program/path.hpp"

#ifndef _WIN32
#include <dlfcn.h>
#endif

namespace geodisk::tools {
namespace {

#ifdef _WIN32
constexpr char kBetweenFiles = ';';
#else
constexpr char kBetweenFiles = ':';
#endif

std::string value_of(const char* variable) {
    const char* const value = std::getenv(variable);
    return value != nullptr ? value : "";
}

/// The library that the driver file `path` names; "" where it is no driver file.
std::string library_of(const Path& path) {
    using Json = nlohmann::json;
    std::string text;
    try {
        text = read_file(path);
    } catch (const UserError&) {
        return "";
    }
    const Json document = Json::parse(text, nullptr, false);
    const Json driver = document.is_object() ? document.value("ICD", Json()) : Json();
    const Json library = driver.is_object() ? driver.value("library_path", Json()) : Json();
    return library.is_string() ? library.get<std::string>() : "";
}

#ifndef _WIN32
/// Functions that drivers have, by the interface that they have with the loader.
constexpr std::array kEntryPoints{"vk_icdGetInstanceProcAddr",
                                  "vk_icdNegotiateLoaderICDInterfaceVersion",
                                  "vkGetInstanceProcAddr"};

std::string value_or(const char* variable, const std::string& otherwise) {
    const std::string value = value_of(variable);
    return value.empty() ? otherwise : value;
}
#endif

/// Why the driver does not load; "" where it does.
std::string fault_of_library(const Path& file, const std::string& library) {
#ifdef _WIN32
    (void)file;
    (void)library;
    return "";
#else
    // Names without a slash are searched as the system does, others beside the driver file.
    const bool is_path = library.find('/') != std::string::npos;
    const std::string name = is_path ? (file.parent_path() / Path(library)).string() : library;
    if (void* const handle = dlopen(name.c_str(), RTLD_LAZY | RTLD_LOCAL)) {
        const bool is_driver = std::ranges::any_of(
            kEntryPoints, [handle](const char* entry) { return dlsym(handle, entry) != nullptr; });
        dlclose(handle);
        return is_driver ? "" : ", whose library " + library + " is no Vulkan driver";
    }
    std::error_code ignored;
    if (is_path && !std::filesystem::exists(Path(name), ignored)) {
        return ", whose library " + name + " does not exist";
    }
    const char* const reason = dlerror();
    return ", whose library " + library + " does not load" +
           (reason != nullptr ? " (" + std::string(reason) + ")" : "");
#endif
}

/// The driver files of a folder, in order.
std::vector<Path> driver_files_in(const Path& folder) {
    std::vector<Path> files;
    std::error_code ignored;
    for (const auto& entry : std::filesystem::directory_iterator(folder, ignored)) {
        if (entry.path().extension() == ".json") {
            files.emplace_back(entry.path());
        }
    }
    std::ranges::sort(files);
    return files;
}

/// The parts of a list that are not empty, each as a path.
std::vector<Path> paths_in(std::string_view list) {
    std::vector<Path> paths;
    while (!list.empty()) {
        const std::string part(list.substr(0, list.find(kBetweenFiles)));
        list.remove_prefix(std::min(part.size() + 1, list.size()));
        if (!part.empty()) {
            paths.emplace_back(part);
        }
    }
    return paths;
}

/// The folders that the loader searches for driver files, as it documents them.
std::vector<Path> driver_folders() {
#ifdef _WIN32
    return {};
#else
    const std::string home = value_of("HOME");
    std::vector<Path> folders;
    for (const std::string& bases :
         {value_or("XDG_CONFIG_HOME", home.empty() ? "" : home + "/.config"),
          value_or("XDG_CONFIG_DIRS", "/etc/xdg"), std::string("/etc"),
          value_or("XDG_DATA_HOME", home.empty() ? "" : home + "/.local/share"),
          value_or("XDG_DATA_DIRS", "/usr/local/share:/usr/share")}) {
        for (const Path& base : paths_in(bases)) {
            folders.emplace_back(base / "vulkan" / "icd.d");
        }
    }
    return folders;
#endif
}

/// Returns the end of a message, after the name of the file or folder.
std::string fault_of_file(const Path& file) {
    std::error_code ignored;
    if (!std::filesystem::exists(file, ignored)) {
        return ", which does not exist";
    }
    if (std::filesystem::is_directory(file, ignored)) {
        return !driver_files_in(file).empty() ? "" : ", a folder without driver files (*.json)";
    }
    const std::string library = library_of(file);
    return library.empty() ? ", which is no driver file" : fault_of_library(file, library);
}

/// The first fault of the files that `variable` names.
std::string fault_of_files(const std::string& variable, std::string_view files) {
    for (const Path& file : paths_in(files)) {
        if (std::string fault = fault_of_file(file); !fault.empty()) {
            fault.insert(0, variable + " names " + file.string());
            return fault + "; correct or unset it";
        }
    }
    return "";
}

/// Replaces folders by the driver files in them.
std::vector<Path> with_files_of_folders(const std::vector<Path>& paths) {
    std::vector<Path> files;
    std::error_code ignored;
    for (const Path& path : paths) {
        if (std::filesystem::is_directory(path, ignored)) {
            std::ranges::move(driver_files_in(path), std::back_inserter(files));
        } else {
            files.push_back(path);
        }
    }
    return files;
}

/// The driver files that the loader takes: those that a variable names, or of the system with those
/// that are added.
std::vector<Path> all_driver_files() {
    for (const char* const variable : {"VK_DRIVER_FILES", "VK_ICD_FILENAMES"}) {
        if (const std::string files = value_of(variable); !files.empty()) {
            return with_files_of_folders(paths_in(files));
        }
    }
    std::vector<Path> all = paths_in(value_of("VK_ADD_DRIVER_FILES"));
    std::error_code ignored;
    for (const Path& folder : driver_folders()) {
        if (std::filesystem::is_directory(folder, ignored)) {
            all.push_back(folder);
        }
    }
    return with_files_of_folders(all);
}

} // namespace

std::string device_of_environment() {
    return value_of(kDeviceVariable);
}

std::string driver_fault() {
    // The first of these that is set replaces the drivers of the system, and the others are
    // ignored.
    for (const char* const variable : {"VK_DRIVER_FILES", "VK_ICD_FILENAMES"}) {
        const std::string files = value_of(variable);
        if (files.empty()) {
            continue;
        }
        const std::string fault = fault_of_files(variable, files);
        return !fault.empty() ? fault
                              : std::string(variable) + " allows the drivers of " + files +
                                    " alone, and none of them works; correct or unset it";
    }
    for (const char* const variable : {"VK_LOADER_DRIVERS_SELECT", "VK_LOADER_DRIVERS_DISABLE"}) {
        if (const std::string filter = value_of(variable); !filter.empty()) {
            return std::string(variable) + " is " + in_quotes(filter) +
                   ", which leaves no driver that works; correct or unset it";
        }
    }
    return fault_of_files("VK_ADD_DRIVER_FILES", value_of("VK_ADD_DRIVER_FILES"));
}

std::vector<std::string> left_out_drivers() {
    std::vector<std::string> found;
    for (const Path& file : all_driver_files()) {
        const std::string fault = fault_of_file(file);
        // Systems have drivers for programs of 32 bits too.
        if (!fault.empty() && fault.find("wrong ELF class") == std::string::npos) {
            found.push_back(file.string() + fault);
        }
    }
    return found;
}

std::string left_out_warning(const std::string& driver) {
    return "the CPU is used, since a Vulkan driver is left out: " + driver;
}

std::vector<std::string> missing_drivers(std::span<const DeviceReport> devices) {
    const auto is_cpu = [](const DeviceReport& device) {
        return device.type == VK_PHYSICAL_DEVICE_TYPE_CPU;
    };
    return std::ranges::all_of(devices, is_cpu) ? left_out_drivers() : std::vector<std::string>();
}

std::string with_driver_fault(const std::string& message) {
    const bool has_devices = message.starts_with("no Vulkan device matches");
    const std::string fault = has_devices ? "" : driver_fault();
    if (fault.empty()) {
        return message;
    }
    return message.substr(0, message.find("; install")) + "; " + fault;
}

} // namespace geodisk::tools
