// The radii of a command's mesh, from the files and numbers that its options name.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include <geodisk/mesh.hpp>
#include <geodisk/radius_field.hpp>

#include "files/images/image.hpp"
#include "geodisk/inputs/split_faces.hpp"
#include "geodisk/options/density_options.hpp"
#include "geometry/mesh.hpp"

namespace geodisk::tools {

/// Returns the grey of an image at the vertices of `file`, or of the parts of its split faces: the
/// mean over the texture coordinates of each vertex, as where a seam runs through it both sides
/// have a say; 1 for vertices without.
std::vector<double> map_values(const GreyImage& image, const MeshFile& file,
                               const SplitFaces* split, std::size_t vertex_count);

struct LoadedRadii {
    RadiusField field;
    std::optional<MeshWarning> warning;
};

/// The radii by the values at the vertices of the mesh at `path`, which must have been read with
/// what the source needs: for an attribute with MeshFile::numbers, for an image with texture
/// coordinates. `split` are the parts of split faces, that `mesh` is made of; null if none are.
///
/// Throws UserError(bad_input) naming the source of a value that is no density or factor, and its
/// vertex.
LoadedRadii load_radii(const DensitySource& source, const std::string& path, const MeshFile& file,
                       const PreparedMesh& mesh, const SplitFaces* split = nullptr);

/// Returns a density at the vertices of `mesh`, as a part of the largest one. Throws as
/// load_radii().
std::vector<double> density_parts(const DensitySource& source, const std::string& path,
                                  const MeshFile& file, const PreparedMesh& mesh,
                                  const SplitFaces* split);

} // namespace geodisk::tools
