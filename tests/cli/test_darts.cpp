// `geodisk sample --method darts`: when it stops, what it says then, and what it refuses.
#include <doctest/doctest.h>

#include <cstdint>
#include <string>
#include <tuple>
#include <vector>

#include <nlohmann/json.hpp>

#include "cli/command.hpp"
#include "files/samples/sample_file.hpp"

namespace geodisk::test {
namespace {

using Arguments = std::vector<std::string>;
using Json = nlohmann::json;

Arguments sample_darts(const Arguments& options) {
    Arguments arguments{"sample", "builtin:cube", "-o", "a.ply"};
    arguments.insert(arguments.end(), options.begin(), options.end());
    return arguments;
}

Arguments darts(const Arguments& options) {
    Arguments arguments = sample_darts({"--method", "darts"});
    arguments.insert(arguments.end(), options.begin(), options.end());
    return arguments;
}

struct Throw {
    std::vector<tools::SampleRow> rows;
    tools::SampleHeader header;
    Json report;
    std::string summary;
};

Throw thrown(const TemporaryFolder& folder, Arguments arguments) {
    arguments.insert(arguments.end(), {"--json", "a.json"});
    const Outcome outcome = run(folder, arguments);
    INFO(outcome.err);
    REQUIRE(outcome.status == 0);
    tools::SampleFile file = tools::read_samples(folder / "a.ply");
    return {std::move(file.rows), std::move(file.header), Json::parse(bytes_of(folder / "a.json")),
            outcome.out};
}

/// Places of the samples, in dart order.
using Places = std::vector<std::tuple<std::uint32_t, float, float>>;

Places places(const Throw& set) {
    Places result;
    for (const tools::SampleRow& row : set.rows) {
        result.emplace_back(row.face, row.bary[1], row.bary[2]);
    }
    return result;
}

bool has_entry(const tools::SampleHeader& header, const std::string& key,
               const std::string& value) {
    for (const auto& [name, text] : header.entries) {
        if (name == key) {
            return text == value;
        }
    }
    return false;
}

} // namespace

TEST_CASE("darts stop at their number, and are a pool if they are as many") {
    const TemporaryFolder folder;
    // The first stage of either expects five darts per sample.
    const Throw pool =
        thrown(folder, sample_darts({"-d", "0.2", "--method", "psdp", "--pool-ratio", "5"}));
    CHECK(pool.report["method"] == "pool");
    CHECK(pool.report["stopped_by"] == "pool");
    CHECK(pool.report["darts"].is_null());
    const auto size = pool.report["candidates"].get<std::uint64_t>();
    const Throw set = thrown(folder, darts({"-d", "0.2", "--darts", std::to_string(size)}));
    CHECK(places(set) == places(pool));
    CHECK(set.report["method"] == "darts");
    CHECK(set.report["darts"] == size);
    CHECK(set.report["stopped_by"] == "darts");
    CHECK(set.report["chunks"] == 1);
    CHECK(set.report["pool_ratio"].is_null());
    CHECK(has_entry(set.header, "darts", std::to_string(size)));
    CHECK(contains(set.summary, "darts         "));

    const Throw more = thrown(folder, darts({"-r", "0.1", "--throws", "2e5"}));
    CHECK(more.rows.size() > set.rows.size());
    CHECK(run(folder, {"verify", "builtin:cube", "a.ply"}).status == 0);
}

TEST_CASE("darts stop at exactly the count, with the first samples") {
    const TemporaryFolder folder;
    const auto all = places(thrown(folder, darts({"-d", "0.1", "--throws", "20000"})));
    REQUIRE(all.size() > 300);
    for (const Arguments& more : {Arguments{}, Arguments{"--throws", "20000"}}) {
        Arguments options{"-d", "0.1", "--count", "300"};
        options.insert(options.end(), more.begin(), more.end());
        const Throw set = thrown(folder, darts(options));
        CHECK(places(set) == Places(all.begin(), all.begin() + 300));
        CHECK(set.report["stopped_by"] == "count");
        // Just as many darts as that took: without the last there is one sample fewer.
        const auto had = set.report["darts"].get<std::uint64_t>();
        for (const std::uint64_t fewer : {0u, 1u}) {
            const std::string darts_left = std::to_string(had - fewer);
            CHECK(thrown(folder, darts({"-d", "0.1", "--throws", darts_left})).rows.size() ==
                  300 - fewer);
        }
        CHECK(set.report["samples"] == 300);
        CHECK(contains(set.summary, "samples       300, rho"));
    }
}

TEST_CASE("darts that run out before the count are told, or an error where none were named") {
    const TemporaryFolder folder;
    const Throw set = thrown(folder, darts({"-d", "0.5", "--count", "5000", "--throws", "300"}));
    CHECK(set.rows.size() < 100);
    CHECK(set.report["stopped_by"] == "darts");
    CHECK(contains(set.summary, " of 5,000 asked for, when the darts ran out, rho"));
    CHECK(set.report["warnings"].back()["kind"] == "count_missed");
    CHECK(contains(set.report["warnings"].back()["message"].get<std::string>(),
                   " of 5,000 samples fit before the darts ran out"));
    const TemporaryFolder empty;
    check_fails(empty, 2, "of 5,000 samples at distance 0.5 with",
                darts({"-d", "0.5", "--count", "5000", "--json", "a.json"}));
    check_fails(empty, 2, "--darts", darts({"-d", "0.5", "--count", "5000"}));
}

TEST_CASE("methods take their own options") {
    const TemporaryFolder folder;
    check_fails(folder, 2, "'dart' is neither pool nor darts",
                sample_darts({"-d", "1", "--method", "dart"}));
    check_fails(folder, 2, "needs a number to stop at", darts({"-d", "1"}));
    check_fails(folder, 2, "no distance given", darts({"--count", "9"}));
    check_fails(folder, 2, "no distance given", darts({"--throws", "9"}));
    check_fails(folder, 2, "contradict", darts({"-d", "1", "-r", "1", "--throws", "9"}));
    check_fails(folder, 2, "--pool-ratio is for --method pool",
                darts({"-d", "1", "--throws", "9", "--pool-ratio", "20"}));
    check_fails(folder, 2, "--darts is for --method darts",
                sample_darts({"-d", "1", "--darts", "9"}));
    for (const char* const value : {"0", "-1", "1.5", "many", "4294967296", "1e300"}) {
        check_fails(folder, 2, "--darts", darts({"-d", "1", "--throws", value}));
        check_fails(folder, 2, "--count", darts({"-d", "1", "--count", value}));
    }
    check_fails(folder, 2, "the maximum is 4,294,967,295", darts({"-d", "1", "--throws", "1e10"}));
}

} // namespace geodisk::test
