// Files that a command reads are never written.
#include "files/output/files_in_use.hpp"

#include <algorithm>
#include <string>
#include <vector>

#include "files/file_identity.hpp"
#include "files/meshes/named_files.hpp"

#include "test_files.hpp"

using namespace geodisk::tools;

namespace {

std::vector<std::string> names_in(const TemporaryFolder& folder, const char* file) {
    std::vector<std::string> names;
    for (const Path& path : files_named_in(folder / file)) {
        names.push_back(path.filename().string());
    }
    std::sort(names.begin(), names.end());
    names.erase(std::unique(names.begin(), names.end()), names.end());
    return names;
}

using Names = std::vector<std::string>;

bool is_same_file(const Path& a, const Path& b) {
    const std::string identity = file_identity(a);
    return !identity.empty() && identity == file_identity(b);
}

} // namespace

TEST_CASE("a file is the same by whatever name") {
    const TemporaryFolder folder;
    folder.write("one", "");
    std::filesystem::create_directory(folder / "sub");
    CHECK(is_same_file(folder / "one", folder / "sub/../one"));
    CHECK(is_same_file(folder / "none", folder / "sub/.././none"));
    CHECK(is_same_file(folder / "no/such/a", folder / "no/such/a"));
    CHECK_FALSE(is_same_file(folder / "one", folder / "none"));
    CHECK_FALSE(is_same_file(folder / "none", folder / "sub/none"));
    CHECK_FALSE(is_same_file(folder / "no/such/a", folder / "no/such/A"));
#ifndef _WIN32
    std::filesystem::create_hard_link(folder / "one", folder / "two");
    CHECK(is_same_file(folder / "one", folder / "two"));
    std::filesystem::create_symlink("none", folder / "dangling");
    CHECK(is_same_file(folder / "none", folder / "dangling"));
    std::filesystem::create_directory_symlink("sub", folder / "SUB"); // As where case is ignored.
    CHECK(is_same_file(folder / "sub/none", folder / "SUB/NONE"));
    CHECK(file_identity("/dev/null").empty());
    CHECK_FALSE(is_same_file("/dev/null", "/dev/null"));
    CHECK(is_same_file("-", "/dev/stdout"));
#endif
}

TEST_CASE("no file that is read or written otherwise is written") {
    const TemporaryFolder folder;
    folder.write("mesh.ply", "");
    FilesInUse files;
    files.add_read({"the mesh", "builtin:cube"});
    files.add_read({"the mesh", ""});
    files.add_read({"the mesh", (folder / "mesh.ply").string()});
    files.add_written({"the samples", (folder / "a.ply").string()});
    files.add_written({"the report", ""});
    check_fails(ExitCode::usage, "mesh.ply: the report would replace the mesh", [&] {
        files.add_written({"the report", (folder / "./mesh.ply").string()});
    });
    check_fails(ExitCode::usage, "a.ply: the report would replace the samples", [&] {
        files.add_written({"the report", (folder / "a.ply").string()});
    });
#ifndef _WIN32
    files.add_read({"the mesh", "-"});
    check_fails(ExitCode::usage, "a stream can be read only once, but the mesh and the samples",
                [&] {
                    files.add_read({"the samples", "/dev/stdin"});
                });
    files.add_written({"the samples", "/dev/null"});
    files.add_written({"the report", "/dev/null"});
#endif
}

TEST_CASE("files that a mesh names are read") {
    const TemporaryFolder folder;
    for (const char* const name :
         {"a b.bin", "tex.png", "my wood.png", "bump.jpg", "old.tga", "sky.hdr"}) {
        folder.write(name, "");
    }
    folder.write("wood.mtl", "newmtl wood\nmap_Kd -s 1 1 1 my wood.png\nbump -bm .5 bump.jpg\n"
                             "refl -type sphere \"sky.hdr\"\n");
    folder.write("mesh.obj", "mtllib wood.mtl missing.mtl\nv 0 0 0\n");
    folder.write("dos.obj", "mtllib .\\wood.mtl\r\nv 0 0 0\r\n");
    folder.write("mesh.ply", "ply\ncomment TextureFile old.tga\ncomment texture: tex.png\n"
                             "end_header\n");
    const std::string json =
        R"({"asset": {"version": "2.0"}, "buffers": [{"uri": "a%20b.bin"},)"
        R"( {"uri": "data:x,y"}], "images": [{"extras": {"uri": "tex.png"}}]})";
    folder.write("mesh.gltf", json);
    const auto size = static_cast<char>(json.size());
    const std::string header("glTF\2\0\0\0\0\0\0\0", 12), binary("\4\0\0\0BIN\0abcd", 12);
    const std::string chunk = size + std::string("\0\0\0JSON", 7) + json;
    folder.write("mesh.glb", header + chunk + binary);
    folder.write("turned.glb", header + binary + chunk);
    CHECK(names_in(folder, "mesh.obj") == Names{"bump.jpg", "my wood.png", "sky.hdr", "wood.mtl"});
    CHECK(names_in(folder, "dos.obj") == Names{"bump.jpg", "my wood.png", "sky.hdr", "wood.mtl"});
    CHECK(names_in(folder, "mesh.ply") == Names{"old.tga", "tex.png"});
    CHECK(names_in(folder, "mesh.gltf") == Names{"a b.bin", "tex.png"});
    CHECK(names_in(folder, "mesh.glb") == Names{"a b.bin", "tex.png"});
    CHECK(names_in(folder, "turned.glb") == Names{"a b.bin", "tex.png"});
    CHECK(names_in(folder, "missing.obj").empty());
    folder.write("deep.gltf", std::string(100000, '['));
    CHECK(names_in(folder, "deep.gltf").empty());

    FilesInUse files;
    files.add_read({"the mesh", (folder / "mesh.obj").string()});
    files.add_written({"the samples", (folder / "new.png").string()});
    check_fails(ExitCode::usage, "my wood.png: the picture would replace a file that ", [&] {
        files.add_written({"the picture", (folder / "my wood.png").string()});
    });
}

TEST_CASE("files that a mesh names are found as the readers find them") {
    const TemporaryFolder folder;
    for (const char* const name : {"a.bin", "my wood.png"}) {
        folder.write(name, "");
    }
    const auto names_of_obj = [&](const std::string& obj, const std::string& mtl) {
        folder.write("wood.mtl", mtl);
        folder.write("mesh.obj", obj);
        return names_in(folder, "mesh.obj");
    };
    const Names both{"my wood.png", "wood.mtl"};
    const std::string plain = "newmtl m\nmap_Kd my wood.png\n";
    CHECK(names_of_obj("mtllib missing.mtl \\\n wood.mtl\n", plain) == both);
    CHECK(names_of_obj("mtl\\\r\nlib wo\\\r\nod.mtl # of oak\r\n", plain) == both);
    CHECK(names_of_obj("mtllib wood.mtl\n", "newmtl m\nmap_Kd my wood.png # of oak\n") == both);
    std::string options;
    for (int i = 0; i < 50; ++i) {
        options += "-blendu on ";
    }
    CHECK(names_of_obj("mtllib wood.mtl\n", "newmtl m\nmap_Kd " + options + "my wood.png\n") ==
          both);

    const auto names_of_gltf = [&](const std::string& before) {
        folder.write("mesh.gltf", R"({"asset": {"version": "2.0"}, "extras": )" + before +
                                      R"(, "buffers": [{"uri": "a.bin"}]})");
        return names_in(folder, "mesh.gltf");
    };
    CHECK(names_of_gltf("\"K\xf6ln\"") == Names{"a.bin"});
    CHECK(names_of_gltf("NaN") == Names{"a.bin"});
    CHECK(names_of_gltf("-Infinity") == Names{"a.bin"});
}
