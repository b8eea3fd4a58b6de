// A search of neighbours on a mesh: its sources and targets by the numbers of the file, and the
// run.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <geodisk/neighbours.hpp>

#include "files/samples/neighbour_file.hpp"
#include "geodisk/device_run.hpp"
#include "geodisk/inputs/mesh_input.hpp"
#include "geodisk/inputs/source_points.hpp"
#include "geodisk/outputs/progress.hpp"

namespace geodisk::tools {

/// Leaves out vertices that no face of the mesh's mask uses.
void keep_masked(const MeshInput& mesh, NumberedPoints& vertices);

/// Search to run.
struct NeighbourJob {
    NumberedPoints sources;
    NeighbourKind kind = NeighbourKind::vertices;
    std::vector<Sample> points; ///< To search, if `kind` says so.
    double within = 0;
    std::vector<double> radii; ///< Radius of each source, or empty.
    std::uint32_t nearest = 0;
    std::uint64_t max_pairs = 0; ///< 0 for the library's.
};

struct NeighbourResult {
    NeighbourTable table;
    double error = 0; ///< Bound on that of distances, in mesh units.
    DeviceRun done;
};

/// Opens the device where need be and searches. Targets that are vertices are those of the file:
/// where some are joined, all of them, or the lowest where the nearest are wanted. Throws
/// UserError.
NeighbourResult search_neighbours(const NeighbourJob& job, const MeshInput& mesh, RunDevice& device,
                                  bool is_bounded, ProgressLine& progress);

} // namespace geodisk::tools
