#include "parts/near_part.hpp"

#include <algorithm>
#include <utility>

#include "parts/cut.hpp"
#include "parts/halo.hpp"
#include "support/try.hpp"

namespace geodisk {

Result<NearPart> near_part(const PreparedMesh& mesh, std::span<const std::uint32_t> owners,
                           std::uint32_t part, double reach) {
    std::vector<std::uint32_t> own;
    for (std::uint32_t face = 0; face < mesh.face_count(); ++face) {
        if (owners[face] == part) {
            own.push_back(face);
        }
    }
    NearPart near;
    near.faces = HaloSearch(mesh).search(own, reach);
    near.local = Ranks(mesh.face_count(), near.faces);
    auto made = mesh.part(near.faces);
    GEODISK_TRY(made);
    near.mesh = std::make_unique<PreparedMesh>(std::move(*made));
    return near;
}

std::vector<std::uint32_t> equal_parts(const PreparedMesh& mesh, std::uint32_t parts) {
    const std::vector<double> work(mesh.face_count(), 1.0 / mesh.face_count());
    return halved_parts(mesh, work, parts);
}

} // namespace geodisk
