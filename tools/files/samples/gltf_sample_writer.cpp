#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <numeric>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>

#include "files/byte_order.hpp"
#include "files/float_values.hpp"
#include "files/meshes/data_uri.hpp"
#include "files/meshes/mesh_fields.hpp"
#include "files/output/block_writer.hpp"
#include "files/samples/sample_instances.hpp"
#include "files/samples/sample_writers.hpp"
#include "geometry/mesh_parts.hpp"
#include "program/exact_text.hpp"
#include "program/failure.hpp"
#include "program/human_text.hpp"
#include "program/safe_text.hpp"

namespace geodisk::tools {
namespace {

using nlohmann::json;

/// Numbers that an attribute holds for each point, at most.
constexpr std::size_t kMostComponents = 4;

/// Document of glTF whose accessors are all in one buffer.
struct GltfDocument {
    json content = json::object();
    std::string buffer;
};

/// Appends to a list of a document, which makes the list if it has none. Returns the number of what
/// was appended.
std::size_t append_to(json& list, json member) {
    list.push_back(std::move(member));
    return list.size() - 1;
}

/// Returns a number of a column as float: glTF allows attributes of its users no integers of 32
/// bits. Throws for what a float does not hold exactly; -1 stands for none.
float float_of_index(const std::string& name, std::uint32_t index) {
    if (index != kNoPart && index > 1u << 24) {
        fail_usage("glTF holds whole numbers up to 16,777,216, and " + name + " has " +
                   std::to_string(index) + "; use " + listed_formats(&FormatFacts::holds_all));
    }
    return index == kNoPart ? -1.0F : static_cast<float>(index);
}

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
                   " has a " + exact_text(*lost) + ", which no float holds; use " +
                   listed_formats(&FormatFacts::holds_all));
    }
}

/// Adds accessors of floats to a document.
class FloatAccessors {
  public:
    FloatAccessors(GltfDocument& gltf, std::size_t count) : gltf_(gltf), count_(count) {}

    /// Returns the number of an accessor; `value(i, k)` is component k of point i.
    template <class Value>
    std::size_t add(std::size_t components, const Value& value) {
        constexpr const char* kTypes[kMostComponents] = {"SCALAR", "VEC2", "VEC3", "VEC4"};
        constexpr int kFloat = 5126, kArrayBuffer = 34962;
        const std::size_t begin = gltf_.buffer.size();
        const std::size_t size = count_ * components * sizeof(float);
        gltf_.buffer.resize(begin + size);
        char* const bytes = gltf_.buffer.data() + begin;
        for_rows(count_, [&](std::size_t i) {
            for (std::size_t k = 0; k < components; ++k) {
                const float number = value(i, k);
                store_little_endian(bytes + (i * components + k) * sizeof number, number);
            }
        });
        json view{{"buffer", 0}, {"byteLength", size}, {"target", kArrayBuffer}};
        if (begin > 0) {
            view["byteOffset"] = begin;
        }
        const auto [least, most] = bounds({bytes, size}, components);
        return append_to(gltf_.content["accessors"],
                         {{"bufferView", append_to(gltf_.content["bufferViews"], std::move(view))},
                          {"componentType", kFloat},
                          {"count", count_},
                          {"min", least},
                          {"max", most},
                          {"type", kTypes[components - 1]}});
    }

    std::size_t count() const { return count_; }

  private:
    using Numbers = std::vector<double>;

    /// Returns the minimum and the maximum of each component.
    static std::pair<Numbers, Numbers> bounds(std::string_view bytes, std::size_t components) {
        const auto number = [&](std::size_t i) {
            return number_of_bytes<float>(bytes.data() + i * sizeof(float));
        };
        Numbers least(components);
        for (std::size_t k = 0; k < components; ++k) {
            least[k] = number(k);
        }
        Numbers most = least;
        for (std::size_t i = components; i < bytes.size() / sizeof(float); ++i) {
            const std::size_t k = i % components;
            least[k] = std::min(least[k], number(i));
            most[k] = std::max(most[k], number(i));
        }
        return {least, most};
    }

    GltfDocument& gltf_;
    std::size_t count_;
};

/// Collects the attributes of the points, all of them of floats.
class Points {
  public:
    Points(GltfDocument& gltf, std::size_t count) : accessors_(gltf, count) {}

    /// `value(i, k)` is component k of point i.
    template <class Value>
    void add(const std::string& name, std::size_t components, const Value& value) {
        if (attributes_.contains(name)) {
            fail_usage("two attributes of glTF would be called " + in_quotes(name) +
                       "; leave one out, or use " + listed_formats(&FormatFacts::holds_all));
        }
        attributes_[name] = accessors_.add(components, value);
    }
    /// Adds whole numbers, one of each point; `index_of(i)` is that of point i.
    template <class IndexOf>
    void add_indices(const std::string& name, const IndexOf& index_of) {
        std::vector<float> numbers(accessors_.count());
        for (std::size_t i = 0; i < numbers.size(); ++i) {
            numbers[i] = float_of_index(name, index_of(i));
        }
        add(name, 1, [&](std::size_t i, std::size_t) { return numbers[i]; });
    }

    /// Returns what has these attributes. A mode of 0 draws points, one of 4 triangles.
    json primitive(int mode, const json& material) const {
        json result{{"attributes", attributes_}, {"mode", mode}};
        if (!material.is_null()) {
            result["material"] = material;
        }
        return result;
    }

    std::size_t positions() const { return attributes_.at("POSITION"); }

  private:
    FloatAccessors accessors_;
    json attributes_;
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
        const auto value = [&](std::size_t i, std::size_t k) {
            return finite_float(field_value(field, i, k, layout.colours));
        };
        if (size <= kMostComponents) {
            points.add(attribute_name(field.name), size, value);
            continue;
        }
        for (std::size_t k = 0; k < size; ++k) { // glTF has no type for so many.
            points.add(attribute_name(field.components[k]), 1,
                       [&](std::size_t i, std::size_t) { return value(i, k); });
        }
    }
}

constexpr int kDrawPoints = 0, kDrawTriangles = 4;

/// Adds a node that places a triangle at each of the `points` of a node, turned by the frames,
/// scaled by the radius.
void add_instances(GltfDocument& gltf, json node, const Points& points, const json& material,
                   std::span<const SampleRow> rows, const SampleHeader& header,
                   const SampleLayout& layout) {
    constexpr const char* kInstances = "EXT_mesh_gpu_instancing";
    const SampleField& frames = *find_frames(layout.further);
    FloatAccessors instances(gltf, rows.size());
    json attributes{{"TRANSLATION", points.positions()}};
    attributes["ROTATION"] = instances.add(4, [&](std::size_t i, std::size_t k) {
        return static_cast<float>(frames.values[4 * i + k]);
    });
    const auto radius = common_radius(header, layout);
    attributes["SCALE"] =
        instances.add(3, [&](std::size_t i, std::size_t) { return scale_of(rows[i], radius); });
    const auto marker = marker_of(header);
    Points corners(gltf, marker.size());
    corners.add("POSITION", 3, [&](std::size_t i, std::size_t k) { return marker[i][k]; });
    if (node.contains("name")) {
        node["name"] = node["name"].get<std::string>() + "Instances";
    }
    const json primitives = json::array({corners.primitive(kDrawTriangles, material)});
    node["mesh"] =
        append_to(gltf.content["meshes"], {{"name", "sample"}, {"primitives", primitives}});
    node["extensions"][kInstances]["attributes"] = attributes;
    gltf.content["extensionsUsed"] = {kInstances};
    append_to(gltf.content["nodes"], std::move(node));
}

/// Returns the number of a material, which it adds, in the colour of a class.
std::size_t add_material(GltfDocument& gltf, const SampleClass& own) {
    const auto& [red, green, blue] = own.colour;
    const json surface{{"baseColorFactor", {red, green, blue, 1.0}}, {"metallicFactor", 0.0}};
    return append_to(gltf.content["materials"],
                     {{"name", own.name}, {"pbrMetallicRoughness", surface}});
}

/// Adds a node with a point for each row, and one that places a triangle at each if there are
/// frames. A class gives their name and, unless it is null, their colour.
void add_nodes(GltfDocument& gltf, std::span<const SampleRow> rows, const SampleHeader& header,
               const SampleTarget& target, const SampleLayout& layout, const SampleClass* own) {
    const std::array<double, 3> origin = origin_for_float(rows, 3);
    check_float_range(target, rows, origin);
    json node;
    if (origin != std::array<double, 3>{}) {
        node["translation"] = origin;
    }
    Points points(gltf, rows.size());
    points.add("POSITION", 3, [&](std::size_t i, std::size_t k) {
        return static_cast<float>(rows[i].position[k] - origin[k]);
    });
    if (layout.is_on_surface) {
        add_surface(points, rows, layout);
    }
    json material; // Null for none.
    if (own != nullptr) {
        node["name"] = own->name;
        if (!has_colours(layout)) {
            material = add_material(gltf, *own);
        }
    }
    const json primitives = json::array({points.primitive(kDrawPoints, material)});
    node["mesh"] = append_to(gltf.content["meshes"], {{"primitives", primitives}});
    append_to(gltf.content["nodes"], node);
    if (find_frames(layout.further) != nullptr) {
        add_instances(gltf, std::move(node), points, material, rows, header, layout);
    }
}

/// Adds the nodes of a class, with its part of all columns.
void add_class(GltfDocument& gltf, std::span<const SampleRow> rows, const SampleHeader& header,
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
    add_nodes(gltf, own_rows, header, target, own_layout, &own);
}

/// Returns the nodes of a scene where y points up and lengths are in metres: all that there are, or
/// one that turns and scales these.
std::vector<std::size_t> place_in_scene(json& nodes, const SampleTarget& target) {
    std::vector<std::size_t> all(nodes.size());
    std::iota(all.begin(), all.end(), std::size_t{0});
    const double scale = target.metres_per_unit;
    if (target.up == Up::y && scale == 1) {
        return all;
    }
    constexpr double kHalf = std::numbers::sqrt2 / 2; // Of a quarter turn.
    json root{{"name", "Samples"}, {"children", all}};
    if (target.up != Up::y) {
        root["rotation"] = target.up == Up::z ? std::array{-kHalf, 0.0, 0.0, kHalf}
                                              : std::array{0.0, 0.0, kHalf, kHalf};
    }
    if (scale != 1) {
        root["scale"] = {scale, scale, scale};
    }
    return {append_to(nodes, std::move(root))};
}

/// Returns the entries of the header, each on one line.
json extras_of(const SampleHeader& header) {
    json extras = json::parse(json_text(header));
    for (json& value : extras) {
        for (json& text : value) { // One, unless it is an array.
            text = one_line(text.get<std::string>());
        }
    }
    return extras;
}

void check_gltf_size(const SampleTarget& target, std::size_t size) {
    if (size > std::numeric_limits<std::uint32_t>::max()) {
        fail_output("the samples take more than the 4 GiB of a " + extension_of(target.format) +
                    " file; use .ply or .csv");
    }
}

/// Writes a binary file: a header, and chunks that consist of whole words.
void write_glb(AtomicFile& file, const SampleTarget& target, std::string text, std::string buffer) {
    const auto fill_up = [](std::string& bytes, char filler) {
        bytes.append((4 - bytes.size() % 4) % 4, filler);
    };
    fill_up(text, ' ');
    fill_up(buffer, '\0');
    constexpr std::uint32_t kVersion = 2, kJson = 0x4e4f534a, kBinary = 0x004e4942;
    constexpr std::size_t kHeader = 12, kChunkHeader = 8;
    const std::size_t size =
        kHeader + kChunkHeader + text.size() + (buffer.empty() ? 0 : kChunkHeader + buffer.size());
    check_gltf_size(target, size);
    std::string head = "glTF";
    append_little_endian(head, kVersion);
    append_little_endian(head, static_cast<std::uint32_t>(size));
    const auto write_chunk = [&](std::uint32_t type, const std::string& bytes) {
        append_little_endian(head, static_cast<std::uint32_t>(bytes.size()));
        append_little_endian(head, type);
        file.write(head);
        file.write(bytes);
        head.clear();
    };
    write_chunk(kJson, text);
    if (!buffer.empty()) {
        write_chunk(kBinary, buffer);
    }
}

} // namespace

void write_gltf(AtomicFile& file, const SampleHeader& header, std::span<const SampleRow> rows,
                const SampleTarget& target, const SampleLayout& layout) {
    GltfDocument gltf;
    json& content = gltf.content;
    content["asset"] = {{"version", "2.0"}, {"generator", "geodisk"}};
    if (json extras = extras_of(header); !extras.empty()) {
        content["asset"]["extras"] = std::move(extras);
    }
    for (const std::vector<SampleClass> classes = sample_classes(rows, layout);
         const SampleClass& own : classes) {
        add_class(gltf, rows, header, target, layout, own);
    }
    if (!content.contains("nodes") && !rows.empty()) { // No accessor may be empty.
        add_nodes(gltf, rows, header, target, layout, nullptr);
    }
    json scene = json::object();
    if (content.contains("nodes")) {
        scene["nodes"] = place_in_scene(content["nodes"], target);
    }
    content["scene"] = append_to(content["scenes"], std::move(scene));
    const bool is_binary = target.format == SampleFormat::glb;
    if (!gltf.buffer.empty()) {
        json buffer{{"byteLength", gltf.buffer.size()}};
        if (!is_binary) {
            buffer["uri"] = data_uri(gltf.buffer);
        }
        append_to(content["buffers"], std::move(buffer));
    }
    // Attributes may have names that are not UTF-8.
    std::string text = content.dump(is_binary ? -1 : 2, ' ', false, json::error_handler_t::replace);
    if (is_binary) {
        write_glb(file, target, std::move(text), std::move(gltf.buffer));
        return;
    }
    check_gltf_size(target, text.size());
    file.write(text + '\n');
}

} // namespace geodisk::tools
