// Files of neuroimaging with a number for each vertex of a surface, such as curvature, thickness or
// the region that the vertex belongs to.
#pragma once

#include <cstddef>
#include <string_view>
#include <vector>

#include "geometry/mesh.hpp"
#include "program/path.hpp"

namespace geodisk::tools {

/// Numbers of vertices.
struct VertexValues {
    std::vector<double> values;   ///< One per vertex of the file.
    std::vector<ValueName> names; ///< Names of values, where the file has any.
    bool is_whole = false;        ///< Integers, such as labels.
};

/// Returns the values of a GIFTI file (`.shape.gii`, `.func.gii`, `.label.gii`) that has one array
/// of them. Throws UserError(bad_input), also where geodisk was built without pugixml.
VertexValues read_gifti_values(const Path& path);

/// Returns true for the bytes of a file such as `lh.curv` and `lh.thickness` of FreeSurfer.
bool is_freesurfer_values(std::string_view bytes);

/// Returns the values of such a file. Throws UserError(bad_input).
std::vector<double> read_freesurfer_values(const Path& path, std::string_view bytes);

/// Returns the labels of an annotation of FreeSurfer (`.annot`): for each vertex the number that
/// its label has in the colour table of the file, or -1 where it has none. Throws
/// UserError(bad_input).
VertexValues read_freesurfer_annotation(const Path& path, std::string_view bytes);

/// Returns true for a list of vertices of FreeSurfer: a file named `.label`, or text that begins as
/// those of FreeSurfer do.
bool is_freesurfer_label(const Path& path, std::string_view bytes);

/// Returns 1 for each vertex in such a list and 0 for the other ones of `vertex_count`. Throws
/// UserError(bad_input), also for a vertex beyond.
VertexValues read_freesurfer_label(const Path& path, std::string_view bytes,
                                   std::size_t vertex_count);

} // namespace geodisk::tools
