// The nodes of a glTF file: which meshes its scene has, and where.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include <glm/mat4x4.hpp>

#include "files/meshes/gltf_data.hpp"
#include "files/meshes/gltf_json.hpp"
#include "geometry/mesh_warning.hpp"

namespace geodisk::tools {

/// A mesh that a node places.
struct GltfPlacement {
    std::optional<std::uint32_t> node;
    std::uint32_t mesh = 0;
    std::vector<glm::dmat4> transforms; ///< One, or those of instances.
    std::optional<std::uint64_t> skin;
    std::vector<double> weights; ///< Weights of morph targets, if the node has its own.
};

/// Throws UserError(bad_input), also if nodes make no tree.
class GltfScene {
  public:
    GltfScene(const GltfDocument& document, GltfData& data) : document_(document), data_(data) {}

    /// Returns the meshes of the default scene, else of the first; without scenes, those of all
    /// nodes; without nodes, all meshes. A node comes before those below it, in the order of the
    /// file.
    std::vector<GltfPlacement> placements();

    /// Returns the node that each one is directly below, of those that placements() met.
    const std::vector<std::optional<std::uint32_t>>& nodes_above() const noexcept { return above_; }

    /// Warns of the nodes that placements() left out because the file says that they are hidden.
    void add_warnings(std::vector<MeshWarning>& warnings) const;

    /// Returns the matrices that place vertices by the joints of `skin`, in their order.
    const std::vector<glm::dmat4>& joint_matrices(std::uint64_t skin);

  private:
    const GltfJson& node(std::uint64_t index) const { return document_.at("nodes", "node", index); }
    std::vector<std::uint64_t> root_nodes() const;
    glm::dmat4 transform_of(const GltfJson& node, const std::string& name) const;
    std::vector<glm::dmat4> instances_of(const GltfJson& node, const std::string& name);
    void add_nodes(std::uint64_t root, std::vector<GltfPlacement>& placements);
    glm::dmat4 global_transform(std::uint64_t node);

    const GltfDocument& document_;
    GltfData& data_;
    std::vector<bool> is_met_;
    std::vector<std::optional<std::uint32_t>> above_;
    std::vector<std::optional<std::uint64_t>> parents_; ///< Made for the first skin.
    std::map<std::uint64_t, glm::dmat4> globals_;       ///< By node, as skins need them.
    std::map<std::uint64_t, std::vector<glm::dmat4>> skins_;
    std::uint64_t hidden_nodes_ = 0; ///< Without those below them.
};

} // namespace geodisk::tools
