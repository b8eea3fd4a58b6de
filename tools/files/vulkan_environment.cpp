#include "files/vulkan_environment.hpp"

#include <algorithm>
#include <cstdlib>
#include <filesystem>
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
        dlclose(handle);
        return "";
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

bool holds_driver_files(const Path& folder) {
    std::error_code ignored;
    for (const auto& entry : std::filesystem::directory_iterator(folder, ignored)) {
        if (entry.path().extension() == ".json") {
            return true;
        }
    }
    return false;
}

/// What follows the name of the file or folder in a message.
std::string fault_of_file(const Path& file) {
    std::error_code ignored;
    if (!std::filesystem::exists(file, ignored)) {
        return ", which does not exist";
    }
    if (std::filesystem::is_directory(file, ignored)) {
        return holds_driver_files(file) ? "" : ", a folder without driver files (*.json)";
    }
    const std::string library = library_of(file);
    return library.empty() ? ", which is no driver file" : fault_of_library(file, library);
}

/// The first fault of the files that `variable` names.
std::string fault_of_files(const std::string& variable, std::string_view files) {
    while (!files.empty()) {
        const std::string file(files.substr(0, files.find(kBetweenFiles)));
        files.remove_prefix(std::min(file.size() + 1, files.size()));
        if (file.empty()) {
            continue;
        }
        if (const std::string fault = fault_of_file(file); !fault.empty()) {
            return variable + " names " + file + fault + "; correct or unset it";
        }
    }
    return "";
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

std::string with_driver_fault(const std::string& message) {
    const std::string fault = driver_fault();
    if (fault.empty()) {
        return message;
    }
    return message.substr(0, message.find("; install")) + "; " + fault;
}

} // namespace geodisk::tools
