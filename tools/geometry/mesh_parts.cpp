#include "geometry/mesh_parts.hpp"

#include <algorithm>
#include <array>
#include <vector>

#include <geodisk/vertex_sets.hpp>

namespace geodisk::tools {
namespace {

std::array<std::uint32_t, 3> corners_of(const PreparedMesh& mesh, std::uint32_t face) {
    const HalfEdge* const edges = &mesh.half_edges()[std::size_t{3} * face];
    return {edges[0].origin, edges[1].origin, edges[2].origin};
}

bool takes_part(const std::array<std::uint32_t, 3>& corners) {
    const auto [a, b, c] = corners;
    return a != b && b != c && c != a;
}

} // namespace

std::vector<std::uint32_t> part_of_triangles(const PreparedMesh& mesh) {
    VertexSets sets(mesh.vertex_count());
    for (std::uint32_t face = 0; face < mesh.face_count(); ++face) {
        if (const auto corners = corners_of(mesh, face); takes_part(corners)) {
            sets.join(corners[0], corners[1]);
            sets.join(corners[1], corners[2]);
        }
    }
    std::vector<std::uint32_t> numbers(mesh.vertex_count(), kNoPart); // By lowest vertex.
    std::vector<std::uint32_t> parts(mesh.face_count(), kNoPart);
    std::uint32_t count = 0;
    for (std::uint32_t face = 0; face < mesh.face_count(); ++face) {
        if (const auto corners = corners_of(mesh, face); takes_part(corners)) {
            std::uint32_t& number = numbers[sets.lowest(corners[0])];
            number = number == kNoPart ? count++ : number;
            parts[face] = number;
        }
    }
    return parts;
}

BareParts parts_without(const PreparedMesh& mesh, std::span<const std::uint32_t> faces,
                        std::span<const std::uint8_t> mask) {
    if (mesh.statistics().components == 1) {
        return {};
    }
    struct Part {
        bool has_sample = false, takes_samples = false;
        double area = 0; ///< That takes samples.
    };
    const std::vector<std::uint32_t> part_of = part_of_triangles(mesh);
    std::vector<Part> parts(mesh.statistics().components);
    for (const std::uint32_t face : faces) {
        if (part_of[face] != kNoPart) {
            parts[part_of[face]].has_sample = true;
        }
    }
    for (std::uint32_t face = 0; face < mesh.face_count(); ++face) {
        if (part_of[face] != kNoPart && (mask.empty() || mask[face] != 0)) {
            const HalfEdge& edge = mesh.half_edges()[std::size_t{3} * face];
            parts[part_of[face]].takes_samples = true;
            parts[part_of[face]].area += 0.5 * edge.length * edge.apex_y;
        }
    }
    BareParts bare;
    bare.parts = 0;
    double area = 0, bare_area = 0;
    for (const Part& part : parts) {
        const bool is_bare = part.takes_samples && !part.has_sample;
        bare.parts += part.takes_samples;
        bare.count += is_bare;
        area += part.area;
        bare_area += is_bare ? part.area : 0;
    }
    bare.area_share = bare_area > 0 ? bare_area / area : 0;
    return bare;
}

} // namespace geodisk::tools
