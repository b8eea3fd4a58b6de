// JobFrame: what a sampling job derives from a whole surface.
// Experimental.
#pragma once

#include <array>
#include <cstddef>
#include <span>

#include <geodisk/export.hpp>
#include <geodisk/mesh.hpp>
#include <geodisk/params.hpp>
#include <geodisk/status.hpp>

namespace geodisk {

/// Everything global about a job on a surface: with it, a part of a mesh is sampled as the whole
/// is. Give the part the seed, distance and pool ratio of the whole, and the whole's face keys. It
/// then has the same candidates in each face, and decides alike wherever no path to the cut
/// matters.
struct JobFrame {
    /// SampleParams::min_distance of the job, in mesh units. The largest radius is half of it.
    double min_distance = 0;
    /// Length that the device measures in: min_distance, or if that exceeds every geodesic distance
    /// of the mesh, an upper bound of those. In mesh units.
    double unit = 0;
    /// Expected samples of the whole surface.
    double samples = 0;
    /// Candidates of a pool per expected sample. Intensities of stages follow from it.
    double pool_ratio = 0;
    /// Length of the longest edge, in units of `unit`. The error bound grows with it.
    double longest_edge = 0;
    /// First bound on the rounding error of a distance, in units of `unit`. The guard follows from
    /// it.
    double error_bound = 0;
    bool radii_vary = false;     ///< SampleParams::radii is set.
    bool nearest_first = false;  ///< Disks take vertex events by distance, not as they come.
    bool splits_once = false;    ///< No edge has more than two faces.
    bool straight_faces = false; ///< The mesh has coordinates, so its faces are straight in space.

    friend bool operator==(const JobFrame&, const JobFrame&) = default;
};

/// Returns true if candidates of a pool are decided in both frames by the same distances,
/// tolerances and rules. The samples of a surface are then the same in both.
GEODISK_API bool decide_alike(const JobFrame& a, const JobFrame& b) noexcept;

/// Derives the frame of a job. Takes time linear in the mesh if `min_distance` exceeds its bounding
/// box, else none to speak of. Errors: those of pool_size().
GEODISK_API Result<JobFrame> frame_of(const PreparedMesh& mesh,
                                      const SampleParams& params) noexcept;

/// Derives the frame of a job on a mesh that was split from another, on whose faces its samples
/// will be told. The guard allows for the steps of weights there.
GEODISK_API Result<JobFrame> frame_of(const PreparedMesh& mesh, const SampleParams& params,
                                      const PreparedMesh& split_from) noexcept;

/// Size of a frame as bytes, with room for later versions.
inline constexpr std::size_t kJobFrameBytes = 128;

/// Returns the frame as bytes, the same on every machine, to keep or send.
GEODISK_API std::array<std::byte, kJobFrameBytes> to_bytes(const JobFrame& frame) noexcept;

/// Returns the frame that to_bytes() was called on. Errors: `invalid_argument` for bytes of
/// something else, of another version or of another GEODISK_SAMPLING_VERSION, for damaged ones, and
/// for values that no frame has.
GEODISK_API Result<JobFrame> frame_from_bytes(std::span<const std::byte> bytes) noexcept;

} // namespace geodisk
