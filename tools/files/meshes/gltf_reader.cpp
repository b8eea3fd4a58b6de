#include <algorithm>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <glm/mat4x4.hpp>

#include "files/input_file.hpp"
#include "files/meshes/file_scope.hpp"
#include "files/meshes/gltf_chunks.hpp"
#include "files/meshes/gltf_data.hpp"
#include "files/meshes/gltf_extensions.hpp"
#include "files/meshes/gltf_json.hpp"
#include "files/meshes/gltf_materials.hpp"
#include "files/meshes/gltf_mesh.hpp"
#include "files/meshes/gltf_placing.hpp"
#include "files/meshes/gltf_scene.hpp"
#include "files/meshes/polygon_mesh.hpp"
#include "files/text_file.hpp"
#include "program/failure.hpp"
#include "program/human_text.hpp"

namespace geodisk::tools {
namespace {

class GltfReader {
  public:
    GltfReader(const Path& path, GltfChunks&& chunks, const WantedFields& fields,
               const FileScope& scope)
        : document_(path, std::move(chunks.json)), data_(document_, chunks.binary, scope),
          scene_(document_, data_), materials_(document_, data_),
          meshes_(document_, data_, fields, materials_), fields_(fields) {}

    PolygonMesh read() && {
        mesh_.names = {"triangle ", "vertex ", {}, {}, 0};
        check_required_extensions(document_, fields_.materials, mesh_.warnings);
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
        if (fields_.materials) {
            mesh_.materials = std::move(materials_).take();
        }
        mesh_.part_names = {names_of("materials"), {}, names_of("nodes"), scene_.nodes_above()};
        warn();
        return std::move(mesh_);
    }

  private:
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
            make_room(mesh_.corners, primitive.corners.size());
            make_room(mesh_.face_ends, primitive.corners.size() / 3);
            make_room(mesh_.part_of_face, primitive.corners.size() / 3);
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

    /// Reserves memory for so many more values; for many at a time no less than twice as much.
    template <class Value>
    static void make_room(std::vector<Value>& values, std::size_t more) {
        if (values.capacity() - values.size() < more) {
            values.reserve(std::max(values.size() + more, 2 * values.capacity()));
        }
    }

    /// Corners of primitives without the attribute have no value.
    void pad(MeshField& field) const {
        if (!field.values.empty()) {
            field.corners.resize(mesh_.corners.size(), MeshField::kNone);
        }
    }

    /// Corners without values leave out the attribute, if it is not needed.
    void fail_components(const GltfField& given, const std::string& place) const {
        if (fields_.needs(given.field.name)) {
            document_.fail(place + ": " + given.accessor +
                           " has another number of components than in a primitive before");
        }
    }

    MeshField& field_like(const GltfField& given) {
        if (given.role != GltfField::Role::attribute) {
            std::optional<MeshField>& field =
                given.role == GltfField::Role::normals ? mesh_.normals : mesh_.material_uvs;
            return field ? *field : field.emplace(without_values(given.field));
        }
        const auto known = std::ranges::find(mesh_.fields, given.field.name, &MeshField::name);
        if (known == mesh_.fields.end()) {
            return mesh_.fields.emplace_back(without_values(given.field));
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
            MeshField& field = field_like(given);
            if (given.field.values.empty()) {
                continue;
            }
            if (field.components != given.field.components) {
                fail_components(given, place);
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
        const GltfPlacing placing(document_, scene_, placement, transform);
        for (std::size_t i = 0; i < vertices.points.size(); ++i) {
            double* const n = &normals[3 * i];
            const glm::dvec3 turned = placing.turn(vertices, i, {n[0], n[1], n[2]});
            n[0] = turned.x;
            n[1] = turned.y;
            n[2] = turned.z;
        }
    }

    /// Returns whether they are mirrored.
    bool add_vertices(const GltfPlacement& placement, const GltfVertices& vertices,
                      const glm::dmat4& transform) {
        GltfPlacing placing(document_, scene_, placement, transform);
        make_room(mesh_.positions, 3 * vertices.points.size());
        for (std::size_t i = 0; i < vertices.points.size(); ++i) {
            const glm::dvec3 point = placing.place(vertices, i);
            mesh_.positions.insert(mesh_.positions.end(), {point.x, point.y, point.z});
        }
        return placing.is_mirrored();
    }

    void warn() {
        add_warning(mesh_.warnings, "other_primitives", others_, "",
                    "primitive of points or lines ignored",
                    "primitives of points or lines ignored");
        scene_.add_warnings(mesh_.warnings);
        for (const auto* const warnings : {&data_.warnings(), &meshes_.warnings()}) {
            mesh_.warnings.insert(mesh_.warnings.end(), warnings->begin(), warnings->end());
        }
    }

    GltfDocument document_;
    GltfData data_;
    GltfScene scene_;
    GltfMaterials materials_;
    GltfMeshReader meshes_;
    const WantedFields& fields_;
    PolygonMesh mesh_;
    std::uint64_t others_ = 0; ///< Primitives without triangles.
};

} // namespace

PolygonMesh read_gltf(const Path& path, const WantedFields& fields, const FileScope& scope) {
    const std::string bytes = read_text(path);
    return GltfReader(path, gltf_chunks(path, bytes), fields, scope).read();
}

} // namespace geodisk::tools
