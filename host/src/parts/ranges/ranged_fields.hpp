// Radii and masks of a surface of which no process holds the whole.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include <geodisk/mesh_range.hpp>
#include <geodisk/radius_field.hpp>

#include "engine/domain/face_mask.hpp"
#include "mesh/radius_pieces.hpp"
#include "parts/ranges/examine.hpp"
#include "parts/ranges/talk.hpp"

namespace geodisk {

/// Fields that decide how many samples the faces of a surface take. They are at the homes of
/// vertices and faces.
class RangedFields {
  public:
    /// Makes the fields of the ranges of all processes, which all call it. Replaces the areas of
    /// faces by their effective areas. Throws Stopped(mesh_rejected) for values that only a process
    /// with all of them tells of as it should.
    static RangedFields create(Talk& talk, const MeshRange& range, RangeFaces& faces,
                               const MeshStatistics& statistics);

    // Properties of the whole, the same on all processes.

    const Areas& areas() const { return areas_; }
    /// Returns the maximum over faces of the effective area, as candidates count it.
    double largest_area() const { return largest_area_; }
    /// Returns border_length(), if MeshRange::needs_borders; else 0.
    double borders() const { return border_length_; }
    /// Returns the radii without faces; null if they do not vary.
    const RadiusField* radii() const { return outline_ ? &*outline_ : nullptr; }
    /// Returns the number of faces that the mask leaves; nothing without one.
    std::optional<std::uint64_t> masked_faces() const { return masked_faces_; }
    /// Returns the sum of field_digest() over all faces.
    std::uint64_t digest() const { return digest_; }

    /// Returns the radii at some vertices, in ascending order; empty if they do not vary. All
    /// processes call it.
    VertexRadii radii_at(Talk& talk, const MeshBlocks& blocks,
                         std::span<const std::uint32_t> vertices) const;
    /// Returns the mask of some faces, in ascending order; empty without one. All processes call
    /// it.
    std::vector<std::uint8_t> mask_of(Talk& talk, const MeshBlocks& blocks,
                                      std::span<const std::uint32_t> faces) const;

  private:
    Areas areas_;
    double largest_area_ = 0, border_length_ = 0;
    std::optional<RadiusField> outline_;
    RadiusKind kind_ = RadiusKind::same;
    std::optional<std::uint64_t> masked_faces_;
    std::uint64_t digest_ = 0;
    std::vector<float> values_, packing_; ///< Values and packing at the block's vertices.
    std::vector<std::uint8_t> mask_;      ///< Mask of the block's faces.
};

} // namespace geodisk
