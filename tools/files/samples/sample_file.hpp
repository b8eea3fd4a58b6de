// Sample files: what `geodisk sample` writes and `geodisk verify` reads.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "files/samples/sample_format.hpp"
#include "geometry/mesh_warning.hpp"
#include "program/path.hpp"

namespace geodisk::tools {

/// One sample. `position` holds as many coordinates as its file or mesh has. `bary` are the weights
/// of the three corners of triangle `face`, in the order of MeshFile::triangles.
struct SampleRow {
    double position[8] = {};
    float normal[3] = {};
    std::uint32_t face = 0;
    float bary[3] = {};
    double radius = 0; ///< In mesh units, where radii vary; 0 in all rows where they do not.
    /// The face of the mesh file that the triangle is of, where polygons were split.
    std::optional<std::uint32_t> polygon;
};

/// Returns true if polygons were split.
inline bool has_polygons(std::span<const SampleRow> rows) {
    return !rows.empty() && rows.front().polygon.has_value();
}

/// Returns true if radii vary.
inline bool has_radii(std::span<const SampleRow> rows) {
    return !rows.empty() && rows.front().radius > 0;
}

/// The radii of samples, where they vary.
struct RadiusRange {
    double least = HUGE_VAL, most = 0; ///< In mesh units.

    RadiusRange() = default;
    explicit RadiusRange(std::span<const SampleRow> rows) {
        for (const SampleRow& row : rows) {
            add(row.radius, row.radius);
        }
    }
    /// Takes in another range.
    void add(const RadiusRange& other) { add(other.least, other.most); }
    bool do_vary() const { return most > 0; }

  private:
    void add(double low, double high) {
        least = std::min(least, low);
        most = std::max(most, high);
    }
};

using HeaderEntries = std::vector<std::pair<std::string, std::string>>;

/// Key and value of each header comment, in order: version, mesh, parameters, device and so on.
/// Line breaks in them are written as blanks.
struct SampleHeader {
    HeaderEntries entries;

    /// The value of the first entry with this key; null without one.
    const std::string* find(std::string_view key) const;
};

/// A column of whole numbers beyond those of SampleRow, a value for each row.
struct ExtraColumn {
    std::string name;
    std::vector<std::uint32_t> values;
};

/// A column of sample_columns.hpp that is none: it has something else than whole numbers.
struct WrongColumn {
    std::string name;
    std::size_t row; ///< First one with such a value.
};

/// Values of an attribute at samples, for each row as many as there are components.
struct SampleField {
    std::string name;
    std::vector<std::string> components; ///< Names of columns.
    bool is_whole = false;               ///< All fit in 32 bits with sign.
    bool is_colour = false;              ///< From 0 to 1, as sRGB encodes them.
    std::vector<double> values;
    bool is_float = false; ///< Files hold it in single precision.
};

/// Columns of a file of samples besides SampleRow.
struct FurtherColumns {
    std::span<const ExtraColumn> numbers = {};
    std::span<const SampleField> fields = {};
};

class AtomicFile;

struct SampleFile {
    std::vector<SampleRow> rows;
    SampleHeader header;
    std::uint32_t dimension = 3;    ///< Coordinates of each row: 0, or 3 to 8; in boxes 1 to 8.
    std::vector<ExtraColumn> extra; ///< Those that part_columns() makes, and of sample_columns.hpp.
    std::vector<double> numbers;    ///< Values of the column that read_samples() was asked for.
    bool has_faces = true;          ///< Else rows have positions alone, as of other programs.
    std::vector<WrongColumn> wrong_columns{}; ///< Left out.
    /// Lines between two rows each; only read_points_and_lines() reads them all.
    std::vector<std::array<std::uint32_t, 2>> segments{};
    std::vector<MeshWarning> warnings{}; ///< Oddities of the file.
    std::string path{};                  ///< Names it in messages.

    /// The values of a column of `extra`; empty without it.
    std::span<const std::uint32_t> extra_values(std::string_view name) const;
};

/// Writes `rows` in the format of `target`:
///   ply   binary little endian, or ascii on request: element vertex with x y z nx ny nz
///         face_index bary_u bary_v bary_w, radius as double where radii vary, and
///         polygon_index where polygons were split; the header as "comment KEY: VALUE". x y z are
///         float, or double where float would blur them: far from the origin for their extent.
///   csv   a header row with the same names; the header before it as "# KEY: VALUE", and last of
///         it the number of samples
///   xyz   x y z per line and nothing else
///   obj   v and vn, and p for each, behind the header as "# KEY: VALUE"
///   pcd   version 0.7, binary or ascii: the columns of PLY, normals as normal_x normal_y normal_z;
///         x y z always in float, relative to "# origin: X Y Z" where that would blur them; the
///         header as "# KEY: VALUE"
///   npz   arrays of numpy: points normals face_index barycentric radius polygon_index, the scalars
///         min_distance and seed, and the header as an object of JSON
///   gltf, glb  points in float, relative to a node that bears what float would blur: NORMAL
///         _FACE_INDEX _BARYCENTRIC _RADIUS _POLYGON_INDEX; the header in asset.extras. With
///         frames, a second node instances a triangle by EXT_mesh_gpu_instancing
///   usda  a PointInstancer of USD with a ball, or with frames a triangle, scaled by the radius at
///         each sample; columns as primvars, the header in customLayerData
///   vtp   points of VTK in XML with a cell each, binary or ascii: Normals face_index barycentric
///         radius polygon_index, and an array of all coordinates where there are more than three;
///         x y z as in PLY; the header as texts in FieldData
///   star  particles of RELION: x y z in pixels, angles of the normal or of the frame, and the
///         further columns; a block of optics; the header as "# KEY: VALUE"
/// With a `dimension` of more than 3 the coordinates are x0 x1 ..., which PLY and PCD have besides
/// x y z so that viewers show the first three, and there are no normals; with 0, of a mesh of edge
/// lengths without coordinates, there are neither. check_dimension() tells which formats take that.
/// All but xyz and obj have the columns `further` last, glTF in attributes as _MESH. Numbers in
/// text are the shortest that read back exactly. Equal samples make equal bytes.
void write_samples(AtomicFile& file, const SampleTarget& target, const SampleHeader& header,
                   std::span<const SampleRow> rows, std::uint32_t dimension = 3,
                   const FurtherColumns& further = {});

/// The same into a file of its own, in the format of its extension, that appears complete or not at
/// all. Throws UserError as sample_target(), check_dimension() and AtomicFile do.
void write_samples(const Path& path, const SampleHeader& header, std::span<const SampleRow> rows,
                   bool is_text, std::uint32_t dimension = 3);

/// The same for samples in a box of 1 to 6 dimensions: no normals, faces and weights; coordinates
/// are double. Formats for viewers have x y z in any case: 0 for what a box of fewer dimensions
/// lacks; CSV and NPZ have just the coordinates there are.
void write_box_samples(AtomicFile& file, const SampleTarget& target, const SampleHeader& header,
                       std::span<const SampleRow> rows, std::uint32_t dimension);

/// UserError(usage) if the format cannot hold columns of these names.
void check_columns(const SampleTarget& target, std::span<const std::string> columns);

/// Returns what to tell the user of coordinates that the file holds otherwise than they are.
std::optional<std::string> precision_note(const SampleTarget& target,
                                          std::span<const SampleRow> rows, std::uint32_t dimension);

/// Returns what to tell the user of samples in a box whose distances the file rounds.
std::optional<std::string> rounding_note(const SampleTarget& target,
                                         std::span<const SampleRow> rows, std::uint32_t dimension,
                                         double min_distance);

/// UserError(usage) if the format cannot hold samples of so many coordinates.
void check_dimension(const SampleTarget& target, std::uint32_t dimension);
/// The same for samples in a box.
void check_box_dimension(const SampleTarget& target, std::uint32_t dimension);

/// Reads a sample file: PLY, PCD, NPZ, VTP, OBJ (points alone), and tables of text such as CSV and
/// XYZ, with or without a row of names. Columns may come in any order and type. face_index bary_u
/// bary_v bary_w must be there, or none of them; and either x0 x1 ... or x y z, which may lack
/// where faces are. The others are 0 if absent, unknown ones are skipped. A format without an
/// extension is told by how it begins. Throws UserError(bad_input) naming the file and the line or
/// record, also for a file that is cut short, and for one without the column `numbers`, if that is
/// not "".
SampleFile read_samples(const Path& path, const std::string& numbers = {});

/// The same for samples in a box, which need have neither faces nor weights, and coordinates x0 x1
/// ... or x, x y or x y z.
SampleFile read_box_samples(const Path& path);

} // namespace geodisk::tools
