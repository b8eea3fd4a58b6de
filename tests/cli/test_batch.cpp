// Many meshes in one go.
#include <doctest/doctest.h>

#include <algorithm>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "cli/command.hpp"

namespace geodisk::test {
namespace {

using Json = nlohmann::json;

/// The lines of a log, all of which must be whole.
std::vector<Json> log_of(const std::filesystem::path& path) {
    std::vector<Json> entries;
    for (const std::string& line : lines_of(bytes_of(path))) {
        entries.push_back(Json::parse(line));
    }
    return entries;
}

/// Returns how often the log reports that each mesh is done.
std::map<std::string, int> times_done(const std::vector<Json>& entries) {
    std::map<std::string, int> times;
    for (const Json& entry : entries) {
        times[entry["mesh"]] += entry["status"] == "ok" ? 1 : 0;
    }
    return times;
}

void write_shape(const TemporaryFolder& folder, const std::string& shape, const std::string& file) {
    std::filesystem::create_directories((folder / file).parent_path());
    REQUIRE(run(folder, {"shapes", shape, "-o", file}).status == 0);
}

/// A folder `meshes` of three meshes and what is none.
void write_meshes(const TemporaryFolder& folder) {
    write_shape(folder, "cube", "meshes/a.ply");
    write_shape(folder, "icosphere:2", "meshes/more/b c.PLY");
    write_shape(folder, "torus-knot:24", "meshes/more/d.ply");
    folder.write("meshes/notes.txt", "no mesh");
    folder.write("meshes/.hidden.obj", "no mesh either");
}

/// The paths in `folder` of all files below `part`.
std::vector<std::string> files_below(const TemporaryFolder& folder, const std::string& part) {
    std::vector<std::string> names;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(folder / part)) {
        if (entry.is_regular_file()) {
            names.push_back(entry.path().lexically_relative(folder / "").generic_string());
        }
    }
    std::sort(names.begin(), names.end());
    return names;
}

/// Checks that a single run with these arguments writes the same bytes as are in `file`.
void check_same(const TemporaryFolder& folder, const std::string& file, const Arguments& sample) {
    const std::string single = "single" + std::filesystem::path(file).extension().string();
    const Outcome outcome = run(folder, joined({"sample", "-q", "-o", single}, sample));
    INFO(outcome.err);
    REQUIRE(outcome.status == 0);
    INFO(file);
    CHECK(bytes_of(folder / file) == bytes_of(folder / single));
    CHECK(!bytes_of(folder / file).empty());
}

/// A manifest whose third line fails after two good ones, and whose fourth takes a while.
void write_slow_list(const TemporaryFolder& folder) {
    folder.write("list.txt", "builtin:cube\nbuiltin:torus-knot:24\nmissing.obj\n"
                             "builtin:icosphere:5 -n 200000\nbuiltin:icosphere:2\n");
}

const Arguments kSlowList{"batch", "list.txt", "-o", "out", "-n", "100", "--jobs", "1"};

/// Ends the slow batch by `signal` while it is at its fourth line.
Outcome end_midway(const TemporaryFolder& folder, int signal) {
    write_slow_list(folder);
    Setting setting;
    setting.signal_at = "missing.obj";
    setting.signal = signal;
    Outcome outcome = run(folder, kSlowList, setting);
    CHECK(files_below(folder, "out") ==
          std::vector<std::string>{"out/batch.jsonl", "out/cube.ply", "out/torus-knot-24.ply"});
    CHECK(log_of(folder / "out/batch.jsonl").size() == 3);
    return outcome;
}

/// Goes on with it, without what takes long.
void check_resumes(const TemporaryFolder& folder) {
    folder.write("list.txt", "builtin:cube\nbuiltin:torus-knot:24\nmissing.obj\n"
                             "builtin:icosphere:5 -n 200\nbuiltin:icosphere:2\n");
    const auto before = std::filesystem::last_write_time(folder / "out/cube.ply");
    const Outcome outcome = run(folder, joined(kSlowList, {"--resume"}));
    CHECK(outcome.status == 1);
    CHECK(contains(outcome.out, "5 of list.txt: 2 ok, 1 failed, 2 skipped"));
    CHECK(std::filesystem::last_write_time(folder / "out/cube.ply") == before);
    const auto times = times_done(log_of(folder / "out/batch.jsonl"));
    CHECK(times == std::map<std::string, int>{{"builtin:cube", 1},
                                              {"builtin:icosphere:2", 1},
                                              {"builtin:icosphere:5", 1},
                                              {"builtin:torus-knot:24", 1},
                                              {"missing.obj", 0}});
    check_same(folder, "out/icosphere-5.ply", {"builtin:icosphere:5", "-n", "200"});
    CHECK(files_below(folder, "out").size() == 5);
}

} // namespace

TEST_CASE("batch does with each mesh of a folder what sample does, however many at a time") {
    const TemporaryFolder folder;
    std::filesystem::create_directory(folder / "meshes");
    write_meshes(folder);
    const Arguments options{"-n", "150", "--seed", "5"};
    const Outcome outcome =
        run(folder, joined({"batch", "meshes", "-o", "meshes/out", "--jobs", "1"}, options));
    INFO(outcome.err);
    CHECK(outcome.status == 0);
    CHECK(outcome.err.empty());
    CHECK(contains(outcome.out, "3 of meshes: 3 ok, 0 failed, 0 skipped"));
    CHECK(contains(outcome.out, "meshes per hour"));
    CHECK(files_below(folder, "meshes/out") ==
          std::vector<std::string>{"meshes/out/a.ply", "meshes/out/batch.jsonl",
                                   "meshes/out/more/b c.ply", "meshes/out/more/d.ply"});
    check_same(folder, "meshes/out/a.ply", joined({"meshes/a.ply"}, options));
    check_same(folder, "meshes/out/more/b c.ply", joined({"meshes/more/b c.PLY"}, options));
    check_same(folder, "meshes/out/more/d.ply", joined({"meshes/more/d.ply"}, options));

    // Output lies in the folder, but is no mesh of it.
    const Outcome three = run(folder, joined({"batch", "meshes", "-o", "meshes/out", "--jobs", "3",
                                              "--resume", "--json", "-", "--ascii"},
                                             options));
    CHECK(three.status == 0);
    const Json report = Json::parse(three.out);
    CHECK(report["meshes"] == 3);
    CHECK(report["ok"] == 3); // With another option they are others.
    CHECK(report["jobs"] == 3);
    CHECK(report["samples"] > 300);
    for (const Json& entry : log_of(folder / "meshes/out/batch.jsonl")) {
        CHECK(entry["status"] == "ok");
        CHECK(entry["exit_code"] == 0);
        CHECK(entry["seconds"] > 0.0);
        CHECK(entry["min_distance"] > 0.0);
    }
    check_same(folder, "meshes/out/a.ply", joined({"meshes/a.ply", "--ascii"}, options));
    check_same(folder, "meshes/out/more/d.ply", joined({"meshes/more/d.ply", "--ascii"}, options));
}

TEST_CASE("a bad file stops no other one of a batch") {
    const TemporaryFolder folder;
    std::filesystem::create_directory(folder / "meshes");
    write_shape(folder, "cube", "meshes/a.ply");
    folder.write("meshes/b.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 9\n");
    folder.write("meshes/c.ply", "ply\n");
    write_shape(folder, "icosphere:2", "meshes/d.ply");
    const Outcome outcome = run(folder, {"batch", "meshes", "-o", "out", "-n", "50"});
    CHECK(outcome.status == 1);
    CHECK(contains(outcome.err, "geodisk: meshes/b.obj: line 4: "));
    CHECK(contains(outcome.err, "geodisk: meshes/c.ply: "));
    CHECK(outcome.err.ends_with(
        "geodisk: 2 meshes of 4 failed; out/batch.jsonl says why, and --resume retries\n"));
    CHECK(files_below(folder, "out") ==
          std::vector<std::string>{"out/a.ply", "out/batch.jsonl", "out/d.ply"});
    std::size_t failed = 0;
    for (const Json& entry : log_of(folder / "out/batch.jsonl")) {
        if (entry["status"] == "failed") {
            ++failed;
            CHECK(entry["exit_code"] == 3);
            CHECK(contains(entry["error"].get<std::string>(), entry["mesh"].get<std::string>()));
        }
    }
    CHECK(failed == 2);

    write_shape(folder, "cube", "meshes/c.ply"); // And then it is good.
    const Outcome again = run(folder, {"batch", "meshes", "-o", "out", "-n", "50", "--resume"});
    CHECK(again.status == 1);
    CHECK(contains(again.out, "4 of meshes: 1 ok, 1 failed, 2 skipped"));
}

TEST_CASE("lines of a manifest have options of their own") {
    const TemporaryFolder folder;
    std::filesystem::create_directories(folder / "in/sub");
    write_shape(folder, "cube", "in/sub/a b.ply");
    folder.write("in/grey.txt", "1\n1\n1\n1\n0.5\n0.5\n0.5\n0.5\n");
    folder.write("in/list.txt",
                 "\xEF\xBB\xBF# meshes\r\n\r\n"
                 "'sub/a b.ply' -n 60 # fewer\r\n"
                 "\"sub/a b.ply\" -r 10% -o second.v2\r\n"
                 "sub/a\" \"b.ply --radius-factor file:grey.txt -o deep/third.csv\r\n"
                 "builtin:torus-knot:24 --method pdts --throws 900 -d 5% --seed 7");
    const Outcome outcome = run(folder, {"batch", "in/list.txt", "-o", "out", "-n", "80",
                                         "--pool-ratio", "30", "--seed", "3"});
    INFO(outcome.err);
    REQUIRE(outcome.status == 0);
    const Arguments common{"--pool-ratio", "30", "--seed", "3"};
    const std::string mesh = "in/sub/a b.ply";
    check_same(folder, "out/sub/a b.ply", joined({mesh, "-n", "60"}, common));
    check_same(folder, "out/second.v2.ply", joined({mesh, "-r", "10%"}, common));
    check_same(folder, "out/deep/third.csv",
               joined({mesh, "-n", "80", "--radius-factor", "file:in/grey.txt"}, common));
    check_same(folder, "out/torus-knot-24.ply",
               {"builtin:torus-knot:24", "--method", "pdts", "--throws", "900", "-d", "5%", "-n",
                "80", "--seed", "7"});
}

TEST_CASE("options of a line replace common ones that set the same thing in another way") {
    const TemporaryFolder folder;
    const std::string mesh = "builtin:cube:3";
    struct Case {
        Arguments common;
        std::string line;
        Arguments same;
    };
    const Case cases[] = {
        {{"-n", "20", "--exact"}, "-d 0.4", {"-d", "0.4"}},
        {{"-n", "20", "--exact"},
         "--method darts -d 0.4",
         {"-n", "20", "--method", "darts", "-d", "0.4"}},
        {{"-d", "0.4", "--dense"}, "--pool-ratio 7", {"-d", "0.4", "--pool-ratio", "7"}},
        {{"-d", "0.4", "--pool-ratio", "7"}, "--dense", {"-d", "0.4", "--dense"}},
        {{"-d", "0.4", "--dense"}, "--maximal", {"-d", "0.4", "--maximal"}},
        {{"-d", "0.4", "--maximal"}, "--dense", {"-d", "0.4", "--dense"}},
        {{"-d", "0.4", "--maximal"},
         "--method darts --darts 99",
         {"-d", "0.4", "--method", "darts", "--darts", "99"}},
        {{"--classes", "0.5,0.3;0.3,0.2"}, "-d 0.4", {"-d", "0.4"}},
        {{"-n", "20", "--classes", "2"}, "-r 0.2", {"-r", "0.2", "--classes", "2"}},
        {{"-d", "0.4", "--only", "part:0", "--mask", "x<0"},
         "--mask y<0",
         {"-d", "0.4", "--only", "part:0", "--mask", "y<0"}},
        {{"-d", "0.4", "--only", "part:1", "--mask", "x<0"},
         "--only part:0",
         {"-d", "0.4", "--only", "part:0", "--mask", "x<0"}},
        {{"-d", "0.4", "--order", "farthest", "--keep", "9"}, "--order dart", {"-d", "0.4"}},
        {{"-d", "0.4", "--order", "progressive", "--levels", "2", "--level-factor", "3"},
         "--order farthest",
         {"-d", "0.4", "--order", "farthest"}},
        {{"-d", "0.4", "--order", "progressive", "--levels", "2"},
         "--order progressive --level-factor 3",
         {"-d", "0.4", "--order", "progressive", "--levels", "2", "--level-factor", "3"}},
    };
    for (const Case& one : cases) {
        CAPTURE(one.line);
        folder.write("list.txt", mesh + " " + one.line + "\n");
        const Outcome outcome = run(folder, joined({"batch", "list.txt", "-o", "out"}, one.common));
        INFO(outcome.err);
        REQUIRE(outcome.status == 0);
        check_same(folder, "out/cube-3.ply", joined({mesh}, one.same));
        std::filesystem::remove_all(folder / "out");
    }
}

TEST_CASE("samples in a folder of meshes are skipped with a note") {
    const TemporaryFolder folder;
    std::filesystem::create_directory(folder / "in");
    REQUIRE(run(folder, {"shapes", "cube:2", "-o", "in/cube.ply"}).status == 0);
    for (const char* const name : {"in/cube-samples.ply", "in/more.obj", "in/scene.glb"}) {
        REQUIRE(run(folder, {"sample", "in/cube.ply", "-n", "9", "-o", name}).status == 0);
    }
    const Outcome outcome = run(folder, {"batch", "in", "-o", "out", "-n", "9"});
    CHECK(outcome.status == 0);
    CHECK(contains(outcome.err, "geodisk: warning: in: 3 files hold samples, not a mesh, and are "
                                "skipped: in/cube-samples.ply, ...\n"));
    CHECK(lines_of(bytes_of(folder / "out/batch.jsonl")).size() == 1);
    CHECK(std::filesystem::exists(folder / "out/cube.ply"));
    // One that is named is no mesh.
    const Outcome named = run(folder, {"batch", "in/cube-samples.ply", "-o", "again", "-n", "9"});
    CHECK(named.status == 1);
    CHECK(contains(named.err, "in/cube-samples.ply: holds samples, but a mesh is expected here"));
    REQUIRE(run(folder, {"sample", "in/cube.ply", "-n", "9", "-o", "s.csv"}).status == 0);
    check_fails(folder, 3,
                "s.csv: holds samples, but a mesh, a folder or a manifest is expected here",
                {"batch", "s.csv", "-o", "other", "-n", "9"});
}

TEST_CASE("wrong lines of a manifest are told before any work") {
    const TemporaryFolder folder;
    const auto check = [&](const char* manifest, int status, const std::string& part,
                           const Arguments& more = {"-n", "9"}) {
        folder.write("list.txt", manifest);
        check_fails(folder, status, part, joined({"batch", "list.txt", "-o", "out"}, more));
    };
    check("builtin:cube\n\nbuiltin:cube -o b -n x\n", 2, "list.txt: line 3: --count: 'x' is not");
    check("builtin:cube \"-n 9\n", 2, "list.txt: line 1: a quote \" has no end");
    check("builtin:cube builtin:torus\n", 2, "list.txt: line 1: ");
    check("-n 9\n", 2, "list.txt: line 1: MESH is required");
    check("builtin:cube --device 0\n", 2, "--device");
    check("builtin:cube --help\n", 2, "--help");
    check("builtin:cube -o ../a\n", 2, "line 1: --output: '../a' is not a file name");
    check("builtin:cube\n", 2, "line 1: no distance given", {"-q"});
    check("out/a.ply -o a\n", 2,
          "out/a.ply: the samples of list.txt: line 1 would replace the mesh");
    check("out/b.ply\nbuiltin:cube -o b\n", 2,
          "out/b.ply: the samples of list.txt: line 2 would replace the mesh");
    check("builtin:cube\n", 2, "the report would replace the samples of list.txt: line 1",
          {"-n", "9", "--json", "out/cube.ply"});
    check("builtin:cube\nmesh.ply\n", 2, "the report would replace the mesh",
          {"-n", "9", "--json", "./mesh.ply"});
    check("builtin:cube\n", 2, "the report would replace the manifest",
          {"-n", "9", "--json", "list.txt"});
    check("builtin:cube\n", 2, "the report would replace the log",
          {"-n", "9", "--json", "out/batch.jsonl"});
    check("# nothing\n", 3, "list.txt: names no mesh");
    check("builtin:cube\n", 2, "--shard: '2/2' is not", {"-n", "9", "--shard", "2/2"});
    check("builtin:cube\n", 2, "--shard", {"-n", "9", "--shard", "1"});
    check("builtin:cube\n", 2, "--jobs", {"-n", "9", "--jobs", "0"});
    check("builtin:cube\n", 2, "--format: 'doc'", {"-n", "9", "--format", "doc"});
    std::filesystem::create_directory(folder / "empty");
    check_fails(folder, 3, "empty: holds no mesh", {"batch", "empty", "-o", "out", "-n", "9"});
    check_fails(folder, 3, "absent: ", {"batch", "absent", "-o", "out", "-n", "9"});
}

TEST_CASE("meshes whose samples would be one file fail, and the others are done") {
    const TemporaryFolder folder;
    write_shape(folder, "cube", "two/a.ply");
    write_shape(folder, "cube", "two/b.ply");
    write_shape(folder, "cube", "two/c.ply");
    std::filesystem::rename(folder / "two/b.ply", folder / "two/a.PLY");
    const Arguments batch{"batch", "two", "-o", "out", "-n", "9"};
    const std::string clash = "two/a.PLY and two/a.ply would both write out/a.ply";
    const Outcome first = run(folder, batch);
    CHECK(first.status == 1);
    CHECK(contains(first.out, "3 of two: 1 ok, 2 failed"));
    CHECK(contains(first.err, clash));
    CHECK(files_below(folder, "out") == std::vector<std::string>{"out/batch.jsonl", "out/c.ply"});
    const Outcome again = run(folder, joined(batch, {"--resume"}));
    CHECK(again.status == 1);
    CHECK(contains(again.out, "0 ok, 2 failed, 1 skipped"));
    // A report may not replace samples that are done, by whatever name.
    check_fails(folder, 2, "the report would replace the samples of two/c.ply",
                joined(batch, {"--resume", "--json", "out/../out/c.ply"}));

    const Outcome kept = run(
        folder, {"batch", "two", "-o", "kept", "-n", "9", "--format", "csv", "--keep-extensions"});
    CHECK(kept.status == 0);
    CHECK(files_below(folder, "kept") ==
          std::vector<std::string>{"kept/a.PLY.csv", "kept/a.ply.csv", "kept/batch.jsonl",
                                   "kept/c.ply.csv"});
}

TEST_CASE("a batch goes on from any folder, and takes no mesh for another of its name") {
    const TemporaryFolder folder;
    write_shape(folder, "cube", "a/m/x.ply");
    write_shape(folder, "icosphere:2", "b/m/x.ply");
    const std::string out = (folder / "out").string();
    Setting in_a, in_b;
    in_a.folder = "a";
    in_b.folder = "b";
    REQUIRE(run(folder, {"batch", "m", "-o", out, "-n", "50"}, in_a).status == 0);
    const Outcome same = run(folder, {"batch", "a/m", "-o", "out", "-n", "50", "--resume"});
    CHECK(contains(same.out, "1 of a/m: 0 ok, 0 failed, 1 skipped"));
    const Outcome other = run(folder, {"batch", "m", "-o", out, "-n", "50", "--resume"}, in_b);
    CHECK(contains(other.out, "1 of m: 1 ok, 0 failed, 0 skipped"));
    CHECK(run(folder, {"verify", "b/m/x.ply", "out/x.ply"}).status == 0);
}

TEST_CASE("a batch takes meshes, folders and manifests together") {
    const TemporaryFolder folder;
    write_shape(folder, "cube", "in/a.ply");
    write_shape(folder, "cube", "sub/b.ply");
    folder.write("list.txt", "builtin:cube -o line\n");
    const Outcome outcome =
        run(folder, {"batch", "sub/b.ply", "builtin:cube", "in", "list.txt", "absent.obj", "-o",
                     "out", "-n", "9", "--json", "report.json"});
    CHECK(outcome.status == 1);
    CHECK(contains(outcome.err, "absent.obj: "));
    CHECK(contains(outcome.out, "5 of sub/b.ply and 4 more: 4 ok, 1 failed"));
    CHECK(files_below(folder, "out") == std::vector<std::string>{"out/a.ply", "out/batch.jsonl",
                                                                 "out/cube.ply", "out/line.ply",
                                                                 "out/sub/b.ply"});
    CHECK(Json::parse(bytes_of(folder / "report.json"))["input"].size() == 5);
}

TEST_CASE("samples whose names differ by case alone are told where they would be one file") {
    const TemporaryFolder folder;
    folder.write("list.txt", "builtin:cube -o a\nbuiltin:icosphere:2 -o A\n");
    const Arguments batch{"batch", "list.txt", "-o", "out", "-n", "30"};
    std::filesystem::create_directory(folder / "out");
    // The folder answers to both names, as with a file system that ignores case.
    std::filesystem::create_directory_symlink("out", folder / "OUT");
    const Outcome clash = run(folder, batch);
    CHECK(clash.status == 1);
    CHECK(contains(clash.err, "list.txt: line 1 and list.txt: line 2 would both write out/A.ply"));
    std::filesystem::remove(folder / "OUT");
    std::filesystem::remove(folder / "out/batch.jsonl");
    CHECK(run(folder, batch).status == 0);
    CHECK(files_below(folder, "out") ==
          std::vector<std::string>{"out/A.ply", "out/a.ply", "out/batch.jsonl"});
}

TEST_CASE("shards of a batch do each mesh once and share no log") {
    const TemporaryFolder folder;
    folder.write("list.txt", "builtin:cube\nbuiltin:cube:2\nbuiltin:cube:3\nbuiltin:cube:4\n"
                             "builtin:cube:5\n");
    std::map<std::string, int> times;
    for (const char* const index : {"0", "1", "2"}) {
        const Outcome outcome = run(folder, {"batch", "list.txt", "-o", "out", "-n", "30",
                                             "--shard", std::string(index) + "/3"});
        CHECK(outcome.status == 0);
        const auto log = log_of(folder / ("out/batch-" + std::string(index) + "-of-3.jsonl"));
        CHECK(log.size() == (*index == '2' ? 1 : 2));
        for (const auto& [mesh, count] : times_done(log)) {
            times[mesh] += count;
        }
    }
    CHECK(times.size() == 5);
    CHECK(std::all_of(times.begin(), times.end(), [](const auto& t) { return t.second == 1; }));
    CHECK(files_below(folder, "out").size() == 8);

    // Another division goes on where they ended, and finds nothing left.
    const Outcome whole = run(folder, {"batch", "list.txt", "-o", "out", "-n", "30", "--resume"});
    CHECK(whole.status == 0);
    CHECK(contains(whole.out, "5 of list.txt: 0 ok, 0 failed, 5 skipped"));
}

TEST_CASE("an interrupted batch goes on without loss or double work") {
    const TemporaryFolder folder;
    const Outcome outcome = end_midway(folder, SIGINT);
    CHECK(outcome.status == 130);
    CHECK(outcome.err.ends_with("geodisk: interrupted\n"));
    CHECK(outcome.out.empty());
    check_resumes(folder);
}

TEST_CASE("a killed batch goes on behind a torn line of its log") {
    const TemporaryFolder folder;
    CHECK(end_midway(folder, SIGKILL).status == -SIGKILL);
    std::ofstream(folder / "out/batch.jsonl", std::ios::app) << R"({"mesh":"builtin:icosph)";
    check_resumes(folder);
}

TEST_CASE("a batch neither overwrites a log nor takes a lost file for done") {
    const TemporaryFolder folder;
    folder.write("list.txt", "builtin:cube\nbuiltin:icosphere:2\n");
    const Arguments batch{"batch", "list.txt", "-o", "out", "-n", "30"};
    REQUIRE(run(folder, batch).status == 0);
    const std::string log = bytes_of(folder / "out/batch.jsonl");
    check_fails(folder, 2, "out/batch.jsonl: there is a log already", batch);
    CHECK(bytes_of(folder / "out/batch.jsonl") == log);
    std::filesystem::remove(folder / "out/cube.ply");
    const Outcome outcome = run(folder, joined(batch, {"--resume"}));
    CHECK(contains(outcome.out, "2 of list.txt: 1 ok, 0 failed, 1 skipped"));
    const Outcome other = run(folder, joined(batch, {"--resume", "--seed", "4"}));
    CHECK(contains(other.out, "2 of list.txt: 2 ok, 0 failed, 0 skipped"));
}

TEST_CASE("the commands that a log tells do the same") {
    const TemporaryFolder folder;
    folder.write("list.txt",
                 "builtin:cube --weld --ascii\n"
                 "builtin:icosphere:2 --radius-factor curvature --radius-factor-floor 0.3\n"
                 "builtin:icosphere:3 --lift normals:0.2 --seed 0x9 -d 20%\n"
                 "builtin:torus-knot:24 --metric euclidean --pool-ratio 10\n"
                 "builtin:cube:3 --method pdts -r 0.1 --throws 300 -o darts.csv\n");
    REQUIRE(run(folder, {"batch", "list.txt", "-o", "out", "-n", "40"}).status == 0);
    for (const Json& entry : log_of(folder / "out/batch.jsonl")) {
        Arguments words;
        std::istringstream text(entry["command"].get<std::string>());
        for (std::string word; text >> word;) {
            words.push_back(word);
        }
        const std::string bytes = bytes_of(folder / entry["output"].get<std::string>());
        std::filesystem::remove(folder / entry["output"].get<std::string>());
        INFO(entry["command"].get<std::string>());
        CHECK(run(folder, Arguments(words.begin() + 1, words.end())).status == 0);
        CHECK(bytes_of(folder / entry["output"].get<std::string>()) == bytes);
    }
}

} // namespace geodisk::test
