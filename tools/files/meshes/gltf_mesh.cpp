#include "files/meshes/gltf_mesh.hpp"

#include <algorithm>
#include <iterator>
#include <limits>
#include <optional>
#include <utility>

namespace geodisk::tools {
namespace {

// Modes of primitives.
constexpr std::uint64_t kPoints = 0, kLines = 1, kLineLoop = 2, kLineStrip = 3, kTriangles = 4,
                        kStrip = 5, kFan = 6;

constexpr const char* kDraco = "KHR_draco_mesh_compression";

std::vector<glm::dvec3> to_points(const std::vector<double>& numbers) {
    std::vector<glm::dvec3> points;
    points.reserve(numbers.size() / 3);
    for (std::size_t i = 0; i + 2 < numbers.size(); i += 3) {
        points.emplace_back(numbers[i], numbers[i + 1], numbers[i + 2]);
    }
    return points;
}

constexpr const char* kNormals = "NORMAL";

/// Types of accessors of 1 to 4 numbers.
constexpr const char* kTypes[] = {"SCALAR", "VEC2", "VEC3", "VEC4"};

std::size_t draco_components(std::string_view type) {
    return static_cast<std::size_t>(std::ranges::find(kTypes, type) - std::begin(kTypes)) + 1;
}

/// True for what may be interpolated: colours, texture coordinates, and attributes of the user.
bool is_attribute(std::string_view name) {
    return name.starts_with("COLOR_") || name.starts_with("TEXCOORD_") || name.starts_with('_');
}

/// "color" and "uv" for the first sets, "color1" for the next; others as in the file.
std::string field_name(std::string_view name) {
    for (const auto& [prefix, field] :
         {std::pair<std::string_view, std::string_view>{"COLOR_", kColourField},
          {"TEXCOORD_", kUvField}}) {
        if (name.starts_with(prefix)) {
            const std::string_view set = name.substr(prefix.size());
            return std::string(field) + (set == "0" ? "" : std::string(set));
        }
    }
    return std::string(name);
}

MeshField field_of(std::string_view name, const GltfAccessor& about) {
    const std::string called = field_name(name);
    const std::string set =
        called.substr(std::min(called.find_first_of("0123456789"), called.size()));
    if (name.starts_with("COLOR_")) {
        MeshField field = make_colours(MeshField::Of::corners, 4);
        field.name = called;
        field.is_light = true;
        for (std::string& component : field.components) {
            component += set;
        }
        return field;
    }
    MeshField field = make_field(called, MeshField::Of::corners, about.components);
    if (name.starts_with("TEXCOORD_") && about.components == 2) {
        field.components = {"u" + set, "v" + set};
        field.is_from_top = true;
    }
    field.is_whole = about.is_whole();
    return field;
}

/// Returns the ends of the lines from each vertex to the next, and in a loop back to the first.
std::vector<std::uint32_t> line_ends(const std::vector<std::uint32_t>& vertices, bool is_loop) {
    std::vector<std::uint32_t> ends;
    for (std::size_t i = 0; i + 1 < vertices.size(); ++i) {
        ends.insert(ends.end(), {vertices[i], vertices[i + 1]});
    }
    if (is_loop && vertices.size() > 2) {
        ends.insert(ends.end(), {vertices.back(), vertices.front()});
    }
    return ends;
}

bool is_not_zero(double weight) {
    return weight != 0;
}

/// Colours of three numbers are opaque.
std::vector<double> with_alpha(const std::vector<double>& colours) {
    std::vector<double> result;
    for (std::size_t i = 0; i + 2 < colours.size(); i += 3) {
        result.insert(result.end(), {colours[i], colours[i + 1], colours[i + 2], 1});
    }
    return result;
}

/// Its number; a damaged one is none, as materials do not change the surface.
std::optional<std::uint32_t> material_of(const GltfJson& primitive) {
    const auto found = primitive.find("material");
    const bool is_number = found != primitive.end() && found->is_number_unsigned() &&
                           *found <= std::numeric_limits<std::uint32_t>::max();
    return is_number ? std::optional(found->get<std::uint32_t>()) : std::nullopt;
}

} // namespace

GltfMesh GltfMeshReader::read(std::uint64_t index, std::vector<double> weights) {
    const GltfJson& object = document_.at("meshes", "mesh", index);
    const std::string name = "mesh " + std::to_string(index);
    weights_ = weights.empty() ? document_.numbers(object, "weights", 0, name) : std::move(weights);
    known_.clear();
    GltfMesh mesh;
    std::uint32_t number = 0;
    for (const GltfJson& primitive : document_.array(object, "primitives", name)) {
        place_ = name + ", primitive " + std::to_string(number);
        if (!primitive.is_object()) {
            document_.fail(place_ + " is not an object");
        }
        add_primitive(primitive, number++, mesh);
    }
    return mesh;
}

void GltfMeshReader::add_primitive(const GltfJson& primitive, std::uint32_t number,
                                   GltfMesh& mesh) {
    const std::uint64_t mode = document_.index_or(primitive, "mode", kTriangles, place_);
    const bool is_of_kind =
        kind_ == GltfKind::triangles ? mode >= kTriangles && mode <= kFan : mode <= kLineStrip;
    if (!is_of_kind) {
        ++mesh.others;
        return;
    }
    const GltfJson* const attributes = document_.find_object(primitive, "attributes", place_);
    if (attributes == nullptr || !document_.find_index(*attributes, "POSITION", place_)) {
        document_.fail(place_ + ": has no POSITION");
    }
    const std::optional<std::uint32_t> material = material_of(primitive);
    material_uvs_ = fields_.materials && material ? materials_.read(*material) : "";
    Source source{primitive, *attributes, {}, {}};
    if (kind_ == GltfKind::triangles) {
        decode_draco(source);
    }
    const auto [known, is_new] = known_.try_emplace(key_of(source), mesh.vertices.size());
    if (is_new) {
        mesh.vertices.push_back(read_vertices(source));
    }
    const std::size_t vertices = mesh.vertices[known->second].points.size();
    mesh.primitives.push_back({number, known->second, corners_of(source, mode, vertices), material,
                               read_fields(source, vertices),
                               mode >= kLines && mode <= kLineStrip});
}

/// A primitive may bear the same data as they are, for readers that know no compression; these are
/// read where the others cannot be.
void GltfMeshReader::decode_draco(Source& source) {
    const GltfJson* const extension = document_.find_extension(source.primitive, kDraco, place_);
    if (extension == nullptr) {
        return;
    }
    const GltfJson* const ids = document_.find_object(*extension, "attributes", place_);
    if (ids == nullptr) {
        document_.fail(place_ + ": is compressed by Draco, without attributes");
    }
    std::vector<std::uint32_t> wanted;
    for (const auto& [name, unused] : ids->items()) {
        if (name == "POSITION" || name.starts_with("JOINTS_") || name.starts_with("WEIGHTS_") ||
            name == material_uvs_ || is_wanted(name)) {
            wanted.push_back(
                static_cast<std::uint32_t>(document_.index(*ids, name.c_str(), place_)));
            source.draco_ids[name] = wanted.back();
        }
    }
    const std::uint64_t view = document_.index(*extension, "bufferView", place_);
    source.draco = draco_decoded(data_.view_bytes(view, place_), wanted);
    if (source.draco.failure.empty() && source.draco_ids.contains("POSITION")) {
        return;
    }
    const std::uint64_t positions = document_.index(source.attributes, "POSITION", place_);
    if (!data_.has_values(positions, place_)) {
        document_.fail(place_ + ": is compressed by Draco, " +
                       (source.draco.failure.empty() ? "without positions" : source.draco.failure));
    }
    source.draco_ids.clear();
}

GltfMeshReader::Key GltfMeshReader::key_of(const Source& source) const {
    constexpr std::uint64_t kNone = std::numeric_limits<std::uint64_t>::max();
    Key key;
    if (!source.draco_ids.empty()) {
        const GltfJson* const extension =
            document_.find_extension(source.primitive, kDraco, place_);
        key.push_back(document_.index(*extension, "bufferView", place_));
    }
    for (const char* const name : {"POSITION", "JOINTS_0", "WEIGHTS_0", "JOINTS_1", "WEIGHTS_1"}) {
        key.push_back(document_.index_or(source.attributes, name, kNone, place_));
    }
    for (const GltfJson& target : document_.array(source.primitive, "targets", place_)) {
        key.push_back(target.is_object() ? document_.index_or(target, "POSITION", kNone, place_)
                                         : kNone);
    }
    return key;
}

std::vector<double> GltfMeshReader::attribute(const Source& source, const std::string& name,
                                              std::uint64_t accessor, std::string_view type) {
    const auto id = source.draco_ids.find(name);
    if (id == source.draco_ids.end()) {
        return data_.numbers(accessor, type, place_);
    }
    const auto found =
        std::ranges::find(source.draco.attributes, id->second, &DracoMesh::Attribute::id);
    if (found == source.draco.attributes.end() || found->components != draco_components(type)) {
        document_.fail(place_ + ": its " + name + " in Draco's data is not of type " +
                       std::string(type));
    }
    std::vector<double> values = found->values;
    const double divisor = found->is_normalized ? 1 : data_.describe(accessor, place_).divisor();
    for (double& value : values) {
        value /= divisor;
    }
    return values;
}

std::vector<double> GltfMeshReader::attribute(const Source& source, const std::string& name,
                                              std::uint64_t accessor) {
    const std::size_t components = data_.describe(accessor, place_).components;
    return attribute(source, name, accessor, kTypes[components - 1]);
}

bool GltfMeshReader::is_wanted(const std::string& name) const {
    return name == kNormals ? fields_.normals : is_attribute(name) && fields_.has(field_name(name));
}

std::vector<GltfField> GltfMeshReader::read_fields(const Source& source, std::size_t vertices) {
    std::vector<GltfField> fields;
    if (!fields_.are_given() && !fields_.normals) {
        return fields;
    }
    for (const auto& [name, unused] : source.attributes.items()) {
        const bool are_normals = name == kNormals;
        if (name == material_uvs_) {
            GltfField& uvs =
                fields.emplace_back(GltfField{make_uvs(), name, GltfField::Role::material_uvs});
            uvs.field.is_from_top = true;
            uvs.field.values = field_values(source, name, vertices);
        }
        if (!are_normals && !is_attribute(name)) {
            continue;
        }
        const std::uint64_t accessor = document_.index(source.attributes, name.c_str(), place_);
        const GltfAccessor about = data_.describe(accessor, place_);
        if (about.components > std::size(kTypes) ||
            (name.starts_with("COLOR_") && about.components < 3)) {
            continue; // Matrices, and what are no colours.
        }
        if (are_normals && fields_.normals && std::ranges::any_of(weights_, is_not_zero) &&
            !document_.array(source.primitive, "targets", place_).empty()) {
            document_.fail(place_ +
                           ": normals of morph targets are not read; use --normals smooth");
        }
        GltfField& field = fields.emplace_back(
            GltfField{field_of(name, about), name,
                      are_normals ? GltfField::Role::normals : GltfField::Role::attribute});
        if (is_wanted(name)) {
            read_values(source, vertices, about.components, field);
        }
    }
    return fields;
}

/// Leaves out the values that cannot be read, unless they are needed.
void GltfMeshReader::read_values(const Source& source, std::size_t vertices, std::size_t components,
                                 GltfField& field) {
    try {
        field.field.values = field_values(source, field.accessor, vertices);
    } catch (const UserError& error) {
        if (field.role == GltfField::Role::normals || fields_.needs(field.field.name)) {
            throw;
        }
        warn_left_out(document_.path(), field.field.name, error, warnings_);
        return;
    }
    if (field.field.is_colour && components == 3) {
        field.field.values = with_alpha(field.field.values);
    }
}

std::vector<double> GltfMeshReader::field_values(const Source& source, const std::string& name,
                                                 std::size_t vertices) {
    const std::uint64_t accessor = document_.index(source.attributes, name.c_str(), place_);
    const std::size_t components = data_.describe(accessor, place_).components;
    if (name == material_uvs_ && components != 2) {
        document_.fail(place_ + ": its " + name + " is not of two numbers");
    }
    std::vector<double> values = attribute(source, name, accessor);
    if (values.size() != components * vertices) {
        document_.fail(place_ + ": has " + name + " for another number of vertices");
    }
    return values;
}

GltfVertices GltfMeshReader::read_vertices(const Source& source) {
    const std::uint64_t positions = document_.index(source.attributes, "POSITION", place_);
    const GltfAccessor about = data_.describe(positions, place_);
    if (about.components != 3) {
        document_.fail(place_ + ": its positions are not of 3 coordinates");
    }
    if (about.count > std::numeric_limits<std::uint32_t>::max()) {
        document_.fail("has more vertices than a face can refer to");
    }
    if (source.draco_ids.empty() && !data_.has_values(positions, place_)) {
        document_.fail(place_ + ": its positions have no data");
    }
    GltfVertices vertices;
    vertices.points = to_points(attribute(source, "POSITION", positions, "VEC3"));
    move_targets(source, vertices.points);
    read_joints(source, vertices);
    return vertices;
}

void GltfMeshReader::move_targets(const Source& source, std::vector<glm::dvec3>& points) {
    std::size_t number = 0;
    for (const GltfJson& target : document_.array(source.primitive, "targets", place_)) {
        const double weight = number < weights_.size() ? weights_[number] : 0;
        ++number;
        const auto accessor = weight != 0 && target.is_object()
                                  ? document_.find_index(target, "POSITION", place_)
                                  : std::nullopt;
        if (!accessor) {
            continue;
        }
        const std::vector<glm::dvec3> moves = to_points(data_.numbers(*accessor, "VEC3", place_));
        if (moves.size() != points.size()) {
            document_.fail(place_ + ": morph target " + std::to_string(number - 1) +
                           " has another number of vertices");
        }
        for (std::size_t i = 0; i < points.size(); ++i) {
            points[i] += weight * moves[i];
        }
    }
}

void GltfMeshReader::read_joints(const Source& source, GltfVertices& vertices) {
    std::vector<std::vector<double>> joints, weights; // Four for each vertex in each set.
    for (std::size_t set = 0;; ++set) {
        const std::string joint = "JOINTS_" + std::to_string(set);
        const std::string weight = "WEIGHTS_" + std::to_string(set);
        const auto first = document_.find_index(source.attributes, joint.c_str(), place_);
        const auto second = document_.find_index(source.attributes, weight.c_str(), place_);
        if (!first || !second) {
            break;
        }
        joints.push_back(attribute(source, joint, *first, "VEC4"));
        weights.push_back(attribute(source, weight, *second, "VEC4"));
        if (joints.back().size() != 4 * vertices.points.size() ||
            weights.back().size() != 4 * vertices.points.size()) {
            document_.fail(place_ + ": has joints or weights for another number of vertices");
        }
    }
    vertices.joints_per_point = 4 * joints.size();
    for (std::size_t i = 0; i < vertices.points.size(); ++i) {
        for (std::size_t set = 0; set < joints.size(); ++set) {
            for (std::size_t k = 4 * i; k < 4 * i + 4; ++k) {
                vertices.joints.push_back(static_cast<std::uint32_t>(joints[set][k]));
                vertices.weights.push_back(weights[set][k]);
            }
        }
    }
}

/// Without indices, all vertices in order.
std::vector<std::uint32_t> GltfMeshReader::indices_of(const Source& source, std::size_t vertices) {
    std::vector<std::uint32_t> indices;
    if (const auto accessor = document_.find_index(source.primitive, "indices", place_)) {
        indices = data_.integers(*accessor, place_);
        for (const std::uint32_t index : indices) {
            if (index >= vertices) {
                document_.fail(place_ + ": vertex index " + std::to_string(index) +
                               " is out of range, it has " + std::to_string(vertices) +
                               " vertices");
            }
        }
    } else {
        for (std::size_t i = 0; i < vertices; ++i) {
            indices.push_back(static_cast<std::uint32_t>(i));
        }
    }
    return indices;
}

std::vector<std::uint32_t> GltfMeshReader::corners_of(const Source& source, std::uint64_t mode,
                                                      std::size_t vertices) {
    if (!source.draco_ids.empty()) {
        return source.draco.corners;
    }
    std::vector<std::uint32_t> indices = indices_of(source, vertices);
    const auto check_multiple = [&](std::size_t corners, const char* of) {
        if (indices.size() % corners != 0) {
            document_.fail(place_ + ": " + std::to_string(indices.size()) +
                           " indices are not those of " + of);
        }
    };
    if (mode == kPoints) {
        return indices;
    }
    if (mode == kLines) {
        check_multiple(2, "lines");
        return indices;
    }
    if (mode == kLineLoop || mode == kLineStrip) {
        return line_ends(indices, mode == kLineLoop);
    }
    if (mode == kTriangles) {
        check_multiple(3, "triangles");
        return indices;
    }
    std::vector<std::uint32_t> corners;
    for (std::size_t i = 0; i + 2 < indices.size(); ++i) {
        const bool is_odd = mode == kStrip && i % 2 == 1;
        const std::uint32_t a = indices[i], b = indices[i + 1], c = indices[i + 2];
        if (mode == kFan) {
            corners.insert(corners.end(), {b, c, indices[0]});
        } else {
            corners.insert(corners.end(), {a, is_odd ? c : b, is_odd ? b : c});
        }
    }
    return corners;
}

} // namespace geodisk::tools
