// Any bytes as a file of one kind.
#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

#include "files/image.hpp"
#include "files/mesh_file.hpp"
#include "files/sample_fields.hpp"
#include "files/sample_file.hpp"
#include "files/sidecar_files.hpp"
#include "program/failure.hpp"

#include <geodisk/mesh.hpp>

#define DOCTEST_CONFIG_IMPLEMENT
#include "unit/test_files.hpp"

using namespace geodisk;
using namespace geodisk::tools;

namespace {

/// All attributes must be there for all triangles, or be refused.
[[maybe_unused]] void read_attributes(const Path& path) {
    MeshSources sources;
    sources.mesh = path.string();
    sources.fields = {{}, true, true, false};
    try {
        const MeshFile mesh = read_mesh(sources);
        std::vector<SampleRow> rows;
        for (std::uint32_t t = 0; t < mesh.triangle_count(); ++t) {
            if (mesh.takes_part(t)) {
                rows.emplace_back().face = t;
                rows.back().bary[t % 3] = 1;
            }
        }
        sample_fields(mesh, rows);
        if (mesh.normals) {
            file_normal(mesh, rows.at(0));
        }
    } catch (const UserError&) {
    }
}

/// What was read must do for preparing, or be refused by that.
[[maybe_unused]] void read_as_mesh(const Path& path) {
    read_attributes(path);
    const MeshFile mesh = read_mesh(path.string());
    const auto prepared =
        PreparedMesh::prepare({mesh.positions, mesh.triangles, mesh.dimension}, ThreadOptions{1});
    if (!prepared && prepared.error().message.empty()) {
        __builtin_trap();
    }
}

[[maybe_unused]] void read_as_samples(const Path& path) {
    try {
        read_samples(path);
    } catch (const UserError&) {
        read_box_samples(path);
    }
}

[[maybe_unused]] void read_as_side_files(const Path& path) {
    try {
        read_coordinates(path);
    } catch (const UserError&) {
    }
    try {
        EdgeLengths lengths(path, 1);
        lengths.between(0, 1);
    } catch (const UserError&) {
    }
    read_values(path);
}

[[maybe_unused]] void read_as_image(const Path& path) {
    const ColourImage colours(path);
    colours.at(0.3, 0.7);
    const GreyImage image(path);
    for (const double at : {0.0, 0.3, 0.999999, -7.2}) {
        const double value = image.at(at, 1 - at);
        if (!(value >= 0 && value <= 1)) {
            __builtin_trap();
        }
    }
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    static const TemporaryFolder folder;
    const Path path = folder.write(GEODISK_FUZZ_NAME, {reinterpret_cast<const char*>(data), size});
    try {
        GEODISK_FUZZ_READ(path);
    } catch (const UserError& error) {
        if (std::string_view(error.what()).empty()) {
            __builtin_trap();
        }
    }
    return 0;
}
