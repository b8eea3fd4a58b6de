// Statistics of samples on a surface by their geodesic distances.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <geodisk/mesh.hpp>

#include "geometry/surface_disk.hpp"
#include "program/batches.hpp"

namespace geodisk::tools::analysis {

/// A histogram from 0 on, with bins of equal width.
struct Histogram {
    double width = 0;
    std::vector<double> counts;
};

/// The sample nearest to another one, in terms of the sum of their radii.
struct Neighbor {
    static constexpr std::uint32_t kNone = ~0u;

    std::uint32_t sample = kNone; ///< kNone where there is none in reach.
    double distance = 0;          ///< In sums of two radii.
};

/// Room beside samples of all classes for one more of a class.
struct ClassRoom {
    double uncovered = 0;   ///< As SurfaceStatistics::uncovered, for a sample of the class.
    double largest_gap = 0; ///< As SurfaceStatistics::largest_gap, in distances for that.
};

/// Distances of two samples are in terms of the sum of their radii, and those of other places in
/// twice the sample's radius: of minimum distances, where radii do not vary. Where samples have
/// classes, they are in terms of the distance that the classes must keep.
struct SurfaceStatistics {
    static constexpr double kReach = 4;        ///< Distances farther than this are not looked at,
    static constexpr double kReachVarying = 2; ///< and not these, where radii vary.

    double reach = kReach;
    double smallest = 0;             ///< Distance of any two; the reach, if all are farther apart.
    double mean_nearest = 0;         ///< Mean distance to a nearest sample, of those in reach.
    std::uint64_t lonely = 0;        ///< Samples without another one in reach.
    Histogram nearest;               ///< Distances of each sample's nearest.
    std::vector<Neighbor> neighbors; ///< Nearest of each sample.
    std::uint32_t probes = 0;        ///< Random places, uniform by area of the faces looked at.
    double uncovered = 0;   ///< Part of them that is not within 1 of a sample, where another
                            ///< one would have room, of any class.
    double largest_gap = 0; ///< Distance of a probe to the nearest sample; the reach, if beyond it.
    /// Pairs at a distance, over those of samples and random places there: 1 where samples know
    /// nothing of each other. As the surface is the same for both, its bends and borders cancel.
    /// Empty where radii vary or there are classes, as there samples are not equally dense.
    Histogram pair_correlation;
    std::vector<ClassRoom> rooms; ///< By class; empty without classes.
};

/// Draws `probes` places by `seed`, on the faces that `face_mask` keeps (SampleParams::face_mask);
/// `samples` are not empty, and their radii positive. Works on as many threads as there are cores;
/// the result does not depend on them. Throws UserError(bad_input) for a disk that does not end,
/// and what `tell` throws.
SurfaceStatistics measure(const PreparedMesh& mesh, std::span<const std::uint8_t> face_mask,
                          std::span<const SurfaceDisk> samples, std::uint32_t probes,
                          std::uint64_t seed, const PartDone& tell,
                          const ClassDistances& classes = {});

} // namespace geodisk::tools::analysis
