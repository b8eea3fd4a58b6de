#include "files/tuning_file.hpp"

#include <cstdio>
#include <limits>
#include <system_error>

#include <nlohmann/json.hpp>

#include <geodisk/detail/cache_folder.hpp>
#include <geodisk/version.hpp>

#include "files/output/output_file.hpp"
#include "files/text_file.hpp"
#include "program/exact_text.hpp"
#include "program/failure.hpp"
#include "program/human_text.hpp"
#include "program/json_text.hpp"

namespace geodisk::tools {
namespace {

using OrderedJson = nlohmann::ordered_json;

constexpr const char* kRemedy = "; run geodisk_bench --tune again, or remove the file";

/// The value of `key` in the file `path`. Throws UserError(bad_input).
const OrderedJson& value_of(const Path& path, const OrderedJson& document, const char* key) {
    if (!document.is_object()) {
        fail_input(path, std::string("is not as geodisk_bench --tune writes it") + kRemedy);
    }
    if (!document.contains(key)) {
        fail_input(path, std::string("has no ") + key + kRemedy);
    }
    return document[key];
}

[[noreturn]] void fail_value(const Path& path, const char* key, const OrderedJson& value,
                             const std::string& wanted) {
    fail_input(path, std::string(key) + ": " + in_quotes(json_text(value, -1)) + " is not " +
                         wanted + kRemedy);
}

/// Takes no number that a conversion would change, nor anything else.
std::uint32_t number_of(const Path& path, const OrderedJson& document, const char* key) {
    constexpr std::uint64_t kMax = std::numeric_limits<std::uint32_t>::max();
    const OrderedJson& value = value_of(path, document, key);
    const auto* const number = value.get_ptr<const OrderedJson::number_unsigned_t*>();
    if (number == nullptr || *number > kMax) {
        fail_value(path, key, value, "a whole number of 0 to " + exact_text(kMax));
    }
    return static_cast<std::uint32_t>(*number);
}

Reads reads_of(const Path& path, const OrderedJson& document) {
    const OrderedJson& value = value_of(path, document, "reads");
    const auto* const name = value.get_ptr<const OrderedJson::string_t*>();
    const std::optional<Reads> reads = name != nullptr ? reads_named(*name) : std::nullopt;
    if (!reads) {
        fail_value(path, "reads", value, "one of auto, storage and texels");
    }
    return *reads;
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
    const std::filesystem::path folder = detail::cache_folder();
    if (folder.empty()) {
        return {};
    }
    char driver[16];
    std::snprintf(driver, sizeof driver, "%08x", device.driver_version);
    return folder / ("tuning-" + uuid_text(device.uuid) + "-" + driver + ".json");
}

std::optional<Tuning> load_tuning(const DeviceReport& device) {
    const std::filesystem::path path = tuning_path(device);
    std::error_code ignored;
    if (path.empty() || !std::filesystem::exists(path, ignored)) {
        return std::nullopt;
    }
    // Without exceptions: a document that is none holds no key.
    const OrderedJson document = OrderedJson::parse(read_text(path), nullptr, false);
    Tuning tuning;
    tuning.local_size = number_of(path, document, "local_size");
    tuning.slot_local_size = number_of(path, document, "slot_local_size");
    tuning.pool_block = number_of(path, document, "pool_block");
    tuning.batches = number_of(path, document, "batches");
    tuning.reads = reads_of(path, document);
    if (const auto checked = chosen_tuning(tuning, device); !checked) {
        fail_input(path, checked.error().message + kRemedy);
    }
    return tuning;
}

std::filesystem::path writable_tuning_path(const DeviceReport& device) {
    std::filesystem::path path = tuning_path(device);
    if (path.empty()) {
        fail_output("cannot save the tuning: neither XDG_CACHE_HOME nor HOME is set");
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
    const OrderedJson document{{"geodisk_version", GEODISK_VERSION_STRING},
                               {"device", device.name},
                               {"driver", driver_text(device)},
                               {"local_size", tuning.local_size},
                               {"slot_local_size", tuning.slot_local_size},
                               {"pool_block", tuning.pool_block},
                               {"batches", tuning.batches},
                               {"reads", to_string(tuning.reads)}};
    AtomicFile file(path);
    file.write(json_text(document, 2) + '\n');
    file.commit();
}

} // namespace geodisk::tools
