#include "geometry/vertex_normals.hpp"

#include <cstddef>

#include "geometry/angles.hpp"

namespace geodisk::tools {

Vec3 direction(Vec3 v) {
    const double largest = largest_coordinate(v); // Products of these stay in the range of double.
    return largest > 0 ? normalize(v / largest) : Vec3{};
}

std::vector<Vec3> normal_sums(const MeshFile& mesh) {
    std::vector<Vec3> sums(mesh.positions.size() / 3);
    for (std::size_t i = 0; i < mesh.triangles.size(); i += 3) {
        Vec3 corners[3];
        for (std::size_t k = 0; k < 3; ++k) {
            corners[k] = point_at(mesh.positions, mesh.triangles[i + k]);
        }
        for (std::size_t k = 0; k < 3; ++k) {
            const Vec3 to_next = direction(corners[(k + 1) % 3] - corners[k]);
            const Vec3 to_last = direction(corners[(k + 2) % 3] - corners[k]);
            const Vec3 normal = cross(to_next, to_last);
            const double angle = angle_of(length(normal), dot(to_next, to_last));
            sums[mesh.triangles[i + k]] += angle * direction(normal);
        }
    }
    return sums;
}

} // namespace geodisk::tools
