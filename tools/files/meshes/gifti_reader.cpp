#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "files/archives/inflate.hpp"
#include "files/base64.hpp"
#include "files/input_file.hpp"
#include "files/meshes/array_fields.hpp"
#include "files/meshes/polygon_mesh.hpp"
#include "files/meshes/value_files.hpp"
#include "files/meshes/xml_numbers.hpp"
#include "files/xml_file.hpp"
#include "program/exact_text.hpp"
#include "program/failure.hpp"
#include "program/human_text.hpp"

namespace geodisk::tools {
namespace {

constexpr std::array<std::pair<std::string_view, NumberType>, 10> kNiftiTypes{{
    {"NIFTI_TYPE_UINT8", kNumberType<std::uint8_t>},
    {"NIFTI_TYPE_INT8", kNumberType<std::int8_t>},
    {"NIFTI_TYPE_INT16", kNumberType<std::int16_t>},
    {"NIFTI_TYPE_UINT16", kNumberType<std::uint16_t>},
    {"NIFTI_TYPE_INT32", kNumberType<std::int32_t>},
    {"NIFTI_TYPE_UINT32", kNumberType<std::uint32_t>},
    {"NIFTI_TYPE_INT64", kNumberType<std::int64_t>},
    {"NIFTI_TYPE_UINT64", kNumberType<std::uint64_t>},
    {"NIFTI_TYPE_FLOAT32", kNumberType<float>},
    {"NIFTI_TYPE_FLOAT64", kNumberType<double>},
}};

constexpr std::string_view kIntent = "NIFTI_INTENT_", kPointset = "POINTSET",
                           kTriangle = "TRIANGLE", kNodeIndex = "NODE_INDEX";

/// Size of a table of numbers.
struct Table {
    std::uint64_t rows = 1, columns = 1;
};

/// The arrays of a file.
class GiftiArrays {
  public:
    explicit GiftiArrays(const XmlFile& file) : file_(file) {}

    static std::string_view intent_of(const pugi::xml_node& array) {
        std::string_view intent = array.attribute("Intent").value();
        intent.remove_prefix(intent.starts_with(kIntent) ? kIntent.size() : 0);
        return intent;
    }

    /// Returns true for numbers of vertices or faces.
    static bool is_of_values(const pugi::xml_node& array) {
        const std::string_view intent = intent_of(array);
        return intent != kPointset && intent != kTriangle && intent != kNodeIndex;
    }

    pugi::xml_node only_array(std::string_view intent) const {
        pugi::xml_node found;
        for (const pugi::xml_node array : file_.root().children("DataArray")) {
            if (intent_of(array) != intent) {
                continue;
            }
            if (found) {
                file_.fail(array, "is the second array of " + std::string(kIntent) +
                                      std::string(intent) + "; one surface is read");
            }
            found = array;
        }
        if (!found) {
            fail_input(file_.path(), "has no array of " + std::string(kIntent) +
                                         std::string(intent) + ", as a surface (.surf.gii) has");
        }
        return found;
    }

    Table table_of(const pugi::xml_node& array) const {
        Table table;
        const std::uint64_t dimensions = file_.count_in(array, "Dimensionality").value_or(1);
        for (std::uint64_t i = 0; i < std::min<std::uint64_t>(dimensions, 10); ++i) {
            const std::string name = "Dim" + std::to_string(i);
            const auto size = file_.count_in(array, name.c_str());
            std::uint64_t& all = i == 0 ? table.rows : table.columns;
            constexpr std::uint64_t kMax = std::numeric_limits<std::uint32_t>::max();
            if (!size || *size > kMax || (*size > 0 && all > kMax / *size)) {
                file_.fail(array, size ? "has more numbers than can be read" : "has no " + name);
            }
            all *= *size;
        }
        return table;
    }

    static const NumberType* type_of(const pugi::xml_node& array) {
        const auto found =
            std::ranges::find(kNiftiTypes, std::string_view(array.attribute("DataType").value()),
                              &std::pair<std::string_view, NumberType>::first);
        return found == kNiftiTypes.end() ? nullptr : &found->second;
    }

    /// Returns the numbers of an array, row by row.
    std::vector<double> numbers_in(const pugi::xml_node& array) const {
        const NumberType* const type = type_of(array);
        if (type == nullptr) {
            file_.fail(array, "has the unknown DataType " +
                                  in_quotes(array.attribute("DataType").value()));
        }
        const Table table = table_of(array);
        const std::uint64_t count = table.rows * table.columns;
        const std::size_t size = bytes_of_numbers(file_, array, *type, count);
        const std::string_view encoding = array.attribute("Encoding").value(),
                               text = array.child_value("Data");
        std::vector<double> numbers;
        if (encoding == "ASCII") {
            numbers = numbers_of_text(file_, array, text, count);
        } else if (encoding == "Base64Binary" || encoding == "GZipBase64Binary") {
            const bool is_little =
                std::string_view(array.attribute("Endian").value()) != "BigEndian";
            numbers = numbers_of_bytes(
                bytes_of_text(array, text, encoding == "GZipBase64Binary", size), *type, is_little);
        } else {
            file_.fail(array, "has the Encoding " + in_quotes(encoding) +
                                  ", which is not read; save the data in the file itself");
        }
        const bool by_column =
            std::string_view(array.attribute("ArrayIndexingOrder").value()) == "ColumnMajorOrder";
        return by_column ? transposed(numbers, table) : numbers;
    }

  private:
    std::string bytes_of_text(const pugi::xml_node& array, std::string_view text, bool is_packed,
                              std::size_t size) const {
        std::optional<std::string> bytes = from_base64(text);
        if (!bytes) {
            file_.fail(array, "is no base64");
        }
        if (is_packed && size > 0) {
            bytes = inflated(file_.path(), *bytes, size, Wrapping::zlib_or_gzip);
            if (!bytes) {
                file_.fail(array, "does not unpack to " + grouped(size) + " bytes");
            }
        }
        if (bytes->size() != size) {
            file_.fail(array, "has " + grouped(bytes->size()) + " bytes, not " + grouped(size));
        }
        return std::move(*bytes);
    }

    static std::vector<double> transposed(const std::vector<double>& columns, const Table& table) {
        std::vector<double> rows;
        rows.reserve(columns.size());
        for (std::size_t row = 0; row < table.rows; ++row) {
            for (std::size_t column = 0; column < table.columns; ++column) {
                rows.push_back(columns[column * table.rows + row]);
            }
        }
        return rows;
    }

    const XmlFile& file_;
};

class GiftiReader {
  public:
    GiftiReader(const XmlFile& file, const WantedFields& fields)
        : file_(file), arrays_(file), fields_(file.path(), fields, mesh_) {}

    PolygonMesh read() && {
        const pugi::xml_node points = arrays_.only_array(kPointset),
                             triangles = arrays_.only_array(kTriangle);
        mesh_.positions = triples(points);
        warn_of_transform(points);
        const std::vector<double> corners = triples(triangles);
        mesh_.corners.reserve(corners.size());
        for (std::size_t i = 0; i < corners.size(); ++i) {
            mesh_.corners.push_back(corner_of(triangles, i / 3, corners[i]));
            if (i % 3 == 2) {
                mesh_.face_ends.push_back(i + 1);
            }
        }
        for (const pugi::xml_node array : file_.root().children("DataArray")) {
            add_attribute(array);
        }
        fields_.finish();
        return std::move(mesh_);
    }

  private:
    std::vector<double> triples(const pugi::xml_node& array) const {
        if (const Table table = arrays_.table_of(array); table.columns != 3) {
            file_.fail(array, "has rows of " + counted(table.columns, "number", "numbers") +
                                  " instead of 3");
        }
        return arrays_.numbers_in(array);
    }

    std::uint32_t corner_of(const pugi::xml_node& array, std::size_t face, double corner) const {
        if (!(corner >= 0 && corner < static_cast<double>(mesh_.vertex_count()))) {
            file_.fail(array, "face " + std::to_string(face) + ": vertex index " +
                                  exact_text(corner) + " is out of range, the file has " +
                                  counted(mesh_.vertex_count(), "vertex", "vertices"));
        }
        return static_cast<std::uint32_t>(corner);
    }

    /// Warns of a matrix that would move the points to another space.
    void warn_of_transform(const pugi::xml_node& points) {
        for (const pugi::xml_node node : points.children("CoordinateSystemTransformMatrix")) {
            constexpr std::uint64_t kSide = 4;
            const std::vector<double> matrix =
                numbers_of_text(file_, points, node.child_value("MatrixData"), kSide * kSide);
            bool moves = false;
            for (std::uint64_t i = 0; i < matrix.size(); ++i) {
                moves = moves || matrix[i] != (i % (kSide + 1) == 0 ? 1.0 : 0.0);
            }
            if (moves) {
                mesh_.warnings.push_back({"transform_ignored",
                                          1,
                                          "",
                                          "transform to " +
                                              in_quotes(node.child_value("TransformedSpace")) +
                                              " ignored: coordinates are as the file has them",
                                          {}});
            }
        }
    }

    /// Returns the name that the metadata of an array give it, or what it is for: "shape".
    static std::string name_of(const pugi::xml_node& array) {
        for (const pugi::xml_node entry : array.child("MetaData").children("MD")) {
            const std::string_view value = entry.child_value("Value");
            if (std::string_view(entry.child_value("Name")) == "Name" && !value.empty()) {
                return std::string(value);
            }
        }
        return lower_case(std::string(GiftiArrays::intent_of(array)));
    }

    /// Adds an array that has a row for each vertex or each face.
    void add_attribute(const pugi::xml_node& array) {
        const NumberType* const type = GiftiArrays::type_of(array);
        if (!GiftiArrays::is_of_values(array) || type == nullptr) {
            return;
        }
        const Table table = arrays_.table_of(array);
        const bool is_of_vertices = table.rows == mesh_.vertex_count();
        if (!is_of_vertices && table.rows != mesh_.face_ends.size()) {
            return;
        }
        MeshArray one{name_of(array),
                      is_of_vertices ? MeshField::Of::vertices : MeshField::Of::faces};
        one.components = table.columns;
        one.is_whole = type->is_whole;
        one.role = GiftiArrays::intent_of(array).starts_with("RGB") ? MeshArray::Role::colours
                                                                    : MeshArray::Role::numbers;
        fields_.add(one, [&] { return arrays_.numbers_in(array); });
    }

    const XmlFile& file_;
    GiftiArrays arrays_;
    PolygonMesh mesh_;
    ArrayFields fields_;
};

void check_root(const XmlFile& file) {
    if (std::strcmp(file.root().name(), "GIFTI") != 0) {
        file.fail(file.root(), "is not the GIFTI of a .gii file");
    }
}

} // namespace

PolygonMesh read_gifti(const Path& path, const WantedFields& fields) {
    const std::string bytes = read_file(path);
    const XmlFile file(path, bytes);
    check_root(file);
    return GiftiReader(file, fields).read();
}

VertexValues read_gifti_values(const Path& path) {
    const std::string bytes = read_file(path);
    const XmlFile file(path, bytes);
    check_root(file);
    const GiftiArrays arrays(file);
    pugi::xml_node found;
    for (const pugi::xml_node array : file.root().children("DataArray")) {
        if (!GiftiArrays::is_of_values(array)) {
            continue;
        }
        if (found) {
            file.fail(array, "is the second array of values; one is read");
        }
        found = array;
    }
    if (!found) {
        fail_input(path, "has no array of values");
    }
    if (const Table table = arrays.table_of(found); table.columns != 1) {
        file.fail(found, "has " + counted(table.columns, "value", "values") +
                             " for each vertex; one is read");
    }
    VertexValues result{arrays.numbers_in(found), {}, arrays.type_of(found)->is_whole};
    for (const pugi::xml_node label : file.root().child("LabelTable").children("Label")) {
        const char* const key = label.attribute(label.attribute("Key") ? "Key" : "Index").value();
        if (const std::optional<double> value = parse_real(key)) {
            result.names.push_back({label.child_value(), *value});
        }
    }
    return result;
}

} // namespace geodisk::tools
