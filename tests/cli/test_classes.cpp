// Classes of samples, made and verified.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "cli/command.hpp"
#include "cli/json_file.hpp"
#include "cli/page_file.hpp"
#include "cli/png_image.hpp"
#include "files/output/output_file.hpp"
#include "files/samples/sample_file.hpp"
#include "program/exact_text.hpp"

namespace geodisk::test {
namespace {

constexpr const char* kClassesMesh = "builtin:torus-knot:8";

} // namespace

TEST_CASE("places of one class") {
    const TemporaryFolder folder;
    const std::vector<std::string> where{"--class-mask", "0:z>0",         "--class-density",
                                         "1:file:d.txt", "--class-avoid", "2:p.csv:30%"};
    std::ofstream density(folder / "d.txt");
    for (int v = 0; v < 26; ++v) {
        density << v % 2 << '\n';
    }
    density.close();
    std::ofstream(folder / "p.csv") << "x,y,z\n0.5,0.5,0.5\n";
    const auto with = [&](std::vector<std::string> words, const std::vector<std::string>& more) {
        words.insert(words.end(), more.begin(), more.end());
        return run(folder, words);
    };
    const Outcome made =
        with({"sample", "builtin:cube:2", "-o", "a.csv", "-d", "5%", "--classes", "3"}, where);
    INFO(made.out, made.err);
    REQUIRE(made.status == 0);
    const tools::SampleFile samples = tools::read_samples(folder / "a.csv");
    const auto classes = samples.extra_values("class");
    for (std::size_t i = 0; i < classes.size(); ++i) {
        const double* const at = samples.rows[i].position;
        CHECK((classes[i] != 0 || at[2] >= 0));
        CHECK((classes[i] != 2 || std::hypot(at[0] - 0.5, at[1] - 0.5, at[2] - 0.5) > 0.3));
    }
    CHECK(std::ranges::count(classes, 1u) > 0);
    CHECK(*samples.header.find("class_avoid") == "2:p.csv:30%");
    CHECK(with({"verify", "builtin:cube:2", "a.csv"}, where).status == 0);
    const Outcome others = run(folder, {"verify", "builtin:cube:2", "a.csv", "--class-mask",
                                        "0:z<0", "--class-avoid", "1:p.csv:30%"});
    CHECK(others.status == 1);
    CHECK(contains(others.err, "that --class-mask left out"));
    CHECK(contains(others.err, "within the radius of a point or line to avoid"));
    REQUIRE(run(folder, {"sample", "builtin:cube:2", "-o", "plain.csv", "-d", "20%"}).status == 0);
    CHECK(contains(
        run(folder, {"verify", "builtin:cube:2", "plain.csv", "--class-mask", "0:z<0"}).err,
        "plain.csv: has no column class, so options of single classes check nothing"));
    CHECK(contains(run(folder, {"verify", "builtin:cube:2", "a.csv", "--class-mask", "5:z<0"}).err,
                   "a.csv: has 3 classes, numbered from 0, so there is no class 5"));
    CHECK(contains(run(folder, {"sample", "builtin:cube:2", "-o", "b.csv", "-d", "9%", "--classes",
                                "2", "--class-mask", "0:z>0", "--mask", "z<0"})
                       .err,
                   "warning: builtin:cube:2: class 0 has no sample"));
    // A line of a batch takes the place of what is given for all.
    std::ofstream(folder / "list.txt") << "builtin:cube:2 --class-mask 1:z<0 -o one\n";
    const Outcome batch =
        run(folder, {"batch", "list.txt", "-o", "out", "-d", "5%", "--classes", "2", "--class-mask",
                     "0:z>0", "--class-avoid", "1:p.csv:30%"});
    INFO(batch.err);
    REQUIRE(batch.status == 0);
    const tools::SampleFile one = tools::read_samples(folder / "out/one.ply");
    CHECK(*one.header.find("class_mask") == "1:z<0");
    CHECK(*one.header.find("class_avoid") == "1:p.csv:30%");

    struct Wrong {
        std::vector<std::string> words;
        const char* message;
    };
    for (const Wrong& wrong : std::vector<Wrong>{
             {{"--class-mask", "3:z>0"}, "there is no class 3; --classes has 3, numbered from 0"},
             {{"--class-mask", "z>0"}, "'z>0' does not begin with a class from 0 to 7 and a colon"},
             {{"--class-mask", "0:z"}, "--class-mask: 'z' is not PROPERTY<VALUE"},
             {{"--class-mask", "0:z>2"}, "has no face for class 0 by --class-mask"},
             {{"--class-avoid", "0:border"}, "--class-avoid: 'border' is not POINTS:RADIUS"},
             {{"--class-avoid", "7:p.csv:1"}, "there is no class 7"},
             {{"--class-density", "0:nope"}, "has no attribute 'nope'"},
             {{"--class-density", "0:file:d.txt", "--class-density", "0:curvature"},
              "--class-density is given twice for class 0"}}) {
        const Outcome outcome = with(
            {"sample", "builtin:cube:2", "-o", "b.csv", "-d", "5%", "--classes", "3"}, wrong.words);
        INFO(outcome.err);
        CHECK(outcome.status != 0);
        CHECK(contains(outcome.err, wrong.message));
    }
    CHECK(contains(run(folder, {"sample", "builtin:cube:2", "-o", "b.csv", "-d", "5%",
                                "--class-density", "0:curvature"})
                       .err,
                   "--class-density is for classes, two or more; add --classes"));
}

TEST_CASE("classes by number") {
    const TemporaryFolder folder;
    const Outcome made = run(folder, {"sample", kClassesMesh, "-o", "a.ply", "-d", "5%",
                                      "--classes", "3", "--json", "a.json"});
    INFO(made.out, made.err);
    REQUIRE(made.status == 0);
    const Json classes = json_in(folder, "a.json")["classes"];
    CHECK(classes["samples"].size() == 3);
    CHECK(classes["distances"][0][1].get<double>() ==
          doctest::Approx(classes["distances"][0][0].get<double>() / std::sqrt(3)));
    const tools::SampleFile samples = tools::read_samples(folder / "a.ply");
    const auto column = samples.extra_values("class");
    REQUIRE(column.size() == samples.rows.size());
    CHECK(classes["samples"][2] == std::ranges::count(column, 2u));
    CHECK(*samples.header.find("classes") == "3");
    const Outcome verified = run(folder, {"verify", kClassesMesh, "a.ply"});
    INFO(verified.out, verified.err);
    CHECK(verified.status == 0);
    CHECK(contains(verified.out, "of the distance of two classes"));
    // All together are denser than one class.
    CHECK(run(folder, {"verify", kClassesMesh, "a.ply", "-d", "5%"}).status == 1);
    CHECK(run(folder, {"verify", kClassesMesh, "a.ply", "-d", "2.8%"}).status == 0);

    // One class is no other than none.
    REQUIRE(run(folder, {"sample", kClassesMesh, "-o", "one.csv", "-d", "5%", "--classes", "1"})
                .status == 0);
    REQUIRE(run(folder, {"sample", kClassesMesh, "-o", "none.csv", "-d", "5%"}).status == 0);
    const tools::SampleFile one = tools::read_samples(folder / "one.csv");
    const tools::SampleFile none = tools::read_samples(folder / "none.csv");
    CHECK(std::ranges::equal(one.rows, none.rows, {}, &tools::SampleRow::face,
                             &tools::SampleRow::face));
    CHECK(std::ranges::count(one.extra_values("class"), 0u) ==
          static_cast<std::ptrdiff_t>(one.rows.size()));
    CHECK(run(folder, {"verify", kClassesMesh, "one.csv"}).status == 0);
}

TEST_CASE("classes by a table, in a file too, and with existing samples") {
    const TemporaryFolder folder;
    std::ofstream(folder / "table.csv") << "# trees and shrubs\n0.4, 0.2\n0.2; 0.15\n";
    REQUIRE(run(folder, {"sample", kClassesMesh, "-o", "a.csv", "--classes", "table.csv"}).status ==
            0);
    REQUIRE(run(folder, {"sample", kClassesMesh, "-o", "b.csv", "--classes", "0.4,0.2;0.2,0.15"})
                .status == 0);
    CHECK(bytes_of(folder / "a.csv") == bytes_of(folder / "b.csv"));
    CHECK(run(folder, {"verify", kClassesMesh, "a.csv"}).status == 0);
    const Outcome closer =
        run(folder, {"verify", kClassesMesh, "a.csv", "--classes", "0.4,0.3;0.3,0.15"});
    CHECK(closer.status == 1);
    CHECK(contains(closer.err, "closer than the distance of their classes"));

    const Outcome more = run(folder, {"sample", kClassesMesh, "-o", "c.ply", "--classes",
                                      "table.csv", "--existing", "a.csv", "--seed", "5"});
    INFO(more.out, more.err);
    CHECK(more.status == 0);
    CHECK(run(folder, {"verify", kClassesMesh, "c.ply"}).status == 0);
    REQUIRE(run(folder, {"sample", kClassesMesh, "-o", "plain.ply", "-d", "1"}).status == 0);
    const Outcome classless = run(folder, {"sample", kClassesMesh, "-o", "d.ply", "--classes",
                                           "table.csv", "--existing", "plain.ply"});
    CHECK(classless.status == 0);
    CHECK(contains(classless.err, "has no column class; its samples get class 0"));
    CHECK(run(folder, {"verify", kClassesMesh, "d.ply"}).status == 0);
    CHECK(contains(run(folder, {"verify", kClassesMesh, "plain.ply", "--classes", "table.csv"}).err,
                   "has no column class"));
}

TEST_CASE("each class has its own radius, disks and statistics") {
    const TemporaryFolder folder;
    const std::string mesh = "builtin:terrain:20";
    const Outcome made = run(folder, {"sample", mesh, "-o", "a.csv", "--classes",
                                      "0.3,0.22;0.22,0.12", "--picture", "a.png", "--legend"});
    INFO(made.out, made.err);
    REQUIRE(made.status == 0);
    const tools::SampleFile samples = tools::read_samples(folder / "a.csv");
    const auto classes = samples.extra_values("class");
    REQUIRE(classes.size() == samples.rows.size());
    for (std::size_t i = 0; i < classes.size(); ++i) {
        CHECK(samples.rows[i].radius == doctest::Approx(classes[i] == 0 ? 0.15 : 0.06));
    }

    REQUIRE(run(folder, {"render", mesh, "a.csv", "-o", "b.png", "--legend"}).status == 0);
    CHECK(bytes_of(folder / "a.png") == bytes_of(folder / "b.png"));
    // Two disks of one class do not overlap, which would be orange, and those of both classes have
    // their own colours.
    const PngImage image = read_png(folder / "a.png");
    const auto count_if = [&](auto is) { return std::ranges::count_if(image.pixels, is); };
    CHECK(count_if([](Pixel p) { return p.red > p.green + 60 && p.green > p.blue + 40; }) == 0);
    CHECK(count_if([](Pixel p) { return p.blue > p.green + 20 && p.green > p.red + 20; }) > 1000);
    CHECK(count_if([](Pixel p) { return p.green > p.blue + 20 && p.blue > p.red + 20; }) > 1000);

    // Files of before have no radii, but classes.
    std::ofstream plain(folder / "plain.csv");
    for (const std::string& line : lines_of(bytes_of(folder / "a.csv"))) {
        if (line.starts_with('#')) {
            plain << line << '\n';
            continue;
        }
        // The columns end with radius and class.
        const std::size_t last = line.rfind(','), before = line.rfind(',', last - 1);
        plain << line.substr(0, before) << line.substr(last) << '\n';
    }
    plain.close();
    REQUIRE(run(folder, {"render", mesh, "plain.csv", "-o", "c.png", "--legend"}).status == 0);
    CHECK(bytes_of(folder / "a.png") == bytes_of(folder / "c.png"));
    CHECK(run(folder, {"verify", mesh, "plain.csv"}).status == 0);

    const Outcome analyzed = run(folder, {"analyze", mesh, "a.csv", "--json", "a.json"});
    INFO(analyzed.out, analyzed.err);
    REQUIRE(analyzed.status == 0);
    CHECK(contains(analyzed.out, "class 1"));
    const Json set = json_in(folder, "a.json")["sets"][0];
    CHECK(set["smallest"] >= 1.0);
    CHECK(set["rho"] < 0.75);
    REQUIRE(set["classes"].size() == 2);
    for (std::uint32_t number = 0; number < 2; ++number) {
        const Json& own = set["classes"][number];
        CHECK(own["samples"] == std::ranges::count(classes, number));
        CHECK(own["min_distance"] == doctest::Approx(number == 0 ? 0.3 : 0.12));
        CHECK(own["smallest"] >= 1.0);
        CHECK(own["rho"] > 0.3);
        CHECK(own["uncovered"] <= set["uncovered"]);
    }

    // A radius other than that of the class is wrong.
    std::string text = bytes_of(folder / "a.csv");
    const std::string radius = ",0.15,0\n";
    REQUIRE(contains(text, radius));
    text.replace(text.find(radius), radius.size(), ",0.16,0\n");
    std::ofstream(folder / "wrong.csv") << text;
    const Outcome wrong = run(folder, {"verify", mesh, "wrong.csv"});
    CHECK(wrong.status == 1);
    CHECK(contains(wrong.out, "wrong radii   1\n"));
    std::ofstream(folder / "none.csv") << "# min_distance: 0.3\n# classes: 2\nx,y,z\n0,0,0\n";
    for (const char* const command : {"render", "analyze"}) {
        const Arguments out =
            command == std::string("render") ? Arguments{"-o", "d.png"} : Arguments{};
        CHECK(contains(
            run(folder, joined({command, "builtin:cube", "none.csv", "--tolerance", "2"}, out)).err,
            "has no column class"));
    }
}

TEST_CASE("a page has the figures of each class") {
    const TemporaryFolder folder;
    const Outcome page =
        run(folder, {"report", "builtin:cube:4", "--classes", "0.5,0.3;0.3,0.2", "-o", "a.html"});
    INFO(page.err);
    if (contains(page.err, "three.js")) {
        return; // This program makes no pages.
    }
    REQUIRE(page.status == 0);
    const PageFile found = read_page(folder / "a.html");
    const auto& classes = found.facts["analysis"]["classes"];
    REQUIRE(classes.size() == 2);
    const std::vector<double>& kinds = found.arrays.at("sample_kinds");
    CHECK(classes[0]["samples"] == std::ranges::count(kinds, 1.0));
    CHECK(classes[1]["samples"] == std::ranges::count(kinds, 2.0));
    CHECK(found.facts["view"]["class_colors"].size() == 2);
    CHECK(found.facts["analysis"]["smallest"] >= 1.0);
}

TEST_CASE("a line of a batch has classes of its own") {
    const TemporaryFolder folder;
    std::ofstream(folder / "table.csv") << "0.5,0.3\n0.3,0.5\n";
    std::ofstream(folder / "list.txt") << "builtin:cube:4 --classes 2 -o a.ply\n"
                                          "builtin:cube:4 --classes table.csv -o b.ply\n"
                                          "builtin:cube:4 --features 30 -o c.ply\n";
    const Outcome made = run(folder, {"batch", "list.txt", "-o", "out", "-d", "10%"});
    INFO(made.out, made.err);
    REQUIRE(made.status == 0);
    CHECK(*tools::read_samples(folder / "out/b.ply").header.find("min_distance") == "0.5");
    for (const std::string name : {"out/a.ply", "out/b.ply", "out/c.ply"}) {
        CHECK(run(folder, {"verify", "builtin:cube:4", name}).status == 0);
    }
}

TEST_CASE("a count scales the table of classes") {
    const TemporaryFolder folder;
    for (const Arguments& exact : {Arguments{}, Arguments{"--exact"}}) {
        REQUIRE(run(folder, joined({"sample", kClassesMesh, "-o", "a.csv", "--classes", "4,2;2,1",
                                    "-n", "300"},
                                   exact))
                    .status == 0);
        const tools::SampleFile samples = tools::read_samples(folder / "a.csv");
        CHECK(std::abs(static_cast<double>(samples.rows.size()) - 300) <= (exact.empty() ? 15 : 0));
        const double distance = tools::parse_real(*samples.header.find("min_distance")).value();
        CHECK(*samples.header.find("classes") ==
              tools::exact_text(distance) + ',' + tools::exact_text(distance / 2) + ';' +
                  tools::exact_text(distance / 2) + ',' + tools::exact_text(distance / 4));
        CHECK(run(folder, {"verify", kClassesMesh, "a.csv"}).status == 0);
    }
}

TEST_CASE("two classes may keep no distance from each other") {
    const TemporaryFolder folder;
    REQUIRE(run(folder, {"sample", kClassesMesh, "-o", "a.ply", "-n", "400", "--classes",
                         "1,0,0.5;0,1,0.5;0.5,0.5,1"})
                .status == 0);
    const Outcome verified = run(folder, {"verify", kClassesMesh, "a.ply"});
    INFO(verified.out);
    CHECK(verified.status == 0);
    const Outcome analyzed = run(folder, {"analyze", kClassesMesh, "a.ply"});
    INFO(analyzed.err);
    CHECK(analyzed.status == 0);
    CHECK(contains(analyzed.out, "smallest"));
    // As if there were a rule, some are too close.
    CHECK(run(folder, {"verify", kClassesMesh, "a.ply", "--classes", "1,1,1;1,1,1;1,1,1"}).status ==
          1);
}

TEST_CASE("each class has as many samples as asked for") {
    const TemporaryFolder folder;
    // A table with -0 is read again.
    REQUIRE(run(folder, {"sample", kClassesMesh, "-o", "zero.csv", "--classes", "0.5,-0;-0,0.5"})
                .status == 0);
    CHECK(run(folder, {"verify", kClassesMesh, "zero.csv"}).status == 0);
    const Arguments darts{"--classes", "0.5,0.4;0.4,0.3", "--method", "darts"};
    const auto sampled = [&](const char* file, const Arguments& options) {
        return run(folder, joined(joined({"sample", kClassesMesh, "-o", file}, darts), options));
    };
    const Outcome few = sampled("few.csv", {"-n", "3,7", "--json", "report.json"});
    INFO(few.err);
    REQUIRE(few.status == 0);
    const Json report = json_in(folder, "report.json");
    CHECK(report["classes"]["samples"] == Json{3, 7});
    CHECK(run(folder, {"verify", kClassesMesh, "few.csv"}).status == 0);
    const auto refuses = [&](const Arguments& options, const char* message) {
        const Outcome refused = sampled("b.csv", options);
        INFO(refused.err);
        CHECK(refused.status == 2);
        CHECK(contains(refused.err, message));
        CHECK_FALSE(std::filesystem::exists(folder / "b.csv"));
    };
    refuses({"-n", "3000,7"}, "--count: placed only ");
    refuses({"-n", "3,7,9"}, "--count has 3 numbers, one for each class, but --classes has 2");
    refuses({"-n", "2,7", "--existing", "few.csv"},
            "class 0 has more existing samples than the 2 asked for");
    refuses({"-n", "3,"}, "--count: '' is not a whole number");
    CHECK(sampled("some.csv", {"-n", "3000,7", "--darts", "5000"}).status == 0);
    const Outcome pool =
        run(folder, {"sample", kClassesMesh, "-o", "b.csv", "--classes", "2", "-n", "3,7"});
    CHECK(contains(pool.err, "is a number for each class, which takes --method darts"));
    const Outcome none = run(folder, {"sample", kClassesMesh, "-o", "b.csv", "-d", "5", "-n", "3,7",
                                      "--method", "darts"});
    CHECK(contains(none.err, "--count has 2 numbers, one for each class, but there are no"));
}

TEST_CASE("what no classes are ends in an error, without a file") {
    const TemporaryFolder folder;
    REQUIRE(run(folder, {"sample", kClassesMesh, "-o", "a.ply", "-d", "10%", "--classes", "3"})
                .status == 0);
    std::ofstream(folder / "bad.csv") << "1 x\nx 1\n";
    for (const auto& [options, message] : std::vector<std::pair<Arguments, const char*>>{
             {{"--classes", "0", "-d", "1"}, "neither a number of classes from 1 to 8"},
             {{"--classes", "9", "-d", "1"}, "neither a number of classes from 1 to 8"},
             {{"--classes", "0.5", "-d", "1"}, "neither a number of classes from 1 to 8"},
             {{"--classes", "none.csv"}, "no such file"},
             {{"--classes", "bad.csv"}, "line 1: 'x' is no number"},
             {{"--classes", "1,2;3,1"}, "not symmetric"},
             {{"--classes", "1,-2;-2,1"}, "not positive and finite, nor 0 for none"},
             {{"--classes", "1,1;1,0"}, "of classes 1 and 1 is 0, not positive and finite"},
             {{"--classes", "1,nan;nan,1"}, "is nan, not positive and finite"},
             {{"--classes", "1,2;2"}, "row 1 of the table has 1 distance"},
             {{"--classes", "1,0.001;0.001,1"}, "more than a factor of 100"},
             {{"--classes", "1,1;1,1", "-d", "1"}, "takes no --min-distance"},
             {{"--classes", "2"}, "no distance given"},
             {{"--classes", "2", "-d", "1", "--existing", "a.ply"}, "its class is 2"}}) {
        const Outcome refused =
            run(folder, joined({"sample", kClassesMesh, "-o", "b.ply"}, options));
        INFO(refused.err);
        CHECK(refused.status != 0);
        CHECK(contains(refused.err, message));
        CHECK_FALSE(std::filesystem::exists(folder / "b.ply"));
    }
    CHECK(contains(
        run(folder, {"sample", kClassesMesh, "-o", "b.xyz", "-d", "1", "--classes", "2"}).err,
        "holds points alone, so no column class"));
}

} // namespace geodisk::test
