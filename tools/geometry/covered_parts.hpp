// Parts of a mesh that the disk of one point covers as a whole.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <geodisk/mesh.hpp>
#include <geodisk/sample.hpp>

namespace geodisk::tools {

/// Points to avoid, and the parts that one of them surely covers as a whole.
struct CoveredParts {
    std::vector<std::uint8_t> faces; ///< 1 for each face of such a part; empty without any.
    /// The points in their order, without those on such a part but the one that covers it.
    std::vector<KeepOut> needed;

    /// Returns true if all faces that may have samples are covered.
    bool cover_all(const PreparedMesh& mesh, std::span<const std::uint8_t> face_mask) const;
};

/// Finds parts whose points are all nearer to a point to avoid than its radius, by a bound on their
/// distances: paths from face to face, each as long as its longest edge. It may miss parts that a
/// disk just covers. The points must lie on faces of the mesh.
CoveredParts covered_parts(const PreparedMesh& mesh, std::span<const KeepOut> avoid);

} // namespace geodisk::tools
