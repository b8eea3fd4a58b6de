// FaceReach: the faces within a distance of others.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <initializer_list>
#include <span>
#include <vector>

#include <geodisk/mesh_view.hpp>

#include "engine/update/face_set.hpp"
#include "engine/update/live_mesh.hpp"
#include "mesh/checks.hpp"

namespace geodisk {

/// Finds a superset of the faces that a geodesic path of some length may meet. A path of this
/// length stays as near in space. So faces are followed from vertex to vertex as long as their
/// bounding boxes are near enough.
class FaceReach {
  public:
    /// Both must outlive it.
    FaceReach(const LiveMesh& faces, const MeshView& mesh) : faces_(faces), mesh_(mesh) {}

    /// Faces within a distance.
    struct Ring {
        double width;
        FaceSet& faces;
    };

    /// Inserts in each ring the sources, and all faces that a path from one of them meets within
    /// its width. The last ring is the widest.
    void reach(std::span<const std::uint32_t> sources, std::initializer_list<Ring> rings);

    /// Calls `visit` for each other face that a path from a source may meet within `width`, with
    /// the square of a distance that the path is not below; for some faces several times. Sources
    /// within `cell` are treated as one.
    void visit_near(std::span<const std::uint32_t> sources, double width, double cell,
                    const std::function<void(std::uint32_t face, double square)>& visit);

    /// Returns true if all faces that a path from `source` meets within `width` are in `all`.
    bool stays_in(std::uint32_t source, double width, const FaceSet& all);

  private:
    struct Box {
        std::array<double, kMaxDimensions> low, high;
        void add(const Box& other, std::uint32_t dimension);
    };
    Box box_of(std::uint32_t face) const;
    /// Returns the square of the distance between two boxes.
    double square_gap(const Box& a, const Box& b) const;
    /// Returns the cell of space that a face's box starts in, of this width.
    std::uint64_t cell_of(const Box& box, double width) const;
    /// Visits the faces within `width` of some, with the square of their distance, until `visit`
    /// returns false. Does not enter faces of `closed`.
    template <class Visit>
    bool flood(std::span<const std::uint32_t> from, const Box& box, double width,
               const FaceSet& closed, const Visit& visit);

    const LiveMesh& faces_;
    const MeshView& mesh_;
    FaceSet seen_, sources_, none_;
    std::vector<std::uint32_t> stack_;
};

} // namespace geodisk
