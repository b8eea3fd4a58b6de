#include <algorithm>
#include <array>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "files/input_file.hpp"
#include "files/meshes/data_uri.hpp"
#include "files/meshes/vtk_cells.hpp"
#include "files/meshes/vtk_stream.hpp"
#include "program/exact_text.hpp"
#include "program/failure.hpp"
#include "program/human_text.hpp"

namespace geodisk::tools {
namespace {

/// Name and shape of the cells of a type number; only those with a shape are read.
struct VtkCellType {
    int number;
    std::string_view name;
    std::optional<VtkShape> shape;
};

constexpr std::array kCellTypes{
    VtkCellType{0, "empty cell", VtkShape::no_face},
    VtkCellType{1, "vertex", VtkShape::no_face},
    VtkCellType{2, "vertices", VtkShape::no_face},
    VtkCellType{3, "line", VtkShape::no_face},
    VtkCellType{4, "polyline", VtkShape::no_face},
    VtkCellType{5, "triangle", VtkShape::polygon},
    VtkCellType{6, "triangle strip", VtkShape::strip},
    VtkCellType{7, "polygon", VtkShape::polygon},
    VtkCellType{8, "pixel", VtkShape::pixel},
    VtkCellType{9, "quad", VtkShape::polygon},
    VtkCellType{10, "tetrahedron", {}},
    VtkCellType{11, "voxel", {}},
    VtkCellType{12, "hexahedron", {}},
    VtkCellType{13, "wedge", {}},
    VtkCellType{14, "pyramid", {}},
    VtkCellType{15, "pentagonal prism", {}},
    VtkCellType{16, "hexagonal prism", {}},
    VtkCellType{21, "quadratic edge", {}},
    VtkCellType{22, "quadratic triangle", {}},
    VtkCellType{23, "quadratic quad", {}},
    VtkCellType{24, "quadratic tetrahedron", {}},
    VtkCellType{25, "quadratic hexahedron", {}},
    VtkCellType{26, "quadratic wedge", {}},
    VtkCellType{27, "quadratic pyramid", {}},
    VtkCellType{28, "biquadratic quad", {}},
    VtkCellType{29, "triquadratic hexahedron", {}},
    VtkCellType{34, "biquadratic triangle", {}},
    VtkCellType{36, "quadratic polygon", {}},
    VtkCellType{42, "polyhedron", {}},
};

/// Arrays of a fixed number of components.
struct FixedArray {
    std::string_view keyword;
    std::size_t components;
    MeshArray::Role role;
};

constexpr std::array kFixedArrays{
    FixedArray{"vectors", 3, MeshArray::Role::numbers},
    FixedArray{"normals", 3, MeshArray::Role::normals},
    FixedArray{"tensors", 9, MeshArray::Role::numbers},
    FixedArray{"tensors6", 6, MeshArray::Role::numbers},
    FixedArray{"global_ids", 1, MeshArray::Role::numbers},
    FixedArray{"pedigree_ids", 1, MeshArray::Role::numbers},
    FixedArray{"edge_flags", 1, MeshArray::Role::numbers},
};

/// Reads the sections of a file, each of which begins with a line of a keyword and numbers.
class VtkReader {
  public:
    VtkReader(const Path& path, std::string_view bytes, const WantedFields& fields,
              const ReadingProgress& progress)
        : path_(path), stream_(path, bytes, progress), cells_(path, fields, mesh_) {}

    PolygonMesh read() && {
        read_dataset();
        while (stream_.next_line(words_)) {
            read_section(lower_case(std::string(words_[0])));
        }
        add_cells();
        cells_.finish();
        return std::move(mesh_);
    }

  private:
    /// Kinds of cells of VTK's polygonal data, in the order in which arrays number them: vertices,
    /// lines, and these.
    static constexpr std::size_t kPolygons = 2, kStrips = 3, kKinds = 4;

    void read_dataset() {
        if (!stream_.next_line(words_) || lower_case(std::string(words_[0])) != "dataset" ||
            words_.size() != 2) {
            stream_.fail("the line DATASET TYPE is expected");
        }
        const std::string type = lower_case(std::string(words_[1]));
        is_grid_ = type == "unstructured_grid";
        if (!is_grid_ && type != "polydata") {
            stream_.fail("a dataset " + in_quotes(words_[1]) +
                         " is no surface; save one as POLYDATA");
        }
    }

    void read_section(const std::string& keyword) {
        constexpr std::array<std::string_view, kKinds> kNames{"vertices", "lines", "polygons",
                                                              "triangle_strips"};
        const auto kind = std::ranges::find(kNames, keyword);
        if (keyword == "points") {
            read_points();
        } else if (kind != kNames.end() && !is_grid_) {
            read_cells(kinds_[static_cast<std::size_t>(kind - kNames.begin())]);
        } else if (keyword == "cells" && is_grid_) {
            read_cells(grid_);
        } else if (keyword == "cell_types" && is_grid_) {
            types_ = stream_.values(type_named("int"), count_at(1));
        } else if (keyword == "point_data" || keyword == "cell_data") {
            add_cells();
            of_ = keyword == "point_data" ? MeshField::Of::vertices : MeshField::Of::faces;
            elements_ = count_at(1);
        } else if (keyword == "field") {
            read_field();
        } else if (keyword == "metadata") {
            stream_.skip_block();
        } else if (!read_attribute(keyword)) {
            stream_.fail("unknown section " + in_quotes(words_[0]));
        }
    }

    std::string_view word_at(std::size_t i) const {
        if (i >= words_.size()) {
            stream_.fail("the line of " + in_quotes(words_[0]) + " has too few words");
        }
        return words_[i];
    }
    std::uint64_t count_at(std::size_t i) const {
        const auto count = parse_integer<std::uint64_t>(word_at(i));
        if (!count || *count > std::numeric_limits<std::uint32_t>::max()) {
            stream_.fail(in_quotes(word_at(i)) + " is not a number of elements");
        }
        return *count;
    }
    VtkType type_named(std::string_view name) const { return stream_.type_named(name); }
    /// Returns a name, in which VTK writes blanks and the like as "%20".
    std::string name_at(std::size_t i) const { return percent_decoded(word_at(i)); }

    void read_points() {
        if (!mesh_.positions.empty()) {
            stream_.fail("a second section of points");
        }
        mesh_.positions = stream_.values(type_named(word_at(2)), 3 * count_at(1));
    }

    /// Reads the number of corners before the corners of each cell, or since version 5 where cells
    /// begin and then all corners.
    void read_cells(VtkCellArray& cells) {
        if (!cells.ends.empty() || has_cells_) {
            stream_.fail("a section " + std::string(words_[0]) +
                         (has_cells_ ? " after the first attributes" : " for the second time"));
        }
        const std::uint64_t first = count_at(1), second = count_at(2);
        if (stream_.has_offsets()) {
            read_offsets(first, second, cells);
            return;
        }
        const std::string what(words_[0]);
        const std::vector<double> numbers = stream_.values(type_named("int"), second);
        cells.ends.reserve(std::min<std::size_t>(first, numbers.size()));
        cells.corners.reserve(numbers.size() - std::min<std::size_t>(first, numbers.size()));
        std::size_t at = 0;
        for (std::uint64_t cell = 0; cell < first; ++cell) {
            const double size = at < numbers.size() ? numbers[at] : -1;
            const std::size_t left = numbers.size() - std::min(at + 1, numbers.size());
            if (!(size >= 0 && size <= static_cast<double>(left))) {
                stream_.fail(what + ": cell " + std::to_string(cell) +
                             " has more corners than are left of " + grouped(second) + " numbers");
            }
            const auto begin = numbers.begin() + static_cast<std::ptrdiff_t>(at + 1);
            cells.corners.insert(cells.corners.end(), begin,
                                 begin + static_cast<std::ptrdiff_t>(size));
            cells.ends.push_back(static_cast<double>(cells.corners.size()));
            at += 1 + static_cast<std::size_t>(size);
        }
        if (at != numbers.size()) {
            stream_.fail(what + ": " + counted(first, "cell has ", "cells have ") + grouped(at) +
                         " of " + grouped(second) + " numbers");
        }
    }

    void read_offsets(std::uint64_t offsets, std::uint64_t corners, VtkCellArray& cells) {
        const auto read_part = [&](std::string_view keyword, std::uint64_t count) {
            if (!stream_.next_line(words_) || lower_case(std::string(words_[0])) != keyword) {
                stream_.fail("a line of " + std::string(keyword) + " is expected");
            }
            return stream_.values(type_named(word_at(1)), count);
        };
        cells.ends = read_part("offsets", offsets);
        cells.corners = read_part("connectivity", corners);
        if (!cells.ends.empty()) {
            if (cells.ends[0] != 0 || cells.ends.back() != static_cast<double>(corners)) {
                stream_.fail("the offsets of cells are not those of " +
                             counted(corners, "corner", "corners"));
            }
            cells.ends.erase(cells.ends.begin());
        }
    }

    /// Makes faces of the cells, once all of them are read.
    void add_cells() {
        if (std::exchange(has_cells_, true)) {
            return;
        }
        cells_.begin_piece(mesh_.vertex_count());
        if (is_grid_) {
            add_grid();
            return;
        }
        for (std::size_t kind = 0; kind < kKinds; ++kind) {
            cells_.add(kinds_[kind], kind == kPolygons ? VtkShape::polygon
                                     : kind == kStrips ? VtkShape::strip
                                                       : VtkShape::no_face);
            kinds_[kind] = {};
        }
    }

    void add_grid() {
        if (types_.size() != grid_.count()) {
            fail_input(path_, "has " + counted(types_.size(), "type of a cell", "types of cells") +
                                  " for " + counted(grid_.count(), "cell", "cells"));
        }
        for (std::size_t i = 0; i < grid_.count(); ++i) {
            const auto type = std::ranges::find(kCellTypes, types_[i], [](const VtkCellType& one) {
                return static_cast<double>(one.number);
            });
            if (type == kCellTypes.end() || !type->shape) {
                fail_input(path_,
                           "cell " + std::to_string(i) + " is a " +
                               (type == kCellTypes.end() ? "cell of type " + exact_text(types_[i])
                                                         : std::string(type->name)) +
                               "; of a grid, triangles, quads and polygons alone are read: extract "
                               "its surface first");
            }
            cells_.add(grid_, i, *type->shape);
        }
        grid_ = {};
    }

    bool read_attribute(const std::string& keyword) {
        const auto fixed = std::ranges::find(kFixedArrays, keyword, &FixedArray::keyword);
        if (fixed != kFixedArrays.end()) {
            const MeshArray array{name_at(1), {}, fixed->components, false, fixed->role};
            add_array(array, type_named(word_at(2)));
        } else if (keyword == "scalars") {
            read_scalars();
        } else if (keyword == "color_scalars") {
            const std::uint64_t components = count_at(2);
            const MeshArray array{name_at(1), {}, components, false, MeshArray::Role::colours};
            add_array(array, type_named(stream_.is_binary() ? "unsigned_char" : "float"));
        } else if (keyword == "texture_coordinates") {
            const std::uint64_t components = count_at(2);
            const MeshArray array{name_at(1), {}, components, false, MeshArray::Role::uvs};
            add_array(array, type_named(word_at(3)));
        } else if (keyword == "lookup_table") {
            stream_.values(type_named(stream_.is_binary() ? "unsigned_char" : "float"),
                           4 * count_at(2));
        } else {
            return false;
        }
        return true;
    }

    void read_scalars() {
        const MeshArray array{name_at(1), {}, words_.size() > 3 ? count_at(3) : 1};
        const VtkType type = type_named(word_at(2));
        if (!stream_.next_line(words_) || lower_case(std::string(words_[0])) != "lookup_table") {
            stream_.fail("scalars need a line LOOKUP_TABLE NAME");
        }
        add_array(array, type);
    }

    /// Reads arrays of any size, of which those that have a row for each element are attributes.
    void read_field() {
        const std::uint64_t count = count_at(2);
        for (std::uint64_t i = 0; i < count; ++i) {
            do {
                if (!stream_.next_line(words_)) {
                    stream_.fail("the file ends before array " + std::to_string(i) + " of " +
                                 std::to_string(count));
                }
            } while (lower_case(std::string(words_[0])) == "metadata" && stream_.skip_block());
            const std::uint64_t components = count_at(1), rows = count_at(2);
            const VtkType type = type_named(word_at(3));
            const MeshArray array{name_at(0), {}, components};
            if (of_ && rows == elements_ && !type.is_text) {
                add_array(array, type);
            } else {
                stream_.skip(type, components, rows);
            }
        }
    }

    /// Reads an array of the points or cells, which must be consumed in any case.
    void add_array(MeshArray array, const VtkType& type) {
        if (!of_) {
            stream_.fail("an attribute before POINT_DATA and CELL_DATA");
        }
        array.of = *of_;
        array.is_whole = type.is_bit || type.number.is_whole;
        if (type.number.is_byte && array.role == MeshArray::Role::numbers &&
            (array.components == 3 || array.components == 4)) {
            array.role = MeshArray::Role::colours;
        }
        stream_.check_product(array.components, elements_);
        std::vector<double> values = stream_.values(type, array.components * elements_);
        cells_.add_array(array, [&] { return std::move(values); });
    }

    const Path& path_;
    VtkStream stream_;
    PolygonMesh mesh_;
    VtkCells cells_;
    std::vector<std::string_view> words_;
    bool is_grid_ = false, has_cells_ = false;
    std::array<VtkCellArray, kKinds> kinds_;
    VtkCellArray grid_;
    std::vector<double> types_;
    std::optional<MeshField::Of> of_; ///< What the next attributes belong to.
    std::uint64_t elements_ = 0;      ///< Number of them.
};

} // namespace

PolygonMesh read_vtk(const Path& path, const WantedFields& fields,
                     const ReadingProgress& progress) {
    const std::string bytes = read_file(path);
    return VtkReader(path, bytes, fields, progress).read();
}

} // namespace geodisk::tools
