// Options of `geodisk verify`.
#pragma once

#include <string>
#include <vector>

#include "geodisk/options/constraint_options.hpp"
#include "geodisk/options/density_options.hpp"
#include "geodisk/options/mask_options.hpp"
#include "geodisk/options/mesh_options.hpp"
#include "geodisk/outputs/outputs.hpp"
#include "program/command.hpp"

namespace geodisk::tools {

struct VerifyOptions {
    MeshOptions mesh;
    DensityOptions density;
    MaskOptions mask;
    ConstraintOptions constraints; ///< Points to avoid.
    std::string samples, min_distance, tolerance, classes;
    bool is_maximal = false; ///< Look for gaps as well.
    OutputOptions out;       ///< No samples.

    /// Returns the files that are read, the samples first.
    std::vector<NamedFile> files_read() const;
    /// Throws UserError(usage) for wrong or contradictory options, before any file is read.
    void check() const;
};

void add_verify_options(Command command, VerifyOptions& options);

} // namespace geodisk::tools
