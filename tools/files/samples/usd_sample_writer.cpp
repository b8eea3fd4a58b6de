#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "files/float_values.hpp"
#include "files/meshes/mesh_fields.hpp"
#include "files/output/block_writer.hpp"
#include "files/samples/sample_instances.hpp"
#include "files/samples/sample_writers.hpp"
#include "program/exact_text.hpp"

namespace geodisk::tools {
namespace {

constexpr std::string_view kIndent = "    ";

/// Returns text in quotes of USD.
std::string quoted(const std::string& text) {
    std::string result = "\"";
    for (const char c : text) {
        if (c == '"' || c == '\\') {
            result += '\\';
        }
        result += c;
    }
    return result + '"';
}

/// Returns a name with '_' for what USD allows in no name.
std::string identifier(std::string name) {
    for (char& c : name) {
        c = c == '.' || c == '-' ? '_' : c;
    }
    return name[0] >= '0' && name[0] <= '9' ? '_' + name : name;
}

/// Returns the float nearest to a number.
std::string float_text(double value) {
    return exact_text(static_cast<float>(value));
}

/// Returns how positions are turned, as no axis but Y and Z points up in USD, and moved.
std::string transforms(const SampleTarget& target, const std::array<double, 3>& origin) {
    std::string text, order;
    if (target.up == Up::x) {
        text += "    float xformOp:rotateY = -90\n";
        order += "\"xformOp:rotateY\"";
    }
    if (origin != std::array<double, 3>{}) {
        text += "    double3 xformOp:translate = (" + exact_text(origin[0]) + ", " +
                exact_text(origin[1]) + ", " + exact_text(origin[2]) + ")\n";
        order += std::string(order.empty() ? "" : ", ") + "\"xformOp:translate\"";
    }
    return order.empty() ? "" : text + "    uniform token[] xformOpOrder = [" + order + "]\n";
}

/// Writes the properties of a PointInstancer, one array after the other.
class Properties {
  public:
    Properties(AtomicFile& file, std::size_t rows, ColourEncoding colours)
        : file_(file), rows_(rows), colours_(colours) {}

    /// Writes an array; `value(i, k)` is component k of row i. Primvars have a value per instance.
    template <class Value>
    void add(const std::string& declaration, std::size_t components, const Value& value,
             bool is_primvar = false) {
        file_.write(std::string(kIndent) + declaration + " = [");
        write_each(file_, rows_, [&](std::string& text, std::size_t i) {
            text += i > 0 ? ", " : "";
            append_value(text, components, [&](std::size_t k) { return value(i, k); });
        });
        const std::string size = has_type(components)
                                     ? ""
                                     : "        elementSize = " + std::to_string(components) + "\n";
        file_.write(is_primvar ? "] (\n" + size + "        interpolation = \"vertex\"\n    )\n"
                               : "]\n");
    }

    template <class Value>
    void add_primvar(const std::string& type, const std::string& name, std::size_t components,
                     const Value& value) {
        add(type + "[] primvars:" + identifier(name), components, value, true);
    }
    void add_field(const SampleField& field) {
        const std::size_t size = field.components.size();
        const auto exact = [&](std::size_t i, std::size_t k) {
            return field_value(field, i, k, colours_);
        };
        const auto value = [&](std::size_t i, std::size_t k) {
            return static_cast<float>(exact(i, k));
        };
        if (field.name == kColourField) {
            add_primvar("color3f", "displayColor", 3, value);
            if (size == 4) {
                add_primvar("float", "displayOpacity", 1,
                            [&](std::size_t i, std::size_t) { return value(i, 3); });
            }
        } else if (field.name == kUvField && size == 2) {
            add_primvar("texCoord2f", "st", size, value);
        } else if (field.is_whole) {
            add_primvar("int" + number_of(size), field.name, size,
                        [&](std::size_t i, std::size_t k) {
                            return static_cast<std::int32_t>(field.values[i * size + k]);
                        });
        } else if (std::ranges::any_of(field.values, is_lost_in_float)) {
            add_primvar("double" + number_of(size), field.name, size, exact);
        } else {
            add_primvar("float" + number_of(size), field.name, size, value);
        }
    }

  private:
    /// Returns true if USD has a type for so many numbers; more are elements of an array of single
    /// ones.
    static bool has_type(std::size_t components) { return components <= 4; }

    static std::string number_of(std::size_t components) {
        return components == 1 || !has_type(components) ? "" : std::to_string(components);
    }

    template <class Value>
    static void append_value(std::string& text, std::size_t components, const Value& value) {
        const bool is_tuple = components > 1 && has_type(components);
        text += is_tuple ? "(" : "";
        for (std::size_t k = 0; k < components; ++k) {
            text += k > 0 ? ", " : "";
            append_number(text, value(k));
        }
        text += is_tuple ? ")" : "";
    }

    AtomicFile& file_;
    std::size_t rows_;
    ColourEncoding colours_;
};

void add_surface(Properties& properties, std::span<const SampleRow> rows,
                 const SampleLayout& layout) {
    properties.add_primvar("normal3f", "normals", 3,
                           [&](std::size_t i, std::size_t k) { return rows[i].normal[k]; });
    properties.add_primvar("uint", "face_index", 1,
                           [&](std::size_t i, std::size_t) { return rows[i].face; });
    properties.add_primvar("float3", "barycentric", 3,
                           [&](std::size_t i, std::size_t k) { return rows[i].bary[k]; });
    if (layout.has_polygon) {
        properties.add_primvar("uint", "polygon_index", 1, [&](std::size_t i, std::size_t) {
            return rows[i].polygon.value_or(0);
        });
    }
    for (const ExtraColumn& column : layout.further.numbers) {
        properties.add_primvar("uint", column.name, 1,
                               [&](std::size_t i, std::size_t) { return column.values[i]; });
    }
    const SampleField* const frames = find_frames(layout.further);
    for (const SampleField& field : layout.further.fields) {
        if (&field != frames) {
            properties.add_field(field);
        }
    }
    if (frames != nullptr) { // USD has w first.
        properties.add("quath[] orientations", 4, [&](std::size_t i, std::size_t k) {
            return static_cast<float>(frames->values[4 * i + (k + 3) % 4]);
        });
    }
}

/// Returns the shape that stands for a sample: a triangle where frames turn it, else a ball. It has
/// the colour of a class, unless that is null.
std::string prototype(const std::string& name, const std::array<double, 3>* colour,
                      const std::optional<Marker>& marker) {
    std::string text =
        "        def " + std::string(marker ? "Mesh" : "Sphere") + " \"" + name + "\"\n        {\n";
    if (colour != nullptr) {
        text += "            color3f[] primvars:displayColor = [(" + float_text((*colour)[0]) +
                ", " + float_text((*colour)[1]) + ", " + float_text((*colour)[2]) + ")]\n";
    }
    if (!marker) {
        return text + "            double radius = 1\n        }\n";
    }
    std::string points;
    for (const std::array<float, 3>& corner : *marker) {
        points += (points.empty() ? "(" : ", (") + exact_text(corner[0]) + ", " +
                  exact_text(corner[1]) + ", " + exact_text(corner[2]) + ')';
    }
    return text + R"(            uniform bool doubleSided = 1
            uniform token subdivisionScheme = "none"
            int[] faceVertexCounts = [3]
            int[] faceVertexIndices = [0, 1, 2]
            point3f[] points = [)" +
           points + "]\n        }\n";
}

/// The shapes of all samples.
struct Prototypes {
    std::vector<std::uint32_t> of_row; ///< Their numbers.
    std::string paths, shapes;

    Prototypes(std::span<const SampleRow> rows, const SampleHeader& header,
               const SampleLayout& layout)
        : of_row(rows.size()) {
        const auto marker = find_frames(layout.further) != nullptr
                                ? std::optional(marker_of(header))
                                : std::nullopt;
        const std::vector<SampleClass> classes = sample_classes(rows, layout);
        for (const SampleClass& one : classes) {
            for (const std::uint32_t row : one.rows) {
                of_row[row] = static_cast<std::uint32_t>(&one - classes.data());
            }
            paths += (paths.empty() ? "[<" : ", <") + path_of(one.name);
            shapes += prototype(one.name, has_colours(layout) ? nullptr : &one.colour, marker);
        }
        paths += classes.empty() ? "" : "]";
        if (classes.empty()) {
            paths = "<" + path_of("Sample");
            shapes = prototype("Sample", nullptr, marker);
        }
    }

  private:
    static std::string path_of(const std::string& name) {
        return "/Samples/Prototypes/" + name + ">";
    }
};

} // namespace

void write_usd(AtomicFile& file, const SampleHeader& header, std::span<const SampleRow> rows,
               const SampleTarget& target, const SampleLayout& layout) {
    const std::array<double, 3> origin = origin_for_float(rows, 3);
    check_float_range(target, rows, origin);
    file.write("#usda 1.0\n(\n    customLayerData = {\n        string geodisk = " +
               quoted(json_text(header)) +
               "\n    }\n    defaultPrim = \"Samples\"\n    metersPerUnit = " +
               exact_text(target.metres_per_unit) + "\n    upAxis = \"" +
               (target.up == Up::y ? "Y" : "Z") + "\"\n)\n\ndef PointInstancer \"Samples\"\n{\n" +
               transforms(target, origin));
    Properties properties(file, rows.size(), layout.colours);
    properties.add("point3f[] positions", 3, [&](std::size_t i, std::size_t k) {
        return static_cast<float>(rows[i].position[k] - origin[k]);
    });
    const Prototypes prototypes(rows, header, layout);
    properties.add("int[] protoIndices", 1,
                   [&](std::size_t i, std::size_t) { return prototypes.of_row[i]; });
    const auto radius = common_radius(header, layout);
    properties.add("float3[] scales", 3,
                   [&](std::size_t i, std::size_t) { return scale_of(rows[i], radius); });
    if (layout.is_on_surface) {
        add_surface(properties, rows, layout);
    }
    file.write("    rel prototypes = " + prototypes.paths +
               "\n\n    def Scope \"Prototypes\"\n    {\n" + prototypes.shapes + "    }\n}\n");
}

} // namespace geodisk::tools
