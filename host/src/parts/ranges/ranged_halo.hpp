// The halo of a part of a surface that no process holds whole.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <geodisk/mesh.hpp>
#include <geodisk/mesh_range.hpp>

#include "parts/part.hpp"
#include "parts/ranges/directory.hpp"
#include "parts/ranges/ranged_fields.hpp"
#include "parts/ranges/talk.hpp"

namespace geodisk {

/// A face near own faces.
struct HaloFace {
    WholeFace face;
    std::uint32_t owner;
    double distance; ///< Lower bound on its geodesic distance from own faces.
};

/// Surface as far as a process knows it.
struct KnownSurface {
    const MeshBlocks& vertices;
    std::span<const double> positions;
    std::span<const WholeFace> faces;
    const Directory& directory;
    const MeshStatistics& statistics;
    const RangedFields& fields;
};

/// Returns all faces of other processes within `reach` of own ones, and perhaps some beyond, in
/// ascending order. All processes call it.
std::vector<HaloFace> find_halo(Talk& talk, const KnownSurface& known, double reach);

/// Returns the places of faces, in ascending order; without radii. All processes call it, perhaps
/// with none.
FacePlaces places_of(Talk& talk, const KnownSurface& known, std::span<const WholeFace> faces);

/// The same with radii.
FacePlaces places_and_radii_of(Talk& talk, const KnownSurface& known,
                               std::span<const WholeFace> faces);

} // namespace geodisk
