// `geodisk box`: files, reports and what it refuses.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <sstream>

#include <nlohmann/json.hpp>

#include "cli/command.hpp"

namespace geodisk::test {
namespace {

using Arguments = std::vector<std::string>;

Arguments box(const std::string& output, const Arguments& options) {
    Arguments arguments{"box", "-o", output};
    arguments.insert(arguments.end(), options.begin(), options.end());
    return arguments;
}

std::string boxed(const TemporaryFolder& folder, const std::string& output,
                  const Arguments& options) {
    const Outcome outcome = run(folder, box(output, options));
    INFO(outcome.err);
    REQUIRE(outcome.status == 0);
    return bytes_of(folder / output);
}

/// The numbers of each line, comments and column names left out.
std::vector<std::vector<double>> rows_of(const std::string& bytes) {
    std::vector<std::vector<double>> rows;
    for (std::string line : lines_of(bytes)) {
        if (line.empty() || !(line[0] >= '0' && line[0] <= '9')) {
            continue;
        }
        std::replace(line.begin(), line.end(), ',', ' ');
        std::istringstream in(line);
        rows.emplace_back();
        for (double value = 0; in >> value;) {
            rows.back().push_back(value);
        }
    }
    return rows;
}

double distance(const std::vector<double>& a, const std::vector<double>& b,
                const std::vector<double>& sides, bool is_periodic) {
    double sum = 0;
    for (std::size_t i = 0; i < sides.size(); ++i) {
        const double d = std::abs(a[i] - b[i]);
        const double way = is_periodic ? std::min(d, sides[i] - d) : d;
        sum += way * way;
    }
    return std::sqrt(sum);
}

} // namespace

TEST_CASE("box: samples keep their distance in every dimension") {
    const TemporaryFolder folder;
    for (std::size_t n = 1; n <= 6; ++n) {
        for (const bool is_periodic : {false, true}) {
            CAPTURE(n);
            Arguments options{"--dim", std::to_string(n), "-d", "0.3", "--seed", "5"};
            if (is_periodic) {
                options.push_back("--periodic");
            }
            const auto rows = rows_of(boxed(folder, "a.csv", options));
            REQUIRE(rows.size() > 1);
            double smallest = 1e9;
            for (std::size_t i = 0; i < rows.size(); ++i) {
                REQUIRE(rows[i].size() == n);
                for (std::size_t k = 0; k < i; ++k) {
                    smallest = std::min(smallest, distance(rows[i], rows[k],
                                                           std::vector<double>(n, 1), is_periodic));
                }
            }
            CHECK(smallest >= 0.3);
            CHECK(smallest < 0.5);
        }
    }
}

TEST_CASE("box: verify takes the box from the file") {
    const TemporaryFolder folder;
    for (const std::string dimension : {"1", "2", "4", "6"}) {
        for (const std::string output : {"a.csv", "a.ply"}) {
            CAPTURE(output);
            boxed(folder, output, {"--dim", dimension, "-n", "300", "--periodic"});
            const Outcome outcome = run(folder, {"verify", output, "--json", "v.json"});
            INFO(outcome.err);
            CHECK(outcome.status == 0);
            CHECK(contains(outcome.out, ", periodic\n"));
            CHECK(contains(outcome.out, "violations    0\n"));
            const auto report = nlohmann::json::parse(bytes_of(folder / "v.json"));
            CHECK(report["smallest_ratio"] >= 1);
            CHECK(report["smallest_ratio"] < 1.1);
        }
    }
    CHECK(run(folder, {"verify", "a.ply", "--quiet"}).out.empty());
}

TEST_CASE("box: verify finds samples that are too close, across the sides too, or outside") {
    const TemporaryFolder folder;
    const auto file = [&](const std::string& sides, const std::string& rows) {
        folder.write("a.csv", "# box: 1 x 2\n# sides: " + sides + "\n# min_distance: 0.1\n" +
                                  "x,y\n" + rows);
        return run(folder, {"verify", "a.csv"});
    };
    const std::string corners = "0.01,0.5\n0.5,0.02\n0.98,0.5\n0.5,1.97\n";
    CHECK(file("open", corners).status == 0);
    const Outcome around = file("periodic", corners);
    CHECK(around.status == 1);
    CHECK(contains(around.out, "violations    2\n"));
    CHECK(contains(around.out, "samples 0 and 2: 0.03\n"));
    CHECK(contains(around.out, "samples 1 and 3: 0.05\n"));
    CHECK(contains(around.out, "too close     4 of 4 samples\n"));
    CHECK(contains(around.err, "2 pairs of samples are closer than 0.1"));
    CHECK(run(folder, {"verify", "a.csv", "-d", "0.02"}).status == 0);
    const Outcome outside = file("open", "0.5,0.5\n0.5,2.5\n");
    CHECK(outside.status == 1);
    CHECK(contains(outside.err, "1 sample lies outside the box"));
    CHECK(file("open", "0.5,0.5\n").status == 0);
    CHECK(file("open", "").status == 0);
}

TEST_CASE("box: verify explains what is no file of samples in a box") {
    const TemporaryFolder folder;
    const auto refuse = [&](const std::string& part, const std::string& text, int status = 3) {
        folder.write("a.csv", text);
        check_fails(folder, status, part, {"verify", "a.csv"});
    };
    const std::string rows = "x,y\n0.5,0.5\n";
    refuse("its header has no box", rows);
    refuse("not 1 to 6 positive sides", "# box: 1 x\n" + rows);
    refuse("not 1 to 6 positive sides", "# box: 1 x -1\n" + rows);
    refuse("has 2 coordinates, but its box has 3 sides", "# box: 1 x 1 x 1\n" + rows);
    refuse("open or periodic", "# box: 1 x 1\n" + rows);
    refuse("no minimum distance", "# box: 1 x 1\n# sides: open\n" + rows, 2);
    refuse("has no column y", "# box: 1 x 1\nx,z\n1,1\n");
    refuse("line 2: 'half' is not a number", "x,y\nhalf,1\n");
    folder.write("a.csv", "# box: 1 x 1\n# sides: open\n# min_distance: 1\n" + rows);
    check_fails(folder, 2, "options for surfaces", {"verify", "a.csv", "--lift", "normals:1"});
    check_fails(folder, 2, "a.csv", {"verify", "a.csv", "--json", "a.csv"});
    folder.write("a.xyz", "0.5 0.5 0\n");
    check_fails(folder, 3, "its header has no box", {"verify", "a.xyz"});
}

TEST_CASE("box: all formats hold the same samples") {
    const TemporaryFolder folder;
    const Arguments options{"--extents", "2,0.5", "-d", "0.1"};
    const std::string csv = boxed(folder, "a.csv", options);
    CHECK(contains(csv, "\nx,y\n"));
    for (const char* const line : {"# box: 2 x 0.5\n", "# sides: open\n", "# min_distance: 0.1\n",
                                   "# seed: 0\n", "# pool_size: ", "# device: "}) {
        CHECK(contains(csv, line));
    }
    const auto rows = rows_of(csv);
    const auto lines = rows_of(boxed(folder, "a.xyz", options));
    Arguments as_text = options;
    as_text.push_back("--ascii");
    const std::string ascii = boxed(folder, "b.ply", as_text);
    CHECK(contains(ascii, "property double x\nproperty double y\nproperty double z\n"
                          "end_header\n"));
    const auto text_rows = rows_of(ascii);
    const std::string binary = boxed(folder, "a.ply", options);
    const std::size_t header = binary.find("end_header\n") + 11;
    CHECK(binary.size() == header + rows.size() * 3 * 8);
    REQUIRE(lines.size() == rows.size());
    REQUIRE(text_rows.size() == rows.size());
    for (std::size_t i = 0; i < rows.size(); ++i) {
        CHECK(lines[i] == std::vector<double>{rows[i][0], rows[i][1], 0});
        CHECK(text_rows[i] == lines[i]);
    }
    CHECK(contains(boxed(folder, "c.csv", {"--dim", "5", "-n", "9"}), "\nx0,x1,x2,x3,x4\n"));
    CHECK(contains(boxed(folder, "c.ply", {"--dim", "4", "-n", "9"}),
                   "property double z\nproperty double x0\n"));
}

TEST_CASE("box: the count is about what was asked for, the seed repeats it") {
    const TemporaryFolder folder;
    const Arguments options{"--dim", "3", "--count", "1000", "--seed", "3"};
    const std::string first = boxed(folder, "a.csv", options);
    CHECK(std::abs(static_cast<double>(rows_of(first).size()) - 1000) < 50);
    CHECK(boxed(folder, "b.csv", options) == first);
    Arguments small = options;
    small.insert(small.end(), {"--memory", "1M"});
    CHECK(boxed(folder, "b.csv", small) == first);
    CHECK(boxed(folder, "b.csv", {"--dim", "3", "--count", "1000", "--seed", "4"}) != first);
}

TEST_CASE("box: darts until there are so many samples, or so many darts were thrown") {
    const TemporaryFolder folder;
    const auto darts = [&](const Arguments& options) {
        Arguments all{"--dim", "2", "-d", "0.02", "--method", "pdts", "--json", "a.json"};
        all.insert(all.end(), options.begin(), options.end());
        const Outcome outcome = run(folder, box("a.csv", all));
        CHECK(outcome.status == 0);
        CHECK(contains(outcome.out, "\ndarts         "));
        return std::pair{rows_of(bytes_of(folder / "a.csv")),
                         nlohmann::json::parse(bytes_of(folder / "a.json"))};
    };
    const auto [all, of_all] = darts({"--throws", "20000"});
    CHECK(of_all["method"] == "darts");
    CHECK(of_all["darts"] == 20000);
    CHECK(of_all["stopped_by"] == "darts");
    CHECK(of_all["pool_ratio"].is_null());
    CHECK(contains(bytes_of(folder / "a.csv"), "# darts: 20000\n"));
    const auto [some, of_some] = darts({"--count", "500"});
    CHECK(of_some["stopped_by"] == "count");
    REQUIRE(some.size() == 500);
    CHECK(some == std::vector(all.begin(), all.begin() + 500));
    CHECK(run(folder, {"verify", "a.csv"}).status == 0);
    check_fails(folder, 2, "only",
                box("b.csv", {"--dim", "1", "-d", "0.5", "--method", "pdts", "--count", "9"}));
    check_fails(folder, 2, "needs a number to stop at",
                box("b.csv", {"--dim", "2", "-d", "0.1", "--method", "pdts"}));
    check_fails(folder, 2, "--darts is for --method darts",
                box("b.csv", {"--dim", "2", "-d", "0.1", "--throws", "9"}));
}

TEST_CASE("box: reports for people and programs") {
    const TemporaryFolder folder;
    const Outcome outcome = run(folder, box("a.csv", {"--dim", "2", "-n", "500", "--periodic",
                                                      "--json", "a.json", "--validate"}));
    CHECK(outcome.status == 0);
    CHECK(outcome.err.empty());
    CHECK(contains(outcome.out, "box           1 x 1, periodic\n"));
    CHECK(contains(outcome.out, " of about 500 asked for, disks fill 4"));
    const auto report = nlohmann::json::parse(bytes_of(folder / "a.json"));
    CHECK(report["box"] ==
          nlohmann::json({{"dimension", 2}, {"extents", {1.0, 1.0}}, {"periodic", true}}));
    CHECK(report["candidates"] > 9500);
    CHECK(report["candidates"] < 10500);
    CHECK(report["samples"] == rows_of(bytes_of(folder / "a.csv")).size());
    CHECK(report["disks"] >= report["samples"]);
    CHECK(report["guard"] == 0x1p-20);
    const double distance = report["min_distance"];
    const double samples = report["samples"];
    CHECK(report["density"] ==
          doctest::Approx(samples * 3.14159265358979 * distance * distance / 4));
    const Outcome quiet = run(folder, box("a.csv", {"--dim", "1", "-n", "9", "--quiet"}));
    CHECK(quiet.out.empty());
}

TEST_CASE("box: what cannot be done is explained") {
    const TemporaryFolder folder;
    check_fails(folder, 2, "no box given; give --dim, --extents or both",
                box("a.csv", {"-n", "9"}));
    for (const char* const dimension : {"0", "7", "2.5", "two"}) {
        check_fails(folder, 2, "--dim", box("a.csv", {"-n", "9", "--dim", dimension}));
    }
    check_fails(folder, 2, "--dim 2 and the 3 sides of --extents contradict each other",
                box("a.csv", {"-n", "9", "--dim", "2", "--extents", "1,1,1"}));
    check_fails(folder, 2, "1 to 6 sides, not 7",
                box("a.csv", {"-n", "9", "--extents", "1,1,1,1,1,1,1"}));
    for (const char* const side : {"0", "-1", "nan", "inf", "wide"}) {
        check_fails(folder, 2, "not a positive, finite length",
                    box("a.csv", {"-n", "9", "--extents", std::string("1,") + side}));
    }
    check_fails(folder, 2, "no distance given", box("a.csv", {"--dim", "2"}));
    check_fails(folder, 2, "contradict", box("a.csv", {"--dim", "2", "-n", "9", "-d", "1"}));
    check_fails(folder, 2, "exceeds the shortest side of the periodic box, 1",
                box("a.csv", {"--dim", "2", "-d", "1.5", "--periodic"}));
    check_fails(folder, 2, "times as long", box("a.csv", {"--dim", "2", "-d", "1e-9"}));
    check_fails(folder, 2, "candidates", box("a.csv", {"--dim", "4", "-d", "1e-4"}));
    check_fails(folder, 2, "use .ply, .csv or .npz", box("a.xyz", {"--dim", "4", "-n", "9"}));
    check_fails(folder, 2, "unknown sample format", box("a.txt", {"--dim", "2", "-n", "9"}));
    check_fails(folder, 2, "would replace the samples",
                box("a.csv", {"--dim", "2", "-n", "9", "--json", "a.csv"}));
    check_fails(folder, 4, "", box("missing/a.csv", {"--dim", "2", "-n", "9"}));
    check_fails(folder, 5, "no-such-device",
                box("a.csv", {"--dim", "2", "-n", "9", "--device", "no-such-device"}));
    check_fails(folder, 6, "--memory", box("a.csv", {"--dim", "2", "-n", "9", "--memory", "1"}));
}

} // namespace geodisk::test
