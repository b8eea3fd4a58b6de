// Readers of large files tell how far they are, and end when asked to.
#include "files/meshes/mesh_file.hpp"

#include "test_files.hpp"

#include <algorithm>
#include <stdexcept>
#include <string>
#include <vector>

using namespace geodisk::tools;

namespace {

std::string row(std::string_view keyword, std::size_t a, std::size_t b, std::size_t c) {
    return std::string(keyword) + std::to_string(a) + " " + std::to_string(b) + " " +
           std::to_string(c) + "\n";
}

/// The bytes of a file with more records than are read at a time: a strip of triangles.
struct LargeFile {
    std::string name, bytes;
};

std::vector<LargeFile> large_files() {
    constexpr std::size_t kFaces = 70000;
    const std::string vertices = std::to_string(kFaces + 2);
    const std::string faces = std::to_string(kFaces);
    LargeFile obj{"strip.obj", ""};
    LargeFile off{"strip.off", "OFF\n" + vertices + " " + faces + " 0\n"};
    LargeFile ply{"strip.ply", "ply\nformat ascii 1.0\nelement vertex " + vertices +
                                   "\nproperty float x\nproperty float y\nproperty float z\n"
                                   "element face " +
                                   faces +
                                   "\nproperty list uchar int vertex_indices\nend_header\n"};
    LargeFile text_stl{"strip.stl", "solid strip\n"};
    LargeFile stl{"binary.stl", std::string(80, ' ')};
    for (int i = 0; i < 4; ++i) {
        stl.bytes += static_cast<char>(kFaces >> 8 * i);
    }
    for (std::size_t v = 0; v < kFaces + 2; ++v) {
        obj.bytes += row("v ", v, v % 2, 0);
        off.bytes += row("", v, v % 2, 0);
        ply.bytes += row("", v, v % 2, 0);
    }
    for (std::size_t f = 0; f < kFaces; ++f) {
        obj.bytes += row("f ", f + 1, f + 2, f + 3);
        off.bytes += row("3 ", f, f + 1, f + 2);
        ply.bytes += row("3 ", f, f + 1, f + 2);
        text_stl.bytes += "facet normal 0 0 1\nouter loop\n" + row("vertex ", f, f % 2, 0) +
                          row("vertex ", f + 1, (f + 1) % 2, 0) + row("vertex ", f + 2, f % 2, 0) +
                          "endloop\nendfacet\n";
        std::string facet(50, '\0');
        facet[12 + 3] = facet[24 + 7] = '\x40'; // (2, 0, 0), (0, 2, 0) and the origin.
        stl.bytes += facet;
    }
    return {obj, off, ply, text_stl, stl};
}

} // namespace

TEST_CASE("readers tell how far they are, and end when asked to") {
    const TemporaryFolder folder;
    for (const LargeFile& file : large_files()) {
        CAPTURE(file.name);
        MeshSources sources;
        sources.mesh = folder.write(file.name, file.bytes).string();
        std::vector<double> parts;
        sources.progress = [&](double part) { parts.push_back(part); };
        CHECK(read_mesh(sources).triangle_count() == 70000);
        REQUIRE(parts.size() >= 2);
        CHECK(std::is_sorted(parts.begin(), parts.end()));
        CHECK(parts.front() >= 0);
        CHECK(parts.back() > 0.4);
        CHECK(parts.back() <= 1);
        sources.progress = [](double part) {
            if (part > 0.3) {
                throw std::runtime_error("enough");
            }
        };
        CHECK_THROWS_WITH(read_mesh(sources), "enough");
    }
}
