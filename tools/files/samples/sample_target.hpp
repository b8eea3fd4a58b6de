// Target and format of written samples.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "geometry/up.hpp"
#include "program/path.hpp"

namespace geodisk::tools {

enum class SampleFormat { ply, csv, xyz, obj, pcd, npz, gltf, glb, usda };

struct SampleTarget {
    Path path;
    SampleFormat format = SampleFormat::ply;
    bool is_text = false;       ///< True for PLY and PCD as text rather than binary.
    bool has_header = true;     ///< Write the header's comments, where the format has comments.
    Up up = Up::y;              ///< Axis of the samples that points up in scenes.
    double metres_per_unit = 1; ///< Unit of lengths in scenes.
};

/// The file `path` in the format of that name ("npz"), or in that of its extension for "". Throws
/// UserError(usage) for a format that is unknown.
SampleTarget sample_target(const Path& path, std::string_view format = {}, bool is_text = false);

/// The names of all formats: "npz".
std::vector<std::string> sample_formats();

/// Returns true if `name` is that of a format.
bool is_sample_format(std::string_view name);

/// Returns true for a format that holds a scene, with an axis that points up and a unit: USD, glTF.
constexpr bool is_scene(SampleFormat format) {
    return format == SampleFormat::usda || format == SampleFormat::gltf ||
           format == SampleFormat::glb;
}

/// ".npz", the extension of files of that format.
std::string extension_of(SampleFormat format);

} // namespace geodisk::tools
