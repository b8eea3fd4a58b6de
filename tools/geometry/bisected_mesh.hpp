// Triangles split in two along their longest edges, again and again. The surface stays the same.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include <geodisk/sample.hpp>

#include "geometry/mesh.hpp"

namespace geodisk::tools {

/// A part of a triangle of the mesh before.
struct FacePart {
    /// Steps of weights: corners of parts have multiples of 1 / kSteps. Samples in parts then keep
    /// 16 bits along the edges of the smallest ones.
    static constexpr std::uint32_t kSteps = 256;

    std::uint32_t face = 0;
    /// Weights of the second and third corner of the face at each corner, in steps.
    std::array<std::array<std::uint16_t, 2>, 3> corners{{{0, 0}, {kSteps, 0}, {0, kSteps}}};

    bool is_whole() const { return *this == FacePart{face}; }
    bool operator==(const FacePart&) const = default;
};

/// The vertices and triangles of a mesh with split ones. Vertices keep their numbers, new ones
/// follow them.
class BisectedMesh {
  public:
    /// The vertices between which a new one lies, in the middle.
    using Ends = std::array<std::uint32_t, 2>;

    explicit BisectedMesh(const MeshFile& mesh);

    std::size_t triangle_count() const { return parts_.size(); }
    const std::vector<std::uint32_t>& triangles() const { return triangles_; }
    const std::vector<double>& positions() const { return positions_; }
    std::size_t vertex_count() const { return old_vertices_ + ends_.size(); }
    /// Part of the mesh that each triangle is, ascending by face.
    const std::vector<FacePart>& parts() const { return parts_; }
    bool is_split() const { return !ends_.empty(); }

    /// Splits each triangle that is wanted once, and others so that triangles side by side share
    /// whole edges. One whose longest edge is a single step stays. Returns the triangle before that
    /// each one is of; nothing if there would be more than `most` triangles, or no other than now.
    std::optional<std::vector<std::uint32_t>> split(const std::vector<bool>& wanted,
                                                    std::size_t most);

    /// Returns values of vertices, `size` each, with means of their ends for the new ones.
    std::vector<double> extended(std::span<const double> values, std::size_t size = 1) const;

    /// Returns a sample on a face of the mesh before, moved by less than 2^-23 of its edges:
    /// weights become multiples of 2^-24 there. It stays in its part.
    Sample whole(const Sample& sample) const;
    /// Returns a sample of a face of the mesh before on the lowest part that holds it.
    Sample part(const Sample& sample) const;

  private:
    /// Returns the place of the longest edge of a triangle, 0 to 2; ties are decided by vertices.
    std::size_t longest(std::size_t triangle) const;
    std::size_t longest(const std::array<std::uint32_t, 3>& corners) const;
    double length2(std::uint32_t a, std::uint32_t b) const;
    /// Returns true if the middle of an edge of a triangle has weights in whole steps.
    bool has_middle(std::size_t triangle, std::size_t edge) const;

    std::uint32_t dimension_;
    std::vector<double> positions_;
    std::vector<std::uint32_t> triangles_;
    std::vector<FacePart> parts_;
    std::vector<std::size_t> first_part_; ///< First part of each face, and one past the last.
    std::size_t old_vertices_;
    std::vector<Ends> ends_; ///< Ends of the edge of each new vertex.
};

} // namespace geodisk::tools
