// Saved meshes with bytes changed and the checksum not looked at: what load() takes must be a mesh
// that distances can be computed on.
#include <cstddef>
#include <cstdint>
#include <vector>

#include <geodisk/mesh.hpp>

#include "lib/frame.hpp"
#include "support/geodesic_query.hpp"

#define DOCTEST_CONFIG_IMPLEMENT
#include <doctest/doctest.h>

using namespace geodisk;
using namespace geodisk::test;

namespace {

std::vector<std::vector<std::byte>> saved_meshes() {
    std::vector<std::vector<std::byte>> all;
    for (const char* const name : {"cube", "moebius", "icosphere", "tube", "klein-bottle"}) {
        const int least = std::string_view(name) == "icosphere" ? 0 : 3;
        all.push_back(prepared(builtin(name, least)).save().value());
    }
    return all;
}

} // namespace

/// The first byte chooses a mesh; three more at a time change one byte each.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    static const auto meshes = saved_meshes();
    if (size == 0) {
        return 0;
    }
    std::vector<std::byte> bytes = meshes[data[0] % meshes.size()];
    for (std::size_t i = 1; i + 2 < size; i += 3) {
        bytes[(std::size_t{data[i]} << 8 | data[i + 1]) % bytes.size()] = std::byte{data[i + 2]};
    }
    const auto mesh = PreparedMesh::load(bytes, ThreadOptions{1});
    if (mesh) {
        const double reach = mesh->statistics().longest_edge;
        const std::vector<Point> targets{face_point(mesh->face_count() - 1, 0.3, 0.3)};
        GeodesicQuery<float>(*mesh, reach, targets, ref::frame_of(*mesh, reach).tolerances())
            .from(face_point(0, 0.3, 0.3));
    }
    return 0;
}
