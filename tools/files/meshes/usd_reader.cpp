#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

#include "files/input_file.hpp"
#include "files/meshes/polygon_mesh.hpp"
#include "files/meshes/usd_prims.hpp"
#include "files/text_file.hpp"
#include "geometry/vec.hpp"
#include "program/failure.hpp"
#include "program/human_text.hpp"

namespace geodisk::tools {
namespace {

using Index = std::uint32_t;

constexpr std::string_view kUsdText = "#usda",
                           kPrimvarPrefix = "primvars:", kIndexSuffix = ":indices";

/// What prims have from those above.
struct UsdPlace {
    glm::dmat4 transform{1};
    std::optional<Index> node, material;
};

/// Faces of a mesh before it is placed.
struct UsdFaces {
    std::vector<Index> vertices; ///< Of all corners.
    std::vector<std::size_t> ends;
    std::size_t points = 0;
    std::vector<Index> order; ///< Place in `vertices` of each corner of the result.
    std::vector<Index> faces; ///< Face of each place in `vertices`.
};

class UsdReader {
  public:
    UsdReader(const Path& path, std::string_view bytes, const WantedFields& wanted)
        : path_(path), wanted_(wanted), text_(path, bytes), scene_(parse_usd(path, bytes, wanted)) {
    }

    PolygonMesh read() && {
        for (UsdPrim& prim : scene_.prims) {
            read_prim(prim, {});
        }
        if (mesh_.face_ends.empty() && meshes_ == 0) {
            fail_input(path_, "has no mesh that is shown");
        }
        for (MeshField& field : mesh_.fields) {
            field.corners.resize(mesh_.corners.size(), MeshField::kNone);
        }
        if (mesh_.normals) {
            mesh_.normals->corners.resize(mesh_.corners.size(), MeshField::kNone);
        }
        warn();
        return std::move(mesh_);
    }

  private:
    [[noreturn]] void fail(const UsdPrim& prim, std::uint32_t line,
                           const std::string& message) const {
        text_.fail(line, "prim <" + prim.path + ">: " + message);
    }

    void read_prim(UsdPrim& prim, UsdPlace place) {
        constexpr std::string_view kOtherShapes[] = {
            "Sphere",      "Cube",       "Cylinder",    "Cone",          "Capsule",
            "Plane",       "Points",     "BasisCurves", "HermiteCurves", "TetMesh",
            "NurbsCurves", "NurbsPatch", "Volume",      "Cylinder_1",    "Capsule_1"};
        const std::string purpose = prim.text("purpose");
        if (prim.text("visibility") == "invisible" || purpose == "guide" || purpose == "proxy") {
            ++hidden_;
            return;
        }
        if (prim.type == "PointInstancer") {
            text_.fail(prim.line, "prim <" + prim.path +
                                      "> is a PointInstancer, which is not read; make meshes of "
                                      "its instances first");
        }
        bool is_reset = false;
        const glm::dmat4 own = usd_transform(text_, prim, is_reset);
        place.transform = is_reset ? own : place.transform * own;
        place.node = add_node(prim.name, place.node);
        if (const std::string bound = prim.text("material:binding"); !bound.empty()) {
            place.material = material_of(bound);
        }
        if (prim.type == "Mesh") {
            add_mesh(prim, place);
        } else if (std::ranges::find(kOtherShapes, prim.type) != std::end(kOtherShapes)) {
            ++others_;
        }
        for (UsdPrim& child : prim.children) {
            read_prim(child, place);
        }
    }

    Index add_node(const std::string& name, std::optional<Index> above) {
        mesh_.part_names.nodes.push_back(name);
        mesh_.part_names.node_above.push_back(above);
        return static_cast<Index>(mesh_.part_names.nodes.size() - 1);
    }

    Index material_of(const std::string& path) {
        const auto [known, is_new] =
            materials_.emplace(path, static_cast<Index>(mesh_.part_names.materials.size()));
        if (is_new) {
            mesh_.part_names.materials.push_back(path.substr(path.rfind('/') + 1));
        }
        return known->second;
    }

    /// Takes the points out of a mesh, three numbers each.
    std::vector<double> take_points(UsdPrim& prim) const {
        const auto found = std::ranges::find(prim.attributes, "points", &UsdAttribute::name);
        if (found == prim.attributes.end()) {
            fail(prim, prim.line, "has no points");
        }
        std::vector<double> points = std::move(found->value.numbers);
        if (points.size() % 3 != 0) {
            fail(prim, found->value.line,
                 "points has " + counted(points.size(), "number", "numbers") +
                     ", not three for each");
        }
        return points;
    }

    /// Frees the corners of a mesh, which were read.
    static void drop_corners(UsdPrim& prim) {
        std::erase_if(prim.attributes, [](const UsdAttribute& attribute) {
            return attribute.name == "faceVertexIndices" || attribute.name == "faceVertexCounts";
        });
    }

    /// Returns integers from 0 to below `end`.
    std::vector<Index> indices_of(const UsdPrim& prim, const UsdAttribute& attribute,
                                  std::size_t end) const {
        std::vector<Index> indices;
        indices.reserve(attribute.value.numbers.size());
        for (const double number : attribute.value.numbers) {
            if (!(number >= 0 && number < static_cast<double>(end) &&
                  number == std::floor(number))) {
                fail(prim, attribute.value.line,
                     in_quotes(attribute.name) + " has the number " + rounded(number, 12) +
                         ", which is not from 0 to below " + grouped(end));
            }
            indices.push_back(static_cast<Index>(number));
        }
        return indices;
    }

    UsdFaces faces_of(const UsdPrim& prim, std::size_t points) const {
        UsdFaces faces;
        faces.points = points;
        const UsdAttribute* const corners = prim.find("faceVertexIndices");
        const UsdAttribute* const counts = prim.find("faceVertexCounts");
        if (corners == nullptr || counts == nullptr) {
            fail(prim, prim.line,
                 std::string("has no ") +
                     (corners == nullptr ? "faceVertexIndices" : "faceVertexCounts"));
        }
        if (corners->value.numbers.size() > std::numeric_limits<Index>::max()) {
            fail(prim, corners->value.line, "has more corners than can be numbered");
        }
        faces.vertices = indices_of(prim, *corners, points);
        for (const Index count : indices_of(prim, *counts, faces.vertices.size() + 1)) {
            const std::size_t begin = faces.ends.empty() ? 0 : faces.ends.back();
            faces.ends.push_back(begin + count);
            if (faces.ends.back() > faces.vertices.size()) {
                break;
            }
            faces.faces.insert(faces.faces.end(), is_counted_ ? count : 0,
                               static_cast<Index>(faces.ends.size() - 1));
        }
        if ((faces.ends.empty() ? 0 : faces.ends.back()) != faces.vertices.size()) {
            fail(prim, counts->value.line,
                 "has " + counted(faces.vertices.size(), "corner", "corners") +
                     ", not as many as faceVertexCounts tells");
        }
        return faces;
    }

    void add_mesh(UsdPrim& prim, const UsdPlace& place) {
        ++meshes_;
        note_scheme(prim);
        const std::vector<double> points = take_points(prim);
        UsdFaces faces = faces_of(prim, points.size() / 3);
        drop_corners(prim);
        const std::size_t first = mesh_.vertex_count();
        if (first + faces.points > std::numeric_limits<Index>::max()) {
            fail_input(path_, "has more vertices than a face can refer to");
        }
        for (std::size_t i = 0; i < points.size(); i += 3) {
            const glm::dvec4 there =
                place.transform * glm::dvec4(points[i], points[i + 1], points[i + 2], 1);
            mesh_.positions.insert(mesh_.positions.end(), {there.x, there.y, there.z});
        }
        const std::size_t first_corner = mesh_.corners.size();
        add_faces(prim, place, faces, first);
        add_parts(prim, place, faces.ends.size());
        add_fields(prim, faces, first_corner);
        add_normals(prim, place, faces, first_corner);
    }

    void note_scheme(const UsdPrim& prim) {
        if (prim.text("subdivisionScheme") == "none") {
            return;
        }
        subdivided_.add(0);
        first_subdivided_ = first_subdivided_.empty() ? '<' + prim.path + '>' : first_subdivided_;
    }

    /// Adds the faces, turned over where the mesh or its place is left-handed. Those of holes have
    /// no corners.
    void add_faces(const UsdPrim& prim, const UsdPlace& place, UsdFaces& faces, std::size_t first) {
        std::vector<bool> is_hole(faces.ends.size(), false);
        if (const UsdAttribute* const holes = prim.find("holeIndices")) {
            for (const Index face : indices_of(prim, *holes, faces.ends.size())) {
                is_hole[face] = true;
            }
        }
        const bool is_left = prim.text("orientation") == "leftHanded";
        const bool is_turned = is_left != (glm::determinant(glm::dmat3(place.transform)) < 0);
        std::size_t begin = 0;
        for (std::size_t face = 0; face < faces.ends.size(); ++face) {
            const std::size_t end = faces.ends[face], count = is_hole[face] ? 0 : end - begin;
            for (std::size_t k = 0; k < count; ++k) {
                const std::size_t corner = is_turned && k > 0 ? end - k : begin + k;
                faces.order.push_back(static_cast<Index>(corner));
                mesh_.corners.push_back(static_cast<Index>(first) + faces.vertices[corner]);
            }
            mesh_.face_ends.push_back(mesh_.corners.size());
            begin = end;
        }
    }

    /// Notes the node and the material of each face.
    void add_parts(const UsdPrim& prim, const UsdPlace& place, std::size_t faces) {
        std::map<std::optional<Index>, Index> parts;
        const auto part_of = [&](const std::optional<Index>& material) {
            const auto [known, is_new] =
                parts.emplace(material, static_cast<Index>(mesh_.parts.size()));
            if (is_new) {
                MeshPart part;
                part.node = place.node;
                part.material = material;
                mesh_.parts.push_back(std::move(part));
            }
            return known->second;
        };
        const std::size_t first = mesh_.part_of_face.size();
        mesh_.part_of_face.resize(first + faces, part_of(place.material));
        for (const UsdPrim& subset : prim.children) {
            const UsdAttribute* const chosen = subset.find("indices");
            const std::string bound = subset.text("material:binding");
            const std::string of = subset.text("elementType");
            if (subset.type == "GeomSubset" && chosen != nullptr && !bound.empty() &&
                (of.empty() || of == "face")) { // Which USD takes for granted.
                const Index part = part_of(material_of(bound));
                for (const Index face : indices_of(subset, *chosen, faces)) {
                    mesh_.part_of_face[first + face] = part;
                }
            }
        }
    }

    /// Returns which of the values of an attribute each corner of the file has, of `count` values.
    std::vector<Index> value_indices(const UsdPrim& prim, const UsdAttribute& attribute,
                                     const std::string& interpolation, const UsdFaces& faces,
                                     std::size_t count) const {
        std::vector<Index> of_elements;
        const UsdAttribute* const indices = prim.find(attribute.name + std::string(kIndexSuffix));
        if (indices != nullptr) {
            of_elements = indices_of(prim, *indices, count);
        }
        const bool is_of_points = interpolation == "vertex" || interpolation == "varying";
        const std::size_t elements = is_of_points                     ? faces.points
                                     : interpolation == "uniform"     ? faces.ends.size()
                                     : interpolation == "faceVarying" ? faces.vertices.size()
                                                                      : 1;
        const std::size_t given = indices == nullptr ? count : of_elements.size();
        if (given != elements) {
            fail(prim, attribute.value.line,
                 in_quotes(attribute.name) + " has " + counted(given, "value", "values") + " for " +
                     counted(elements, "element", "elements"));
        }
        std::vector<Index> result;
        result.reserve(faces.vertices.size());
        for (std::size_t corner = 0; corner < faces.vertices.size(); ++corner) {
            const std::size_t element = is_of_points                     ? faces.vertices[corner]
                                        : interpolation == "uniform"     ? faces.faces[corner]
                                        : interpolation == "faceVarying" ? corner
                                                                         : 0;
            result.push_back(indices == nullptr ? static_cast<Index>(element)
                                                : of_elements[element]);
        }
        return result;
    }

    /// Appends the values of an attribute, and which of them each corner has.
    void append(const UsdPrim& prim, const UsdAttribute& attribute,
                const std::string& interpolation, const UsdFaces& faces, std::size_t first_corner,
                MeshField& field) {
        const std::size_t size = field.components.size();
        const std::vector<double>& values = attribute.value.numbers;
        if (values.size() % size != 0) {
            fail(prim, attribute.value.line,
                 in_quotes(attribute.name) + " has " + counted(values.size(), "number", "numbers") +
                     ", not " + std::to_string(size) + " for each value");
        }
        const std::vector<Index> indices =
            value_indices(prim, attribute, interpolation, faces, values.size() / size);
        const std::size_t before = field.values.size() / size;
        if (before + values.size() / size >= MeshField::kNone) {
            fail_input(path_, "has more values of " + in_quotes(field.name) + " than can be read");
        }
        field.corners.resize(first_corner, MeshField::kNone);
        for (const Index corner : faces.order) {
            field.corners.push_back(static_cast<Index>(before) + indices[corner]);
        }
        field.values.insert(field.values.end(), values.begin(), values.end());
    }

    void add_fields(const UsdPrim& prim, const UsdFaces& faces, std::size_t first_corner) {
        for (const UsdAttribute& attribute : prim.attributes) {
            const bool is_primvar = attribute.name.starts_with(kPrimvarPrefix) &&
                                    !attribute.name.ends_with(kIndexSuffix);
            const std::string_view name =
                std::string_view(attribute.name).substr(is_primvar ? kPrimvarPrefix.size() : 0);
            if (!is_primvar || name == "normals" || name == "displayOpacity" ||
                !wanted_.are_given()) {
                continue;
            }
            add_field(prim, attribute, field_of_primvar(name, attribute.type), faces, first_corner);
        }
    }

    void add_field(const UsdPrim& prim, const UsdAttribute& attribute, MeshField&& own,
                   const UsdFaces& faces, std::size_t first_corner) {
        if (own.components.empty()) {
            return; // Texts are no attribute.
        }
        auto known = std::ranges::find(mesh_.fields, own.name, &MeshField::name);
        if (known == mesh_.fields.end()) {
            mesh_.fields.push_back(std::move(own));
            known = mesh_.fields.end() - 1;
        } else if (known->components.size() != own.components.size()) {
            fail(prim, attribute.value.line,
                 in_quotes(attribute.name) + " has another number of components than that of "
                                             "another mesh");
        } else {
            known->is_whole = known->is_whole && own.is_whole;
        }
        if (!attribute.is_read) {
            return;
        }
        try {
            append(prim, attribute,
                   attribute.interpolation.empty() ? "constant" : attribute.interpolation, faces,
                   first_corner, *known);
        } catch (const UserError& error) {
            const bool is_needed =
                wanted_.needs(known->name) ||
                std::ranges::any_of(known->components, [&](const std::string& component) {
                    return wanted_.needs(component);
                });
            if (is_needed) {
                throw;
            }
            warn_left_out(path_, known->name, error, mesh_.warnings);
        }
    }

    /// Adds the normals, turned as the mesh is.
    void add_normals(const UsdPrim& prim, const UsdPlace& place, const UsdFaces& faces,
                     std::size_t first_corner) {
        const UsdAttribute* attribute = prim.find("primvars:normals");
        const char* usual = "constant";
        if (attribute == nullptr) {
            attribute = prim.find("normals");
            usual = "vertex";
        }
        const glm::dmat3 matrix(place.transform);
        if (!wanted_.normals || attribute == nullptr || !attribute->is_read ||
            !(std::abs(glm::determinant(matrix)) > 0)) {
            return;
        }
        if (!mesh_.normals) {
            mesh_.normals = make_field("normal", MeshField::Of::corners, 3);
        }
        std::vector<double>& values = mesh_.normals->values;
        const std::size_t begin = values.size();
        append(prim, *attribute,
               attribute->interpolation.empty() ? usual : attribute->interpolation, faces,
               first_corner, *mesh_.normals);
        const glm::dmat3 turn = glm::transpose(glm::inverse(matrix));
        for (std::size_t i = begin; i < values.size(); i += 3) {
            const Vec3 normal = turn * Vec3{values[i], values[i + 1], values[i + 2]};
            values[i] = normal.x;
            values[i + 1] = normal.y;
            values[i + 2] = normal.z;
        }
    }

    void warn() {
        std::vector<MeshWarning>& warnings = mesh_.warnings;
        add_warning(warnings, "hidden_nodes", hidden_, "",
                    "hidden prim left out with what is below it",
                    "hidden prims left out with what is below them");
        add_warning(warnings, "other_primitives", others_, "",
                    "prim of another shape than a mesh left out",
                    "prims of other shapes than meshes left out");
        add_warning(warnings, "control_meshes", subdivided_.count, first_subdivided_,
                    "subdivision surface: the mesh that controls it is read",
                    "subdivision surfaces: the meshes that control them are read");
        add_warning(warnings, "time_samples", scene_.sampled, "",
                    "attribute that changes over time read at its first time",
                    "attributes that change over time read at their first times");
        if (scene_.metres_per_unit > 0 && scene_.metres_per_unit != 1) {
            warnings.push_back({"scene_units",
                                1,
                                "",
                                "coordinates are as the file has them: a unit is " +
                                    rounded(scene_.metres_per_unit, 6) + " m" +
                                    (scene_.up.empty() ? "" : ", and " + scene_.up + " points up"),
                                {}});
        }
    }

    const Path& path_;
    const WantedFields& wanted_;
    bool is_counted_ = wanted_.are_given() || wanted_.normals; ///< Faces of corners matter.
    UsdText text_;                                             ///< Names lines in errors.
    UsdScene scene_;
    PolygonMesh mesh_;
    std::map<std::string, Index> materials_; ///< By their paths.
    std::uint64_t meshes_ = 0, hidden_ = 0, others_ = 0;
    Found subdivided_;
    std::string first_subdivided_;
};

} // namespace

void refuse_binary_usd(const Path& path) {
    const std::string name = path.filename().string(), stem = path.stem().string();
    fail_input(path,
               "is a binary USD file; convert it: usdcat -f " + name + " -o " + stem + ".usda");
}

PolygonMesh read_usd(const Path& path, const WantedFields& fields) {
    const std::string bytes = read_file(path);
    if (bytes.starts_with("PXR-USDC") || bytes.starts_with("PK\x03\x04")) {
        refuse_binary_usd(path);
    }
    if (!bytes.starts_with(kUsdText)) {
        refuse_other_content(path, bytes);
        refuse_other_mesh(path, bytes, ".usda");
        fail_input(path, bytes.empty() ? "is empty"
                                       : "is no text of USD: it does not begin with "
                                         "'#usda'");
    }
    if (!bytes.starts_with(std::string(kUsdText) + " 1.")) {
        fail_input(path, "line 1: is no text of USD in version 1");
    }
    return UsdReader(path, bytes, fields).read();
}

} // namespace geodisk::tools
