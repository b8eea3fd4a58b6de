// `geodisk_mpi sample` of a mesh file that no process reads as a whole.
#pragma once

#include <cstdint>

#include "geodisk/options/sample_options.hpp"

namespace geodisk::tools {

class Session;

/// Samples a mesh that all processes read in ranges, on the first process, as sample_to_files()
/// does; see ReadCall for `parts`. Returns false, and has done nothing, if the
/// options or the mesh need the first process to read the whole. Throws UserError.
bool sample_ranges_to_files(const SampleOptions& options, std::uint32_t parts, Session& session);

} // namespace geodisk::tools
