// Places of the vertices of a glTF file.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>

#include "files/meshes/gltf_json.hpp"
#include "files/meshes/gltf_mesh.hpp"
#include "files/meshes/gltf_scene.hpp"

namespace geodisk::tools {

/// Places the vertices of a mesh: all in one way, or each by its joints.
class GltfPlacing {
  public:
    GltfPlacing(const GltfDocument& document, GltfScene& scene, const GltfPlacement& placement,
                const glm::dmat4& transform);

    /// Throws UserError(bad_input) if a weight belongs to a joint that does not exist.
    glm::dvec3 place(const GltfVertices& vertices, std::size_t i);
    /// Returns a normal at a point that place() knows; of any length.
    glm::dvec3 turn(const GltfVertices& vertices, std::size_t i, const glm::dvec3& normal) const;
    /// Returns true if most of the points so far were mirrored.
    bool is_mirrored() const { return mirrored_ > 0; }

  private:
    std::optional<glm::dmat4> matrix_of(const GltfVertices& vertices, std::size_t i) const;

    const GltfDocument& document_;
    std::uint32_t mesh_;
    glm::dmat4 transform_;
    const std::vector<glm::dmat4>* joints_ = nullptr;
    std::int64_t mirrored_ = 0;
};

} // namespace geodisk::tools
