// Files that cannot be read or written.
#include <doctest/doctest.h>

#include <unistd.h>

#include "cli/command.hpp"

namespace geodisk::test {
namespace {

constexpr const char* kTriangle = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";

/// In place of a folder without permission, which root may write to all the same.
constexpr const char* kBelowFile = "mesh.obj/a.ply";

} // namespace

TEST_CASE("a mesh that cannot be read") {
    const TemporaryFolder folder;
    folder.write("empty.obj", "");
    folder.write("empty.ply", "");
    folder.write("points.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\n");
    folder.write("range.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 4\n");
    folder.write("flat.obj", "v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\n");
    folder.write("nan.obj", "v 0 0 0\nv nan 0 0\nv 0 1 0\nf 1 2 3\n");
    folder.write("words.ply", "this is not a mesh\n");
    folder.write("cut.ply", "ply\nformat binary_little_endian 1.0\nelement vertex 3\n"
                            "property float x\nproperty float y\nproperty float z\nend_header\n12");
    folder.write("mesh.3ds", "solid\n");
    folder.write("cut.stl", "solid\nfacet\nvertex 0 0 0\n");
    std::filesystem::create_directory(folder / "folder.obj");
    const auto fails = [&](const std::string& mesh, const std::string& part) {
        check_fails(folder, 3, part, {"sample", mesh, "-o", "a.ply", "-n", "9"});
        check_fails(folder, 3, part, {"verify", mesh, "a.ply", "-d", "1"});
    };
    fails("none.obj", "none.obj: no such file");
    fails("folder.obj", "folder.obj: is a folder");
    fails("empty.obj", "empty.obj: ");
    fails("empty.ply", "empty.ply: ");
    fails("points.obj", "points.obj: has no faces");
    fails("range.obj", "range.obj: line 4");
    fails("flat.obj", "flat.obj: has no face with an area");
    fails("nan.obj", "not finite");
    fails("words.ply", "words.ply: ");
    fails("cut.ply", "cut.ply: ");
    fails("mesh.3ds", "unknown mesh format");
    fails("cut.stl", "cut.stl: line 3: the file ends inside a facet");
}

TEST_CASE("an output that cannot be written") {
    const TemporaryFolder folder;
    folder.write("mesh.obj", kTriangle);
    std::filesystem::create_directory(folder / "folder.ply");
    const auto fails = [&](int status, const std::string& output, const std::string& part) {
        check_fails(folder, status, part, {"sample", "mesh.obj", "-o", output, "-n", "9"});
    };
    fails(2, "a.xls", "unknown sample format");
    fails(2, "a", "unknown sample format");
    fails(4, "none/a.ply", "none/a.ply: ");
    fails(4, "folder.ply", "is a folder");
    fails(4, kBelowFile, kBelowFile);
    check_fails(folder, 4, kBelowFile,
                {"sample", "mesh.obj", "-o", "a.ply", "-n", "9", "--json", kBelowFile});
}

TEST_CASE("an output never replaces an input or another output") {
    const TemporaryFolder folder;
    const Outcome made = run(folder, {"sample", "builtin:cube", "-o", "mesh.ply", "-n", "9"});
    REQUIRE(made.status == 0);
    const std::string before = bytes_of(folder / "mesh.ply");
    check_fails(folder, 2, "replace the mesh", {"sample", "mesh.ply", "-o", "mesh.ply", "-n", "9"});
    check_fails(folder, 2, "replace the mesh",
                {"sample", "mesh.ply", "-o",
                 "../" + (folder / "mesh.ply").parent_path().filename().string() + "/mesh.ply",
                 "-n", "9"});
    check_fails(folder, 2, "replace the mesh",
                {"sample", "mesh.ply", "-o", "a.ply", "-n", "9", "--json", "mesh.ply"});
    check_fails(folder, 2, "replace the samples",
                {"sample", "mesh.ply", "-o", "a.ply", "-n", "9", "--json", "./a.ply"});
    check_fails(folder, 2, "replace the samples",
                {"sample", "mesh.ply", "-o", "a.ply", "-n", "9", "--picture", "a.ply"});
    check_fails(folder, 2, "the report would go to the same place as the samples",
                {"sample", "mesh.ply", "-o", "-", "--format", "csv", "-n", "9", "--json", "-"});
    folder.write("textured.obj", "mtllib wood.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    folder.write("wood.mtl", "map_Kd wood.png\n");
    folder.write("wood.png", "old");
    check_fails(folder, 2, "wood.png: the picture would replace a file that textured.obj names",
                {"sample", "textured.obj", "-o", "a.ply", "-n", "9", "--picture", "wood.png"});
    Setting appended; // Standard output is the mesh itself.
    appended.stdout_path = (folder / "mesh.ply").string();
    check_fails(folder, 2, "standard output: the summary would go to the same place as the samples",
                {"verify", "mesh.ply", "mesh.ply"}, appended);
    CHECK(bytes_of(folder / "mesh.ply") == before);
}

TEST_CASE("samples go to a stream behind what is there, and what is told goes elsewhere") {
    const TemporaryFolder folder;
    const Arguments sample{"sample", "builtin:cube", "-n", "20", "--format", "csv"};
    REQUIRE(run(folder, joined(sample, {"-o", "file.csv"})).status == 0);
    const std::string samples = bytes_of(folder / "file.csv");
    for (const char* const name : {"-", "/dev/stdout"}) {
        const Outcome piped = run(folder, joined(sample, {"-o", name, "--json", "a.json"}));
        CHECK(piped.status == 0);
        CHECK(piped.out == samples);
        CHECK(contains(piped.err, "min distance"));
        folder.write("log", "kept\n");
        Setting appended;
        appended.stdout_path = (folder / "log").string();
        CHECK(run(folder, joined(sample, {"-o", name}), appended).status == 0);
        CHECK(bytes_of(folder / "log") == "kept\n" + samples);
    }
    const Outcome errors = run(folder, joined(sample, {"-o", "/dev/stderr"}));
    CHECK(errors.err == samples);
    CHECK(contains(errors.out, "min distance"));
    CHECK(run(folder, joined(sample, {"-o", "/dev/null"})).status == 0);
    check_fails(folder, 2, "give --format", {"sample", "builtin:cube", "-n", "20", "-o", "-"});
    const Outcome shape = run(folder, {"shapes", "cube", "-o", "-"});
    CHECK(shape.out.starts_with("ply\n"));
}

TEST_CASE("meshes and samples are read from streams, and as what the user says") {
    const TemporaryFolder folder;
    folder.write("plate.txt", kTriangle);
    const Arguments sample{"sample", "plate.txt", "-o", "a.csv", "-n", "9"};
    check_fails(folder, 3, "or give --mesh-format", sample);
    const Arguments as_obj = joined(sample, {"--mesh-format", "obj"});
    REQUIRE(run(folder, as_obj).status == 0);
    CHECK(contains(bytes_of(folder / "a.csv"), "# mesh_format: obj\n"));
    CHECK(run(folder, {"verify", "plate.txt", "a.csv", "--mesh-format", "obj"}).status == 0);
    check_fails(folder, 2, "--mesh-format: 'doc' is none of",
                joined(sample, {"--mesh-format", "doc"}));

    Setting shell;
    shell.program = "/bin/sh";
    const auto piped = [&](const std::string& arguments) -> Arguments {
        return {"-c", "cat plate.txt a.csv | " GEODISK_COMMAND " " + arguments};
    };
    const Outcome from_input =
        run(folder,
            {"-c", "cat plate.txt | " GEODISK_COMMAND
                   " sample - -o - --format csv -n 9 --mesh-format obj | tee b.csv"},
            shell);
    CHECK(from_input.status == 0);
    CHECK(contains(from_input.out, "# mesh: -\n"));
    CHECK(run(folder,
              {"-c", "cat a.csv | " GEODISK_COMMAND " verify plate.txt - --mesh-format obj"}, shell)
              .status == 0);
    const Outcome unknown = run(folder, piped("sample - -o c.csv -n 9"), shell);
    CHECK(unknown.status == 3);
    CHECK(contains(unknown.err, "standard input: unknown mesh format"));
    const Outcome twice = run(folder, piped("verify - - --mesh-format obj"), shell);
    CHECK(twice.status == 2);
    CHECK(contains(twice.err, "a stream can be read only once"));
    const Outcome plain = run(folder, joined(as_obj, {"--no-header"}));
    CHECK(plain.status == 0);
    CHECK(bytes_of(folder / "a.csv").starts_with("x,y,z,nx,"));
    const Outcome unchecked = run(folder, {"verify", "plate.txt", "a.csv", "--mesh-format", "obj"});
    CHECK(unchecked.status == 0);
    CHECK(contains(unchecked.err, "none was checked; give --min-distance"));
    CHECK(
        run(folder, {"verify", "plate.txt", "a.csv", "--mesh-format", "obj", "-d", "1%"}).status ==
        0);
}

/// Returns true if samples can be drawn at all where no file may be larger. Some drivers compile
/// into files in memory, which the limit ends as well.
bool driver_lives_with(const TemporaryFolder& folder, std::size_t file_size_limit) {
    Setting full;
    full.file_size_limit = file_size_limit;
    const Outcome outcome =
        run(folder, {"sample", "builtin:cube", "-o", "tiny.xyz", "-n", "1", "-q"}, full);
    std::filesystem::remove(folder / "tiny.xyz");
    const bool lives = outcome.status == 0;
    if (!lives) {
        MESSAGE("skipped: the driver needs larger files itself");
    }
    return lives;
}

TEST_CASE("a full disk leaves nothing behind and old files whole") {
    const TemporaryFolder folder;
    Setting full;
    full.file_size_limit = 4096;
    check_fails(folder, 4, "b.ply: cannot write: ", {"shapes", "cube:100", "-o", "b.ply"}, full);
    if (!driver_lives_with(folder, *full.file_size_limit)) {
        return;
    }
    const std::vector<std::string> arguments{"sample", "builtin:cube", "-o", "a.ply", "-n", "1000"};
    check_fails(folder, 4, "a.ply: cannot write: ", arguments, full);
    folder.write("a.ply", "old");
    check_fails(folder, 4, "a.ply: cannot write: ", arguments, full);
    CHECK(bytes_of(folder / "a.ply") == "old");
}

TEST_CASE("when the report cannot be written, the samples are not either") {
    const TemporaryFolder folder;
    Setting full;
    full.file_size_limit = 300; // Enough for a sample as text, too little for the report.
    if (driver_lives_with(folder, *full.file_size_limit)) {
        check_fails(folder, 4, "a.json: cannot write: ",
                    {"sample", "builtin:cube", "-o", "a.xyz", "-n", "1", "--json", "a.json"}, full);
    }
    Setting closed;
    closed.stdout_path = "/dev/full";
    check_fails(folder, 4, "standard output",
                {"sample", "builtin:cube", "-o", "a.xyz", "-n", "1", "--json", "-"}, closed);
}

TEST_CASE("what standard output does not take leaves no file") {
    const TemporaryFolder folder;
    const Arguments sample{"sample", "builtin:cube", "-o", "a.ply", "-n", "9"};
    Setting full, unread, closed;
    full.stdout_path = "/dev/full";
    unread.stdout_has_reader = false;
    closed.closed = {STDIN_FILENO, STDOUT_FILENO};
    for (const Setting& setting : {full, unread, closed}) {
        check_fails(folder, 4, "the summary cannot be written to standard output", sample, setting);
        check_fails(folder, 4, "standard output", {"--help"}, setting);
        const Outcome quiet = run(folder, joined(sample, {"--quiet"}), setting);
        CHECK(quiet.status == 0);
        std::filesystem::remove(folder / "a.ply");
    }
    for (const Arguments& data :
         {joined(sample, {"--json", "-"}),
          Arguments{"sample", "builtin:cube", "-o", "-", "--format", "ply", "-n", "9"}}) {
        check_fails(folder, 4, "standard output: cannot write: ", data, full);
        check_fails(folder, 4, "standard output: cannot write: is not open", data, closed);
        const Outcome enough = run(folder, data, unread); // As of a reader like `head`.
        CHECK(enough.status == 4);
        CHECK(enough.err.empty());
        CHECK(files_in(folder).empty());
    }
    Setting silent;
    silent.closed = {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO};
    CHECK(run(folder, joined(sample, {"--json", "a.json"}), silent).status == 4);
    CHECK(files_in(folder).empty());
}

TEST_CASE("oddities of a mesh are warnings, also when quiet") {
    const TemporaryFolder folder;
    folder.write("mesh.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 -1 0\nv 0 0 1\nv 2 0 0\n"
                             "f 1 2 3\nf 1 2 4\nf 1 2 5\nf 1 1 2\nf 1 2 6\n");
    const Outcome outcome = run(folder, {"sample", "mesh.obj", "-o", "a.ply", "-n", "9", "-q"});
    CHECK(outcome.status == 0);
    CHECK(outcome.out.empty());
    const std::vector<std::string> lines = lines_of(outcome.err);
    CHECK(lines.size() == 3);
    for (const std::string& line : lines) {
        CHECK(line.starts_with("geodisk: warning: mesh.obj: "));
    }
    CHECK(contains(outcome.err, "repeated vertex"));
    CHECK(contains(outcome.err, "without area"));
    CHECK(contains(outcome.err, "three or more faces"));
    CHECK(std::filesystem::exists(folder / "a.ply"));
}

} // namespace geodisk::test
