// What a batch is to do: one job for each mesh.
#pragma once

#include <string>
#include <vector>

#include "geodisk/options/batch_options.hpp"

namespace geodisk::tools {

struct BatchItem {
    SampleJob job;       ///< With its output.
    std::string command; ///< As sample_command() gives it: what `geodisk sample` does alike.
    std::string place;   ///< Where the user named it: a mesh file, or a line of the manifest.
};

/// All meshes of the folder or manifest, of whatever shard. Throws UserError: `usage` for options
/// and lines of a manifest that will not do, and for files that two would write or that one would
/// write and another read; `bad_input` for an input that cannot be read or names no mesh.
std::vector<BatchItem> batch_items(const BatchOptions& options);

} // namespace geodisk::tools
