// glTF files: the memory that reading them takes.
#include "files/meshes/mesh_file.hpp"

#include "gltf_parts.hpp"
#include "support/runtime_memory.hpp"

#include <cstdint>
#include <vector>

using namespace geodisk::tools;

TEST_CASE("glTF instances take memory and time in proportion to their number") {
    const auto bytes_for = [](std::size_t instances) {
        std::vector<float> places(3 * instances, 0);
        for (std::size_t i = 0; i < instances; ++i) {
            places[3 * i] = static_cast<float>(2 * i);
        }
        LongerSquare square;
        square.add(bytes_of_values<float>(places), 5126, static_cast<int>(instances), "VEC3");
        square.parts.nodes = R"("nodes": [{"mesh": 0, "extensions":
            {"EXT_mesh_gpu_instancing": {"attributes": {"TRANSLATION": 2}}}}],)";
        const std::uint64_t before = geodisk::test::allocated_bytes();
        const MeshFile mesh = square.mesh();
        CHECK(mesh.triangle_count() == 2 * instances);
        CHECK(mesh.positions[mesh.positions.size() - 3] == 2 * static_cast<double>(instances - 1));
        return static_cast<double>(geodisk::test::allocated_bytes() - before);
    };
    // Copying all before for each of them would take four times as much.
    CHECK(bytes_for(8000) < 2.5 * bytes_for(4000));
}
