// Reports on devices and their kernels.
#include <doctest/doctest.h>

#include <string>

#include <nlohmann/json.hpp>

#include "cli/command.hpp"

namespace geodisk::test {
namespace {

using Json = nlohmann::json;

constexpr const char* kExtension = "VK_KHR_pipeline_executable_properties";

} // namespace

TEST_CASE("info lists devices, as text and as JSON") {
    const TemporaryFolder folder;
    const Outcome text = run(folder, {"info"});
    CHECK(text.status == 0);
    CHECK(contains(text.out, "[default]"));
    CHECK(contains(text.out, "runs geodisk     yes"));
    const Outcome json = run(folder, {"info", "--json"});
    CHECK(json.status == 0);
    const Json document = Json::parse(json.out);
    CHECK(!document.at("devices").empty());
    CHECK(document.at("default_device").is_number());
}

TEST_CASE("info --kernels tells what the driver does, or that it does not") {
    const TemporaryFolder folder;
    const Arguments asked{"info", "--kernels", "--json"};
    const Outcome outcome = run(folder, asked);
    if (outcome.status != 0) {
        MESSAGE("the driver tells nothing of its kernels");
        check_fails(folder, 5, kExtension, asked);
        return;
    }
    const Json document = Json::parse(outcome.out);
    CHECK(!document.at("device").get<std::string>().empty());
    std::size_t detects = 0;
    for (const Json& kernel : document.at("kernels")) {
        detects += kernel.at("kernel") == "detect" ? 1u : 0u;
        CHECK(kernel.at("statistics").is_object());
    }
    CHECK(detects >= 4); // One radius or varying ones, with a ring or a heap.
    const Outcome table = run(folder, {"info", "--kernels"});
    CHECK(table.status == 0);
    CHECK(contains(table.out, "\ndetect "));
}

TEST_CASE("options of info --kernels are checked") {
    const TemporaryFolder folder;
    check_fails(folder, 2, "--device requires --kernels", {"info", "--device", "0"});
    check_fails(folder, 2, "--reads requires --kernels", {"info", "--reads", "texels"});
    check_fails(folder, 2, "'books' is none of auto, storage and texels",
                {"info", "--kernels", "--reads", "books"});
    check_fails(folder, 5, "abacus", {"info", "--kernels", "--device", "abacus"});
}

} // namespace geodisk::test
