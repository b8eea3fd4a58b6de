// Samples in VTK's XML files, of geodisk or other programs.
#include <algorithm>
#include <deque>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "files/meshes/vtp_data.hpp"
#include "files/samples/sample_rows.hpp"
#include "files/text_tokens.hpp"
#include "files/xml_file.hpp"
#include "geometry/mesh.hpp"
#include "program/exact_text.hpp"
#include "program/failure.hpp"
#include "program/human_text.hpp"

namespace geodisk::tools {
namespace {

/// Reads the arrays of points that hold columns of samples.
class VtpSamples {
  public:
    VtpSamples(const XmlFile& file, std::string_view appended)
        : file_(file), data_(file, appended) {}

    SampleFile read(SampleDomain domain, const std::string& numbers) {
        list_columns();
        const auto place_of = [this](std::string_view name) { return this->place_of(name); };
        const ColumnPlaces places = find_places(file_.path(), domain, place_of);
        ExtraReader extra(file_.path(), place_of, numbers);
        SampleFile samples;
        samples.dimension = places.dimension();
        samples.has_faces = places.has_faces;
        samples.rows.reserve(rows_);
        for (std::size_t row = 0; row < rows_; ++row) {
            const auto value_at = [&](std::size_t place) {
                const Column& column = columns_[place];
                return column.array->values[row * column.array->components + column.index];
            };
            samples.rows.push_back(make_row(places, value_at, [&](const std::string& message) {
                fail_input(file_.path(), "point " + std::to_string(row) + ": " + message);
            }));
            extra.add_row([&](std::size_t place) { return std::optional(value_at(place)); });
        }
        std::move(extra).move_to(samples);
        add_header(samples.header);
        return samples;
    }

  private:
    struct Array {
        pugi::xml_node node;
        std::size_t components;
        std::vector<double> values; ///< Empty until a column is asked for.
    };

    struct Column {
        std::string name;
        Array* array;
        std::size_t index; ///< Component.
    };

    void list_columns() {
        const pugi::xml_node piece = file_.root().child("PolyData").child("Piece");
        if (!piece || piece.next_sibling("Piece")) {
            file_.fail(file_.root(), "has no piece of points, or several; one is read");
        }
        if (file_.count_in(piece, "NumberOfPolys").value_or(0) > 0 ||
            file_.count_in(piece, "NumberOfStrips").value_or(0) > 0) {
            file_.fail(piece, "has faces, so this is a mesh and no file of samples");
        }
        rows_ = file_.count_in(piece, "NumberOfPoints").value_or(0);
        if (rows_ > std::numeric_limits<std::uint32_t>::max()) {
            file_.fail(piece, "has more points than can be numbered");
        }
        list_array(piece.child("Points").child("DataArray"), "x", 3);
        const pugi::xml_node data = piece.child("PointData");
        const std::string_view normals = data.attribute("Normals").value();
        for (const pugi::xml_node node : data.children("DataArray")) {
            const std::string_view name = node.attribute("Name").value();
            const std::uint64_t components =
                std::max<std::uint64_t>(file_.count_in(node, "NumberOfComponents").value_or(1), 1);
            const std::string_view first = name.empty()            ? ""
                                           : name == normals       ? "nx"
                                           : name == "barycentric" ? "bary_u"
                                           : name == "coordinates" ? "x0"
                                                                   : name;
            if (VtpData::type_of(node) != nullptr && components <= kMaxCoordinates) {
                list_array(node, first, components);
            }
        }
    }

    /// Lists the columns of an array, whose first one has that name among those of samples, or
    /// which are numbered.
    void list_array(const pugi::xml_node& node, std::string_view first, std::size_t components) {
        if (!node || first.empty()) {
            return;
        }
        const auto listed_from = [&](const auto& names) {
            const auto found = std::ranges::find(names, first);
            return static_cast<std::size_t>(names.end() - found) >= components
                       ? std::vector<std::string>(found,
                                                  found + static_cast<std::ptrdiff_t>(components))
                       : std::vector<std::string>();
        };
        std::vector<std::string> names = listed_from(kSampleColumnNames);
        names = names.empty() ? listed_from(kNumberedColumnNames) : names;
        arrays_.push_back({node, components, {}});
        for (std::size_t k = 0; k < components; ++k) {
            columns_.push_back({!names.empty()    ? names[k]
                                : components == 1 ? std::string(first)
                                                  : std::string(first) + '_' + std::to_string(k),
                                &arrays_.back(), k});
        }
    }

    std::optional<std::size_t> place_of(std::string_view name) {
        const auto found = std::ranges::find(columns_, name, &Column::name);
        if (found == columns_.end()) {
            return std::nullopt;
        }
        Array& array = *found->array;
        if (array.values.empty()) {
            array.values = data_.read(array.node, rows_ * array.components);
        }
        return static_cast<std::size_t>(found - columns_.begin());
    }

    /// Adds the texts of the file, whose characters are numbers; a zero ends each.
    void add_header(SampleHeader& header) const {
        for (const pugi::xml_node node :
             file_.root().child("PolyData").child("FieldData").children("Array")) {
            std::string text;
            TextTokens words(node.child_value());
            for (std::string_view word = words.next(); !word.empty(); word = words.next()) {
                const auto code = parse_integer<unsigned>(word);
                if (!code || *code > 255) {
                    file_.fail(node, "has " + in_quotes(word) + ", which is no character");
                }
                if (*code == 0) {
                    header.entries.emplace_back(node.attribute("Name").value(), text);
                    text.clear();
                } else {
                    text += static_cast<char>(*code);
                }
            }
        }
    }

    const XmlFile& file_;
    VtpData data_;
    std::size_t rows_ = 0;
    std::deque<Array> arrays_; ///< Which columns point to.
    std::vector<Column> columns_;
};

} // namespace

SampleFile read_vtp_samples(const Path& path, std::string&& bytes, SampleDomain domain,
                            const std::string& numbers) {
    const VtpParts parts(bytes);
    const XmlFile file(path, parts.xml);
    check_polydata(file);
    return VtpSamples(file, parts.appended).read(domain, numbers);
}

} // namespace geodisk::tools
