// Items of a batch: one job for each mesh.
#pragma once

#include <set>
#include <string>
#include <vector>

#include "geodisk/options/batch_options.hpp"

namespace geodisk::tools {

struct BatchItem {
    SampleJob job;       ///< With its output.
    std::string command; ///< As sample_command() gives it, from any folder.
    std::string place;   ///< Source of the mesh: a mesh file, or a line of the manifest.
    std::string fault;   ///< Error of an item whose output is also that of another, or "".
};

/// All meshes that the inputs name, of whatever shard. Throws UserError: `usage` for options
/// and lines of a manifest that will not do; `bad_input` for an input that cannot be read or names
/// no mesh.
std::vector<BatchItem> batch_items(const BatchOptions& options);

/// Throws UserError(usage) if the samples of an item, the log or the report would replace a file
/// that is read or written otherwise. Samples of the commands `done` stay as they are.
void check_batch_files(const BatchOptions& options, const std::vector<BatchItem>& items,
                       const std::string& log, const std::set<std::string>& done);

} // namespace geodisk::tools
