#include <algorithm>
#include <array>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <glm/mat4x4.hpp>

#include "files/file_scope.hpp"
#include "files/gltf_chunks.hpp"
#include "files/gltf_data.hpp"
#include "files/gltf_json.hpp"
#include "files/gltf_materials.hpp"
#include "files/gltf_mesh.hpp"
#include "files/gltf_scene.hpp"
#include "files/input_file.hpp"
#include "files/polygon_mesh.hpp"
#include "files/text_file.hpp"
#include "program/failure.hpp"
#include "program/human_text.hpp"

namespace geodisk::tools {
namespace {

enum class Extension { read, ignored, unknown };

/// What becomes of an extension that a file requires, also for the colours of materials if wanted.
Extension kind_of(std::string_view name, bool has_materials) {
    constexpr std::array<std::string_view, 6> kRead{
        "EXT_mesh_gpu_instancing", "EXT_meshopt_compression", "KHR_draco_mesh_compression",
        "KHR_meshopt_compression", "KHR_mesh_quantization",   "KHR_node_visibility"};
    constexpr std::array<std::string_view, 2> kReadOfMaterials{
        "KHR_materials_pbrSpecularGlossiness", "KHR_texture_transform"};
    // Of materials, pictures and whatever else leaves the surface as it is.
    constexpr std::array<std::string_view, 17> kHarmless{
        "material",  "texture", "light",    "technique", "image",     "camera",
        "animation", "audio",   "metadata", "xmp",       "packing",   "outline",
        "features",  "_lod",    "hoverab",  "selectab",  "interactiv"};
    if (std::ranges::find(kRead, name) != kRead.end() ||
        (has_materials && std::ranges::find(kReadOfMaterials, name) != kReadOfMaterials.end())) {
        return Extension::read;
    }
    const std::string lower = lower_case(std::string(name));
    const bool is_harmless = std::ranges::any_of(
        kHarmless, [&](std::string_view part) { return lower.find(part) != std::string::npos; });
    return is_harmless ? Extension::ignored : Extension::unknown;
}

/// Places points: all in one way, or each by its joints.
class Placing {
  public:
    explicit Placing(const glm::dmat4& transform)
        : transform_(transform), mirrored_(glm::determinant(transform) < 0 ? 1 : 0) {}
    Placing(const glm::dmat4& transform, const std::vector<glm::dmat4>& joints)
        : transform_(transform), joints_(&joints) {}

    /// Nothing if a weight belongs to a joint that there is not.
    std::optional<glm::dvec3> place(const GltfVertices& vertices, std::size_t i) {
        const std::optional<glm::dmat4> matrix = matrix_of(vertices, i);
        if (!matrix) {
            return std::nullopt;
        }
        if (joints_ != nullptr) {
            mirrored_ += glm::determinant(*matrix) < 0 ? 1 : -1;
        }
        const glm::dvec4 placed = *matrix * glm::dvec4(vertices.points[i], 1);
        return glm::dvec3(placed);
    }
    /// Returns a normal at a point that place() knows; of any length.
    glm::dvec3 turn(const GltfVertices& vertices, std::size_t i, const glm::dvec3& normal) const {
        const glm::dmat3 m(matrix_of(vertices, i).value_or(transform_));
        const glm::dmat3 cofactors(glm::cross(m[1], m[2]), glm::cross(m[2], m[0]),
                                   glm::cross(m[0], m[1]));
        return (glm::determinant(m) < 0 ? -1.0 : 1.0) * (cofactors * normal);
    }
    /// True if most of the points so far were mirrored.
    bool is_mirrored() const { return mirrored_ > 0; }

  private:
    std::optional<glm::dmat4> matrix_of(const GltfVertices& vertices, std::size_t i) const {
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

    glm::dmat4 transform_;
    const std::vector<glm::dmat4>* joints_ = nullptr;
    std::int64_t mirrored_ = 0;
};

class GltfReader {
  public:
    GltfReader(const Path& path, GltfChunks&& chunks, const WantedFields& fields,
               const FileScope& scope)
        : document_(path, std::move(chunks.json)), data_(document_, chunks.binary, scope),
          scene_(document_, data_), materials_(document_, data_),
          meshes_(document_, data_, fields, materials_), has_materials_(fields.materials) {}

    PolygonMesh read() && {
        mesh_.names = {"triangle ", "vertex ", {}, {}, 0};
        check_extensions();
        for (const GltfPlacement& placement : scene_.placements()) {
            add_mesh(placement);
        }
        for (MeshField& field : mesh_.fields) {
            pad(field);
        }
        for (std::optional<MeshField>* const field : {&mesh_.normals, &mesh_.material_uvs}) {
            if (*field) {
                pad(**field);
            }
        }
        if (has_materials_) {
            mesh_.materials = std::move(materials_).take();
        }
        mesh_.part_names = {names_of("materials"), {}, names_of("nodes"), scene_.nodes_above()};
        warn();
        return std::move(mesh_);
    }

  private:
    void check_extensions() {
        for (const GltfJson& value :
             document_.array(document_.root(), "extensionsRequired", "the file")) {
            const std::string name = value.is_string() ? value.get<std::string>() : value.dump();
            switch (kind_of(name, has_materials_)) {
            case Extension::read:
                break;
            case Extension::ignored:
                mesh_.warnings.push_back(
                    {"ignored_extension",
                     1,
                     "",
                     "extension " + in_quotes(name) +
                         " is required and ignored: it does not change the surface",
                     {}});
                break;
            case Extension::unknown:
                document_.fail("requires the extension " + in_quotes(name) +
                               ", which is not read and may change the surface");
            }
        }
    }

    /// Names of the elements of a top-level array; "" for those without.
    std::vector<std::string> names_of(const char* list) const {
        std::vector<std::string> names;
        const auto elements = document_.root().find(list);
        if (elements == document_.root().end() || !elements->is_array()) {
            return names;
        }
        for (const GltfJson& element : *elements) {
            const bool has_name =
                element.is_object() && element.contains("name") && element["name"].is_string();
            names.push_back(has_name ? element["name"].get<std::string>() : "");
        }
        return names;
    }

    void add_mesh(const GltfPlacement& placement) {
        const GltfMesh mesh = meshes_.read(placement.mesh, placement.weights);
        others_ += mesh.others;
        for (const glm::dmat4& transform : placement.transforms) {
            add_placed(placement, mesh, transform);
        }
    }

    void add_placed(const GltfPlacement& placement, const GltfMesh& mesh,
                    const glm::dmat4& transform) {
        struct Placed {
            std::uint32_t first;
            bool is_mirrored;
        };
        std::vector<Placed> placed;
        for (const GltfVertices& vertices : mesh.vertices) {
            const auto first = static_cast<std::uint32_t>(mesh_.positions.size() / 3);
            if (vertices.points.size() > std::numeric_limits<std::uint32_t>::max() - first) {
                document_.fail("has more vertices than a face can refer to");
            }
            placed.push_back({first, add_vertices(placement, vertices, transform)});
        }
        for (const GltfPrimitive& primitive : mesh.primitives) {
            const auto [first, is_mirrored] = placed[primitive.vertices];
            const auto part = static_cast<std::uint32_t>(mesh_.parts.size());
            add_fields(placement, mesh, primitive, transform, is_mirrored);
            mesh_.parts.push_back(
                {placement.node, placement.mesh, primitive.number, primitive.material, {}});
            for (std::size_t i = 0; i + 2 < primitive.corners.size(); i += 3) {
                const std::uint32_t* const c = &primitive.corners[i];
                mesh_.corners.insert(
                    mesh_.corners.end(),
                    {first + c[0], first + c[is_mirrored ? 2 : 1], first + c[is_mirrored ? 1 : 2]});
                mesh_.face_ends.push_back(mesh_.corners.size());
                mesh_.part_of_face.push_back(part);
            }
        }
    }

    /// Corners of primitives without the attribute have no value.
    void pad(MeshField& field) const {
        if (!field.values.empty()) {
            field.corners.resize(mesh_.corners.size(), MeshField::kNone);
        }
    }

    MeshField& field_like(const GltfField& given, const std::string& place) {
        if (given.role != GltfField::Role::attribute) {
            std::optional<MeshField>& field =
                given.role == GltfField::Role::normals ? mesh_.normals : mesh_.material_uvs;
            return field ? *field : field.emplace(without_values(given.field));
        }
        const auto known = std::ranges::find(mesh_.fields, given.field.name, &MeshField::name);
        if (known == mesh_.fields.end()) {
            return mesh_.fields.emplace_back(without_values(given.field));
        }
        if (known->components != given.field.components) {
            document_.fail(place + ": " + given.accessor +
                           " has another number of components than in a primitive before");
        }
        known->is_whole = known->is_whole && given.field.is_whole;
        return *known;
    }

    static MeshField without_values(MeshField field) {
        field.values.clear();
        return field;
    }

    /// Adds the attributes of the corners of a primitive that come next.
    void add_fields(const GltfPlacement& placement, const GltfMesh& mesh,
                    const GltfPrimitive& primitive, const glm::dmat4& transform, bool is_mirrored) {
        const std::string place = "mesh " + std::to_string(placement.mesh) + ", primitive " +
                                  std::to_string(primitive.number);
        for (const GltfField& given : primitive.fields) {
            if (given.role != GltfField::Role::attribute && given.field.values.empty()) {
                continue;
            }
            MeshField& field = field_like(given, place);
            if (given.field.values.empty()) {
                continue;
            }
            field.corners.resize(mesh_.corners.size(), MeshField::kNone);
            const std::size_t first = field.values.size() / field.components.size();
            const std::vector<double>& values = given.field.values;
            field.values.insert(field.values.end(), values.begin(), values.end());
            if (given.role == GltfField::Role::normals) {
                turn_normals(placement, mesh.vertices[primitive.vertices], transform,
                             std::span(field.values).last(values.size()));
            }
            for (std::size_t i = 0; i + 2 < primitive.corners.size(); i += 3) {
                for (const std::size_t k : {0u, is_mirrored ? 2u : 1u, is_mirrored ? 1u : 2u}) {
                    field.corners.push_back(
                        static_cast<std::uint32_t>(first + primitive.corners[i + k]));
                }
            }
        }
    }

    void turn_normals(const GltfPlacement& placement, const GltfVertices& vertices,
                      const glm::dmat4& transform, std::span<double> normals) {
        const Placing placing = placing_of(placement, transform);
        for (std::size_t i = 0; i < vertices.points.size(); ++i) {
            double* const n = &normals[3 * i];
            const glm::dvec3 turned = placing.turn(vertices, i, {n[0], n[1], n[2]});
            n[0] = turned.x;
            n[1] = turned.y;
            n[2] = turned.z;
        }
    }

    Placing placing_of(const GltfPlacement& placement, const glm::dmat4& transform) {
        return placement.skin ? Placing(transform, scene_.joint_matrices(*placement.skin))
                              : Placing(transform);
    }

    /// Returns whether they are mirrored.
    bool add_vertices(const GltfPlacement& placement, const GltfVertices& vertices,
                      const glm::dmat4& transform) {
        Placing placing = placing_of(placement, transform);
        for (std::size_t i = 0; i < vertices.points.size(); ++i) {
            const std::optional<glm::dvec3> point = placing.place(vertices, i);
            if (!point) {
                document_.fail("mesh " + std::to_string(placement.mesh) + ": vertex " +
                               std::to_string(i) + " has a joint that its skin has not");
            }
            mesh_.positions.insert(mesh_.positions.end(), {point->x, point->y, point->z});
        }
        return placing.is_mirrored();
    }

    void warn() {
        add_warning(mesh_.warnings, "other_primitives", others_, "",
                    "primitive of points or lines ignored",
                    "primitives of points or lines ignored");
        add_warning(mesh_.warnings, "hidden_nodes", scene_.hidden_nodes(), "",
                    "hidden node left out with what is below it",
                    "hidden nodes left out with what is below them");
        mesh_.warnings.insert(mesh_.warnings.end(), data_.warnings().begin(),
                              data_.warnings().end());
    }

    GltfDocument document_;
    GltfData data_;
    GltfScene scene_;
    GltfMaterials materials_;
    GltfMeshReader meshes_;
    bool has_materials_; ///< Whether they are wanted.
    PolygonMesh mesh_;
    std::uint64_t others_ = 0; ///< Primitives without triangles.
};

} // namespace

PolygonMesh read_gltf(const Path& path, const WantedFields& fields, const FileScope& scope) {
    const std::string bytes = read_text(path);
    return GltfReader(path, gltf_chunks(path, bytes), fields, scope).read();
}

} // namespace geodisk::tools
