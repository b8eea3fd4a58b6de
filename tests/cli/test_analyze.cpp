// `geodisk analyze` tells what sets are like, and agrees with `geodisk verify`.
#include <doctest/doctest.h>

#include <string>

#include <nlohmann/json.hpp>

#include "cli/command.hpp"
#include "files/samples/sample_file.hpp"

namespace geodisk::test {
namespace {

constexpr const char* kAnalyzedMesh = "builtin:icosphere:3";

void make_set(const TemporaryFolder& folder, const std::string& file, const Arguments& more) {
    REQUIRE(run(folder, joined({"sample", kAnalyzedMesh, "-o", file}, more)).status == 0);
}

nlohmann::json analysis(const TemporaryFolder& folder, const Arguments& arguments) {
    const Outcome outcome =
        run(folder, joined(joined({"analyze", kAnalyzedMesh}, arguments), {"--json", "-"}));
    INFO(outcome.err);
    REQUIRE(outcome.status == 0);
    return nlohmann::json::parse(outcome.out);
}

} // namespace

TEST_CASE("a set is what dart throwing gives") {
    const TemporaryFolder folder;
    make_set(folder, "a.ply", {"-d", "0.1"});
    const auto set = analysis(folder, {"a.ply"})["sets"][0];
    const auto verified =
        nlohmann::json::parse(run(folder, {"verify", kAnalyzedMesh, "a.ply", "--json", "-"}).out);
    CHECK(set["smallest"].get<double>() ==
          doctest::Approx(verified["smallest_ratio"].get<double>()).epsilon(1e-9));
    CHECK(set["rho"].get<double>() == doctest::Approx(verified["rho"].get<double>()));
    CHECK(set["mean_nearest"].get<double>() == doctest::Approx(1.09).epsilon(0.01));
    CHECK(set["uncovered"].get<double>() < 0.01);
    CHECK(set["largest_gap"].get<double>() > 1);
    CHECK(set["without_neighbor"] == 0);
    CHECK(set["components_without_samples"] == 0);
    const auto& g = set["pair_correlation"]["g"];
    CHECK(g.size() == 80);
    for (std::size_t bin = 0; bin < 20; ++bin) { // Up to the minimum distance.
        CHECK(g[bin] == 0);
    }
    CHECK(g[20].get<double>() > 2);
    // Half the darts leave more room.
    make_set(folder, "b.ply", {"-d", "0.1", "--pool-ratio", "5"});
    CHECK(analysis(folder, {"b.ply"})["sets"][0]["uncovered"].get<double>() >
          2 * set["uncovered"].get<double>());
}

TEST_CASE("several sets tell whether they are even") {
    const TemporaryFolder folder;
    Arguments files;
    for (int seed = 0; seed < 8; ++seed) {
        files.push_back(std::to_string(seed) + ".csv");
        make_set(folder, files.back(), {"-d", "0.12", "--seed", std::to_string(seed)});
    }
    const auto report = analysis(folder, files);
    CHECK(report["sets"].size() == 8);
    CHECK(report["evenness"]["sets"] == 8);
    CHECK(report["evenness"]["p"].get<double>() > 0.001);
    CHECK(report["evenness"]["dispersion"].get<double>() < 0.5); // They keep their distance.
    CHECK(report["number"]["deviation"].get<double>() > 0);

    // Each set without a tenth of its samples, all in one place.
    for (const std::string& file : files) {
        tools::SampleFile samples = tools::read_samples(folder / file);
        std::erase_if(samples.rows,
                      [](const tools::SampleRow& row) { return row.position[2] > 0.8; });
        tools::write_samples(folder / file, samples.header, samples.rows, false);
    }
    CHECK(analysis(folder, files)["evenness"]["p"].get<double>() < 1e-6);

    // Sets of other distances have no mean.
    make_set(folder, "other.csv", {"-d", "0.2"});
    const auto mixed = analysis(folder, {"0.csv", "other.csv"});
    CHECK(mixed["evenness"].is_null());
    CHECK(mixed["number"].is_null());
    const Outcome text = run(folder, {"analyze", kAnalyzedMesh, "0.csv", "other.csv"});
    CHECK(contains(text.out, "0.csv"));
    CHECK(contains(text.out, "other.csv"));
    CHECK_FALSE(contains(text.out, "on average"));
}

TEST_CASE("with a mask, only the faces that take samples count") {
    const TemporaryFolder folder;
    make_set(folder, "half.ply", {"-d", "0.1", "--mask", "z>0"});
    const auto masked = analysis(folder, {"half.ply", "--mask", "z>0"})["sets"][0];
    CHECK(masked["rho"].get<double>() == doctest::Approx(0.72).epsilon(0.02));
    CHECK(masked["uncovered"].get<double>() < 0.01);
    CHECK(masked["largest_gap"].get<double>() < 1.5);
    const auto whole = analysis(folder, {"half.ply"})["sets"][0];
    CHECK(whole["rho"].get<double>() < 0.6);
    CHECK(whole["uncovered"].get<double>() > 0.4);
    check_fails(folder, 3, "on faces that --mask left out, first sample",
                {"analyze", kAnalyzedMesh, "half.ply", "--mask", "z>0.5"});
    check_fails(folder, 2, "--only", {"analyze", kAnalyzedMesh, "half.ply", "--only", "part:x"});
}

TEST_CASE("what cannot be analyzed is told") {
    const TemporaryFolder folder;
    make_set(folder, "a.ply", {"-n", "50"});
    check_fails(folder, 2, "SAMPLES", {"analyze", kAnalyzedMesh});
    check_fails(folder, 2, "--probes", {"analyze", kAnalyzedMesh, "a.ply", "--probes", "0"});
    check_fails(folder, 2, "--probes", {"analyze", kAnalyzedMesh, "a.ply", "--probes", "1e8"});
    check_fails(folder, 2, "--seed", {"analyze", kAnalyzedMesh, "a.ply", "--seed", "x"});
    check_fails(folder, 2, "--radius", {"analyze", kAnalyzedMesh, "a.ply", "-r", "-1"});
    check_fails(folder, 2, "would replace", {"analyze", kAnalyzedMesh, "a.ply", "--json", "a.ply"});
    check_fails(folder, 3, "another mesh", {"analyze", "builtin:icosphere:4", "a.ply"});
    check_fails(folder, 3, "b.ply", {"analyze", kAnalyzedMesh, "a.ply", "b.ply"});
    folder.write("none.csv", "# min_distance: 0.1\nface_index,bary_u,bary_v,bary_w,x,y,z\n");
    check_fails(folder, 3, "no samples", {"analyze", kAnalyzedMesh, "none.csv"});
}

} // namespace geodisk::test
