#include <algorithm>
#include <array>
#include <sstream>
#include <vector>

#include <nlohmann/json.hpp>
#include <tiny_gltf.h>

#include "files/ply_file.hpp"
#include "files/sample_writers.hpp"
#include "program/failure.hpp"
#include "program/safe_text.hpp"

namespace geodisk::tools {
namespace {

/// glTF allows attributes of its users no integers of 32 bits; a float holds these exactly.
float exact_float(std::uint32_t index) {
    if (index > 1u << 24) {
        fail_usage("glTF holds numbers of faces up to 16,777,216, and samples lie in face " +
                   std::to_string(index) + "; use .ply, .csv or .npz");
    }
    return static_cast<float>(index);
}

std::string upper_case(std::string text) {
    std::ranges::transform(text, text.begin(), [](char c) {
        return c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c;
    });
    return text;
}

/// Collects the attributes of the points, all of them of floats.
class Points {
  public:
    Points(tinygltf::Model& model, std::span<const SampleRow> rows) : model_(model), rows_(rows) {
        model_.buffers.resize(1);
        primitive_.mode = TINYGLTF_MODE_POINTS;
    }

    /// `value(row, i)` is that of component i.
    template <class Value>
    void add(const char* name, std::size_t components, const Value& value) {
        std::string bytes;
        std::vector<double> least(components), most(components);
        for (std::size_t i = 0; i < rows_.size(); ++i) {
            for (std::size_t k = 0; k < components; ++k) {
                const float number = value(rows_[i], k);
                append_little_endian(bytes, number);
                const auto exact = static_cast<double>(number);
                least[k] = i == 0 ? exact : std::min(least[k], exact);
                most[k] = i == 0 ? exact : std::max(most[k], exact);
            }
        }
        std::vector<unsigned char>& all = model_.buffers[0].data;
        tinygltf::BufferView view;
        view.buffer = 0;
        view.byteOffset = all.size();
        view.byteLength = bytes.size();
        view.target = TINYGLTF_TARGET_ARRAY_BUFFER;
        all.insert(all.end(), bytes.begin(), bytes.end());
        tinygltf::Accessor accessor;
        accessor.bufferView = static_cast<int>(model_.bufferViews.size());
        accessor.componentType = TINYGLTF_COMPONENT_TYPE_FLOAT;
        accessor.count = rows_.size();
        accessor.type = components == 3 ? TINYGLTF_TYPE_VEC3 : TINYGLTF_TYPE_SCALAR;
        accessor.minValues = std::move(least);
        accessor.maxValues = std::move(most);
        primitive_.attributes[name] = static_cast<int>(model_.accessors.size());
        model_.bufferViews.push_back(std::move(view));
        model_.accessors.push_back(std::move(accessor));
    }

    const tinygltf::Primitive& primitive() const { return primitive_; }

  private:
    tinygltf::Model& model_;
    std::span<const SampleRow> rows_;
    tinygltf::Primitive primitive_;
};

void add_surface(Points& points, const SampleLayout& layout) {
    points.add("NORMAL", 3, [](const SampleRow& row, std::size_t k) { return row.normal[k]; });
    points.add("_FACE_INDEX", 1,
               [](const SampleRow& row, std::size_t) { return exact_float(row.face); });
    points.add("_BARYCENTRIC", 3, [](const SampleRow& row, std::size_t k) { return row.bary[k]; });
    if (layout.has_radius) {
        points.add("_RADIUS", 1, [](const SampleRow& row, std::size_t) {
            return static_cast<float>(row.radius);
        });
    }
    for (const ExtraColumn& column : layout.extra) {
        const std::uint32_t* next = column.values.data();
        points.add(("_" + upper_case(column.name)).c_str(), 1,
                   [&next](const SampleRow&, std::size_t) { return exact_float(*next++); });
    }
    if (layout.has_polygon) {
        points.add("_POLYGON_INDEX", 1, [](const SampleRow& row, std::size_t) {
            return exact_float(row.polygon.value_or(0));
        });
    }
}

/// A node with all points.
tinygltf::Node add_points(tinygltf::Model& model, std::span<const SampleRow> rows,
                          const SampleTarget& target, const SampleLayout& layout) {
    tinygltf::Node node;
    const std::array<double, 3> origin = origin_for_float(rows, 3);
    check_float_range(target, rows, origin);
    if (origin != std::array<double, 3>{}) {
        node.translation.assign(origin.begin(), origin.end());
    }
    Points points(model, rows);
    points.add("POSITION", 3, [&](const SampleRow& row, std::size_t k) {
        return static_cast<float>(row.position[k] - origin[k]);
    });
    if (layout.is_on_surface) {
        add_surface(points, layout);
    }
    tinygltf::Mesh mesh;
    mesh.primitives.push_back(points.primitive());
    model.meshes.push_back(std::move(mesh));
    node.mesh = 0;
    return node;
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
    if (!rows.empty()) { // No accessor may be empty.
        model.nodes.push_back(add_points(model, rows, target, layout));
        model.scenes[0].nodes.push_back(0);
    }
    const bool is_binary = target.format == SampleFormat::glb;
    std::ostringstream out;
    tinygltf::TinyGLTF writer;
    if (!writer.WriteGltfSceneToStream(&model, out, true, is_binary)) {
        throw UserError(ExitCode::internal, "the samples do not go into a glTF file");
    }
    file.write(out.view());
}

} // namespace geodisk::tools
