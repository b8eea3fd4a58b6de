// The meshes of a glTF file, before nodes place them.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include <glm/vec3.hpp>

#include "files/meshes/draco_mesh.hpp"
#include "files/meshes/gltf_data.hpp"
#include "files/meshes/gltf_json.hpp"
#include "files/meshes/gltf_materials.hpp"
#include "files/meshes/mesh_fields.hpp"

namespace geodisk::tools {

/// Vertices that one primitive or several have.
struct GltfVertices {
    std::vector<glm::dvec3> points;
    /// As many joints and weights for each point, where it has any.
    std::size_t joints_per_point = 0;
    std::vector<std::uint32_t> joints;
    std::vector<double> weights;
};

/// Values that an attribute has at the vertices of a primitive.
struct GltfField {
    /// Nodes turn normals. Those of a material are the texture coordinates for its image.
    enum class Role : std::uint8_t { attribute, normals, material_uvs };

    MeshField field;      ///< Without values if they are not wanted.
    std::string accessor; ///< Name in the file.
    Role role = Role::attribute;
};

struct GltfPrimitive {
    std::uint32_t number = 0; ///< In its mesh.
    std::size_t vertices = 0; ///< Index of its GltfVertices.
    /// Vertices of it: three for each triangle, two for each line, or one for each point.
    std::vector<std::uint32_t> corners;
    std::optional<std::uint32_t> material;
    std::vector<GltfField> fields; ///< All that it has.
    bool has_lines = false;
};

struct GltfMesh {
    std::vector<GltfVertices> vertices;
    std::vector<GltfPrimitive> primitives; ///< Those that are wanted.
    std::uint64_t others = 0;              ///< Number of those that are not.
};

/// Primitives to read.
enum class GltfKind : std::uint8_t { triangles, points_and_lines };

/// Reads triangles, strips and fans, also those that Draco has compressed; or points, and lines,
/// loops and strips of them. Primitives of the same positions share vertices. Throws
/// UserError(bad_input) naming mesh and primitive.
class GltfMeshReader {
  public:
    /// Reads `materials` of primitives if WantedFields::materials.
    GltfMeshReader(const GltfDocument& document, GltfData& data, const WantedFields& fields,
                   GltfMaterials& materials, GltfKind kind = GltfKind::triangles)
        : document_(document), data_(data), fields_(fields), materials_(materials), kind_(kind) {}

    /// Reads mesh `index` with its morph targets by `weights`, or by its own for none.
    GltfMesh read(std::uint64_t index, std::vector<double> weights);

    /// Returns warnings about attributes that are left out.
    const std::vector<MeshWarning>& warnings() const noexcept { return warnings_; }

  private:
    /// Accessors of what makes vertices; those of other primitives that are equal share them.
    using Key = std::vector<std::uint64_t>;
    struct Source {
        const GltfJson& primitive;
        const GltfJson& attributes;
        DracoMesh draco;
        std::map<std::string, std::uint32_t> draco_ids; ///< By attribute.
    };

    void add_primitive(const GltfJson& primitive, std::uint32_t number, GltfMesh& mesh);
    void decode_draco(Source& source);
    Key key_of(const Source& source) const;
    GltfVertices read_vertices(const Source& source);
    std::vector<GltfField> read_fields(const Source& source, std::size_t vertices);
    void read_values(const Source& source, std::size_t vertices, std::size_t components,
                     GltfField& field);
    std::vector<double> field_values(const Source& source, const std::string& name,
                                     std::size_t vertices);
    bool is_wanted(const std::string& name) const;
    void read_joints(const Source& source, GltfVertices& vertices);
    void move_targets(const Source& source, std::vector<glm::dvec3>& points);
    std::vector<double> attribute(const Source& source, const std::string& name,
                                  std::uint64_t accessor, std::string_view type);
    /// The same of any type.
    std::vector<double> attribute(const Source& source, const std::string& name,
                                  std::uint64_t accessor);
    std::vector<std::uint32_t> indices_of(const Source& source, std::size_t vertices);
    std::vector<std::uint32_t> corners_of(const Source& source, std::uint64_t mode,
                                          std::size_t vertices);

    const GltfDocument& document_;
    GltfData& data_;
    const WantedFields& fields_;
    GltfMaterials& materials_;
    GltfKind kind_;
    std::string place_;           ///< The primitive that is being read, for messages.
    std::string material_uvs_;    ///< Attribute that its material needs, or "".
    std::vector<double> weights_; ///< Weights of morph targets.
    std::map<Key, std::size_t> known_;
    std::vector<MeshWarning> warnings_;
};

} // namespace geodisk::tools
