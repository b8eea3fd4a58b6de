// Attributes of a mesh at samples on it.
#pragma once

#include <span>
#include <vector>

#include "files/images/textures.hpp"
#include "files/samples/sample_file.hpp"
#include "geometry/mesh.hpp"
#include "geometry/vec.hpp"

namespace geodisk::tools {

/// Returns MeshFile::fields at `rows`: numbers by the weights of corners, whole numbers and labels
/// of the corner with the largest weight. Colours are those of sRGB; amounts of light are encoded
/// after they are interpolated.
std::vector<SampleField> sample_fields(const MeshFile& mesh, std::span<const SampleRow> rows);

/// Returns the colours of textures and materials at `rows`, by MeshFile::texture_uvs; white without
/// material.
SampleField texture_colours(const MeshFile& mesh, const Textures& textures,
                            std::span<const SampleRow> rows);

/// Returns MeshFile::normals at a sample, not of unit length.
Vec3 file_normal(const MeshFile& mesh, const SampleRow& row);

} // namespace geodisk::tools
