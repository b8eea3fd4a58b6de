// The benchmark: its files and failures. What its times are is nothing a test could know.
#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <future>
#include <iterator>
#include <set>

#include <nlohmann/json.hpp>

#include "cli/command.hpp"

namespace geodisk::test {
namespace {

using Json = nlohmann::json;

Setting bench() {
    Setting setting;
    setting.program = GEODISK_BENCH;
    return setting;
}

void check_row(const Json& row) {
    for (const char* const key :
         {"triangles", "samples", "candidates", "disks", "windows", "tested", "batches",
          "dispatches", "regrown", "starts", "max_waiting", "longest_chain", "device_bytes"}) {
        INFO(key);
        CHECK(row[key].is_number_unsigned());
    }
    for (const char* const key :
         {"prepare_seconds", "upload_seconds", "device_seconds", "readback_seconds",
          "reference_seconds", "device_per_reference", "device_cpu_seconds",
          "reference_cpu_seconds", "device_samples_per_second", "reference_samples_per_second",
          "min_distance", "disks_per_sample", "windows_per_disk", "tested_per_disk",
          "bytes_per_candidate"}) {
        INFO(key);
        CHECK(row[key].is_number_float());
        CHECK(row[key] >= 0.0);
    }
    CHECK(row["samples"] > 0u);
    CHECK(row["disks_per_sample"] >= 1.0);
}

} // namespace

TEST_CASE("the benchmark tells its results and circumstances") {
    const TemporaryFolder folder;
    const Outcome outcome = run(folder,
                                {"builtin:cube", "-n", "50,2e2", "--repeats", "2", "--seed", "7",
                                 "--json", "a.json", "--csv", "a.csv"},
                                bench());
    REQUIRE(outcome.status == 0);
    CHECK(outcome.err.empty());
    CHECK(contains(outcome.out, "builtin:cube"));

    const Json report = Json::parse(bytes_of(folder / "a.json"));
    const Json& circumstances = report["circumstances"];
    for (const char* const key : {"version", "commit", "build_type", "compiler", "device", "driver",
                                  "device_type", "cpu", "date"}) {
        INFO(key);
        CHECK_FALSE(circumstances[key].get<std::string>().empty());
    }
    CHECK(circumstances["dirty"].is_boolean());
    CHECK(circumstances["cores"].is_number_unsigned());
    CHECK(circumstances["repeats"] == 2);
    CHECK(circumstances["warm_ups"] == 1);
    CHECK(circumstances["seed"] == 7);
    REQUIRE(report["rows"].size() == 2);
    for (const Json& row : report["rows"]) {
        CHECK(row["sweep"] == "listed");
        CHECK(row["mesh"] == "builtin:cube");
        CHECK(row["triangles"] == 12);
        check_row(row);
    }
    CHECK(report["rows"][1]["count"] == 200);
    CHECK(report["growth"].empty());

    std::vector<std::string> lines = lines_of(bytes_of(folder / "a.csv"));
    const auto is_comment = [](const std::string& line) { return line.starts_with("# "); };
    CHECK(std::count_if(lines.begin(), lines.end(), is_comment) ==
          static_cast<std::ptrdiff_t>(circumstances.size()));
    std::erase_if(lines, is_comment);
    REQUIRE(lines.size() == 3);
    CHECK(lines[0].starts_with("sweep,mesh,triangles,count,samples,"));
    for (const std::string& line : lines) {
        CHECK(std::count(line.begin(), line.end(), ',') + 1 ==
              static_cast<std::ptrdiff_t>(report["rows"][0].size()));
    }
}

TEST_CASE("a tuning is found, kept for the device, and changes no sample" *
          doctest::test_suite("slow")) {
    const TemporaryFolder folder;
    Setting tuned = bench();
    tuned.environment = {{"XDG_CACHE_HOME", (folder / "cache").string()}};
    // Each size of work groups is compiled anew, so these are given.
    const Outcome found = run(folder,
                              {"builtin:cube", "-n", "50", "--repeats", "1", "--tune",
                               "--local-size", "64", "--slot-local-size", "8"},
                              tuned);
    REQUIRE(found.status == 0);
    CHECK(found.err.empty());
    for (const char* const setting : {"reads storage", "pool_block 8", "batches 12", "kept in"}) {
        CAPTURE(setting);
        CHECK(contains(found.out, setting));
    }
    CHECK_FALSE(contains(found.out, "local_size 32"));
    const auto kept = std::filesystem::directory_iterator(folder / "cache" / "geodisk")->path();
    Json tuning = Json::parse(bytes_of(kept));
    CHECK(tuning["device"].is_string());

    tuning["pool_block"] = 16;
    tuning["batches"] = 5;
    std::ofstream(kept) << tuning;
    Setting sampler = tuned;
    sampler.program = GEODISK_COMMAND;
    const std::vector<std::string> sample{"sample", "builtin:cube", "-n",     "200",
                                          "-q",     "--json",       "a.json", "-o"};
    const auto with_output = [&](const char* name) {
        std::vector<std::string> arguments = sample;
        arguments.push_back(name);
        return arguments;
    };
    REQUIRE(run(folder, with_output("a.ply"), sampler).status == 0);
    const Json report = Json::parse(bytes_of(folder / "a.json"));
    CHECK(report["tuning"]["pool_block"] == 16);
    CHECK(report["tuning"]["batches"] == 5);
    std::filesystem::remove(kept);
    REQUIRE(run(folder, with_output("b.ply"), sampler).status == 0);
    CHECK(Json::parse(bytes_of(folder / "a.json"))["tuning"]["batches"] != 5);
    CHECK(bytes_of(folder / "a.ply") == bytes_of(folder / "b.ply"));

    std::ofstream(kept) << "{}";
    check_fails(folder, 3, "has no local_size; run geodisk_bench --tune again",
                with_output("c.ply"), sampler);
    tuning["pool_block"] = 3;
    std::ofstream(kept) << tuning;
    check_fails(folder, 3, "the pool block must be", with_output("c.ply"), sampler);
    tuning["pool_block"] = 1;
    tuning["reads"] = "minds";
    std::ofstream(kept) << tuning;
    check_fails(folder, 3, "is not one of auto, storage and texels", with_output("c.ply"), sampler);
    std::ofstream(folder / "file") << "";
    Setting nowhere = bench();
    nowhere.environment = {{"XDG_CACHE_HOME", (folder / "file").string()},
                           {"MESA_SHADER_CACHE_DISABLE", "true"}}; // Mesa would complain as well.
    check_fails(folder, 4, "file/geodisk", {"builtin:cube", "--tune"}, nowhere);
    check_fails(folder, 2, "contradicts", {"builtin:cube", "--tune", "--json", "t.json"}, tuned);
}

TEST_CASE("two that keep a tuning at once, and one that reads it, do not meet half a file" *
          doctest::test_suite("slow")) {
    const TemporaryFolder folder;
    Setting tuned = bench();
    tuned.environment = {{"XDG_CACHE_HOME", (folder / "cache").string()}};
    Setting sampler = tuned;
    sampler.program = GEODISK_COMMAND;
    const Arguments tune{"builtin:cube", "-n", "20", "--repeats", "1", "--tune"};
    std::array<std::future<Outcome>, 2> tuning;
    for (auto& one : tuning) {
        one = std::async(std::launch::async, [&] { return run(folder, tune, tuned); });
    }
    const auto are_done = [&] {
        return std::all_of(tuning.begin(), tuning.end(), [](auto& one) {
            return one.wait_for(std::chrono::seconds(0)) == std::future_status::ready;
        });
    };
    do {
        CHECK(run(folder, {"sample", "builtin:cube", "-n", "20", "-q", "-o", "a.ply"}, sampler)
                  .status == 0);
    } while (!are_done());
    for (auto& one : tuning) {
        CHECK(one.get().status == 0);
    }
    const std::filesystem::directory_iterator kept(folder / "cache" / "geodisk");
    CHECK(std::distance(begin(kept), end(kept)) == 1);
    CHECK(
        run(folder, {"sample", "builtin:cube", "-n", "20", "-q", "-o", "b.ply"}, sampler).status ==
        0);
    CHECK(bytes_of(folder / "a.ply") == bytes_of(folder / "b.ply"));
}

TEST_CASE("the benchmark sweeps samples and triangles") {
    const TemporaryFolder folder;
    const Outcome outcome =
        run(folder,
            {"builtin:cube", "--scaling", "--scaling-counts", "20,60", "--scaling-samples", "50",
             "--scaling-faces", "200", "--repeats", "1", "--warm-ups", "0", "--json", "a.json"},
            bench());
    REQUIRE(outcome.status == 0);
    CHECK(files_in(folder) == std::vector<std::string>{"a.json"});
    const Json report = Json::parse(bytes_of(folder / "a.json"));
    std::vector<std::uint64_t> faces;
    for (const Json& row : report["rows"]) {
        check_row(row);
        if (row["sweep"] == "triangles") {
            CHECK(row["count"] == 50);
            faces.push_back(row["triangles"]);
        }
    }
    CHECK(report["rows"].size() == faces.size() + 2);
    CHECK(faces == std::vector<std::uint64_t>{12, 48, 108, 192});
    std::set<std::string> fitted;
    for (const Json& growth : report["growth"]) {
        CHECK(growth["exponent"].is_number_float());
        CHECK(growth["points"] == (growth["sweep"] == "samples" ? 2u : faces.size()));
        fitted.insert(growth["sweep"].get<std::string>() + ' ' +
                      growth["quantity"].get<std::string>());
    }
    CHECK(fitted == std::set<std::string>{"samples device_seconds", "samples reference_seconds",
                                          "triangles device_seconds", "triangles prepare_seconds",
                                          "triangles reference_seconds"});
}

TEST_CASE("the benchmark explains its failures") {
    const TemporaryFolder folder;
    folder.write("broken.obj", "f 1 2 3\n");
    check_fails(folder, 2, "MESH is required (see geodisk_bench --help)", {}, bench());
    check_fails(folder, 2, "--count", {"builtin:cube", "-n", "few"}, bench());
    check_fails(folder, 2, "--repeats", {"builtin:cube", "--repeats", "0"}, bench());
    check_fails(folder, 2, "need --scaling", {"builtin:cube", "--scaling-faces", "9"}, bench());
    check_fails(folder, 2, "contradict", {"builtin:cube", "-n", "9", "--scaling"}, bench());
    check_fails(folder, 2, "would replace", {"builtin:cube", "--json", "a.txt", "--csv", "./a.txt"},
                bench());
    check_fails(folder, 2, "would replace broken.obj", {"broken.obj", "--json", "broken.obj"},
                bench());
    check_fails(folder, 3, "missing.obj", {"builtin:cube", "missing.obj"}, bench());
    check_fails(folder, 3, "broken.obj", {"broken.obj"}, bench());
    check_fails(folder, 4, "cannot write", {"builtin:cube", "--json", "none/a.json"}, bench());
    check_fails(folder, 5, "none of them", {"builtin:cube", "--device", "none of them"}, bench());
}

} // namespace geodisk::test
