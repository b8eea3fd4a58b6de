// The triangles that take samples, by the options of a command.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include <geodisk/mesh.hpp>

#include "geodisk/inputs/split_faces.hpp"
#include "geodisk/options/mask_options.hpp"
#include "geometry/mesh.hpp"

namespace geodisk::tools {

/// Returns a byte per triangle, 1 for those of a part of the mesh at `path`. Throws
/// UserError(bad_input) for a part that the mesh does not have.
std::vector<std::uint8_t> faces_of(const OnlyRule& part, const std::string& path,
                                   const MeshFile& mesh);

/// Returns a byte per triangle of the mesh at `path`, 1 where the rule holds for the whole of it.
/// Throws UserError(bad_input) if it holds for none.
std::vector<std::uint8_t> faces_of(const MaskRule& rule, const std::string& path,
                                   const MeshFile& mesh);

struct LoadedMask {
    std::vector<std::uint8_t> faces; ///< A byte per triangle, 1 where it takes samples.
    std::vector<MeshWarning> warnings;
};

/// Returns the mask of the mesh at `path`; empty without options. The mesh must have been read with
/// the properties and texture coordinates of the rules. Warns of a rule that leaves out nothing.
/// With `split`, the mask is of the parts of split faces, of which images may show some alone.
///
/// Throws UserError(bad_input) for a part that the mesh does not have, naming those that it has,
/// and if no triangle is left.
LoadedMask load_mask(const MaskOptions& options, const std::string& path, const MeshFile& mesh,
                     const SplitFaces* split = nullptr);

/// Where single classes of samples may lie.
struct LoadedShares {
    std::size_t count = 0;     ///< Number of classes.
    std::vector<float> shares; ///< SampleParams::class_shares; empty without options.
    std::vector<MeshWarning> warnings;
};

/// Returns the shares of classes by their masks and densities, on `mesh`, which is of the file or
/// of the parts of split faces. Throws as load_mask() and load_radii().
LoadedShares load_shares(const MaskOptions& options, const std::string& path, const MeshFile& file,
                         const PreparedMesh& mesh, const SplitFaces* split = nullptr);

} // namespace geodisk::tools
