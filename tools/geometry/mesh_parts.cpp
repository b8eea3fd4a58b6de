#include "geometry/mesh_parts.hpp"

#include <algorithm>
#include <vector>

#include <geodisk/detail/vertex_sets.hpp>

namespace geodisk::tools {
namespace {

bool takes_part(const std::uint32_t* corners) {
    return corners[0] != corners[1] && corners[1] != corners[2] && corners[2] != corners[0];
}

} // namespace

std::vector<std::uint32_t> part_of_triangles(std::span<const std::uint32_t> triangles) {
    const std::uint32_t last = triangles.empty() ? 0 : *std::ranges::max_element(triangles);
    VertexSets sets(last + 1);
    for (std::size_t i = 0; i < triangles.size(); i += 3) {
        if (const std::uint32_t* const corners = &triangles[i]; takes_part(corners)) {
            sets.join(corners[0], corners[1]);
            sets.join(corners[1], corners[2]);
        }
    }
    std::vector<std::uint32_t> numbers(std::size_t{last} + 1, kNoPart); // By lowest vertex.
    std::vector<std::uint32_t> parts(triangles.size() / 3, kNoPart);
    std::uint32_t count = 0;
    for (std::size_t face = 0; face < parts.size(); ++face) {
        if (const std::uint32_t* const corners = &triangles[3 * face]; takes_part(corners)) {
            std::uint32_t& number = numbers[sets.lowest(corners[0])];
            number = number == kNoPart ? count++ : number;
            parts[face] = number;
        }
    }
    return parts;
}

std::vector<std::uint32_t> part_of_faces(const PreparedMesh& mesh) {
    std::vector<std::uint32_t> triangles;
    triangles.reserve(mesh.half_edges().size());
    for (const HalfEdge& edge : mesh.half_edges()) {
        triangles.push_back(edge.origin);
    }
    return part_of_triangles(triangles);
}

BareParts parts_without(const PreparedMesh& mesh, std::span<const std::uint32_t> faces,
                        std::span<const std::uint8_t> mask) {
    if (mesh.statistics().components == 1) {
        return {};
    }
    struct Part {
        bool has_sample = false, takes_samples = false;
        double area = 0; ///< Area that takes samples.
    };
    const std::vector<std::uint32_t> part_of = part_of_faces(mesh);
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
