// The options that say how radii vary over a mesh, the same for every command that takes them.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include <geodisk/mesh.hpp>
#include <geodisk/radius_field.hpp>

#include "common/mesh_file.hpp"

namespace CLI {
class App;
}

namespace geodisk::tools {

/// As given on the command line.
struct DensityOptions {
    std::string attribute, file, map, floor;
    bool curvature = false;

    /// Whether radii vary at all. Throws UserError(usage) for options that contradict each other.
    bool is_given() const;
    /// The files that are read.
    std::vector<std::string> files() const;
    /// Name and value of what is given, as the header of a sample file names it.
    std::vector<std::pair<std::string, std::string>> additions() const;
};

void add_density_options(CLI::App& command, DensityOptions& options);

struct LoadedRadii {
    RadiusField field;
    std::string warning; ///< Empty without.
};

/// The factors at the vertices of the mesh at `path`, which must have been read with what the
/// options need: for an attribute as the last one of `file`, for an image with texture coordinates.
///
/// Throws UserError(bad_input) naming the source of a value that is no factor, and its vertex.
LoadedRadii load_radii(const DensityOptions& options, const std::string& path, const MeshFile& file,
                       const PreparedMesh& mesh);

} // namespace geodisk::tools
