#include "mesh/mesh_digest.hpp"

#include <bit>

namespace geodisk {
namespace {

void add(std::uint64_t& digest, std::uint64_t word) {
    digest = (digest ^ word) * 0x9e3779b97f4a7c15u;
    digest ^= digest >> 29;
}

} // namespace

std::uint64_t face_digest(std::uint64_t face, const std::uint32_t* corners,
                          std::span<const HalfEdge, 3> edges) {
    std::uint64_t digest = 0;
    add(digest, face + 1);
    for (std::size_t k = 0; k < 3; ++k) {
        add(digest, corners[k]);
        for (const double x : {edges[k].length, edges[k].apex_x, edges[k].apex_y}) {
            add(digest, std::bit_cast<std::uint64_t>(x));
        }
    }
    return digest;
}

std::uint64_t field_digest(std::uint64_t face, const RadiusField* radii, std::uint32_t in_radii,
                           bool takes_samples) {
    std::uint64_t digest = 0;
    add(digest, face + 1);
    add(digest, takes_samples ? 1 : 0);
    const std::size_t first = std::size_t{3} * in_radii;
    for (std::size_t h = first; radii != nullptr && h < first + 3; ++h) {
        add(digest, std::bit_cast<std::uint32_t>(radii->spreads()[h]));
        const auto packing = radii->packing();
        add(digest,
            std::bit_cast<std::uint32_t>(packing.empty() ? radii->factors()[h] : packing[h]));
    }
    return digest;
}

std::uint64_t surface_digest(const PreparedMesh& mesh, const SampleParams& params) {
    std::uint64_t sum = 0;
    for (std::uint32_t face = 0; face < mesh.face_count(); ++face) {
        const auto edges = mesh.half_edges().subspan(std::size_t{3} * face).first<3>();
        const std::uint32_t corners[3] = {edges[0].origin, edges[1].origin, edges[2].origin};
        sum += face_digest(face, corners, edges);
        if (params.radii != nullptr || !params.face_mask.empty()) {
            const bool takes = params.face_mask.empty() || params.face_mask[face] != 0;
            sum += field_digest(face, params.radii, face, takes);
        }
    }
    return sum;
}

} // namespace geodisk
