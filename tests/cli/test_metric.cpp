// `geodisk sample --metric`: distances that do not go along the surface say so.
#include <doctest/doctest.h>

#include <nlohmann/json.hpp>

#include "cli/command.hpp"

namespace geodisk::test {

TEST_CASE("metric: straight-line samples are never presented as exact") {
    const TemporaryFolder folder;
    const Outcome outcome =
        run(folder, {"sample", "builtin:folded-sheet", "-n", "300", "-o", "a.csv", "--metric",
                     "euclidean", "--json", "a.json", "--validate"});
    INFO(outcome.err);
    REQUIRE(outcome.status == 0);
    CHECK(contains(outcome.out, "in mesh units, euclidean, not exact along the surface\n"));
    CHECK(contains(bytes_of(folder / "a.csv"),
                   "\n# metric: euclidean, not exact along the surface\n"));
    const auto report = nlohmann::json::parse(bytes_of(folder / "a.json"));
    CHECK(report["metric"] == "euclidean, not exact along the surface");
    // Straight lines are never longer than the way along the surface.
    CHECK(run(folder, {"verify", "builtin:folded-sheet", "a.csv"}).status == 0);

    const Outcome exact = run(folder, {"sample", "builtin:folded-sheet", "-n", "300", "-o", "b.csv",
                                       "--metric", "geodesic", "--json", "b.json"});
    REQUIRE(exact.status == 0);
    CHECK_FALSE(contains(exact.out, "not exact"));
    CHECK_FALSE(contains(bytes_of(folder / "b.csv"), "metric"));
    const auto geodesic = nlohmann::json::parse(bytes_of(folder / "b.json"));
    CHECK(geodesic["metric"] == "geodesic");
    CHECK(geodesic["samples"] > report["samples"]);
}

TEST_CASE("metric: the closed form says that it approximates") {
    const TemporaryFolder folder;
    const Outcome outcome = run(folder, {"sample", "builtin:torus-knot", "-n", "200", "-o", "a.ply",
                                         "--metric", "approximate", "--validate"});
    INFO(outcome.err);
    REQUIRE(outcome.status == 0);
    CHECK(contains(outcome.out, ", approximate, not exact along the surface\n"));
    CHECK(contains(bytes_of(folder / "a.ply"),
                   "\ncomment metric: approximate, not exact along the surface\n"));
}

TEST_CASE("metric: what has no straight lines is refused") {
    const TemporaryFolder folder;
    const auto sample = [](const std::vector<std::string>& options) {
        std::vector<std::string> arguments{"sample", "-n", "9", "-o", "a.ply"};
        arguments.insert(arguments.end(), options.begin(), options.end());
        return arguments;
    };
    check_fails(folder, 2, "'manhattan' is none of geodesic, euclidean and approximate",
                sample({"builtin:cube", "--metric", "manhattan"}));
    check_fails(folder, 2, "takes no --lift",
                sample({"builtin:cube", "--metric", "euclidean", "--lift", "normals:1"}));
    check_fails(folder, 2, "needs three coordinates per vertex; the mesh has 4",
                sample({"builtin:clifford-torus", "--metric", "euclidean"}));
}

} // namespace geodisk::test
