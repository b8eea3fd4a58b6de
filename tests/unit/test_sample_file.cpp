#include "files/samples/sample_file.hpp"

#include "files/meshes/line_file.hpp"
#include "files/meshes/mesh_file.hpp"
#include "files/output/output_file.hpp"
#include "test_files.hpp"

#include <cmath>

using namespace geodisk::tools;

namespace {

std::vector<SampleRow> some_rows(double offset) {
    std::vector<SampleRow> rows;
    for (std::uint32_t i = 0; i < 100; ++i) {
        SampleRow row;
        for (int k = 0; k < 3; ++k) {
            row.position[k] = offset + std::sin(i * 1.7 + k);
            row.normal[k] = static_cast<float>(std::cos(i * 0.3 + k));
        }
        row.face = i == 99 ? 2147483647u : 7 * i;
        row.bary[0] = 1.0f / static_cast<float>(i + 1);
        row.bary[1] = 1e-30f;
        row.bary[2] = 1.0f - row.bary[0];
        rows.push_back(row);
    }
    return rows;
}

const SampleHeader kHeader{{{"version", "0.1.0"},
                            {"mesh", "a: b.obj"},
                            {"min_distance", "0.01"},
                            {"device", "llvmpipe (LLVM 15, 256 bits)"}}};

void check_same(const SampleRow& a, const SampleRow& b, bool float_positions) {
    for (int k = 0; k < 3; ++k) {
        if (float_positions) {
            CHECK(static_cast<float>(a.position[k]) == static_cast<float>(b.position[k]));
        } else {
            CHECK(a.position[k] == b.position[k]);
        }
        CHECK(a.normal[k] == b.normal[k]);
        CHECK(a.bary[k] == b.bary[k]);
    }
    CHECK(a.face == b.face);
}

std::string csv_with(std::string_view row) {
    return "x,y,z,face_index,bary_u,bary_v,bary_w\n" + std::string(row) + "\n";
}

void check_refused(std::string_view name, std::string_view bytes, std::string_view part) {
    const TemporaryFolder folder;
    check_fails(ExitCode::bad_input, part, [&] { read_samples(folder.write(name, bytes)); });
}

} // namespace

TEST_CASE("sample files may begin with a byte order mark, but not be UTF-16") {
    const TemporaryFolder folder;
    const std::string text = csv_with("1,2,3,4,1,0,0");
    CHECK(read_samples(folder.write("a.csv", "\xEF\xBB\xBF" + text)).rows.size() == 1);
    std::string wide = "\xff\xfe";
    for (const char c : text) {
        wide += c;
        wide += '\0';
    }
    check_refused("a.csv", wide, "is UTF-16; save it as UTF-8");
    write_samples(folder / "a.ply", {}, some_rows(0), true);
    const std::string ply = "\xEF\xBB\xBF" + bytes_of(folder / "a.ply");
    CHECK(read_samples(folder.write("b.ply", ply)).rows.size() == 100);
}

TEST_CASE("columns of parts are written last and kept") {
    const TemporaryFolder folder;
    const std::vector<SampleRow> rows = some_rows(0);
    ExtraColumn mesh{"mesh", {}}, primitive{"primitive", {}};
    for (std::uint32_t i = 0; i < rows.size(); ++i) {
        mesh.values.push_back(i / 7);
        primitive.values.push_back(2000000000u + i);
    }
    const std::vector<ExtraColumn> extra{mesh, primitive};
    for (const bool is_text : {false, true}) {
        for (const char* const name : {"a.ply", "a.csv", "a.npz", "a.pcd"}) {
            CAPTURE(name);
            AtomicFile file(folder / name);
            write_samples(file, sample_target(folder / name, {}, is_text), {}, rows, 3, {extra});
            file.commit();
            const SampleFile back = read_samples(folder / name);
            REQUIRE(back.extra.size() == 2);
            CHECK(back.extra[0].name == "mesh");
            CHECK(back.extra[0].values == mesh.values);
            CHECK(back.extra[1].values == primitive.values);
        }
    }
    const std::vector<std::string> names{"mesh"};
    check_columns(sample_target("a.glb"), names);
    check_fails(ExitCode::usage, "holds points alone, so no column mesh",
                [&] { check_columns(sample_target("a.xyz"), names); });
    const SampleFile other = read_samples(
        folder.write("b.csv", "x,y,z,face_index,bary_u,bary_v,bary_w,mesh\n0,0,0,0,1,0,0,chair\n"));
    CHECK(other.rows.size() == 1);
    CHECK(other.extra.empty());
}

TEST_CASE("samples read back as written") {
    const TemporaryFolder folder;
    for (const double offset : {0.0, 1e7}) {
        const std::vector<SampleRow> rows = some_rows(offset);
        for (const std::string name : {"a.ply", "b.PLY", "c.csv", "d.npz"}) {
            CAPTURE(name);
            CAPTURE(offset);
            const bool ascii = name == "b.PLY";
            write_samples(folder / name, kHeader, rows, ascii);
            const SampleFile read = read_samples(folder / name);
            CHECK(read.header.entries == kHeader.entries);
            REQUIRE(read.rows.size() == rows.size());
            const bool float_positions = offset == 0 && name < "c.csv";
            for (std::size_t i = 0; i < rows.size(); ++i) {
                check_same(rows[i], read.rows[i], float_positions);
            }
        }
    }
    CHECK(folder.file_count() == 4);
}

TEST_CASE("the faces of split polygons are written and read back") {
    const TemporaryFolder folder;
    std::vector<SampleRow> rows = some_rows(0);
    for (SampleRow& row : rows) {
        row.polygon = row.face / 2;
    }
    for (const std::string name : {"a.ply", "b.csv"}) {
        CAPTURE(name);
        write_samples(folder / name, kHeader, rows, false);
        CHECK(contains(bytes_of(folder / name), "polygon_index"));
        const SampleFile read = read_samples(folder / name);
        REQUIRE(read.rows.size() == rows.size());
        for (std::size_t i = 0; i < rows.size(); ++i) {
            CHECK(read.rows[i].polygon == rows[i].polygon);
        }
    }
    write_samples(folder / "c.ply", kHeader, some_rows(0), false);
    CHECK_FALSE(contains(bytes_of(folder / "c.ply"), "polygon_index"));
    CHECK_FALSE(read_samples(folder / "c.ply").rows[0].polygon);
}

TEST_CASE("positions far from the origin stay apart") {
    const TemporaryFolder folder;
    SampleRow row;
    row.position[0] = 1e7 + 0.25;
    write_samples(folder / "a.ply", {}, std::vector<SampleRow>{row}, false);
    CHECK(read_samples(folder / "a.ply").rows.at(0).position[0] == 1e7 + 0.25);
    CHECK(contains(bytes_of(folder / "a.ply"), "property double x"));
}

TEST_CASE("no samples make a valid file") {
    const TemporaryFolder folder;
    for (const char* name : {"a.ply", "a.csv", "a.xyz"}) {
        write_samples(folder / name, kHeader, {}, true);
    }
    CHECK(read_samples(folder / "a.ply").rows.empty());
    CHECK(read_samples(folder / "a.csv").rows.empty());
    CHECK(bytes_of(folder / "a.xyz").empty());
}

TEST_CASE("the text formats are plain") {
    const TemporaryFolder folder;
    SampleRow row;
    row.position[0] = 0.1;
    row.position[1] = -2;
    row.position[2] = 1e-7;
    row.normal[2] = 1;
    row.face = 5;
    row.bary[0] = 0.2f;
    row.bary[1] = 0.8f;
    const std::vector<SampleRow> rows{row, SampleRow{}};
    const SampleHeader header{{{"mesh", "two\nlines"}}};
    write_samples(folder / "a.xyz", header, rows, false);
    CHECK(bytes_of(folder / "a.xyz") == "0.1 -2 1e-07\n0 0 0\n");
    write_samples(folder / "a.csv", header, rows, false);
    CHECK(bytes_of(folder / "a.csv") == "# mesh: two lines\n# samples: 2\n"
                                        "x,y,z,nx,ny,nz,face_index,bary_u,bary_v,bary_w\n"
                                        "0.1,-2,1e-07,0,0,1,5,0.2,0.8,0\n0,0,0,0,0,0,0,0,0,0\n");
    write_samples(folder / "a.ply", header, rows, true);
    CHECK(bytes_of(folder / "a.ply") ==
          "ply\nformat ascii 1.0\ncomment mesh: two lines\nelement vertex 2\n"
          "property float x\nproperty float y\nproperty float z\n"
          "property float nx\nproperty float ny\nproperty float nz\nproperty int face_index\n"
          "property float bary_u\nproperty float bary_v\nproperty float bary_w\n"
          "end_header\n0.1 -2 1e-07 0 0 1 5 0.2 0.8 0\n"
          "0 0 0 0 0 0 0 0 0 0\n");
}

TEST_CASE("binary samples have the documented layout") {
    const TemporaryFolder folder;
    write_samples(folder / "a.ply", {}, some_rows(0), false);
    const std::string bytes = bytes_of(folder / "a.ply");
    const std::size_t body = bytes.find("end_header\n") + 11;
    CHECK(bytes.size() - body == 100 * 10 * 4);
    CHECK(static_cast<unsigned char>(bytes[body + 40 + 24]) == 7); // face_index of row 1
}

TEST_CASE("output paths are checked early") {
    const TemporaryFolder folder;
    std::filesystem::create_directory(folder / "folder.ply");
    const auto check = [&](const std::filesystem::path& path) {
        check_writable(sample_target(path).path);
    };
    check_fails(ExitCode::usage, ".ply, .csv, .xyz, ", [&] { check(folder / "a.txt"); });
    check_fails(ExitCode::usage, ".vtp and .star", [&] { check(folder / "a"); });
    check_fails(ExitCode::bad_output, "No such file", [&] { check(folder / "missing" / "a.ply"); });
    check_fails(ExitCode::bad_output, "is a folder", [&] { check(folder / "folder.ply"); });
    check(folder / "a.ply");
    CHECK(folder.file_count() == 1);
    check_fails(ExitCode::usage, "known are",
                [&] { write_samples(folder / "a.txt", {}, {}, false); });
}

TEST_CASE("sample files may lack and add columns in any order") {
    const TemporaryFolder folder;
    const SampleFile samples = read_samples(
        folder.write("a.csv", "\n# seed: 7\r\nquality,bary_w,bary_v,bary_u,face_index,z,y,x\r\n"
                              "9, 0.5,0.25,0.25, 3,1,2,3\r\n\n"));
    REQUIRE(samples.rows.size() == 1);
    CHECK(samples.rows[0].position[0] == 3);
    CHECK(samples.rows[0].bary[2] == 0.5f);
    CHECK(samples.rows[0].face == 3);
    CHECK(samples.header.entries.size() == 1);
}

TEST_CASE("lines of OBJ may be continued, and comments may follow them") {
    const TemporaryFolder folder;
    const auto path = folder.write("a.obj", "# mesh: b.obj\nv 1 2 \\\n3 # first\nv 4 5 6#\n"
                                            "v 7 8 9\nl 1 2 \\\n  3 \\\r\n-3 # closed\np 1\n");
    const SampleFile samples = read_points_and_lines(path);
    REQUIRE(samples.rows.size() == 3);
    CHECK(samples.rows[0].position[2] == 3);
    CHECK(samples.rows[1].position[2] == 6);
    CHECK(samples.segments == std::vector<std::array<std::uint32_t, 2>>{{0, 1}, {1, 2}, {2, 0}});
    REQUIRE(samples.header.find("mesh") != nullptr);
    CHECK(*samples.header.find("mesh") == "b.obj");
    // Errors name the first of the lines joined.
    check_fails(ExitCode::bad_input, "line 2: '7' is not one of the 1 vertex before it",
                [&] { read_points_and_lines(folder.write("b.obj", "v 0 0 0\nl 1 \\\n 7\n")); });
}

TEST_CASE("broken sample files are refused with their line or record") {
    for (const char* const name : {"a.gltf", "a.glb", "a.usda"}) {
        check_refused(name, "", "does not read them back; use .ply, .csv, .npz, .pcd or .vtp");
    }
    check_refused("a.csv", "", "no header row");
    check_refused("a.csv", "x,y,z,face_index\n1,2,3,0\n", "no column bary_u");
    check_refused("a.csv", "2\nmethane\nC 0 0 0\n", "has 1 point, but its first line says 2");
    check_refused("a.csv", "1,2\n", "line 1: has no header row, and fewer than three numbers");
    check_refused("a.obj", "v 0 0 0\nf 1 1 1\n", "line 2: a face, so this is a mesh");
    check_refused("a.csv", csv_with("1,2,3,0,1,0"), "line 2");
    check_refused("a.csv", csv_with("1,2,3,0,1,0,0,0"), "line 2");
    check_refused("a.csv", csv_with("1,2,x,0,1,0,0"), "line 2: 'x'");
    check_refused("a.csv", csv_with("1,2,nan,0,1,0,0"), "line 2: z");
    check_refused("a.csv", csv_with("1,2,3,-1,1,0,0"), "line 2: face_index");
    check_refused("a.csv", csv_with("1,2,3,0.5,1,0,0"), "line 2: face_index");
    check_refused("a.ply", "ply\nformat ascii 1.0\nelement face 0\nend_header\n",
                  "no element vertex");

    const TemporaryFolder folder;
    write_samples(folder / "a.ply", kHeader, some_rows(0), false);
    const std::string bytes = bytes_of(folder / "a.ply");
    check_refused("a.ply", bytes.substr(0, bytes.size() - 1), "record 99");
    check_refused("a.ply", bytes + "x", "after the last sample");
}

TEST_CASE("sample files that are cut short are refused") {
    const TemporaryFolder folder;
    for (const auto& [file_name, is_text] : {std::pair{"a.csv", true},
                                             {"b.ply", true},
                                             {"c.ply", false},
                                             {"d.pcd", true},
                                             {"e.pcd", false}}) {
        const std::string name = file_name;
        write_samples(folder / name, kHeader, some_rows(0), is_text);
        const std::string bytes = bytes_of(folder / name);
        INFO(name);
        CHECK(read_samples(folder / name).rows.size() == 100);
        for (const std::size_t cut : {1u, 2u, 5u, 9u, 200u, 1000u}) {
            INFO(cut);
            folder.write("cut", bytes.substr(0, bytes.size() - cut));
            std::filesystem::rename(folder / "cut", folder / ("cut" + name));
            const auto error = error_of([&] { read_samples(folder / ("cut" + name)); });
            REQUIRE(error);
            CHECK(error->code() == ExitCode::bad_input);
        }
    }
    const std::string csv = bytes_of(folder / "a.csv");
    CHECK(contains(csv, "\n# samples: 100\nx,y,z,"));
    std::string lines = csv.substr(0, csv.rfind('\n', csv.size() - 2) + 1);
    check_refused("a.csv", lines, "has 99 samples, but its header says 100");
    check_refused("a.csv", csv + csv.substr(lines.size()), "has 101 samples");
    // Files of before have no count.
    lines.erase(lines.find("# samples"), lines.find("x,y,z") - lines.find("# samples"));
    CHECK(read_samples(folder.write("old.csv", lines)).rows.size() == 99);
}

TEST_CASE("points of other programs are read from tables of all kinds") {
    const TemporaryFolder folder;
    const auto check = [&](std::string_view name, std::string_view bytes) {
        const std::string shown = std::string(name) + ": " + std::string(bytes);
        INFO(shown);
        const SampleFile file = read_samples(folder.write(name, bytes));
        CHECK_FALSE(file.has_faces);
        CHECK(file.dimension == 3);
        REQUIRE(file.rows.size() == 2);
        CHECK(file.rows[1].position[0] == 4);
        CHECK(file.rows[1].position[1] == 5.5);
        CHECK(file.rows[1].position[2] == -6);
    };
    check("a.csv", "x,y,z\n1,2,3\n4,5.5,-6\n");
    check("a.csv", "1,2,3\n4,5.5,-6\n");
    check("a.csv", "id;Z;Y;X\r\n1;3;2;1\r\n2;-6;5.5;4\r\n");
    check("a.csv", "\"X\";\"Y\";\"Z\"\n1;2;3\n4;5,5;-6\n"); // With commas for points.
    check("a.txt", "//X Y Z\n1 2 3\n4 5.5 -6\n");           // CloudCompare
    check("a.csv", "\"Points:0\",\"Points:1\",\"Points:2\"\n1,2,3\n4,5.5,-6\n"); // ParaView
    check("a.xyz", "1 2 3\n4 5.5 -6\n");
    check("a.tsv", "# of numpy\n1\t2\t3\t0\n4\t5.5\t-6\t0\n");
    check("a.pts", "2\n1 2 3 0 9 9 9\n4 5.5 -6 0 9 9 9\n");
    check("a.asc", "\xEF\xBB\xBF"
                   "1 2 3\n4 5.5 -6\n");
    check("a.obj", "# points\nv 1 2 3\nv 4 5.5 -6\np 1\np 2\n");
    check("a.ply", "ply\nformat ascii 1.0\nelement vertex 2\nproperty float x\nproperty float y\n"
                   "property float z\nend_header\n1 2 3\n4 5.5 -6\n");
    check("a.pcd", "VERSION .7\nFIELDS x y z rgb\nSIZE 4 4 4 4\nTYPE F F F U\nCOUNT 1 1 1 1\n"
                   "WIDTH 2\nHEIGHT 1\nVIEWPOINT 0 0 0 1 0 0 0\nPOINTS 2\nDATA ascii\n"
                   "1 2 3 7\n4 5.5 -6 7\n");
    // Quoted cells may hold what separates them.
    check("a.csv", "\"name\",\"x\",\"y\",\"z\"\n\"well, old\",\"1\",\"2\",\"3\"\nb,4,5.5,-6\n");
    check("a.csv", "\"a;b\",x,y,z\n1,1,2,3\n\"say \"\"4,5\"\"\" , \"4\" ,5.5,-6\n");
    check("a.csv", "note,x,y,z\n\"of two\nlines, or\r\nthree\",1,2,3\n5\" pipe,4,5.5,-6\n");
    check("a.csv", "name;x;y;z\n\"a;b\";1;2;3\n\"c\";\"4\";\"5,5\";-6\n");
    check("a.txt", "name x y z\n\"well old\" 1 2 3\n\"b 4 5.5 -6\n");
    check("a.tsv", "name\tx\ty\tz\nwell old\t1\t2\t3\n\t4\t5.5\t-6\n");
    // Molecules: a count, a remark, and an element before each place.
    for (const std::string remark :
         {"", "of water", "-76.4", "Properties=species:S:1:pos:R:3", "a 1 2 3", "1 2 3"}) {
        check("a.xyz", "2\n" + remark + "\nC 1 2 3\nN 4 5.5 -6\n");
    }
    check("a.xyz", "2\nC 1 2 3 0.5\nN 4 5.5 -6 0.25\n");
    check("a.xyz", "2\n# of water\nC 1 2 3\nN 4 5.5 -6\n");
    check("a.xyz", "2\nplaces\n1 2 3\n4 5.5 -6\n");
    check("a.xyz", "2\nelement x y z\n6 1 2 3\n7 4 5.5 -6\n");
    check("pipe", "x,y,z\n1,2,3\n4,5.5,-6\n"); // Without an extension, by how it begins.
    check_refused("a.pts", "3\n1 2 3\n4 5.5 -6\n", "has 2 points, but its first line says 3");
    check_refused("a.xyz", "1 2 3\n4 5.5 -6", "its last line has no line end");
    check_refused("a.xyz", "3\nof water\nC 1 2 3\nN 4 5.5 -6\n",
                  "has 2 points, but its first line says 3");
    check_refused("a.xyz", "2\n1 2 3\n1 2 3\n4 5.5 -6\n",
                  "has 3 points, but its first line says 2");
    check_refused("a.xyz", "2\n\n6 1 2 3\n7 4 5.5 -6\n",
                  "its first column may be x or the numbers of elements; name the columns in its "
                  "second line");
    check_refused("a.csv", "x,y,z\n1,2,3\n\"4,5.5,-6\n", "line 3: a quotation mark has no end");
    check_refused("a.csv", "x,y,z\n1,2,3\n\"4,5\",5.5,-6\n", "line 3: '4,5' is not a number");
    CHECK(read_samples(folder.write("a.xyz", "0\n\n")).rows.empty());
    CHECK(read_samples(folder.write("a.xyz", "0\nnothing\n")).rows.empty());
    check_refused("a.pcd",
                  "FIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\nPOINTS 2\n"
                  "DATA binary_compressed\n",
                  "'binary_compressed' is not read");
    check_refused("a.pcd", // 244 is the size of U 4, were it counted on from F.
                  "FIELDS x y z\nSIZE 4 4 244\nTYPE F F F\nPOINTS 1\nDATA binary\n" +
                      std::string(252, '\0'),
                  "field 'z' is of type F and size 244, which is not read");
}

TEST_CASE("comments are left out on request, and the samples read back") {
    const TemporaryFolder folder;
    for (const char* const name : {"a.csv", "a.ply", "a.pcd"}) {
        SampleTarget target = sample_target(folder / name);
        target.has_header = false;
        AtomicFile file(target.path);
        write_samples(file, target, kHeader, some_rows(0));
        file.commit();
        CHECK_FALSE(contains(bytes_of(target.path), "llvmpipe"));
        const SampleFile read = read_samples(target.path);
        CHECK(read.rows.size() == 100);
        CHECK(read.header.entries.empty());
    }
    CHECK(bytes_of(folder / "a.csv").starts_with("x,y,z,nx,"));
}

TEST_CASE("a mesh file is not a sample file and the other way round") {
    const TemporaryFolder folder;
    write_samples(folder / "a.ply", kHeader, some_rows(0), false);
    check_fails(ExitCode::bad_input, "holds samples",
                [&] { read_mesh((folder / "a.ply").string()); });
    check_refused("b.ply",
                  "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\n"
                  "property float y\nproperty float z\nelement face 1\n"
                  "property list uchar int vertex_indices\nend_header\n0 0 0\n3 0 0 0\n",
                  "has faces, so this is a mesh");
}
