#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>
#include <ostream>
#include <streambuf>
#include <vector>

#include <geodisk/detail/uninitialized.hpp>
#include <nlohmann/json.hpp>
#include <tiny_gltf.h>

#include "files/byte_order.hpp"
#include "files/float_values.hpp"
#include "files/meshes/mesh_fields.hpp"
#include "files/output/block_writer.hpp"
#include "files/samples/sample_instances.hpp"
#include "files/samples/sample_writers.hpp"
#include "program/exact_text.hpp"
#include "program/failure.hpp"
#include "program/human_text.hpp"
#include "program/safe_text.hpp"

namespace geodisk::tools {
namespace {

/// Throws for what a float does not hold exactly: glTF allows attributes of its users no integers
/// of 32 bits. `index_of(i)` is that of row i.
template <class IndexOf>
void check_indices(std::size_t rows, const IndexOf& index_of) {
    for (std::size_t i = 0; i < rows; ++i) {
        if (index_of(i) > 1u << 24) {
            fail_usage("glTF holds numbers of faces up to 16,777,216, and samples lie in face " +
                       std::to_string(index_of(i)) + "; use .ply, .csv or .npz");
        }
    }
}

/// Types of accessors of 1 to 4 numbers.
constexpr int kTypes[] = {TINYGLTF_TYPE_SCALAR, TINYGLTF_TYPE_VEC2, TINYGLTF_TYPE_VEC3,
                          TINYGLTF_TYPE_VEC4};

std::string upper_case(std::string text) {
    std::ranges::transform(text, text.begin(), [](char c) {
        return c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c;
    });
    return text;
}

/// Returns the name that glTF has for an attribute: its own begin without '_'.
std::string attribute_name(const std::string& name) {
    return name == kColourField    ? "COLOR_0"
           : name == kUvField      ? "TEXCOORD_0"
           : name.starts_with('_') ? upper_case(name)
                                   : '_' + upper_case(name);
}

/// Throws for values that a float does not hold.
void check_values(const SampleField& field) {
    const auto lost = std::ranges::find_if(field.values, is_lost_in_float);
    if (lost != field.values.end()) {
        fail_usage("glTF holds attributes as floats, and the attribute " + in_quotes(field.name) +
                   " has a " + exact_text(*lost) +
                   ", which no float holds; use .ply, .csv or .npz");
    }
}

/// Adds accessors of floats to a file.
class FloatAccessors {
  public:
    FloatAccessors(tinygltf::Model& model, std::size_t count) : model_(model), count_(count) {
        model_.buffers.resize(1);
    }

    /// Returns the number of an accessor; `value(i, k)` is component k of point i.
    template <class Value>
    int add(std::size_t components, const Value& value) {
        UninitializedVector<float> numbers(count_ * components);
        for_rows(count_, [&](std::size_t i) {
            for (std::size_t k = 0; k < components; ++k) {
                numbers[i * components + k] = value(i, k);
            }
        });
        tinygltf::Accessor accessor;
        accessor.bufferView = static_cast<int>(model_.bufferViews.size());
        accessor.componentType = TINYGLTF_COMPONENT_TYPE_FLOAT;
        accessor.count = count_;
        accessor.type = kTypes[components - 1];
        set_bounds(accessor, numbers, components);
        model_.bufferViews.push_back(append(numbers));
        model_.accessors.push_back(std::move(accessor));
        return static_cast<int>(model_.accessors.size() - 1);
    }

    std::size_t count() const { return count_; }

  private:
    static void set_bounds(tinygltf::Accessor& accessor, std::span<const float> numbers,
                           std::size_t components) {
        const auto first = numbers.first(components);
        accessor.minValues.assign(first.begin(), first.end());
        accessor.maxValues = accessor.minValues;
        for (std::size_t i = components; i < numbers.size(); ++i) {
            const auto number = static_cast<double>(numbers[i]);
            double& least = accessor.minValues[i % components];
            double& most = accessor.maxValues[i % components];
            least = std::min(least, number);
            most = std::max(most, number);
        }
    }

    /// Appends numbers to the buffer.
    tinygltf::BufferView append(std::span<const float> numbers) {
        std::vector<unsigned char>& all = model_.buffers[0].data;
        tinygltf::BufferView view;
        view.buffer = 0;
        view.byteOffset = all.size();
        view.byteLength = numbers.size_bytes();
        view.target = TINYGLTF_TARGET_ARRAY_BUFFER;
        all.resize(view.byteOffset + view.byteLength);
        for (std::size_t i = 0; i < numbers.size(); ++i) {
            store_little_endian(all.data() + view.byteOffset + i * sizeof(float), numbers[i]);
        }
        return view;
    }

    tinygltf::Model& model_;
    std::size_t count_;
};

/// Collects the attributes of the points, all of them of floats.
class Points {
  public:
    Points(tinygltf::Model& model, std::size_t count) : accessors_(model, count) {
        primitive_.mode = TINYGLTF_MODE_POINTS;
    }

    /// `value(i, k)` is component k of point i.
    template <class Value>
    void add(const std::string& name, std::size_t components, const Value& value) {
        primitive_.attributes[name] = accessors_.add(components, value);
    }
    /// The same for numbers of faces, one of each point.
    template <class IndexOf>
    void add_indices(const std::string& name, const IndexOf& index_of) {
        check_indices(accessors_.count(), index_of);
        add(name, 1, [&](std::size_t i, std::size_t) { return static_cast<float>(index_of(i)); });
    }

    const tinygltf::Primitive& primitive() const { return primitive_; }

  private:
    FloatAccessors accessors_;
    tinygltf::Primitive primitive_;
};

/// Writes a stream to a file.
class FileBuffer : public std::streambuf {
  public:
    explicit FileBuffer(AtomicFile& file) : file_(file) {}

  private:
    std::streamsize xsputn(const char* bytes, std::streamsize count) override {
        file_.write({bytes, static_cast<std::size_t>(count)});
        return count;
    }
    int_type overflow(int_type c) override {
        const char byte = traits_type::to_char_type(c);
        xsputn(&byte, 1);
        return c;
    }

    AtomicFile& file_;
};

/// Returns a number as float, with the largest one in place of infinity, which glTF has not.
float finite_float(double value) {
    constexpr double kMax = std::numeric_limits<float>::max();
    return static_cast<float>(std::clamp(value, -kMax, kMax));
}

void add_surface(Points& points, std::span<const SampleRow> rows, const SampleLayout& layout) {
    points.add("NORMAL", 3, [&](std::size_t i, std::size_t k) { return rows[i].normal[k]; });
    points.add_indices("_FACE_INDEX", [&](std::size_t i) { return rows[i].face; });
    points.add("_BARYCENTRIC", 3, [&](std::size_t i, std::size_t k) { return rows[i].bary[k]; });
    if (layout.has_radius) {
        points.add("_RADIUS", 1,
                   [&](std::size_t i, std::size_t) { return static_cast<float>(rows[i].radius); });
    }
    for (const ExtraColumn& column : layout.further.numbers) {
        points.add_indices('_' + upper_case(column.name),
                           [&](std::size_t i) { return column.values[i]; });
    }
    if (layout.has_polygon) {
        points.add_indices("_POLYGON_INDEX",
                           [&](std::size_t i) { return rows[i].polygon.value_or(0); });
    }
    const SampleField* const frames = find_frames(layout.further);
    for (const SampleField& field : layout.further.fields) {
        if (&field == frames) {
            continue; // Which turn instances.
        }
        check_values(field);
        const std::size_t size = field.components.size();
        points.add(attribute_name(field.name), size, [&](std::size_t i, std::size_t k) {
            return finite_float(field_value(field, i, k, layout.colours));
        });
    }
}

constexpr const char* kInstances = "EXT_mesh_gpu_instancing";

/// Adds a node that places a triangle at each of the points of a node, turned by the frames, scaled
/// by the radius.
void add_instances(tinygltf::Model& model, const tinygltf::Node& points,
                   std::span<const SampleRow> rows, const SampleHeader& header,
                   const SampleLayout& layout) {
    const tinygltf::Primitive& primitive =
        model.meshes[static_cast<std::size_t>(points.mesh)].primitives[0];
    const int positions = primitive.attributes.at("POSITION"), material = primitive.material;
    const SampleField& frames = *find_frames(layout.further);
    FloatAccessors instances(model, rows.size());
    const int turns = instances.add(4, [&](std::size_t i, std::size_t k) {
        return static_cast<float>(frames.values[4 * i + k]);
    });
    const auto radius = common_radius(header, layout);
    const int scales =
        instances.add(3, [&](std::size_t i, std::size_t) { return scale_of(rows[i], radius); });
    Points corners(model, kMarker.size());
    corners.add("POSITION", 3, [](std::size_t i, std::size_t k) { return kMarker[i][k]; });
    tinygltf::Mesh mesh;
    mesh.name = "sample";
    mesh.primitives.push_back(corners.primitive());
    mesh.primitives[0].mode = TINYGLTF_MODE_TRIANGLES;
    mesh.primitives[0].material = material;
    tinygltf::Node node;
    node.name = points.name.empty() ? "" : points.name + "Instances";
    node.translation = points.translation;
    node.mesh = static_cast<int>(model.meshes.size());
    tinygltf::Value::Object attributes{{"TRANSLATION", tinygltf::Value(positions)},
                                       {"ROTATION", tinygltf::Value(turns)},
                                       {"SCALE", tinygltf::Value(scales)}};
    node.extensions.emplace(kInstances, tinygltf::Value(tinygltf::Value::Object{
                                            {"attributes", tinygltf::Value(attributes)}}));
    model.extensionsUsed = {kInstances};
    model.meshes.push_back(std::move(mesh));
    model.nodes.push_back(std::move(node));
}

/// Adds a node with a point for each row, and one that places a triangle at each if there are
/// frames. A class gives their name and, unless it is null, their colour.
void add_nodes(tinygltf::Model& model, std::span<const SampleRow> rows, const SampleHeader& header,
               const SampleTarget& target, const SampleLayout& layout, const SampleClass* own) {
    tinygltf::Node node;
    const std::array<double, 3> origin = origin_for_float(rows, 3);
    check_float_range(target, rows, origin);
    if (origin != std::array<double, 3>{}) {
        node.translation.assign(origin.begin(), origin.end());
    }
    Points points(model, rows.size());
    points.add("POSITION", 3, [&](std::size_t i, std::size_t k) {
        return static_cast<float>(rows[i].position[k] - origin[k]);
    });
    if (layout.is_on_surface) {
        add_surface(points, rows, layout);
    }
    tinygltf::Mesh mesh;
    mesh.primitives.push_back(points.primitive());
    if (own != nullptr) {
        node.name = own->name;
        if (!has_colours(layout)) {
            tinygltf::Material material;
            material.name = own->name;
            const auto& [red, green, blue] = own->colour;
            material.pbrMetallicRoughness.baseColorFactor = {red, green, blue, 1};
            material.pbrMetallicRoughness.metallicFactor = 0;
            mesh.primitives[0].material = static_cast<int>(model.materials.size());
            model.materials.push_back(std::move(material));
        }
    }
    node.mesh = static_cast<int>(model.meshes.size());
    model.meshes.push_back(std::move(mesh));
    model.nodes.push_back(node);
    if (find_frames(layout.further) != nullptr) {
        add_instances(model, node, rows, header, layout);
    }
}

/// Adds the nodes of a class, with its part of all columns.
void add_class(tinygltf::Model& model, std::span<const SampleRow> rows, const SampleHeader& header,
               const SampleTarget& target, const SampleLayout& layout, const SampleClass& own) {
    std::vector<SampleRow> own_rows;
    std::vector<ExtraColumn> numbers;
    std::vector<SampleField> fields;
    for (const ExtraColumn& column : layout.further.numbers) {
        numbers.push_back({column.name, {}});
    }
    for (const SampleField& field : layout.further.fields) {
        fields.push_back(field);
        fields.back().values.clear();
    }
    for (const std::uint32_t row : own.rows) {
        own_rows.push_back(rows[row]);
        for (std::size_t i = 0; i < numbers.size(); ++i) {
            numbers[i].values.push_back(layout.further.numbers[i].values[row]);
        }
        for (std::size_t i = 0; i < fields.size(); ++i) {
            const std::size_t size = fields[i].components.size();
            const auto values =
                std::span(layout.further.fields[i].values).subspan(row * size, size);
            fields[i].values.insert(fields[i].values.end(), values.begin(), values.end());
        }
    }
    SampleLayout own_layout = layout;
    own_layout.further = {numbers, fields};
    add_nodes(model, own_rows, header, target, own_layout, &own);
}

/// Returns the nodes of a scene where y points up and lengths are in metres: `nodes`, or one that
/// turns and scales these.
std::vector<int> place_in_scene(tinygltf::Model& model, std::vector<int> nodes,
                                const SampleTarget& target) {
    const double scale = target.metres_per_unit;
    if (nodes.empty() || (target.up == Up::y && scale == 1)) {
        return nodes;
    }
    constexpr double kHalf = std::numbers::sqrt2 / 2; // Of a quarter turn.
    tinygltf::Node root;
    root.name = "Samples";
    root.children = std::move(nodes);
    if (target.up != Up::y) {
        root.rotation = target.up == Up::z ? std::vector{-kHalf, 0.0, 0.0, kHalf}
                                           : std::vector{0.0, 0.0, kHalf, kHalf};
    }
    if (scale != 1) {
        root.scale = {scale, scale, scale};
    }
    model.nodes.push_back(std::move(root));
    return {static_cast<int>(model.nodes.size() - 1)};
}

/// tinygltf throws at text that is not UTF-8, which json_text() replaces.
tinygltf::Value extras_of(const SampleHeader& header) {
    tinygltf::Value::Object extras;
    const auto document = nlohmann::json::parse(json_text(header));
    for (const auto& [key, value] : document.items()) {
        if (value.is_array()) {
            tinygltf::Value::Array all;
            for (const nlohmann::json& one : value) {
                all.emplace_back(one_line(one.get<std::string>()));
            }
            extras.emplace(key, tinygltf::Value(std::move(all)));
        } else {
            extras.emplace(key, tinygltf::Value(one_line(value.get<std::string>())));
        }
    }
    return tinygltf::Value(std::move(extras));
}

} // namespace

void write_gltf(AtomicFile& file, const SampleHeader& header, std::span<const SampleRow> rows,
                const SampleTarget& target, const SampleLayout& layout) {
    tinygltf::Model model;
    model.asset.version = "2.0";
    model.asset.generator = "geodisk";
    model.asset.extras = extras_of(header);
    model.scenes.resize(1);
    model.defaultScene = 0;
    for (const std::vector<SampleClass> classes = sample_classes(rows, layout);
         const SampleClass& own : classes) {
        add_class(model, rows, header, target, layout, own);
    }
    if (model.nodes.empty() && !rows.empty()) { // No accessor may be empty.
        add_nodes(model, rows, header, target, layout, nullptr);
    }
    std::vector<int> nodes(model.nodes.size());
    std::iota(nodes.begin(), nodes.end(), 0);
    model.scenes[0].nodes = place_in_scene(model, std::move(nodes), target);
    const bool is_binary = target.format == SampleFormat::glb;
    FileBuffer buffer(file);
    std::ostream out(&buffer);
    out.exceptions(std::ios::badbit); // Keeps those of the file.
    tinygltf::TinyGLTF writer;
    if (!writer.WriteGltfSceneToStream(&model, out, true, is_binary)) {
        throw UserError(ExitCode::internal, "the samples do not go into a glTF file");
    }
}

} // namespace geodisk::tools
