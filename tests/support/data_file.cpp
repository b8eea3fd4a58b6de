#include "support/data_file.hpp"

#include <cstdlib>
#include <fstream>
#include <string_view>

#include <doctest/doctest.h>

namespace geodisk::test {
namespace {

const std::filesystem::path kOwnData = GEODISK_TEST_DATA;
const std::filesystem::path kSharedData = GEODISK_SHARED_DATA;

bool is_set(const char* variable) {
    const char* const value = std::getenv(variable);
    return value != nullptr && std::string_view(value) == "true";
}

/// Returns true if the test that runs is one of those that may be left out.
bool may_be_left_out() {
    std::ifstream names(kOwnData / "mesh_tests.txt");
    const std::string_view test = doctest::getContextOptions()->currentTest->m_name;
    for (std::string name; std::getline(names, name);) {
        if (name == test) {
            return true;
        }
    }
    return false;
}

void tell_missing(const std::string& name, bool has_stand_in) {
    const std::string reason = "no folder " + kSharedData.string() + " for " + name +
                               "; set GEODISK_SHARED_DATA when configuring";
    if (is_set("CI") && !(is_set("GEODISK_NO_MESHES") && (has_stand_in || may_be_left_out()))) {
        FAIL_CHECK(reason);
    } else if (!has_stand_in) {
        MESSAGE("skipped: " << reason);
    }
}

} // namespace

std::optional<std::filesystem::path> data_file(const std::string& name, bool has_stand_in) {
    const std::filesystem::path folder = *std::filesystem::path(name).begin();
    if (folder == "bad" || folder == "cases") {
        return kOwnData / name;
    }
    if (!std::filesystem::is_directory(kSharedData)) {
        tell_missing(name, has_stand_in);
        return std::nullopt;
    }
    return kSharedData / name;
}

} // namespace geodisk::test
