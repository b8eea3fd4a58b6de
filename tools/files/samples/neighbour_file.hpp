// Files of neighbours: which targets are near each source, and how far they are.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "files/output/output_file.hpp"
#include "files/samples/sample_format.hpp"
#include "program/path.hpp"

namespace geodisk::tools {

/// Rows of targets, one for each source (CSR).
struct NeighbourTable {
    std::vector<std::uint32_t> sources; ///< Number of the vertex or point of each row.
    std::vector<std::uint64_t> offsets; ///< Start of each row, and the end of the last.
    std::vector<std::uint32_t> targets;
    std::vector<float> distances; ///< In mesh units.
};

/// Returns where and how to write neighbours, as sample_target(). Throws UserError(usage) for
/// another format than .npz and .csv, of `what` is written; `formats` lists all that are.
SampleTarget neighbour_target(const Path& path, const std::string& format,
                              const std::string& what = "neighbours",
                              const std::string& formats = ".npz or .csv");

/// Writes the arrays of the table to an .npz archive under their names, or to CSV a line of source,
/// target and distance for each pair. Distances read back as they are.
void write_neighbours(AtomicFile& file, const SampleTarget& target, const NeighbourTable& table);

} // namespace geodisk::tools
