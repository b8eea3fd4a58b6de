// The formats of sample files, what each of them holds, and where samples are written.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "files/images/colour_encoding.hpp"
#include "geometry/up.hpp"
#include "program/path.hpp"

namespace geodisk::tools {

class AtomicFile;
enum class SampleDomain;
struct SampleFile;
struct SampleHeader;
struct SampleLayout;
struct SampleRow;
struct SampleTarget;

enum class SampleFormat { ply, csv, xyz, npz, pcd, obj, gltf, glb, usda, vtp, star };

/// What a format holds of each sample; each holds what those before it do.
enum class SampleContent { points, normals, columns };

/// Axes that may point up in a format of scenes, which have a unit too.
enum class SceneAxes { none, y, y_or_z };

/// Throws UserError(usage) for numbers that the format does not hold.
using SampleWriter = void (*)(AtomicFile&, const SampleHeader&, std::span<const SampleRow>,
                              const SampleTarget&, const SampleLayout&);
/// Reads `bytes` of a file, and the column `numbers` unless it is "". Throws UserError(bad_input).
using SampleReader = SampleFile (*)(const Path&, std::string&& bytes, SampleDomain,
                                    const std::string& numbers);

struct FormatFacts {
    std::string_view name; ///< "npz", of files named *.npz.
    SampleContent content;
    std::uint32_t min_dimension, max_dimension; ///< Number of coordinates.
    bool has_floats;                            ///< Coordinates are floats, whatever they need.
    bool is_for_programs; ///< Holds just the coordinates there are; viewers have x y z in any case.
    SceneAxes axes;
    ColourEncoding colours;
    SampleWriter write;
    SampleReader read; ///< Null for what is written alone.

    bool has_columns() const { return content == SampleContent::columns; }
    bool is_scene() const { return axes != SceneAxes::none; }
    /// Returns true for columns of any numbers and any number of coordinates.
    bool holds_all() const { return has_columns() && !has_floats && min_dimension == 0; }
    /// Returns true if samples read back with all that they are.
    bool is_read_back() const { return has_columns() && read != nullptr; }
};

const FormatFacts& facts_of(SampleFormat format);

/// Returns the format of that name ("npz"), or for "" the one that the extension of a file says.
std::optional<SampleFormat> find_format(const Path& path, std::string_view name = {});

/// ".npz", the extension of files of that format.
std::string extension_of(SampleFormat format);
/// "an .obj file".
std::string a_file(SampleFormat format);

using IsFormat = std::function<bool(const FormatFacts&)>;

/// Returns the names, behind `before`, of all formats, or of those for which `is` returns true.
std::vector<std::string> sample_formats(const IsFormat& is = nullptr,
                                        const std::string& before = "");

/// Returns the same as a list: ".ply, .csv or .npz".
std::string listed_formats(const IsFormat& is, const std::string& before = ".",
                           std::string_view last = " or ");

struct SampleTarget {
    Path path;
    SampleFormat format = SampleFormat::ply;
    bool is_text = false;       ///< True for PLY, PCD and VTP as text rather than binary.
    bool has_header = true;     ///< Write the header's comments, where the format has comments.
    Up up = Up::y;              ///< Axis of the samples that points up in scenes.
    double metres_per_unit = 1; ///< Unit of lengths in scenes.
    /// Edge of a pixel in mesh units, which are angstroms, in STAR; nothing if lengths are pixels.
    std::optional<double> pixel_size{};
};

/// The file `path` in the format of that name ("npz"), or in that of its extension for "". Throws
/// UserError(usage) for a format that is unknown.
SampleTarget sample_target(const Path& path, std::string_view format = {}, bool is_text = false);

} // namespace geodisk::tools
