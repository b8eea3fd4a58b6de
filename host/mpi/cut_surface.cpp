#include "cut_surface.hpp"

#include <algorithm>

#include "geodisk/mpi.hpp"
#include "parts/cut.hpp"
#include "parts/halo.hpp"
#include "support/guard.hpp"
#include "support/try.hpp"

namespace geodisk {
namespace {

bool all_have_faces(std::span<const std::uint32_t> parts, std::uint32_t count) {
    std::vector<bool> has_faces(count);
    for (const std::uint32_t part : parts) {
        has_faces[part] = true;
    }
    return std::ranges::find(has_faces, false) == has_faces.end();
}

} // namespace

Result<std::vector<std::uint32_t>> cut_surface(const PreparedMesh& mesh, const SampleParams& params,
                                               std::uint32_t processes) {
    return divide_faces(mesh, work_of_faces(mesh, params), processes);
}

Result<std::vector<std::uint32_t>> divide_faces(const PreparedMesh& mesh,
                                                std::span<const double> work,
                                                std::uint32_t processes) noexcept {
    return guarded([&]() -> Result<std::vector<std::uint32_t>> {
        GEODISK_TRY(check_processes(mesh, processes));
        std::vector<std::uint32_t> parts = metis_parts(mesh, work, processes);
        return all_have_faces(parts, processes) ? parts : halved_parts(mesh, work, processes);
    });
}

Result<std::vector<std::uint32_t>> faces_within(const PreparedMesh& mesh,
                                                std::span<const std::uint8_t> is_marked,
                                                double reach) noexcept {
    return guarded([&]() -> Result<std::vector<std::uint32_t>> {
        std::vector<std::uint32_t> faces;
        for (std::uint32_t face = 0; face < mesh.face_count(); ++face) {
            if (is_marked[face] != 0) {
                faces.push_back(face);
            }
        }
        if (reach > 0) {
            faces = HaloSearch(mesh).search(faces, reach);
        }
        return faces;
    });
}

} // namespace geodisk
