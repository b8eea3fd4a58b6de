// Faces of a surface that an edit has kept as they were.
#pragma once

#include <cstdint>
#include <vector>

#include <geodisk/update.hpp>

namespace geodisk {

inline constexpr std::uint32_t kNoFace = ~std::uint32_t{0};

/// Correspondence of the faces of two surfaces.
struct FaceMatch {
    /// For each face before, its number after, or kNoFace if it has changed or is gone.
    std::vector<std::uint32_t> kept;
    /// Faces after that have changed, are new, or met a face that is not kept.
    std::vector<std::uint32_t> changed;
};

/// Matches faces by their keys, or by their numbers if they have none. A face is kept if its
/// corners, radii and mask are the same, and its vertices are joined as before. Takes time linear
/// in both. All sizes are checked.
FaceMatch match_faces(const SurfaceJob& before, const SurfaceJob& after);

} // namespace geodisk
