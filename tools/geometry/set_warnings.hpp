// Warnings about a set of samples, besides what users asked for.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "geometry/mesh_parts.hpp"
#include "geometry/mesh_warning.hpp"

namespace geodisk::tools {

/// A set of samples on a mesh or in a box, and what was asked for.
struct SampledSet {
    std::uint64_t samples = 0;
    std::uint64_t existing = 0;   ///< Those of the samples that existed before.
    bool avoids = false;          ///< There are points to avoid.
    double min_distance = 0;      ///< As it is told.
    double wanted_count = 0;      ///< Samples that the distance was chosen for, or 0.
    std::uint64_t cut = 0;        ///< Samples of the run that an exact count left out.
    std::uint32_t stop_count = 0; ///< Samples to stop at, or 0.
    bool has_darts = false;       ///< The number of darts was given.
    double lacks_features = 0;    ///< Angle in degrees of features that were not found, or 0.
    std::string domain = "mesh";  ///< Name of what has the room for samples.
    BareParts bare{};
};

/// Returns warnings about a count that was missed, features that were not found, a set without new
/// samples, parts of the area without samples, and a distance that leaves one sample to each part.
std::vector<MeshWarning> set_warnings(const SampledSet& set);

} // namespace geodisk::tools
