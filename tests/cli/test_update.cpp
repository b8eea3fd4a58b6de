// Samples that follow an edit of their mesh.
#include <doctest/doctest.h>

#include <cmath>
#include <fstream>
#include <sstream>
#include <string>

#include <geodisk/version.hpp>

#include "cli/command.hpp"
#include "cli/json_file.hpp"

namespace geodisk::test {
namespace {

/// Writes a hilly square of 40 by 40 cells, with a bump of this height, as PLY.
void write_hills(const TemporaryFolder& folder, const std::string& name, double bump,
                 int columns = 40) {
    std::ofstream file(folder / name);
    file << "ply\nformat ascii 1.0\nelement vertex " << (columns + 1) * 41
         << "\nproperty double x\nproperty double y\nproperty double z\nelement face "
         << 2 * columns * 40 << "\nproperty list uchar int vertex_indices\nend_header\n";
    for (int y = 0; y <= 40; ++y) {
        for (int x = 0; x <= columns; ++x) {
            const bool is_bump = x == 20 && y == 20;
            file << x << ' ' << y << ' '
                 << std::sin(0.3 * x) * std::cos(0.2 * y) + (is_bump ? bump : 0) << '\n';
        }
    }
    for (int y = 0; y < 40; ++y) {
        for (int x = 0; x < columns; ++x) {
            const int a = y * (columns + 1) + x, c = a + columns + 1;
            file << "3 " << a << ' ' << a + 1 << ' ' << c + 1 << '\n';
            file << "3 " << a << ' ' << c + 1 << ' ' << c << '\n';
        }
    }
}

/// Returns what follows the header, which counts the candidates that were decided.
std::string rows_of(const TemporaryFolder& folder, const std::string& name) {
    const std::string bytes = bytes_of(folder / name);
    return bytes.substr(bytes.find("end_header"));
}

double disks_in(const TemporaryFolder& folder, const std::string& name) {
    return json_in(folder, name)["disks"].get<double>();
}

} // namespace

TEST_CASE("samples are updated to those of a whole run, and few disks are computed") {
    const TemporaryFolder folder;
    write_hills(folder, "old.ply", 0);
    write_hills(folder, "new.ply", 1);
    const Arguments job{"-d", "2", "--seed", "3"};
    REQUIRE(run(folder, joined({"sample", "old.ply", "-o", "a.ply"}, job)).status == 0);
    const Outcome updated = run(folder, joined({"sample", "new.ply", "-o", "b.ply", "--from",
                                                "old.ply", "--update", "a.ply", "--json", "b.json"},
                                               job));
    INFO(updated.out, updated.err);
    REQUIRE(updated.status == 0);
    REQUIRE(run(folder, joined({"sample", "new.ply", "-o", "c.ply", "--from", "old.ply", "--json",
                                "c.json"},
                               job))
                .status == 0);
    REQUIRE(run(folder, joined({"sample", "new.ply", "-o", "d.ply"}, job)).status == 0);
    CHECK(rows_of(folder, "b.ply") == rows_of(folder, "c.ply"));
    CHECK(rows_of(folder, "b.ply") == rows_of(folder, "d.ply"));
    CHECK(rows_of(folder, "b.ply") != rows_of(folder, "a.ply"));
    CHECK(disks_in(folder, "b.json") < disks_in(folder, "c.json") / 2);

    // Nothing has changed.
    REQUIRE(run(folder, joined({"sample", "old.ply", "-o", "e.ply", "--from", "old.ply", "--update",
                                "a.ply", "--json", "e.json"},
                               job))
                .status == 0);
    CHECK(rows_of(folder, "e.ply") == rows_of(folder, "a.ply"));
    CHECK(disks_in(folder, "e.json") == 0);
}

TEST_CASE("updates are whole runs where edges are longer than the distance") {
    const TemporaryFolder folder;
    // A torus of few faces, with radii that vary.
    const auto write_torus = [&folder](const std::string& name, double bump) {
        std::ostringstream file;
        file << "ply\nformat ascii 1.0\nelement vertex 160\nproperty double x\nproperty double "
                "y\nproperty double z\nproperty double q\nelement face 320\nproperty list uchar "
                "int vertex_indices\nend_header\n";
        file.precision(17);
        for (int i = 0; i < 20; ++i) {
            for (int k = 0; k < 8; ++k) {
                const double a = 0.1 * 3.14159265 * i, b = 0.25 * 3.14159265 * k;
                const double r = 1 + 0.4 * std::cos(b);
                const bool is_bump = (8 * i + k) % 50 == 5;
                file << r * std::cos(a) << ' ' << r * std::sin(a) << ' '
                     << 0.4 * std::sin(b) + (is_bump ? bump : 0) << ' '
                     << 1 - 0.25 * ((7 * i + k) % 3) << '\n';
            }
        }
        for (int i = 0; i < 20; ++i) {
            for (int k = 0; k < 8; ++k) {
                const auto at = [](int row, int column) { return row % 20 * 8 + column % 8; };
                file << "3 " << at(i, k) << ' ' << at(i + 1, k) << ' ' << at(i + 1, k + 1) << '\n';
                file << "3 " << at(i, k) << ' ' << at(i + 1, k + 1) << ' ' << at(i, k + 1) << '\n';
            }
        }
        folder.write(name, file.str());
    };
    write_torus("old.ply", 0);
    write_torus("mid.ply", 0.02);
    write_torus("new.ply", 0.3);
    for (const char* const seed : {"1", "2"}) {
        CAPTURE(seed);
        const Arguments job{"-d", "0.04", "--radius-factor", "q", "--seed", seed};
        const auto sample = [&](const std::string& mesh, const std::string& out,
                                const Arguments& more) {
            const Outcome made =
                run(folder, joined(joined({"sample", mesh, "-o", out}, job), more));
            INFO(made.err);
            REQUIRE(made.status == 0);
            return made.err;
        };
        const std::string again = "all samples are decided again, as without --update";
        const auto follow = [&](const std::string& before, const std::string& edited,
                                const std::string& out) {
            const Arguments from{"--from", before + ".ply"};
            sample(edited + ".ply", "whole.ply", from);
            const std::string told = sample(edited + ".ply", out + ".s.ply",
                                            joined(from, {"--update", before + ".s.ply"}));
            CHECK(rows_of(folder, out + ".s.ply") == rows_of(folder, "whole.ply"));
            return told;
        };
        sample("old.ply", "old.s.ply", {});
        sample("new.ply", "plain.ply", {});
        // Longer edges than the frame of the mesh before allows.
        CHECK(contains(follow("old", "new", "new"), "need wider tolerances; so " + again));
        CHECK(rows_of(folder, "new.s.ply") == rows_of(folder, "plain.ply"));
        CHECK_FALSE(contains(bytes_of(folder / "new.s.ply"), "job_frame"));
        // Shorter ones, in the frame of the mesh before; then samples of that.
        CHECK_FALSE(contains(follow("new", "mid", "mid"), again));
        CHECK(contains(bytes_of(folder / "mid.s.ply"), "comment job_frame: 47444a46"));
        CHECK(contains(follow("mid", "old", "old"),
                       "mid.s.ply was decided with other tolerances than a run over mid.ply"));
    }
}

TEST_CASE("an edit that only copies a face changes no samples") {
    const TemporaryFolder folder;
    const std::string old = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0.2\nf 1 2 3\nf 2 4 3\n";
    folder.write("old.obj", old);
    folder.write("new.obj", old + "f 1 2 3\n");
    REQUIRE(run(folder, {"sample", "old.obj", "-d", "0.1", "-o", "s.ply"}).status == 0);
    const Outcome updated = run(folder, {"sample", "new.obj", "-d", "0.1", "--from", "old.obj",
                                         "--update", "s.ply", "-o", "u.ply"});
    INFO(updated.err);
    REQUIRE(updated.status == 0);
    CHECK(rows_of(folder, "u.ply") == rows_of(folder, "s.ply"));
}

TEST_CASE("files say what they were made from, and whether their samples were changed") {
    const TemporaryFolder folder;
    write_hills(folder, "old.ply", 0);
    write_hills(folder, "new.ply", 1);
    const Arguments job{"-d", "3"};
    for (const char* const name : {"a.csv", "a.ply", "a.pcd", "a.npz"}) {
        CAPTURE(name);
        REQUIRE(run(folder, joined({"sample", "old.ply", "-o", name}, job)).status == 0);
        const Outcome checked = run(folder, {"verify", "old.ply", name});
        CHECK(checked.status == 0);
        CHECK_FALSE(contains(checked.err, "digest"));
        const Arguments update{"sample", "new.ply", "-o",       std::string("b-") + name,
                               "--from", "old.ply", "--update", name};
        CHECK(run(folder, joined(update, job)).status == 0);
    }
    CHECK(contains(bytes_of(folder / "b-a.csv"), "# from: old.ply\n# update: a.csv\n"));

    // Without a row, with one twice, and with a row from elsewhere.
    const std::string text = bytes_of(folder / "a.csv");
    const std::size_t last = text.rfind('\n', text.size() - 2) + 1;
    const std::string row = text.substr(last);
    const auto count_is = [&](const std::string& whole, int more) {
        const std::size_t at = whole.find("# samples: ") + 11;
        const std::size_t end = whole.find('\n', at);
        const int count = std::stoi(whole.substr(at, end - at));
        return whole.substr(0, at) + std::to_string(count + more) + whole.substr(end);
    };
    REQUIRE(
        run(folder, {"sample", "old.ply", "-o", "other.csv", "-d", "3", "--seed", "5"}).status ==
        0);
    const std::string other = bytes_of(folder / "other.csv");
    const std::string foreign = other.substr(other.rfind('\n', other.size() - 2) + 1);
    for (const std::string& changed : {count_is(text.substr(0, last), -1), count_is(text + row, 1),
                                       text.substr(0, last) + foreign}) {
        folder.write("changed.csv", changed);
        check_fails(folder, 3,
                    "changed.csv: has other samples than its digest is of: samples of the run are "
                    "missing, others were added, or numbers were changed, for example rounded; "
                    "give the file as geodisk sample wrote it",
                    joined({"sample", "new.ply", "-o", "b.ply", "--from", "old.ply", "--update",
                            "changed.csv"},
                           job));
        const Outcome checked =
            run(folder, {"verify", "old.ply", "changed.csv", "--json", "v.json"});
        CHECK(contains(checked.err, "changed.csv: its samples do not fit the digest in its header: "
                                    "samples of the run are missing"));
        CHECK(json_in(folder, "v.json")["warnings"].back()["kind"] == "other_rows");
    }
    folder.write("changed.csv", count_is(text.substr(0, last), -1));
    CHECK(run(folder, {"verify", "old.ply", "changed.csv"}).status == 0); // They keep the distance.
    // Areas of cells are those of the samples that are left, whose file tells so still.
    REQUIRE(run(folder, {"cells", "old.ply", "changed.csv", "-o", "cells.csv", "-q"}).status == 0);
    CHECK(contains(run(folder, {"verify", "old.ply", "cells.csv"}).err, "samples of the run are"));
    REQUIRE(run(folder, {"cells", "old.ply", "a.csv", "-o", "whole.csv", "-q"}).status == 0);
    CHECK_FALSE(contains(run(folder, {"verify", "old.ply", "whole.csv"}).err, "digest"));
    // A digest that is none.
    const std::size_t entry = text.find("# digest: ");
    const std::string after = text.substr(text.find('\n', entry));
    for (const char* const digest :
         {"# digest:", "# digest: ", "# digest: 0123", "# digest: none"}) {
        folder.write("changed.csv", text.substr(0, entry) + digest + after);
        check_fails(folder, 3, "changed.csv: its header has ",
                    {"verify", "old.ply", "changed.csv"});
        check_fails(folder, 3, ", not one of 16 hexadecimal digits",
                    joined({"sample", "new.ply", "-o", "no.ply", "--from", "old.ply", "--update",
                            "changed.csv"},
                           job));
    }
    // Other orders are the same samples, and files without a digest are taken.
    const std::size_t first = text.find('\n', text.find("\nx,") + 1) + 1;
    folder.write("sorted.csv", text.substr(0, first) + row + text.substr(first, last - first));
    const std::size_t digest = text.find("# digest: ");
    folder.write("before.csv", text.substr(0, digest) + text.substr(text.find('\n', digest) + 1));
    for (const char* const name : {"sorted.csv", "before.csv"}) {
        REQUIRE(run(folder, joined({"sample", "new.ply", "-o", "c.ply", "--from", "old.ply",
                                    "--update", name},
                                   job))
                    .status == 0);
        CHECK(rows_of(folder, "c.ply") == rows_of(folder, "b-a.ply"));
    }
}

TEST_CASE("edits of radius factors need not keep the largest and the least one") {
    const TemporaryFolder folder;
    write_hills(folder, "hills.ply", 0);
    std::string even, dense;
    for (int vertex = 0; vertex < 41 * 41; ++vertex) {
        even += "0.9\n";
        dense += vertex == 500 ? "0.4\n" : vertex == 900 ? "1\n" : "0.9\n";
    }
    const auto write = [&](const std::string& name, const std::string& values) {
        std::istringstream factors(values);
        std::string content = bytes_of(folder / "hills.ply"), line;
        content.replace(content.find("element face"), 0, "property double g\n");
        std::size_t at = content.find("end_header\n") + 11;
        while (std::getline(factors, line)) {
            at = content.find('\n', at);
            content.insert(at, ' ' + line);
            at += line.size() + 2;
        }
        folder.write(name, content);
    };
    write("old.ply", even);
    write("new.ply", dense);
    const Arguments job{"-d", "2", "--radius-factor", "attribute:g"};
    for (const auto& [before, after] : {std::pair{"old.ply", "new.ply"}, {"new.ply", "old.ply"}}) {
        REQUIRE(run(folder, joined({"sample", before, "-o", "a.ply"}, job)).status == 0);
        REQUIRE(run(folder, joined({"sample", after, "-o", "b.ply", "--from", before, "--update",
                                    "a.ply", "--json", "b.json"},
                                   job))
                    .status == 0);
        REQUIRE(
            run(folder,
                joined({"sample", after, "-o", "c.ply", "--from", before, "--json", "c.json"}, job))
                .status == 0);
        CHECK(rows_of(folder, "b.ply") == rows_of(folder, "c.ply"));
        CHECK(disks_in(folder, "b.json") > 0);
        CHECK(disks_in(folder, "b.json") < disks_in(folder, "c.json"));
    }
}

TEST_CASE("updates of other samples, meshes and kinds are refused") {
    const TemporaryFolder folder;
    write_hills(folder, "old.ply", 0);
    write_hills(folder, "new.ply", 1);
    REQUIRE(run(folder, {"sample", "old.ply", "-o", "a.ply", "-d", "3"}).status == 0);
    REQUIRE(run(folder, {"sample", "old.ply", "-o", "points.xyz", "-d", "3"}).status == 0);
    const auto refused = [&](int status, const std::string& part, const Arguments& more) {
        check_fails(folder, status, part, joined({"sample", "new.ply", "-o", "b.ply"}, more));
    };
    const Arguments edit{"--from", "old.ply", "--update", "a.ply"};
    refused(2, "--update needs the mesh of the samples; add --from OLD_MESH",
            {"-d", "3", "--update", "a.ply"});
    refused(3, "a.ply: has as its seed 0, not 9; give the options it was made with",
            joined(edit, {"-d", "3", "--seed", "9"}));
    refused(3, "a.ply: has as its minimum distance 3, not 2.9", joined(edit, {"-d", "2.9"}));
    refused(3, "a.ply: has as its pool_ratio 20, not 10",
            joined(edit, {"-d", "3", "--pool-ratio", "10"}));
    refused(3, "a.ply: has as its mask none, not x<9", joined(edit, {"-d", "3", "--mask", "x<9"}));
    for (const Arguments& kind :
         {Arguments{"--maximal"}, Arguments{"--classes", "2"},
          Arguments{"--method", "darts", "--darts", "400"}, Arguments{"--exact", "-n", "100"},
          Arguments{"--order", "farthest"}}) {
        const Arguments make{"sample", "old.ply", "-o", "other.ply"};
        const Arguments distance =
            kind[0] == "--exact" ? Arguments{} : Arguments{"-d", "3"}; // It finds one.
        const Outcome made = run(folder, joined(joined(make, distance), kind));
        INFO(made.err);
        REQUIRE(made.status == 0);
        refused(3, "has samples of --", {"-d", "3", "--from", "old.ply", "--update", "other.ply"});
    }
    folder.write("bare.csv", "x,y,z,face_index,bary_u,bary_v,bary_w\n0,0,0,0,1,0,0\n");
    REQUIRE(
        run(folder, {"sample", "old.ply", "-o", "seams.ply", "-d", "3", "--keep-seams"}).status ==
        0);
    refused(3, "seams.ply: has as its keep_seams yes, not none",
            {"-d", "3", "--from", "old.ply", "--update", "seams.ply"});
    refused(3, "a.ply: has as its keep_seams none, not yes",
            joined(edit, {"-d", "3", "--keep-seams"}));
    refused(3, "does not say its seed and minimum distance",
            {"-d", "3", "--from", "old.ply", "--update", "bare.csv"});
    refused(2, "--from takes no --avoid", joined(edit, {"-d", "3", "--avoid", "a.ply:1"}));
    // Errors name the files that they are about.
    std::string other_seed = bytes_of(folder / "a.ply");
    other_seed.replace(other_seed.find("seed: 0"), 7, "seed: 9");
    folder.write("seed.ply", other_seed);
    refused(3, "seed.ply: sample ",
            {"-d", "3", "--seed", "9", "--from", "old.ply", "--update", "seed.ply"});
    std::string other_frame = bytes_of(folder / "a.ply");
    other_frame.replace(other_frame.find("comment seed: 0"), 15,
                        "comment seed: 0\ncomment job_frame: 47");
    folder.write("frame.ply", other_frame);
    refused(3,
            "frame.ply: its header has a wrong job_frame: a job frame has 128 bytes, there are 1",
            {"-d", "3", "--from", "old.ply", "--update", "frame.ply"});
    std::string other_sampling = bytes_of(folder / "a.ply");
    const std::string own = "sampling_version: " + std::to_string(GEODISK_SAMPLING_VERSION);
    REQUIRE(contains(other_sampling, own));
    other_sampling.replace(other_sampling.find(own), own.size(), "sampling_version: 9");
    folder.write("sampling.ply", other_sampling);
    refused(3,
            "sampling.ply: was made by sampling version 9, and this is 1, in which a seed gives "
            "other sets; sample the mesh again",
            {"-d", "3", "--from", "old.ply", "--update", "sampling.ply"});
    for (const Arguments& reads :
         {Arguments{"verify", "old.ply", "sampling.ply"},
          Arguments{"sample", "old.ply", "-d", "2", "-o", "b.ply", "--existing", "sampling.ply"}}) {
        const Outcome warned = run(folder, reads);
        CHECK(warned.status == 0);
        CHECK(contains(warned.err, "warning: sampling.ply: was made by sampling version 9"));
    }
    write_hills(folder, "wide.ply", 0, 60);
    refused(3, "a.ply: sample ", {"-d", "3", "--from", "wide.ply", "--update", "a.ply"});
    refused(2, "--update: the minimum distance exceeds old.ply", joined(edit, {"-d", "900"}));
    refused(3, "has no faces and weights, so its samples cannot be updated",
            {"-d", "3", "--from", "old.ply", "--update", "points.xyz"});
}

} // namespace geodisk::test
