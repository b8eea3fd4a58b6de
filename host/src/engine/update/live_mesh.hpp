// LiveMesh: which faces meet at each vertex of a mesh that is edited.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <unordered_map>
#include <vector>

#include <geodisk/mesh_view.hpp>

namespace geodisk {

/// The corners of all faces, and the faces at each vertex. Faces that name a vertex twice take no
/// part. Takes time linear in the mesh to make, and in the edit to change.
class LiveMesh {
  public:
    using Corners = std::array<std::uint32_t, 3>;

    /// Connects a mesh whose indices are in range.
    explicit LiveMesh(const MeshView& mesh);

    std::uint32_t face_count() const { return static_cast<std::uint32_t>(faces_.size()); }
    const Corners& corners(std::uint32_t face) const { return faces_[face]; }
    bool takes_part(std::uint32_t face) const { return takes_part(faces_[face]); }

    /// Returns the faces at a vertex, in ascending order.
    std::span<const std::uint32_t> faces_at(std::uint32_t vertex) const;

    /// Adds faces without corners, up to this number.
    void grow(std::uint32_t faces) { faces_.resize(faces, Corners{}); }
    /// Gives a face other corners.
    void set(std::uint32_t face, const Corners& corners);

    /// Calls `visit` for each face that shares a vertex with this one, also for itself, and as
    /// often as they share one.
    template <class Visit>
    void for_faces_around(std::uint32_t face, const Visit& visit) const {
        if (!takes_part(face)) {
            return;
        }
        for (const std::uint32_t vertex : faces_[face]) {
            for (const std::uint32_t other : faces_at(vertex)) {
                visit(other);
            }
        }
    }

  private:
    static bool takes_part(const Corners& c) {
        return c[0] != c[1] && c[1] != c[2] && c[2] != c[0];
    }
    std::vector<std::uint32_t>& own_list(std::uint32_t vertex);

    std::vector<Corners> faces_;
    std::vector<std::uint32_t> starts_; ///< First face of each vertex in `at_`, and the end.
    std::vector<std::uint32_t> at_;
    std::unordered_map<std::uint32_t, std::vector<std::uint32_t>> edited_; ///< In place of `at_`.
};

} // namespace geodisk
