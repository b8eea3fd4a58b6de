// LitFaces: how the disks of samples light the faces of a surface, and what they cover.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <geodisk/job_frame.hpp>
#include <geodisk/mesh.hpp>
#include <geodisk/params.hpp>

#include "engine/maximal/gap_cell.hpp"
#include "records.h"

namespace geodisk {

/// Effect of a disk on a cell, by one way in which it lights the face.
enum class Cover : std::uint8_t {
    all,  ///< No sample fits anywhere in the cell.
    some, ///< It may cover a part.
    none,
};

/// The lights of all faces, in double precision and units of the frame.
class LitFaces {
  public:
    /// `mesh`, and the radii of `params`, must outlive it. Lit intervals are widened by `slack`.
    LitFaces(const PreparedMesh& mesh, const SampleParams& params, const JobFrame& frame,
             double slack);

    /// Adds records of the device. Those of a face are numbered in any order.
    void add(std::span<const gpu::LitRec> records);

    /// A cell with what a test of any light needs of it.
    struct Target {
        struct Place {
            double x, y;
        };
        Place at[3];   ///< The centroid in the frame of each half-edge of the face.
        double reach;  ///< Maximum distance of a point of the cell from the centroid.
        double margin; ///< The same with the rounding of weights to multiples of 2^-24.
        double min_radius, largest_radius; ///< In the cell; 0 if radii do not vary.

        /// Returns the minimum distance of samples in the cell, at least.
        double spacing() const { return min_radius > 0 ? 2 * min_radius : 1; }
    };
    Target target(const GapCell& cell) const;
    /// Does the same for any triangle in a face. Its radii are 0.
    Target target(const FacePart& part) const;
    /// Returns the target of a point, by its weights as multiples of 2^-24.
    Target target(std::uint32_t face, FaceWeights weights) const;

    Cover cover(std::uint32_t light, const Target& target) const;
    /// Returns by how much a point of the target may be beyond the limit of the light; infinite
    /// where it is not lit.
    double excess(std::uint32_t light, const Target& target) const;

    /// Distances of a target from the sample of a light, and from the lit part: 0 within.
    struct Sight {
        double distance, outside;
    };
    Sight sight(std::uint32_t light, const Target& target) const;
    const gpu::LitRec& record(std::uint32_t light) const { return records_[light]; }

    /// Returns the lights that were added to a face since the number `first`.
    std::span<const std::uint32_t> lights_of(std::uint32_t face) const;
    /// Sorts the lights from `first` on by face, for lights_of().
    void sort_from(std::size_t first);
    std::size_t size() const { return records_.size(); }
    /// Drops the lights whose sample has a mark. Those left are numbered anew.
    void drop(std::span<const std::uint8_t> marks);

    /// Returns the area of a face, in units of the frame.
    double area(std::uint32_t face) const;
    /// Returns true if the longest edge of the face is many times its height. Parts of the grid
    /// that a line crosses are then far too many, so that it is better cut into halves.
    bool is_sliver(std::uint32_t face) const;
    /// Cuts a triangle from the middle of its longest edge.
    std::array<FacePart, 2> halves(const FacePart& part) const;
    std::uint32_t face_count() const { return mesh_.face_count(); }

  private:
    double radius_at(std::uint32_t face, FaceWeights weights) const;
    /// Names the longest edge of a triangle by the corner across it.
    struct LongestEdge {
        std::size_t across;
        double square; ///< Square of its length, in units of the frame.
    };
    LongestEdge longest_edge(const FacePart& part) const;
    void place(std::uint32_t face, FaceWeights weights, Target& target) const;
    double limit_of(const gpu::LitRec& record, double radius) const;

    const PreparedMesh& mesh_;
    const RadiusField* radii_;
    double unit_;
    double slack_;
    std::vector<double> reaches_; ///< Maximum distance of a corner from the centroid, by face.
    std::vector<gpu::LitRec> records_;
    std::vector<std::uint32_t> starts_, sorted_;
};

} // namespace geodisk
