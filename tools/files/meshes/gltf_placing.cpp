#include "files/meshes/gltf_placing.hpp"

namespace geodisk::tools {

GltfPlacing::GltfPlacing(const GltfDocument& document, GltfScene& scene,
                         const GltfPlacement& placement, const glm::dmat4& transform)
    : document_(document), mesh_(placement.mesh), transform_(transform) {
    if (placement.skin) {
        joints_ = &scene.joint_matrices(*placement.skin);
    } else {
        mirrored_ = glm::determinant(transform) < 0 ? 1 : 0;
    }
}

glm::dvec3 GltfPlacing::place(const GltfVertices& vertices, std::size_t i) {
    const std::optional<glm::dmat4> matrix = matrix_of(vertices, i);
    if (!matrix) {
        document_.fail("mesh " + std::to_string(mesh_) + ": vertex " + std::to_string(i) +
                       " has a joint that its skin has not");
    }
    if (joints_ != nullptr) {
        mirrored_ += glm::determinant(*matrix) < 0 ? 1 : -1;
    }
    return glm::dvec3(*matrix * glm::dvec4(vertices.points[i], 1));
}

glm::dvec3 GltfPlacing::turn(const GltfVertices& vertices, std::size_t i,
                             const glm::dvec3& normal) const {
    const glm::dmat3 m(matrix_of(vertices, i).value_or(transform_));
    const glm::dmat3 cofactors(glm::cross(m[1], m[2]), glm::cross(m[2], m[0]),
                               glm::cross(m[0], m[1]));
    return (glm::determinant(m) < 0 ? -1.0 : 1.0) * (cofactors * normal);
}

std::optional<glm::dmat4> GltfPlacing::matrix_of(const GltfVertices& vertices,
                                                 std::size_t i) const {
    if (joints_ == nullptr || vertices.joints_per_point == 0) {
        return transform_;
    }
    const std::size_t begin = i * vertices.joints_per_point;
    double sum = 0;
    glm::dmat4 result(0);
    for (std::size_t k = begin; k < begin + vertices.joints_per_point; ++k) {
        const double weight = vertices.weights[k];
        if (weight == 0) {
            continue;
        }
        if (vertices.joints[k] >= joints_->size()) {
            return std::nullopt;
        }
        sum += weight;
        result += weight * (*joints_)[vertices.joints[k]];
    }
    if (sum != 0) {
        return result / sum;
    }
    // Weights that are all zero: as viewers do, by the first joint alone.
    const std::uint32_t joint = vertices.joints[begin];
    return joint < joints_->size() ? std::optional((*joints_)[joint]) : std::nullopt;
}

} // namespace geodisk::tools
