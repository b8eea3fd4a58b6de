// The nearest sample of each texel of a texture of a mesh.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include <geodisk/nearest.hpp>

#include "files/samples/map_file.hpp"
#include "files/samples/sample_file.hpp"
#include "geodisk/device_run.hpp"
#include "geodisk/inputs/mesh_input.hpp"
#include "geodisk/opened_device.hpp"
#include "geodisk/outputs/progress.hpp"
#include "geometry/texels.hpp"

namespace geodisk::tools {

/// Texels of a map.
struct MapSize {
    TextureSize texture;
    std::uint32_t padding = 0; ///< Texels around islands to fill, see pad().
};

struct MapResult {
    SampleMap map;
    std::uint64_t covered = 0;     ///< Texels with a face.
    std::uint64_t overlapping = 0; ///< Covered texels with several faces.
    std::uint64_t unreached = 0;   ///< Covered texels in parts of the mesh without a sample.
    std::uint64_t padded = 0;      ///< Texels without a face that have values of others.
    std::uint64_t repeating = 0;   ///< Faces with texture coordinates outside of 0 to 1.
    float largest_distance = 0;
    double error = 0; ///< Bound on that of distances, in mesh units.
    std::vector<std::array<std::uint32_t, 2>> touching; ///< Pairs of samples whose cells touch.
    DeviceRun done;
};

/// Looks up the texels of a mesh that was read with texture coordinates. Takes 12 bytes for each
/// texel besides what is the same for all sizes. Throws UserError; `path` names the mesh.
MapResult look_up_map(const MeshFile& mesh, MapSize size, const std::string& path,
                      const NearestSamples& disks, ProgressLine& progress);

/// Opens the device where need be and finds the nearest of the samples in `rows`, for texels as
/// look_up_map(). Finds the pairs that touch if `has_touching`. Throws UserError.
MapResult run_map(std::span<const SampleRow> rows, MapSize size, const MeshInput& mesh,
                  bool has_touching, RunDevice& device, std::uint64_t bytes,
                  ProgressLine& progress);

} // namespace geodisk::tools
