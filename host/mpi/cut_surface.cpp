#include "cut_surface.hpp"

#include <algorithm>

#include "parts/cut.hpp"

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
    return cut_by_work(mesh, work_of_faces(mesh, params), processes);
}

Result<std::vector<std::uint32_t>>
cut_by_work(const PreparedMesh& mesh, std::span<const double> work, std::uint32_t processes) {
    std::vector<std::uint32_t> parts = metis_parts(mesh, work, processes);
    return all_have_faces(parts, processes) ? parts : grown_parts(mesh, work, processes);
}

} // namespace geodisk
