// `geodisk report` writes one file that has everything, and nothing of others in it.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <csignal>
#include <filesystem>
#include <regex>
#include <string>

#include <nlohmann/json.hpp>

#include "cli/command.hpp"
#include "cli/page_file.hpp"
#include "files/samples/sample_file.hpp"

namespace geodisk::test {
namespace {

using OrderedJson = nlohmann::ordered_json;

constexpr const char* kPageMesh = "builtin:torus-knot:8";

PageFile page(const TemporaryFolder& folder, const Arguments& arguments) {
    const Outcome outcome =
        run(folder, joined({"report"}, joined(arguments, {"-o", "p.html", "-q"})));
    INFO(outcome.err);
    REQUIRE(outcome.status == 0);
    REQUIRE(outcome.out.empty());
    return read_page(folder / "p.html");
}

double sum_of(const std::vector<double>& numbers) {
    double sum = 0;
    for (const double number : numbers) {
        sum += number;
    }
    return sum;
}

/// Checks that the page itself fetches nothing; three.js names places that it never asks for.
void check_fetches_nothing(const PageFile& page) {
    CHECK(contains(page.text, "default-src 'none'"));
    const std::regex fetch(R"((src|href)\s*=\s*["']?(?!data:)[a-z]+:)", std::regex::icase);
    const std::string head = page.text.substr(0, page.text.find("id=\"facts\""));
    CHECK_FALSE(std::regex_search(head, fetch));
    const std::size_t own = page.text.rfind("\"use strict\";");
    REQUIRE(own != std::string::npos);
    // The name of SVG is no address.
    const std::string script =
        std::regex_replace(page.text.substr(own), std::regex("\"http://www.w3.org/2000/svg\""), "");
    for (const char* const call : {"fetch(", "XMLHttpRequest", "import", "http:", "https:"}) {
        CAPTURE(call);
        CHECK_FALSE(contains(script, call));
    }
}

/// Arrays that belong together are of one length, and name what there is.
void check_arrays(const PageFile& page, std::size_t triangles) {
    const auto& arrays = page.arrays;
    const auto samples = page.facts["samples"].get<std::size_t>();
    CHECK(arrays.at("sample_faces").size() == samples);
    CHECK(arrays.at("sample_weights").size() == 2 * samples);
    CHECK(arrays.at("sample_neighbors").size() == samples);
    CHECK(arrays.at("sample_distances").size() == samples);
    const std::size_t points = arrays.at("positions").size() / 3;
    CHECK(arrays.at("normals").size() == 2 * points);
    const std::vector<double>& corners = arrays.at("corners");
    CHECK(corners.size() == 3 * triangles);
    CHECK(*std::max_element(corners.begin(), corners.end()) + 1 == points);
    CHECK(arrays.at("face_frames").size() == 3 * triangles);
    CHECK(arrays.at("face_bases").size() == triangles);
    double cells = 0;
    for (std::size_t f = 0; f < triangles; ++f) {
        cells += arrays.at("face_columns")[f] * arrays.at("face_rows")[f];
    }
    CHECK(arrays.at("cell_windows").size() == static_cast<std::size_t>(cells));
    const auto windows = static_cast<std::size_t>(sum_of(arrays.at("cell_windows")));
    CHECK(page.facts["view"]["windows"] == windows);
    for (const char* const name : {"window_x", "window_y", "window_sigmas", "window_left",
                                   "window_right", "window_samples"}) {
        CAPTURE(name);
        CHECK(arrays.at(name).size() == windows);
    }
}

} // namespace

TEST_CASE("a page has the samples that `sample` writes, and what `analyze` tells of them") {
    const TemporaryFolder folder;
    const Arguments asked = {kPageMesh, "-n", "400", "--seed", "18446744073709551615"};
    const PageFile found = page(folder, asked);
    REQUIRE(run(folder, joined({"sample", "-o", "a.ply", "-q"}, asked)).status == 0);
    const tools::SampleFile file = tools::read_samples(folder / "a.ply");
    REQUIRE(found.facts["samples"] == file.rows.size());
    for (std::size_t i = 0; i < file.rows.size(); ++i) {
        CHECK(found.arrays.at("sample_faces")[i] == file.rows[i].face);
        CHECK(found.arrays.at("sample_weights")[2 * i] == file.rows[i].bary[1]);
        CHECK(found.arrays.at("sample_weights")[2 * i + 1] == file.rows[i].bary[2]);
    }
    CHECK(found.facts["seed"] == "18446744073709551615"); // JavaScript would round the number.
    const Outcome analyzed = run(folder, {"analyze", kPageMesh, "a.ply", "--json", "-", "-q"});
    REQUIRE(analyzed.status == 0);
    OrderedJson set = OrderedJson::parse(analyzed.out)["sets"][0];
    set.erase("samples_file");
    CHECK(found.facts["analysis"] == set);
    // The nearest of all are as far apart as the smallest distance.
    const std::vector<double>& distances = found.arrays.at("sample_distances");
    const double distance = found.facts["min_distance"];
    CHECK(*std::min_element(distances.begin(), distances.end()) / distance ==
          doctest::Approx(set["smallest"].get<double>()).epsilon(1e-6));
    CHECK(sum_of(distances) / distance / static_cast<double>(distances.size()) ==
          doctest::Approx(set["mean_nearest"].get<double>()).epsilon(1e-6));
    check_arrays(found, found.facts["mesh"]["triangles"].get<std::size_t>());
    check_fetches_nothing(found);
    CHECK(contains(found.text, "under the MIT License"));
    CHECK(contains(found.text, "three.js authors"));
}

TEST_CASE("a page tells the command that makes it again") {
    const TemporaryFolder folder;
    const PageFile found = page(folder, {kPageMesh, "-n", "100", "--view", "top"});
    CHECK(found.facts["command"] ==
          "geodisk report " + std::string(kPageMesh) + " -n 100 --view top -o p.html -q");
    CHECK(found.facts["view"]["from"].size() == 1);
    const OrderedJson& view = found.facts["view"];
    CHECK(view["from"][0][2].get<double>() == doctest::Approx(1).epsilon(1e-4));
    CHECK(view["up"] == OrderedJson({0.0, 0.0, 1.0}));
    CHECK(found.facts["commit"].is_string());
    CHECK(found.facts["seconds"].contains("measure"));
    CHECK(found.facts["seconds"]["other"].get<double>() >= 0);
    CHECK_FALSE(found.facts["seconds"].contains("spectrum"));
    CHECK(found.facts["spectrum"].is_null());
    CHECK(found.facts["device"]["name"].is_string());
}

TEST_CASE("names that look like parts of a page stay names") {
    const TemporaryFolder folder;
    for (const std::string name : {"</script><!--\"'&.ply", "a\xff\n.ply", "сетка 網.ply"}) {
        std::string file = name;
        std::replace(file.begin(), file.end(), '/', '|');
        CAPTURE(file);
        REQUIRE(run(folder, {"shapes", "cube", "-o", file}).status == 0);
        const PageFile found = page(folder, {file, "-n", "50"});
        CHECK(found.facts["mesh"]["path"].is_string());
        CHECK(found.arrays.count("window_samples") == 1);
        if (file.find('\xff') != std::string::npos) {
            CHECK(contains(found.facts["command"].get<std::string>(), "$'a\\xff\\x0a.ply'"));
        } else {
            CHECK(found.facts["mesh"]["path"] == file);
        }
    }
}

TEST_CASE("a page has a spectrum where one is asked for") {
    const TemporaryFolder folder;
    const PageFile file = page(folder, {"builtin:icosphere:3", "-d", "0.4", "--harmonics", "60"});
    const auto& spectrum = file.facts["spectrum"];
    CHECK(spectrum["harmonics"] == 60);
    CHECK(spectrum["expected"].get<double>() == doctest::Approx(3.01).epsilon(0.01));
    CHECK(spectrum["frequency"].size() >= 3);
    CHECK(spectrum["power"].size() == spectrum["frequency"].size());
    CHECK(spectrum["anisotropy"].size() == spectrum["frequency"].size());
    check_fails(folder, 2, "--harmonics",
                {"report", "builtin:cube", "-d", "0.4", "-o", "q.html", "--harmonics", "9"});
    check_fails(folder, 2, "do not vary",
                {"report", "builtin:icosphere:3", "-d", "0.4", "-o", "q.html", "--harmonics", "9",
                 "--density", "curvature"});
    CHECK_FALSE(std::filesystem::exists(folder / "q.html"));
}

TEST_CASE("ten thousand samples on a large mesh stay below 10 MB") {
    const TemporaryFolder folder;
    const PageFile found = page(folder, {"builtin:showpiece:135", "-n", "10000"});
    CHECK(found.facts["mesh"]["triangles"].get<int>() > 70000);
    CHECK(found.facts["samples"].get<int>() > 9500);
    CHECK(found.facts["view"]["left_out"].empty());
    CHECK(found.text.size() < 10e6);
}

TEST_CASE("surfaces of every kind have a page") {
    const TemporaryFolder folder;
    for (const std::string mesh :
         {"builtin:cube", "builtin:moebius:4", "builtin:clifford-torus:16", "builtin:spike"}) {
        CAPTURE(mesh);
        const PageFile found = page(folder, {mesh, "-n", "100"});
        check_arrays(found, found.facts["mesh"]["triangles"].get<std::size_t>());
    }
    CHECK(page(folder, {"builtin:terrain:12", "-n", "50"}).facts["view"]["up"] ==
          OrderedJson({0.0, 0.0, 1.0}));
    CHECK(page(folder, {"builtin:terrain:12", "-n", "50", "--up", "x"}).facts["view"]["up"] ==
          OrderedJson({1.0, 0.0, 0.0}));
}

TEST_CASE("radii that vary are each sample's own") {
    const TemporaryFolder folder;
    const PageFile found =
        page(folder, {"builtin:showpiece:60", "-n", "300", "--density", "curvature"});
    const std::vector<double>& radii = found.arrays.at("sample_radii");
    REQUIRE(radii.size() == found.facts["samples"]);
    const auto [least, most] = std::minmax_element(radii.begin(), radii.end());
    CHECK(*least == doctest::Approx(found.facts["sample_radii"]["least"].get<double>()));
    CHECK(*most == doctest::Approx(found.facts["sample_radii"]["most"].get<double>()));
    CHECK(found.facts["analysis"]["pair_correlation"].is_null());
    CHECK(page(folder, {kPageMesh, "-n", "50"}).arrays.at("sample_radii").size() == 1);
}

TEST_CASE("lengths alone leave nothing to look at, and the page says so") {
    const TemporaryFolder folder;
    folder.write("bare.obj", "f 1 2 3\n");
    folder.write("lengths.txt", "1 2 3\n2 3 4\n1 3 5.5\n");
    const PageFile found =
        page(folder, {"bare.obj", "--edge-lengths", "lengths.txt", "--min-distance", "0.3"});
    CHECK(found.facts["view"]["surface"] == false);
    REQUIRE(found.facts["view"]["left_out"].size() == 1);
    CHECK(contains(found.facts["view"]["left_out"][0].get<std::string>(), "without coordinates"));
    CHECK(found.arrays.count("positions") == 0);
    CHECK(found.arrays.at("sample_faces").size() == found.facts["samples"]);
}

TEST_CASE("the report and the summary of a page") {
    const TemporaryFolder folder;
    const Outcome outcome =
        run(folder, {"report", kPageMesh, "-n", "100", "-o", "p.htm", "--json", "a.json"});
    REQUIRE(outcome.status == 0);
    CHECK(contains(outcome.out, "file          p.htm\n"));
    CHECK(contains(outcome.out, "nearest       1.0"));
    CHECK(contains(outcome.out, "room for more "));
    const OrderedJson report = OrderedJson::parse(bytes_of(folder / "a.json"));
    CHECK(report["seconds"].contains("write"));
    CHECK(report["seconds"].contains("disks"));
    CHECK(report["output"] == "p.htm");
    CHECK(report["analysis"]["samples"] == report["samples"]);
}

TEST_CASE("what cannot be a page is told, and leaves none") {
    const TemporaryFolder folder;
    const Arguments good = {"report", kPageMesh, "-n", "50", "-o", "p.html"};
    check_fails(folder, 2, "*.html", {"report", kPageMesh, "-n", "50", "-o", "p.pdf"});
    check_fails(folder, 2, "--output is required", {"report", kPageMesh, "-n", "50"});
    check_fails(folder, 2, "--min-distance", {"report", kPageMesh, "-o", "p.html"});
    check_fails(folder, 2, "--view", joined(good, {"--view", "sideways"}));
    check_fails(folder, 2, "--up", joined(good, {"--up", "north"}));
    check_fails(folder, 2, "--probes", joined(good, {"--probes", "1e8"}));
    check_fails(folder, 2, "would replace", joined(good, {"--json", "p.html"}));
    check_fails(folder, 3, "nowhere.ply", {"report", "nowhere.ply", "-n", "50", "-o", "p.html"});
    check_fails(folder, 4, "nowhere", {"report", kPageMesh, "-n", "50", "-o", "nowhere/p.html"});
    check_fails(folder, 5, "nowhere", joined(good, {"--device", "nowhere"}));
    Setting full;
    full.file_size_limit = 500000;
    check_fails(folder, 4, "p.html", good, full);
}

TEST_CASE("an interrupt while distances are measured leaves no page") {
    if (!terminals_work()) {
        MESSAGE("skipped: this system has no terminals, as where devpts is not mounted");
        return;
    }
    const TemporaryFolder folder;
    Setting setting;
    setting.has_terminal = true;
    setting.signal_at = "measuring distances  [";
    setting.signal = SIGINT;
    // So many that there is a bar on any machine, as there is after half a second.
    const Outcome outcome = run(
        folder, {"report", "builtin:icosphere:5", "-n", "30000", "--probes", "1e7", "-o", "p.html"},
        setting);
    CHECK(outcome.status == 130);
    CHECK(files_in(folder).empty());
}

} // namespace geodisk::test
