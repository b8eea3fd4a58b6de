// Numbers of a tuning file, which a person may have edited.
#include <doctest/doctest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

#include "files/tuning_file.hpp"
#include "program/failure.hpp"
#include "test_files.hpp"

namespace geodisk::tools {

#ifndef _WIN32
namespace {

/// Returns what load_tuning() says of a file that holds `text`.
std::string message_for(const TemporaryFolder& folder, const std::string& text) {
    setenv("XDG_CACHE_HOME", std::filesystem::path(folder / ".").c_str(), 1);
    const DeviceReport device;
    const std::filesystem::path path = tuning_path(device);
    std::filesystem::create_directories(path.parent_path());
    std::ofstream(path) << text;
    std::string message;
    try {
        load_tuning(device);
    } catch (const UserError& error) {
        CHECK(error.code() == ExitCode::bad_input);
        message = error.what();
    }
    unsetenv("XDG_CACHE_HOME");
    CHECK(message.starts_with(path.string()));
    CHECK(message.ends_with("; run geodisk_bench --tune again, or remove the file"));
    return message;
}

std::string tuning(const std::string& local_size, const std::string& reads = R"("storage")") {
    return R"({"local_size":)" + local_size +
           R"(,"slot_local_size":8,"pool_block":1,"batches":24,"reads":)" + reads + '}';
}

} // namespace

TEST_CASE("a tuning file holds whole numbers that fit, or is refused by name and key") {
    const TemporaryFolder folder;
    for (const char* const number : {"4294967360", "18446744073709551680", "1e30", "128.7", "64.0",
                                     "-64", "true", "null", "\"64\"", "[64]", "{}", "1e400"}) {
        CAPTURE(number);
        const std::string message = message_for(folder, tuning(number));
        const bool is_json = std::string(number) != "1e400"; // No document at all.
        CHECK(
            contains(message, is_json ? "local_size: " : "is not as geodisk_bench --tune writes"));
    }
    for (const char* const reads : {"\"minds\"", "1", "null", "[]"}) {
        CHECK(contains(message_for(folder, tuning("64", reads)), "reads: "));
    }
    CHECK(contains(message_for(folder, "{}"), "has no local_size"));
    for (const char* const text : {"", "[]", "7", "{\"local_size\":", "\xff"}) {
        CHECK(contains(message_for(folder, text), "is not as geodisk_bench --tune writes it"));
    }
}
#endif

} // namespace geodisk::tools
