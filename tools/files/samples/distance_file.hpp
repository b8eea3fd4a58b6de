// Files of distances from sources to the vertices of a mesh.
#pragma once

#include <cstdint>
#include <vector>

#include "files/output/output_file.hpp"
#include "files/samples/sample_format.hpp"

namespace geodisk::tools {

/// Distances of all vertices, in mesh units: a row of them for each source, or one row to the
/// nearest source.
struct DistanceTable {
    std::vector<std::uint32_t> sources; ///< Number of the vertex or point of each.
    std::vector<double> distances;      ///< Infinite where no path leads.
    /// Number of the nearest source of each vertex, as in `sources`; GeodesicDistances::kNone where
    /// there is none. Empty where each source has a row.
    std::vector<std::uint32_t> nearest;
};

/// Writes the arrays of the table to an .npz archive under their names, `distances` with a row for
/// each source if these have one; or to CSV a line of vertex, distance and source for each distance
/// that is finite. Distances read back as they are.
void write_distances(AtomicFile& file, const SampleTarget& target, const DistanceTable& table);

} // namespace geodisk::tools
