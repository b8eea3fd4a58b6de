// Machines where geodisk cannot run.
#include <doctest/doctest.h>

#include <cstdlib>
#include <optional>
#include <string>
#include <utility>

#include <nlohmann/json.hpp>

#include "cli/command.hpp"
#include "support/sanitizers.hpp"

namespace geodisk::test {
namespace {

const std::vector<std::string> kSample{"sample", "builtin:cube", "-o", "a.ply", "-n", "9"};

Setting with_driver(const std::string& manifest) {
    Setting setting;
    // The loader's names for the same setting, new and old.
    setting.environment = {{"VK_DRIVER_FILES", manifest}, {"VK_ICD_FILENAMES", manifest}};
    return setting;
}

/// The library of the first driver that the environment or the system names; "" if none is found.
std::string real_driver() {
    std::vector<std::filesystem::path> manifests;
    for (const char* const name : {"VK_DRIVER_FILES", "VK_ICD_FILENAMES"}) {
        if (const char* const value = std::getenv(name)) {
            const std::string files = value;
            manifests.emplace_back(files.substr(0, files.find(':')));
        }
    }
    std::error_code ignored;
    for (const auto& entry :
         std::filesystem::directory_iterator("/usr/share/vulkan/icd.d", ignored)) {
        if (contains(entry.path().filename().string(), "lvp")) {
            manifests.push_back(entry.path());
        }
    }
    for (const std::filesystem::path& manifest : manifests) {
        const auto json = nlohmann::json::parse(bytes_of(manifest), nullptr, false);
        if (!json.is_discarded() && json.contains("ICD")) {
            const std::string library = json["ICD"].value("library_path", "");
            return library.starts_with('.') ? (manifest.parent_path() / library).string() : library;
        }
    }
    return "";
}

/// With the driver of weak_driver.cpp; nothing if there is none to build it on.
std::optional<Setting> with_weak_driver() {
    const std::string driver = real_driver();
    if (driver.empty()) {
        MESSAGE("skipped: no driver manifest found to build a weak driver on");
        return std::nullopt;
    }
    Setting setting = with_driver(GEODISK_WEAK_DRIVER_MANIFEST);
    setting.environment.emplace_back("GEODISK_TEST_DRIVER", driver);
    return setting;
}

} // namespace

TEST_CASE("no driver") {
    const TemporaryFolder folder;
    check_fails(folder, 5, "driver", kSample, with_driver("/nonexistent/driver.json"));
    check_fails(folder, 5, "driver", {"info"}, with_driver("/nonexistent/driver.json"));
}

TEST_CASE("no such device") {
    const TemporaryFolder folder;
    std::vector<std::string> arguments = kSample;
    arguments.insert(arguments.end(), {"--device", "abacus"});
    check_fails(folder, 5, "abacus", arguments);
    const Outcome outcome = run(folder, arguments);
    CHECK_FALSE(contains(outcome.err, "none of them works"));
}

TEST_CASE("a device can be chosen by index") {
    const TemporaryFolder folder;
    std::vector<std::string> arguments = kSample;
    arguments.insert(arguments.end(), {"--device", "0"});
    CHECK(run(folder, arguments).status == 0);
}

TEST_CASE("a device that is too weak") {
    const TemporaryFolder folder;
    const std::optional<Setting> setting = with_weak_driver();
    if (!setting) {
        return;
    }
    check_fails(folder, 5, "maxComputeWorkGroupInvocations is 16", kSample, *setting);
    const Outcome info = run(folder, {"info"}, *setting);
    CHECK(info.status == 5);
    CHECK(contains(info.out, "runs geodisk     no:"));
    CHECK(contains(info.err, "none of these Vulkan devices"));
}

TEST_CASE("a device that cannot draw may still sample") {
    const TemporaryFolder folder;
    std::optional<Setting> setting = with_weak_driver();
    if (!setting) {
        return;
    }
    setting->environment.emplace_back("GEODISK_TEST_NO_GRAPHICS", "1");
    const Outcome quick = run(folder, {"builtin:cube"}, *setting);
    INFO(quick.err);
    CHECK(quick.status == 0);
    CHECK(contains(quick.out, "picture       none, the device cannot draw\n"));
    CHECK(files_in(folder) == std::vector<std::string>{"cube-samples.ply"});

    // The mesh is read once, and warned about once.
    setting->stdin_path =
        folder.write("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 7 7 7\nf 1 2 3\n").string();
    const Outcome piped = run(folder, {"-", "--mesh-format", "obj", "--count", "9"}, *setting);
    INFO(piped.err);
    CHECK(piped.status == 0);
    CHECK(lines_of(piped.err).size() == 1);
    CHECK(std::filesystem::exists(folder / "stdin-samples.ply"));

    check_fails(folder, 5, "graphics", joined(kSample, {"--picture", "a.png"}), *setting);
    check_fails(folder, 5, "graphics",
                {"render", "builtin:cube", "cube-samples.ply", "-o", "a.png"}, *setting);
}

#ifdef __linux__
TEST_CASE("a batch goes on when its device is lost, and opens it anew") {
    const TemporaryFolder folder;
    std::optional<Setting> setting = with_weak_driver();
    if (!setting) {
        return;
    }
    folder.write("list.txt", "builtin:torus-knot:24\nbuiltin:cube\n");
    REQUIRE(run(folder, {"sample", "builtin:cube", "-n", "300", "-o", "cube.ply"}).status == 0);
    const Arguments batch{"batch", "list.txt", "-n", "300", "--jobs", "1"};
    setting->environment.emplace_back("GEODISK_TEST_LOSSES", "1");
    const Outcome once = run(folder, joined(batch, {"-o", "once"}), *setting);
    INFO(once.err);
    CHECK(once.status == 0);
    CHECK(contains(once.out, "2 ok, 0 failed"));
    // The runs beside are done again as well.
    const Outcome beside =
        run(folder, {"batch", "list.txt", "-n", "300", "--jobs", "2", "-o", "beside"}, *setting);
    INFO(beside.err);
    CHECK(beside.status == 0);
    CHECK(contains(beside.out, "2 ok, 0 failed"));

    setting->environment.back().second = "2"; // Again where it is tried once more.
    const Outcome twice = run(folder, joined(batch, {"-o", "twice"}), *setting);
    INFO(twice.err);
    CHECK(twice.status == 1);
    CHECK(contains(twice.err, "builtin:torus-knot:24: "));
    CHECK(contains(twice.out, "1 ok, 1 failed"));
    for (const char* const file : {"once/cube.ply", "beside/cube.ply", "twice/cube.ply"}) {
        CHECK(bytes_of(folder / file) == bytes_of(folder / "cube.ply"));
    }
    CHECK(contains(bytes_of(folder / "twice/batch.jsonl"), "\"exit_code\":7"));
}

// AddressSanitizer tells of crashes itself, and adds calls of its own to those that led there.
TEST_CASE("a driver that crashes is told from geodisk" *
          doctest::skip(GEODISK_HAS_ADDRESS_SANITIZER)) {
    const TemporaryFolder folder;
    const std::optional<Setting> setting = with_weak_driver();
    if (!setting) {
        return;
    }
    for (const auto& [crash, message] : {std::pair{"access", "crashed (SIGSEGV)"},
                                         {"abort", "crashed (SIGABRT)"},
                                         {"exit", "the process was ended"}}) {
        Setting crashing = *setting;
        crashing.environment.emplace_back("GEODISK_TEST_CRASH", crash);
        check_fails(folder, 7,
                    std::string(message) + " in libgeodisk_weak_driver.so, not in geodisk: "
                                           "the Vulkan driver or what it uses",
                    kSample, crashing);
    }
}
#endif

TEST_CASE("verify needs no device") {
    const TemporaryFolder folder;
    REQUIRE(run(folder, kSample).status == 0);
    CHECK(run(folder, {"verify", "builtin:cube", "a.ply"}, with_driver("/nonexistent")).status ==
          0);
}

} // namespace geodisk::test
