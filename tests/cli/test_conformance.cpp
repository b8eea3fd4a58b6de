// The golden sets on a device, and what is said of one that gives others.
#include <doctest/doctest.h>

#include <algorithm>
#include <fstream>
#include <string>

#include <nlohmann/json.hpp>

#include "cli/command.hpp"

namespace geodisk::test {
namespace {

using Json = nlohmann::json;

} // namespace

TEST_CASE("this device gives the golden sets") {
    const TemporaryFolder folder;
    const Outcome outcome = run(folder, {"conformance", "-o", "record.json"});
    INFO(outcome.out);
    CHECK(outcome.status == 0);
    CHECK(outcome.err.empty());
    const Json record = Json::parse(bytes_of(folder / "record.json"));
    CHECK(record["sets"] >= 30);
    CHECK(record["same"] == record["sets"]);
    CHECK(record["results"].size() == record["sets"]);
    CHECK(!record["device"]["name"].get<std::string>().empty());
    CHECK(
        std::ranges::any_of(record["results"], [](const Json& set) { return set["chunks"] > 1; }));
}

TEST_CASE("a device that gives another set is told") {
    const TemporaryFolder folder;
    std::ofstream(folder / "sets.txt") << "# of this test\n\n"
                                          "bfdb6bcc10ad6eab 12 sample builtin:cube -d 0.9\n";
    const Outcome printed = run(folder, {"conformance", "--sets", "sets.txt", "--print-sets"});
    REQUIRE(printed.status == 0);
    CHECK(contains(printed.out, "sample builtin:cube -d 0.9\n"));
    std::ofstream(folder / "right.txt") << printed.out;
    CHECK(run(folder, {"conformance", "--sets", "right.txt"}).status == 0);

    std::string digits = printed.out.substr(0, 16);
    digits[15] = digits[15] == '0' ? '1' : '0';
    std::ofstream(folder / "wrong.txt") << digits << printed.out.substr(16) << printed.out;
    const Outcome wrong = run(folder, {"conformance", "--sets", "wrong.txt", "-o", "a.json"});
    CHECK(wrong.status == 1);
    CHECK(contains(wrong.out, "different"));
    CHECK(contains(wrong.out, "1 of 2 sets"));
    CHECK(contains(wrong.err, "1 of 2 sets"));
    CHECK(Json::parse(bytes_of(folder / "a.json"))["same"] == 1);
}

TEST_CASE("a set that cannot be computed fails alone") {
    const TemporaryFolder folder;
    std::ofstream(folder / "sets.txt")
        << "0123456789abcdef 1 sample builtin:cube -d 0.1 --memory 1K\n"
           "0123456789abcdef 1 box --dim 9 -d 1\n"
           "0123456789abcdef 1 sample missing.obj -d 0.1\n";
    const Outcome outcome = run(folder, {"conformance", "--sets", "sets.txt"});
    CHECK(outcome.status == 1);
    CHECK(contains(outcome.out, "failed: the run takes"));
    CHECK(contains(outcome.out, "failed: --dim"));
    CHECK(contains(outcome.out, "failed: missing.obj"));
    CHECK(contains(outcome.out, "0 of 3 sets"));

    std::ofstream(folder / "bad.txt") << "# nothing\nsample builtin:cube -d 0.1\n";
    check_fails(folder, 3, "line 2: is not a fingerprint", {"conformance", "--sets", "bad.txt"});
    std::ofstream(folder / "empty.txt") << "# nothing\n";
    check_fails(folder, 3, "has no sets", {"conformance", "--sets", "empty.txt"});
    check_fails(folder, 2, "", {"conformance", "--sets", "bad.txt", "-o", "bad.txt"});
    check_fails(folder, 5, "abacus", {"conformance", "--device", "abacus"});
}

} // namespace geodisk::test
