// A mesh reads no file outside of its folder, whatever its format.
#include "files/meshes/file_scope.hpp"

#include <array>
#include <string>

#include "files/meshes/mesh_file.hpp"

#include "gltf_parts.hpp"
#include "png_bytes.hpp"
#include "test_files.hpp"

using namespace geodisk::tools;

namespace {

/// Kind of file that a mesh in the folder `in` names.
enum class Named { library, image, buffer };

constexpr std::array kAll{Named::library, Named::image, Named::buffer};

class NamingMesh {
  public:
    explicit NamingMesh(Named kind) : kind_(kind) {
        std::filesystem::create_directories(folder / "in/sub");
        for (const std::string place : {"", "in/", "in/sub/"}) {
            folder.write(place + "named", kind == Named::library ? "newmtl m\n"
                                          : kind == Named::image ? png_bytes(1, 1, "\x80", 8, 0)
                                                                 : kBuffer);
        }
    }

    /// Reads the mesh when it names `name`.
    void read(const std::string& name, bool allows_outside = false) const {
        MeshSources sources;
        sources.mesh = write(name).string();
        sources.fields.materials = kind_ != Named::buffer;
        sources.allows_outside = allows_outside;
        const MeshFile mesh = read_mesh(sources);
        CHECK(mesh.triangle_count() > 0);
    }

    void check_refused(const std::string& name, const std::string& said) const {
        check_fails(ExitCode::bad_input,
                    said + " is not a file of its folder, so it is not read; add --allow-outside "
                           "if you trust the mesh",
                    [&] { read(name); });
    }

    TemporaryFolder folder;

  private:
    std::filesystem::path write(const std::string& name) const {
        if (kind_ == Named::buffer) {
            Parts parts;
            parts.buffer = "\"uri\": \"" + name + "\", \"byteLength\": 60";
            return folder.write("in/mesh.gltf", text_of(parts));
        }
        folder.write("in/mesh.mtl", "newmtl m\nmap_Kd " + name + '\n');
        const std::string library = kind_ == Named::library ? name : "mesh.mtl";
        return folder.write("in/mesh.obj", "mtllib " + library +
                                               "\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nusemtl m\n"
                                               "f 1/1 2/1 3/1\n");
    }

    Named kind_;
};

} // namespace

TEST_CASE("files that a mesh names are read from its folder alone") {
    for (const Named kind : kAll) {
        CAPTURE(static_cast<int>(kind));
        const NamingMesh mesh(kind);
        mesh.read("named");
        mesh.read("./named");
        mesh.read("sub/named");
        mesh.read("sub/../named");
        const std::string whole = (mesh.folder / "named").generic_string();
        for (const std::string& name :
             {std::string("../named"), std::string("sub/../../named"), whole,
              std::string("/etc/passwd"), std::string("file:named"),
              std::string("http://example.org/named")}) {
            mesh.check_refused(name, '\'' + name + '\'');
        }
        mesh.read("../named", true);
        mesh.read(whole, true);
    }
}

#ifndef _WIN32
TEST_CASE("links that a mesh names are followed before its folder is compared") {
    for (const Named kind : kAll) {
        CAPTURE(static_cast<int>(kind));
        const NamingMesh mesh(kind);
        const std::filesystem::path in = mesh.folder / "in";
        std::filesystem::create_symlink("sub/named", in / "inner");
        std::filesystem::create_symlink("../named", in / "outer");
        std::filesystem::create_directory_symlink("..", in / "up");
        mesh.read("inner");
        const std::string target =
            (std::filesystem::canonical(mesh.folder / ".") / "named").string() + ", which";
        mesh.check_refused("outer", "'outer' leads to " + target);
        mesh.check_refused("up/named", "'up/named' leads to " + target);
        mesh.read("outer", true);
        mesh.read("up/named", true);
    }
}

TEST_CASE("a folder that is a link itself is that of its mesh") {
    const NamingMesh mesh(Named::library);
    mesh.read("named");
    std::filesystem::create_directory_symlink("in", mesh.folder / "link");
    MeshSources sources;
    sources.mesh = (mesh.folder / "link/mesh.obj").string();
    sources.fields.materials = true;
    CHECK(read_mesh(sources).triangle_count() == 1);
}
#endif
