// Help, version, and every way to ask for something impossible.
#include <doctest/doctest.h>

#include "cli/command.hpp"
#include "files/sample_file.hpp"

namespace geodisk::test {
namespace {

using Arguments = std::vector<std::string>;

Arguments sample(const Arguments& options) {
    Arguments arguments{"sample", "builtin:cube", "-o", "a.ply"};
    arguments.insert(arguments.end(), options.begin(), options.end());
    return arguments;
}

} // namespace

TEST_CASE("help tells options, examples and exit statuses") {
    const TemporaryFolder folder;
    for (const Arguments& arguments : {Arguments{"--help"}, Arguments{"sample", "--help"},
                                       Arguments{"batch", "--help"}, Arguments{"verify", "-h"}}) {
        const Outcome outcome = run(folder, arguments);
        CHECK(outcome.status == 0);
        CHECK(outcome.err.empty());
        CHECK(contains(outcome.out, "Usage: geodisk"));
        CHECK(contains(outcome.out, "Exit status:"));
        for (const char* const status :
             {"0 ", "1 ", "2 ", "3 ", "4 ", "5 ", "6 ", "7 ", "130 ", "143 "}) {
            CHECK(contains(outcome.out, std::string("\n  ") + status));
        }
        for (const std::string& line : lines_of(outcome.out)) {
            CHECK_MESSAGE(line.size() <= 100, line);
        }
    }
    const Outcome help = run(folder, {"sample", "--help"});
    for (const char* const option :
         {"--min-distance", "--radius", "--count", "--seed", "--method", "--throws", "--pool-ratio",
          "--device", "--json", "--quiet", "--ascii"}) {
        CHECK(contains(help.out, option));
    }
}

TEST_CASE("nothing asked for is a question for help") {
    const TemporaryFolder folder;
    const Outcome outcome = run(folder, {});
    CHECK(outcome.status == 0);
    CHECK(outcome.out == run(folder, {"--help"}).out);
}

TEST_CASE("a mesh alone is sampled and drawn, and no file replaced") {
    const TemporaryFolder folder;
    const Outcome first = run(folder, {"builtin:cube"});
    INFO(first.err);
    REQUIRE(first.status == 0);
    CHECK(contains(first.out, "file          cube-samples.ply\n"));
    CHECK(contains(first.out, "picture       cube-samples.png\n"));
    const std::string samples = bytes_of(folder / "cube-samples.ply");
    const auto written = tools::read_samples(folder / "cube-samples.ply").rows.size();
    CHECK((written > 9500 && written < 10500));
    folder.write("cube-samples-2.png", "mine");
    std::filesystem::create_directory(folder / "meshes");
    std::filesystem::copy_file(folder / "cube-samples.png", folder / "cube-samples-3.ply");
    const Outcome second = run(folder, {"builtin:cube", "-q"});
    CHECK(second.status == 0);
    CHECK(second.out.empty());
    CHECK(bytes_of(folder / "cube-samples.ply") == samples);
    CHECK(bytes_of(folder / "cube-samples-2.png") == "mine");
    CHECK(bytes_of(folder / "cube-samples-4.ply") == samples);
    folder.write("meshes/flat.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    CHECK(run(folder, {"meshes/flat.obj"}).status == 0);
    CHECK(bytes_of(folder / "flat-samples.png").starts_with("\x89PNG"));
}

TEST_CASE("each command has a manual page with its options") {
    const TemporaryFolder folder;
    REQUIRE(run(folder, {"manual", "-o", "."}).status == 0);
    const std::string main = bytes_of(folder / "geodisk.1");
    CHECK(main.starts_with(".TH GEODISK 1 "));
    CHECK(contains(main, ".SH EXIT STATUS\n.nf\n  0    success\n"));
    CHECK(contains(main, "\\fBgeodisk\\-sample\\fR(1)"));
    CHECK_FALSE(contains(main, "completion"));
    const std::string page = bytes_of(folder / "geodisk-sample.1");
    CHECK(contains(page, "geodisk\\-sample \\- put samples on a mesh"));
    CHECK(contains(page, ".TP\n\\fB\\-d\\fR, \\fB\\-\\-min\\-distance\\fR \\fID\\fR\nLeast"));
    CHECK(contains(page, "Default: psdp.\n"));
    for (const char* const command : {"batch", "verify", "analyze", "spectrum", "render", "report",
                                      "transfer", "box", "shapes", "info", "quick"}) {
        CHECK(bytes_of(folder / (std::string("geodisk-") + command + ".1")).starts_with(".TH "));
    }
}

TEST_CASE("the version is one line") {
    const TemporaryFolder folder;
    const Outcome outcome = run(folder, {"--version"});
    CHECK(outcome.status == 0);
    CHECK(outcome.out.starts_with("geodisk "));
    CHECK(lines_of(outcome.out).size() == 1);
}

TEST_CASE("colours are for terminals that want them") {
    if (!terminals_work()) {
        return;
    }
    const TemporaryFolder folder;
    folder.write("odd.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\nf 1 2 3\n");
    const auto told = [&](const Arguments& arguments, const std::string& terminal,
                          const std::string& no_color, bool has_terminal = true) {
        Setting setting;
        setting.has_terminal = has_terminal;
        setting.environment = {{"TERM", terminal}, {"NO_COLOR", no_color}};
        return run(folder, arguments, setting).err;
    };
    const Arguments wrong{"resample"};
    const Arguments odd{"sample", "odd.obj", "-o", "a.csv", "-n", "9", "-q"};
    CHECK(contains(told(wrong, "xterm", ""), "\x1b[31mgeodisk:\x1b[0m "));
    CHECK(contains(told(odd, "xterm", ""), "\x1b[33mgeodisk: warning:\x1b[0m "));
    for (const Arguments& arguments : {wrong, odd}) {
        for (const std::string& plain : {told(arguments, "xterm", "1"), told(arguments, "dumb", ""),
                                         told(arguments, "xterm", "", false)}) {
            CHECK(plain.starts_with("geodisk: "));
            CHECK_FALSE(contains(plain, "\x1b"));
        }
    }
}

TEST_CASE("shapes lists names that sample and verify take") {
    const TemporaryFolder folder;
    const Outcome outcome = run(folder, {"shapes"});
    CHECK(outcome.status == 0);
    CHECK(contains(outcome.out, "builtin:cube "));
    CHECK(contains(outcome.out, "builtin:torus-knot "));
}

TEST_CASE("wrong usage is explained") {
    const TemporaryFolder folder;
    check_fails(folder, 2, "'smaple': no such command or mesh file (see geodisk --help)",
                {"smaple", "builtin:cube", "-n", "9"});
    check_fails(folder, 2, "'missing.obj': no such command or mesh file", {"missing.obj"});
    check_fails(folder, 2, "unknown built-in shape 'kube'", {"builtin:kube"});
    check_fails(folder, 2, "--count", {"builtin:cube", "--count", "9"});
    check_fails(folder, 2, "MESH is required (see geodisk sample --help)", {"sample"});
    check_fails(folder, 2, "--output is required", {"sample", "builtin:cube", "-n", "9"});
    check_fails(folder, 2, "SAMPLES is required", {"verify", "builtin:cube"});
    check_fails(folder, 2, "--speed", sample({"-n", "9", "--speed", "3"}));
    check_fails(folder, 2, "surplus", sample({"surplus", "-n", "9"}));
    check_fails(folder, 2, "--count needs a value", sample({"-n"}));
    check_fails(folder, 2, "--count is given more than once", sample({"-n", "9", "-n", "8"}));
    check_fails(folder, 2, "--json needs a value", sample({"-n", "9", "--json=", "--seed=3"}));
    check_fails(folder, 2, "--json: needs a value before --seed=3",
                sample({"-n", "9", "--json", "--seed=3"}));
    check_fails(folder, 2, "--json: needs a value before -q", sample({"-n", "9", "--json", "-q"}));
    check_fails(folder, 2, "--json: needs a value", sample({"-n", "9", "--json", ""}));
    check_fails(folder, 2, "--seed: needs a value", sample({"-n", "9", "--seed", ""}));
}

TEST_CASE("the distance must be given once and make sense") {
    const TemporaryFolder folder;
    check_fails(folder, 2, "no distance given", sample({}));
    check_fails(folder, 2, "--min-distance and --count contradict",
                sample({"--min-distance", "1", "--count", "9"}));
    check_fails(folder, 2, "contradict", sample({"--min-distance", "1", "--radius", "0.5"}));
    check_fails(folder, 2, "contradict", sample({"-d", "1", "-r", "1", "-n", "1"}));
    for (const char* const length : {"0", "-1", "nan", "inf", "0%", "-5%", "1e999"}) {
        check_fails(folder, 2, "not a positive, finite length", sample({"-d", length}));
        check_fails(folder, 2, "not a positive, finite length", sample({"-r", length}));
    }
    for (const char* const length : {"thin", "1,5", "1 m", "%", "0x10", "1%%"}) {
        check_fails(folder, 2, "is not a length", sample({"-d", length}));
    }
    for (const char* const count : {"0", "-3", "1.5", "many", "nan", "1e30"}) {
        check_fails(folder, 2, "--count", sample({"-n", count}));
    }
    check_fails(folder, 2, "is not a length",
                {"verify", "builtin:cube", "a.ply", "--min-distance", "wide"});
}

TEST_CASE("a pool that cannot fit names its size") {
    const TemporaryFolder folder;
    check_fails(folder, 2, "candidates", sample({"-d", "1e-7"}));
    check_fails(folder, 2, "4.29e+09", sample({"-d", "1e-7"}));
    check_fails(folder, 2, "candidates", sample({"-d", "1e-300"}));
    check_fails(folder, 2, "candidates", sample({"-n", "1e12"}));
    check_fails(folder, 6, "--memory", sample({"-n", "9", "--memory", "1"}));
}

TEST_CASE("other values out of range are named") {
    const TemporaryFolder folder;
    for (const char* const seed : {"-1", "1.5", "18446744073709551616", "0xg", "", "0x"}) {
        check_fails(folder, 2, "--seed", sample({"-n", "9", "--seed", seed}));
    }
    for (const char* const ratio : {"0", "0.5", "10001", "nan", "much"}) {
        check_fails(folder, 2, "--pool-ratio", sample({"-n", "9", "--pool-ratio", ratio}));
    }
    for (const char* const size : {"0", "-1M", "1T", "all", "M"}) {
        check_fails(folder, 2, "--memory", sample({"-n", "9", "--memory", size}));
    }
    for (const char* const seconds : {"0", "-3", "soon", "1e9"}) {
        check_fails(folder, 2, "--stall-timeout", sample({"-n", "9", "--stall-timeout", seconds}));
    }
    check_fails(folder, 2, "unknown built-in shape 'kube'",
                {"sample", "builtin:kube", "-o", "a.ply", "-n", "9"});
    check_fails(folder, 2, "resolution", {"sample", "builtin:cube:0", "-o", "a.ply", "-n", "9"});
}

} // namespace geodisk::test
