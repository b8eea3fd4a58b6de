// Help, version, and every way to ask for something impossible.
#include <doctest/doctest.h>

#include <cstdlib>
#include <set>
#include <sstream>

#include "cli/command.hpp"
#include "files/samples/sample_file.hpp"

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
         {"--min-distance", "--radius", "--count", "--seed", "--method", "--darts", "--pool-ratio",
          "--device", "--json", "--quiet", "--ascii"}) {
        CHECK(contains(help.out, option));
    }
}

TEST_CASE("no arguments print help to standard error, with the status of wrong usage") {
    const TemporaryFolder folder;
    const Outcome outcome = run(folder, {});
    CHECK(outcome.status == 2);
    CHECK(outcome.out.empty());
    CHECK(outcome.err == run(folder, {"--help"}).out);
}

TEST_CASE("samples without a name are named by their mesh, and no file replaced") {
    const TemporaryFolder folder;
    REQUIRE(run(folder, {"sample", "builtin:cube", "-n", "50"}).status == 0);
    const Outcome second = run(folder, {"sample", "builtin:cube", "-n", "90"});
    REQUIRE(second.status == 0);
    CHECK(contains(second.out, "file          cube-samples-2.ply\n"));
    CHECK(files_in(folder) == std::vector<std::string>{"cube-samples-2.ply", "cube-samples.ply"});
    CHECK(bytes_of(folder / "cube-samples.ply") != bytes_of(folder / "cube-samples-2.ply"));
}

TEST_CASE("samples in the place of their mesh are told the order of the arguments") {
    const TemporaryFolder folder;
    for (const char* const name : {"a.ply", "a.csv"}) {
        REQUIRE(run(folder, {"sample", "builtin:cube", "-n", "20", "-o", name}).status == 0);
        const std::string message =
            std::string(name) + ": holds samples, but a mesh is expected here";
        check_fails(folder, 3, message + "; give MESH SAMPLES in this order",
                    {"verify", name, "builtin:cube"});
        check_fails(folder, 3, message, {"sample", name, "-n", "20", "-o", "b.ply"});
        check_fails(folder, 3, message + "; --from takes the mesh before, --update its samples",
                    {"sample", "builtin:cube", "-d", "0.3", "--from", name, "-o", "b.ply"});
    }
    Setting piping;
    piping.stdin_path = (folder / "a.ply").string();
    const Outcome piped =
        run(folder, {"sample", "-", "--mesh-format", "ply", "-n", "9", "-o", "b.ply"}, piping);
    CHECK(piped.status == 3);
    CHECK(contains(piped.err, "standard input: holds samples, but a mesh is expected here"));
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
    CHECK(contains(page, ".TP\n\\fB\\-d\\fR, \\fB\\-\\-min\\-distance\\fR \\fID\\fR\nMinimum"));
    CHECK(contains(page, "Default: pool.\n"));
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
    check_fails(folder, 2,
                "'smaple': no such command or mesh file; did you mean sample? (see geodisk --help)",
                {"smaple", "builtin:cube", "-n", "9"});
    check_fails(folder, 2, "'missing.obj': no such command or mesh file", {"missing.obj"});
    check_fails(folder, 2, "unknown built-in shape 'kube'", {"builtin:kube"});
    check_fails(folder, 2, "--count: 'many' is not", {"builtin:cube", "--count", "many"});
    check_fails(folder, 2, "MESH is required (see geodisk sample --help)", {"sample"});
    check_fails(folder, 2, "SAMPLES is required", {"verify", "builtin:cube"});
    check_fails(folder, 2, "--speed", sample({"-n", "9", "--speed", "3"}));
    check_fails(folder, 2, "one argument too many: 'surplus'", sample({"surplus", "-n", "9"}));
    check_fails(folder, 2, "'1e-6'; if it is the value of --weld, give --weld=1e-6",
                sample({"-n", "9", "--weld", "1e-6"}));
    check_fails(folder, 2, "an argument is empty", {"sample", "", "-o", "a.ply", "-n", "9"});
    check_fails(folder, 2, "'1e30' is above 2^53", sample({"-n", "1e30"}));
    check_fails(folder, 3, ".: is a folder", {"sample", ".", "-o", "a.ply", "-n", "9"});
    check_fails(folder, 4, ".: cannot write: is a folder",
                {"sample", "builtin:cube", "-o", ".", "-n", "9"});
    check_fails(folder, 2, "--count needs a value", sample({"-n"}));
    check_fails(folder, 2, "--count is given more than once", sample({"-n", "9", "-n", "8"}));
    check_fails(folder, 2, "--json: needs a value", sample({"-n", "9", "--json=", "--seed=3"}));
    check_fails(folder, 2, "--json: needs a value before --seed=3",
                sample({"-n", "9", "--json", "--seed=3"}));
    check_fails(folder, 2, "--json: needs a value before -q", sample({"-n", "9", "--json", "-q"}));
    check_fails(folder, 2, "--json: needs a value", sample({"-n", "9", "--json", ""}));
    check_fails(folder, 2, "--seed: needs a value", sample({"-n", "9", "--seed", ""}));
}

TEST_CASE("a mistyped word is answered by the one it is close to") {
    const TemporaryFolder folder;
    std::filesystem::create_directory(folder / "meshes");
    check_fails(folder, 2, "'--cuont': no such option; did you mean --count? (see geodisk sample",
                sample({"--cuont", "9"}));
    check_fails(folder, 2, "'--min': no such option; did you mean --min-distance?",
                sample({"--min", "9"}));
    check_fails(folder, 2, "'--min_distance': no such option; did you mean --min-distance?",
                sample({"--min_distance=1"}));
    check_fails(folder, 2, "'--outptu': no such option; did you mean --output?",
                {"batch", "meshes", "--outptu", "out"});
    check_fails(folder, 2, "'--verison': no such option; did you mean --version?", {"--verison"});
    check_fails(folder, 2, "'--xyzzy': no such option; a file of this name must come after --",
                {"--xyzzy"});
    check_fails(folder, 2, "'-z': no such option", sample({"-z"}));
    check_fails(folder, 2, "'-qz': no such option", sample({"-qz"}));
    check_fails(folder, 2, "; did you mean icosphere?", {"builtin:icosfere"});
    check_fails(folder, 2, "; did you mean torus-knot?", {"shapes", "torusknot", "-o", "a.ply"});
    check_fails(folder, 2,
                "is none of geodesic, euclidean and approximate; did you mean euclidean?",
                sample({"-n", "9", "--metric", "euclidian"}));
    check_fails(folder, 2, "; did you mean glb?", sample({"-n", "9", "--format", "gbl"}));
    check_fails(folder, 2, "'poll' is neither pool nor darts; did you mean pool?",
                sample({"-n", "9", "--method", "poll"}));
    check_fails(folder, 2, "; did you mean voronoi?",
                {"render", "builtin:cube", "a.ply", "-o", "a.png", "--style", "vornoi"});
    check_fails(folder, 2,
                "meshes is a folder; to sample all meshes in it, run geodisk batch meshes -o",
                {"meshes", "--count", "9"});
    check_fails(folder, 2, "options come after the command: geodisk sample", {"-q", "sample"});
    const Outcome far = run(folder, {"quux"});
    CHECK_FALSE(contains(far.err, "did you mean"));
}

TEST_CASE("-- ends the options, and values that look like options go behind =") {
    const TemporaryFolder folder;
    const std::string plate = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
    for (const char* const name : {"--count.obj", "-q.obj", "-", "--"}) {
        folder.write(name, plate);
    }
    const Outcome double_dash =
        run(folder, {"sample", "-n", "20", "-o", "a.csv", "-q", "--", "--count.obj"});
    INFO(double_dash.err);
    CHECK(double_dash.status == 0);
    CHECK(run(folder, {"verify", "-q", "--", "--count.obj", "a.csv"}).status == 0);
    CHECK(run(folder, {"-n20", "--output=-b.csv", "-q", "--", "-q.obj"}).status == 0);
    CHECK(run(folder, {"verify", "-q", "--", "-q.obj", "-b.csv"}).status == 0);
    CHECK(run(folder, {"sample", "-n=20", "-o=c.csv", "-q", "--mesh-format=obj", "./--"}).status ==
          0);
    CHECK(bytes_of(folder / "a.csv").size() > 100);
    CHECK(files_in(folder) ==
          std::vector<std::string>{"-", "--", "--count.obj", "-b.csv", "-q.obj", "a.csv", "c.csv"});
    check_fails(folder, 2,
                "--output: needs a value before -b.csv; if that is the value, give "
                "--output=-b.csv",
                {"sample", "-n", "20", "-o", "-b.csv", "--", "-q.obj"});
    check_fails(folder, 2, "--count: '-5' is not a whole number", sample({"--count=-5"}));
    check_fails(folder, 2, "--output: needs a value", {"sample", "x.obj", "-o", "--"});
    check_fails(folder, 2, "'-x.obj': no such option; a file of this name must come after --",
                {"-x.obj"});
}

TEST_CASE("options of sample follow a mesh alone, and go before it") {
    const TemporaryFolder folder;
    folder.write("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    std::filesystem::create_directory(folder / "sub");
    folder.write("sub/a.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n");
    const auto rows = [&](const char* name) {
        return tools::read_samples(folder / name).rows.size();
    };
    REQUIRE(run(folder, {"a.obj", "--count", "50", "--seed", "7", "-q"}).status == 0);
    CHECK(rows("a-samples.ply") < 60);
    REQUIRE(run(folder, {"--count", "50", "-d", "0.5", "--method", "pdts", "--throws", "9", "a.obj",
                         "--format", "csv", "-q"})
                .status == 0);
    CHECK(rows("a-samples-2.csv") < 10);
    CHECK(run(folder, {"a.obj", "-n", "9", "-o", "b.csv", "--json", "-"}).status == 0);
    CHECK(rows("b.csv") > 5);
    CHECK(files_in(folder) == std::vector<std::string>{"a-samples-2.csv", "a-samples-2.png",
                                                       "a-samples.ply", "a-samples.png", "a.obj",
                                                       "b.csv", "sub"});
    CHECK(run(folder, {"a.obj", "--dry-run"}).status == 0);
    check_fails(folder, 2, "contradict", {"a.obj", "-d", "1", "-n", "5"});

    const Outcome list = run(folder, {"a.obj", "none.obj", "sub/a.off", "-n", "9"});
    CHECK(list.status == 1);
    CHECK(contains(list.err, "none.obj: "));
    CHECK(contains(list.err, "1 mesh of 3 failed"));
    CHECK(contains(list.out, "a-samples-3.ply"));
    CHECK(contains(list.out, "a-samples-4.ply"));
    CHECK(lines_of(list.err).size() == 2);
    for (const char* const option : {"--output", "--picture", "--json"}) {
        check_fails(folder, 2, " names one file, but 2 meshes are given",
                    {"a.obj", "sub/a.off", option, "x.ply"});
    }
    check_fails(folder, 2, "--seed: 'x' is not", {"a.obj", "sub/a.off", "--seed", "x"});
}

TEST_CASE("help shows the examples of its command alone, and they are commands") {
    const TemporaryFolder folder;
    std::set<std::string> seen;
    for (const char* const command :
         {"", "sample", "batch", "verify", "analyze", "spectrum", "render", "report", "transfer",
          "box", "shapes", "info", "quick"}) {
        CAPTURE(command);
        const bool is_main = std::string(command).empty();
        const Outcome help =
            run(folder, is_main ? Arguments{"--help"} : Arguments{command, "--help"});
        std::size_t count = 0;
        for (const std::string& line : lines_of(help.out)) {
            if (!line.starts_with("  geodisk ")) {
                continue;
            }
            ++count;
            CAPTURE(line);
            const bool is_own = line.starts_with(std::string("  geodisk ") + command + ' ') ||
                                line == std::string("  geodisk ") + command;
            CHECK((is_main || is_own || std::string(command) == "quick"));
            CHECK((is_main || seen.insert(line).second));
            const TemporaryFolder empty;
            std::istringstream words(line);
            Arguments arguments;
            for (std::string word; words >> word;) {
                arguments.push_back(word);
                // Without content they are all read, and refused, before any work.
                const bool is_file = word.find('.') != std::string::npos;
                if (is_file && word.find('%') == std::string::npos) {
                    empty.write(word, "");
                }
            }
            std::filesystem::create_directory(empty / "meshes");
            empty.write("list.txt", "");
            arguments.erase(arguments.begin());
            const bool works = std::string(command) == "shapes" || std::string(command) == "info";
            Setting none;
            none.environment = {{"VK_DRIVER_FILES", "/nowhere.json"}};
            const int status = run(empty, arguments, works ? Setting{} : none).status;
            CHECK((works ? status == 0 : status == 1 || status == 3 || status == 5));
        }
        CHECK(count >= (std::string(command) == "transfer" ? 1 : 2));
        CHECK(count <= 4);
    }
}

TEST_CASE("the environment chooses a device, and is named where it is wrong") {
    const TemporaryFolder folder;
    const auto with = [](const char* name, const std::string& value) {
        Setting setting;
        setting.environment = {{name, value}};
        return setting;
    };
    const Arguments quick = sample({"-n", "9", "-q"});
    check_fails(folder, 5, "GEODISK_DEVICE: no Vulkan device matches \"abacus\"; there is 0", quick,
                with("GEODISK_DEVICE", "abacus"));
    for (const Arguments& arguments :
         {Arguments{"info"}, Arguments{"batch", "builtin:cube", "-o", "out", "-n", "9"}}) {
        const Outcome outcome = run(folder, arguments, with("GEODISK_DEVICE", "abacus"));
        CHECK(outcome.status == 5);
        CHECK(contains(outcome.err, "GEODISK_DEVICE: no Vulkan device matches"));
    }
    CHECK(run(folder, joined(quick, {"--device", "0"}), with("GEODISK_DEVICE", "abacus")).status ==
          0);
    CHECK(run(folder, quick, with("GEODISK_DEVICE", "0")).status == 0);
    CHECK(run(folder, quick, with("GEODISK_DEVICE", "")).status == 0);
}

TEST_CASE("a driver that variables name, and that is not there, is named") {
    const TemporaryFolder folder;
    folder.write("text.json", "no driver");
    folder.write("lost.json", R"({"ICD":{"library_path":"./lost.so","api_version":"1.3.0"}})");
    folder.write("name.json", R"({"ICD":{"library_path":"liblost-driver.so.9"}})");
    std::filesystem::create_directory(folder / "drivers");
    const auto told = [&](const char* variable, const std::string& value) {
        Setting setting;
        setting.environment = {{"VK_DRIVER_FILES", ""}, {"VK_ICD_FILENAMES", ""}};
        setting.environment.emplace_back(variable, value);
        const Outcome outcome = run(folder, {"info"}, setting);
        CHECK(outcome.status == 5);
        CHECK(outcome.err.find("install") == std::string::npos);
        return outcome.err;
    };
    const auto path = [&](const char* name) { return (folder / name).string(); };
    for (const char* const variable : {"VK_ICD_FILENAMES", "VK_DRIVER_FILES"}) {
        const std::string names = std::string(variable) + " names ";
        CHECK(contains(told(variable, "/nope.json"), "no Vulkan driver was found; " + names +
                                                         "/nope.json, which does not exist; "
                                                         "correct or unset it"));
        CHECK(contains(told(variable, path("lost.json") + ":/nope.json"),
                       names + path("lost.json") + ", whose library "));
        CHECK(contains(told(variable, path("name.json")), "liblost-driver.so.9 does not load"));
        CHECK(contains(told(variable, path("text.json")), ", which is no driver file"));
        CHECK(contains(told(variable, path("drivers")), ", a folder without driver files"));
    }
    for (const char* const variable : {"VK_LOADER_DRIVERS_SELECT", "VK_LOADER_DRIVERS_DISABLE"}) {
        const bool selects = std::string(variable).ends_with("SELECT");
        const std::string value = selects ? "*abacus*" : "*";
        Setting setting;
        setting.environment = {
            {"VK_DRIVER_FILES", ""}, {"VK_ICD_FILENAMES", ""}, {variable, value}};
        const Outcome outcome = run(folder, {"info"}, setting);
        if (outcome.status == 5) { // Loaders before 1.3.234 do not know them.
            CHECK(
                contains(outcome.err, std::string(variable) + " is '" + value + "', which leaves"));
        }
    }
}

TEST_CASE("a driver that does not load is named where only a CPU is left") {
    const TemporaryFolder folder;
    folder.write("lost.json", R"({"ICD":{"library_path":"liblost-driver.so.9"}})");
    folder.write("other.json", R"({"ICD":{"library_path":"libm.so.6"}})");
    if (contains(run(folder, {"info"}).out, " GPU\n")) {
        return; // Where there is a GPU, nobody misses a driver.
    }
    Setting added;
    const std::string both =
        (folder / "lost.json").string() + ':' + (folder / "other.json").string();
    for (const char* const variable : {"VK_DRIVER_FILES", "VK_ICD_FILENAMES"}) {
        if (const char* const files = std::getenv(variable)) {
            added.environment.emplace_back(variable, std::string(files) + ':' + both);
        }
    }
    added.environment.emplace_back("VK_ADD_DRIVER_FILES", both);
    const std::string lost =
        (folder / "lost.json").string() + ", whose library liblost-driver.so.9 does not load (";
    const std::string other =
        (folder / "other.json").string() + ", whose library libm.so.6 is no Vulkan driver";
    const std::string warning = "warning: the CPU is used, since a Vulkan driver is left out: ";
    const Outcome info = run(folder, {"info"}, added);
    CHECK(info.status == 0);
    CHECK(contains(info.out, "drivers left out    " + lost));
    CHECK(contains(info.out, other));
    const Outcome made = run(folder, {"sample", "builtin:cube", "-n", "20", "-o", "a.csv"}, added);
    CHECK(made.status == 0);
    CHECK(contains(made.err, warning + lost));
    CHECK(contains(made.err, warning + other));
    const Outcome batch = run(folder, {"batch", "builtin:cube", "-n", "20", "-o", "out"}, added);
    CHECK(contains(batch.err, warning + lost));
    const Outcome chosen =
        run(folder, {"sample", "builtin:cube", "-n", "20", "-o", "b.csv", "--device", "0"}, added);
    CHECK(chosen.err.find("left out") == std::string::npos);
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
