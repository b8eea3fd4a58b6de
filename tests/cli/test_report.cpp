// The JSON report and the summary.
#include <doctest/doctest.h>

#include <algorithm>
#include <cstdlib>

#include <nlohmann/json.hpp>

#include "cli/command.hpp"
#include "files/samples/sample_file.hpp"

namespace geodisk::test {
namespace {

using Json = nlohmann::json;

void check_seconds(const Json& seconds) {
    for (const char* const key :
         {"load", "prepare", "device", "pipelines", "upload", "sample", "readback", "write"}) {
        INFO(key);
        REQUIRE(seconds.contains(key));
        CHECK(seconds[key].is_number_float());
        CHECK(seconds[key] >= 0.0);
    }
}

void check_mesh(const Json& mesh) {
    CHECK(mesh["vertices"] == 8);
    CHECK(mesh["triangles"] == 12);
    CHECK(mesh["components"] == 1);
    CHECK(mesh["boundary_edges"] == 0);
    CHECK(mesh["coinciding_border_edges"] == 0);
    CHECK(mesh["nonmanifold_edges"] == 0);
    CHECK(mesh["area"].get<double>() == doctest::Approx(6));
}

bool is_plain(const std::string& text) {
    return std::all_of(text.begin(), text.end(),
                       [](char c) { return c == '\n' || (c >= ' ' && c <= '~'); });
}

} // namespace

TEST_CASE("a count that its distance misses is come near to, by a distance that can be given") {
    const TemporaryFolder folder;
    const auto sample = [&](const Arguments& more, const std::string& name) {
        const Arguments all =
            joined({"sample", "builtin:tube", "-o", name + ".csv", "--json", "a.json"}, more);
        const Outcome outcome = run(folder, all);
        REQUIRE(outcome.status == 0);
        CHECK(contains(outcome.out, " of about 30 asked for, in ") == (name == "near"));
        return Json::parse(bytes_of(folder / "a.json"));
    };
    const Json near = sample({"--count", "30"}, "near");
    CHECK(near["runs"] > 1);
    CHECK(std::abs(near["samples"].get<int>() - 30) <= 1);
    const Json given = sample({"--min-distance", near["min_distance"].dump()}, "given");
    CHECK(given["runs"] == 1);
    CHECK(given["samples"] == near["samples"]);
    CHECK(bytes_of(folder / "near.csv") == bytes_of(folder / "given.csv"));
}

TEST_CASE("the report has every documented key") {
    const TemporaryFolder folder;
    const Outcome outcome = run(folder, {"sample", "builtin:cube", "-o", "a.ply", "-n", "300",
                                         "--seed", "18446744073709551615", "--json", "a.json"});
    REQUIRE(outcome.status == 0);
    const Json report = Json::parse(bytes_of(folder / "a.json"));
    check_mesh(report["mesh"]);
    check_seconds(report["seconds"]);
    for (const char* const key : {"seed", "candidates", "samples", "batches", "dispatches", "disks",
                                  "windows", "max_waiting", "regrown", "starts", "device_bytes",
                                  "tested", "longest_chain", "chunks", "runs"}) {
        INFO(key);
        CHECK(report[key].is_number_unsigned());
    }
    for (const char* const key : {"min_distance", "radius", "rho", "guard", "pool_ratio"}) {
        INFO(key);
        CHECK(report[key].is_number_float());
    }
    for (const char* const key : {"name", "driver", "type"}) {
        INFO(key);
        CHECK(report["device"][key].is_string());
    }
    CHECK(report["version"].is_string());
    CHECK(report["seed"] == 18446744073709551615u);
    CHECK(report["radius"].get<double>() * 2 == report["min_distance"].get<double>());
    const std::size_t samples = tools::read_samples(folder / "a.ply").rows.size();
    CHECK(report["samples"] == samples);
    CHECK(samples > 250);
    CHECK(samples < 350);
    CHECK(report["candidates"] >= 5600);
    CHECK(report["candidates"] <= 6400);
    CHECK(report["rho"] > 0.65);
    CHECK(report["rho"] < 0.8);
}

TEST_CASE("the report tells of seams whose vertices are doubled") {
    const TemporaryFolder folder;
    folder.write("square.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 0 0\nv 1 1 0\nv 0 1 0\n"
                               "f 1 2 3\nf 4 5 6\n");
    const Outcome outcome = run(folder, {"sample", "square.obj", "-o", "a.ply", "-n", "50",
                                         "--json", "a.json", "--keep-seams"});
    REQUIRE(outcome.status == 0);
    CHECK(contains(outcome.out, "6 boundary edges, 2 of them on others,"));
    CHECK(contains(outcome.err, "square.obj: 2 edges coincide but are not connected"));
    const Json report = Json::parse(bytes_of(folder / "a.json"));
    CHECK(report["mesh"]["boundary_edges"] == 6);
    CHECK(report["mesh"]["coinciding_border_edges"] == 2);
    REQUIRE(report["warnings"].size() == 2);
    CHECK(report["warnings"][0]["kind"] == "components");
    CHECK(report["warnings"][1]["kind"] == "unwelded");
    CHECK(report["warnings"][1]["count"] == 2);
    CHECK(report["warnings"][1]["first"].is_null());
    CHECK(report["warnings"][1]["file"] == "square.obj");
    CHECK(report["mesh"]["keep_seams"] == "yes");
    CHECK(report["mesh"]["joined_edges"] == 0);

    const Outcome closed =
        run(folder, {"sample", "square.obj", "-o", "b.ply", "-n", "50", "--json", "b.json"});
    CHECK(closed.err.empty());
    CHECK(contains(closed.out, "1 component, 4 boundary edges, 2 edges joined along seams, area"));
    CHECK(Json::parse(bytes_of(folder / "b.json"))["mesh"]["joined_edges"] == 2);

    folder.write("odd.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nf 3 3 1\nf 1 2 3\n");
    for (const Arguments& command : {Arguments{"sample", "odd.obj", "-o", "b.ply", "-n", "9"},
                                     {"verify", "odd.obj", "b.ply"}}) {
        const Outcome odd = run(folder, joined(command, {"--json", "-"}));
        REQUIRE(odd.status == 0);
        const Json warnings = Json::parse(odd.out)["warnings"];
        REQUIRE(warnings.size() == 1);
        CHECK(warnings[0]["kind"] == "repeated_vertices");
        CHECK(warnings[0]["first"] == "line 4");
        CHECK(odd.err ==
              "geodisk: warning: odd.obj: " + warnings[0]["message"].get<std::string>() + "\n");
    }
}

TEST_CASE("the report counts parts without a sample, which are too small for a candidate") {
    const TemporaryFolder folder;
    folder.write("parts.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 2 0 0\nv 3 0 0\nv 2 1 0\n"
                              "v 5 0 0\nv 5.05 0 0\nv 5 0.05 0\nv 6 0 0\nv 6.05 0 0\n"
                              "v 6 0.05 0\nf 1 2 3\nf 4 5 6\nf 7 8 9\nf 10 11 12\nf 7 7 1\n");
    const auto sample = [&](const char* distance) {
        return run(folder,
                   {"sample", "parts.obj", "-o", "a.ply", "-d", distance, "--json", "a.json"});
    };
    Outcome outcome = sample("3"); // Beyond every part: one in each that has a candidate.
    REQUIRE(outcome.status == 0);
    CHECK(contains(outcome.out, "4 components (2 without a sample)"));
    Json report = Json::parse(bytes_of(folder / "a.json"));
    CHECK(report["mesh"]["components"] == 4);
    CHECK(report["mesh"]["components_without_samples"] == 2);
    CHECK(report["warnings"].back()["kind"] == "single_samples");
    CHECK(contains(outcome.err, "no part has more than one sample: the minimum distance of 3"));
    outcome = sample("0.05");
    REQUIRE(outcome.status == 0);
    report = Json::parse(bytes_of(folder / "a.json"));
    CHECK(report["mesh"]["components_without_samples"] == 0);
}

TEST_CASE("a count that parts cannot give, and parts without samples, are warnings") {
    const TemporaryFolder folder;
    std::string parts;
    for (int i = 0; i < 40; ++i) {
        const std::string x = std::to_string(3 * i);
        const std::string next = std::to_string(3 * i + 1);
        parts += "v " + x + " 0 0\nv " + next + " 0 0\nv " + x + " 1 0\nf -3 -2 -1\n";
    }
    folder.write("parts.obj", parts);
    const auto kinds = [&](const char* count) {
        const Outcome outcome =
            run(folder, {"sample", "parts.obj", "-o", "a.ply", "-n", count, "--json", "a.json"});
        REQUIRE(outcome.status == 0);
        std::string found;
        const Json report = Json::parse(bytes_of(folder / "a.json"));
        for (const Json& warning : report["warnings"]) {
            found += warning["kind"].get<std::string>() + ' ';
            CHECK(contains(outcome.err, warning["message"].get<std::string>()));
        }
        return found;
    };
    CHECK(kinds("2") == "components count_missed bare_parts ");
    CHECK(kinds("400") == "components ");
}

TEST_CASE("the report takes the place of the summary on standard output") {
    const TemporaryFolder folder;
    const Outcome outcome =
        run(folder, {"sample", "builtin:cube", "-o", "a.ply", "-n", "9", "--json", "-"});
    CHECK(outcome.status == 0);
    CHECK(Json::parse(outcome.out)["mesh"]["triangles"] == 12);
    CHECK(outcome.err.empty());
    CHECK(files_in(folder) == std::vector<std::string>{"a.ply"});
}

TEST_CASE("the summary is short and plain when piped") {
    const TemporaryFolder folder;
    const Outcome outcome = run(folder, {"sample", "builtin:cube", "-o", "a.ply", "-d", "0.25"});
    CHECK(outcome.status == 0);
    CHECK(outcome.err.empty());
    CHECK(is_plain(outcome.out));
    CHECK(lines_of(outcome.out).size() <= 10);
    for (const char* const part :
         {"builtin:cube", "0.25", "0.125", "rho", "a.ply", "12 triangles"}) {
        INFO(part);
        CHECK(contains(outcome.out, part));
    }
    const Outcome quiet =
        run(folder, {"sample", "builtin:cube", "-o", "a.ply", "-d", "0.25", "--quiet"});
    CHECK(quiet.status == 0);
    CHECK(quiet.out.empty());
    CHECK(quiet.err.empty());
}

TEST_CASE("the locale changes nothing") {
    const TemporaryFolder folder;
    Setting german;
    german.environment = {{"LC_ALL", "de_DE.UTF-8"}};
    const std::vector<std::string> arguments{"sample", "builtin:cube", "-o", "a.csv", "-d", "0.5"};
    REQUIRE(run(folder, arguments).status == 0);
    const std::string before = bytes_of(folder / "a.csv");
    REQUIRE(run(folder, arguments, german).status == 0);
    CHECK(bytes_of(folder / "a.csv") == before);
}

} // namespace geodisk::test
