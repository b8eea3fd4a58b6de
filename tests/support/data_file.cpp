#include "support/data_file.hpp"

#include <cstdlib>
#include <string_view>

#include <doctest/doctest.h>

namespace geodisk::test {
namespace {

const std::filesystem::path kOwnData = GEODISK_TEST_DATA;
const std::filesystem::path kSharedData = GEODISK_SHARED_DATA;

bool is_continuous_integration() {
    const char* value = std::getenv("CI");
    return value != nullptr && std::string_view(value) == "true";
}

void tell_missing(const std::string& name) {
    const std::string reason = "no folder " + kSharedData.string() + " for " + name +
                               "; set GEODISK_SHARED_DATA when configuring";
    if (is_continuous_integration()) {
        FAIL_CHECK(reason);
    } else {
        MESSAGE("skipped: " << reason);
    }
}

} // namespace

std::optional<std::filesystem::path> data_file(const std::string& name) {
    const std::filesystem::path folder = *std::filesystem::path(name).begin();
    if (folder == "bad" || folder == "cases") {
        return kOwnData / name;
    }
    if (!std::filesystem::is_directory(kSharedData)) {
        tell_missing(name);
        return std::nullopt;
    }
    return kSharedData / name;
}

} // namespace geodisk::test
