#include "files/tuning_file.hpp"

#include <cstdio>
#include <cstdlib>
#include <system_error>

#include <nlohmann/json.hpp>

#include <geodisk/version.hpp>

#include "files/output_file.hpp"
#include "files/text_file.hpp"
#include "program/failure.hpp"
#include "program/human_text.hpp"

namespace geodisk::tools {
namespace {

using Json = nlohmann::ordered_json;

std::filesystem::path cache_folder() {
    const auto variable = [](const char* name) {
        const char* const value = std::getenv(name);
        return std::filesystem::path(value != nullptr ? value : "");
    };
#ifdef _WIN32
    return variable("LOCALAPPDATA");
#else
    // Relative paths are to be ignored (XDG Base Directory Specification).
    if (auto cache = variable("XDG_CACHE_HOME"); cache.is_absolute()) {
        return cache;
    }
    const auto home = variable("HOME");
    return home.is_absolute() ? home / ".cache" : std::filesystem::path();
#endif
}

} // namespace

std::optional<Reads> reads_named(const std::string& name) {
    for (const Reads reads : {Reads::automatic, Reads::storage, Reads::texels}) {
        if (name == to_string(reads)) {
            return reads;
        }
    }
    return std::nullopt;
}

std::filesystem::path tuning_path(const DeviceReport& device) {
    const std::filesystem::path folder = cache_folder();
    if (folder.empty()) {
        return {};
    }
    char driver[16];
    std::snprintf(driver, sizeof driver, "%08x", device.driver_version);
    return folder / "geodisk" / ("tuning-" + uuid_text(device.uuid) + "-" + driver + ".json");
}

std::optional<Tuning> load_tuning(const DeviceReport& device) {
    const std::filesystem::path path = tuning_path(device);
    std::error_code ignored;
    if (path.empty() || !std::filesystem::exists(path, ignored)) {
        return std::nullopt;
    }
    constexpr const char* kRemedy = "; run geodisk_bench --tune again, or remove the file";
    Tuning tuning;
    try {
        const Json document = Json::parse(read_text(path));
        tuning.local_size = document.at("local_size").get<std::uint32_t>();
        tuning.slot_local_size = document.at("slot_local_size").get<std::uint32_t>();
        tuning.pool_block = document.at("pool_block").get<std::uint32_t>();
        tuning.batches = document.at("batches").get<std::uint32_t>();
        tuning.reads = reads_named(document.at("reads").get<std::string>()).value();
    } catch (const Json::exception&) {
        fail_input(path, std::string("is not as geodisk_bench --tune writes it") + kRemedy);
    } catch (const std::bad_optional_access&) {
        fail_input(path, std::string("has no reads that geodisk knows") + kRemedy);
    }
    if (const auto checked = chosen_tuning(tuning, device); !checked) {
        fail_input(path, checked.error().message + kRemedy);
    }
    return tuning;
}

std::filesystem::path writable_tuning_path(const DeviceReport& device) {
    std::filesystem::path path = tuning_path(device);
    if (path.empty()) {
        fail_output("the tuning has nowhere to go: neither XDG_CACHE_HOME nor HOME is set");
    }
    std::error_code error;
    std::filesystem::create_directories(path.parent_path(), error);
    if (error) {
        fail_output(path.parent_path().string() + ": cannot be made: " + error.message());
    }
    check_writable(path);
    return path;
}

void store_tuning(const Path& path, const DeviceReport& device, const Tuning& tuning) {
    const Json document{{"geodisk_version", GEODISK_VERSION_STRING},
                        {"device", device.name},
                        {"driver", driver_text(device)},
                        {"local_size", tuning.local_size},
                        {"slot_local_size", tuning.slot_local_size},
                        {"pool_block", tuning.pool_block},
                        {"batches", tuning.batches},
                        {"reads", to_string(tuning.reads)}};
    AtomicFile file(path);
    // Drivers name themselves as they like; text that is not UTF-8 must not end the program.
    file.write(document.dump(2, ' ', false, Json::error_handler_t::replace) + '\n');
    file.commit();
}

} // namespace geodisk::tools
