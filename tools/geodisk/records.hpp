// Data that samples are written with besides place, face and weights: normals, attributes, frames.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "files/samples/sample_file.hpp"
#include "geodisk/inputs/mesh_input.hpp"
#include "geodisk/options/run_options.hpp"

namespace geodisk::tools {

/// Throws UserError(usage) if the mesh has no normals in space and `options` ask for some.
void check_record(const RecordOptions& options, const MeshInput& mesh);

/// Replaces the normals of faces in `rows` by those that `options` ask for. A normal that cancels
/// to zero stays that of the face.
void set_normals(const RecordOptions& options, const MeshInput& mesh, std::span<SampleRow> rows);

/// Returns the attributes of the mesh at `rows`, and their frames where there is a style of them.
std::vector<SampleField> record_fields(const MeshInput& mesh, std::span<const SampleRow> rows,
                                       std::uint64_t seed, const std::optional<FrameStyle>& style);

} // namespace geodisk::tools
