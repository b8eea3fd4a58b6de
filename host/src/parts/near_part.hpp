// NearPart: some faces of a mesh, and all that is near enough to them.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include <geodisk/mesh.hpp>
#include <geodisk/status.hpp>

#include "mesh/ranks.hpp"

namespace geodisk {

struct NearPart {
    std::unique_ptr<PreparedMesh> mesh;
    std::vector<std::uint32_t> faces; ///< Of the whole. Ascending.
    Ranks local;                      ///< Numbers that faces of the whole have here.

    /// Returns the half-edge of the whole that is this one of the part.
    std::uint32_t half_edge(std::uint32_t of_part) const {
        return 3 * faces[of_part / 3] + of_part % 3;
    }
};

/// Returns the faces whose owner is `part`, and those within `reach` around them. `owners` has one
/// owner per face. Errors: those of PreparedMesh::part().
Result<NearPart> near_part(const PreparedMesh& mesh, std::span<const std::uint32_t> owners,
                           std::uint32_t part, double reach);

/// Returns the owner of each face: one of so many parts, equally large.
std::vector<std::uint32_t> equal_parts(const PreparedMesh& mesh, std::uint32_t parts);

} // namespace geodisk
