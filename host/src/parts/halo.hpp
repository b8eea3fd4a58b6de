// Surroundings of some faces of a surface, within a distance along it.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <geodisk/export.hpp>
#include <geodisk/job_frame.hpp>
#include <geodisk/mesh.hpp>

#include "mesh/edge_paths.hpp"

namespace geodisk {

/// Finds the faces around some faces, again and again. Takes 16 bytes per vertex of the mesh and
/// one per face.
class GEODISK_API HaloSearch {
  public:
    /// The mesh must outlive it.
    explicit HaloSearch(const PreparedMesh& mesh);

    /// Returns these faces and those within `reach` of them, ascending. Faces that name a vertex
    /// twice are among them only if they are given. Takes time by the faces that it finds.
    std::vector<std::uint32_t> search(std::span<const std::uint32_t> from, double reach);
    /// Returns a lower bound on the distance of a vertex from the faces that were searched from
    /// last, at most 5/4 of the reach. Linear in faces, the values are lower bounds everywhere.
    double distance(std::uint32_t vertex) const { return -reach_ * values_[vertex]; }
    /// Returns the least value at a corner of a face.
    double nearest_corner(std::uint32_t face) const;

  private:
    static constexpr std::uint8_t kNone = 0;  ///< Of a face: none of those below.
    static constexpr std::uint8_t kSteep = 1; ///< Values may have too large a gradient there.
    static constexpr std::uint8_t kFound = 2;

    /// Returns true if all faces at a vertex are found.
    bool is_inside(std::uint32_t vertex) const;
    /// Fills in the values along edges.
    void find_paths(std::span<const std::uint32_t> from);
    /// Returns the faces that are found, ascending, and removes all marks, which these faces have.
    std::vector<std::uint32_t> unmarked(std::span<const std::uint32_t> faces);

    const PreparedMesh& mesh_;
    EdgePaths paths_;
    std::vector<double> values_;         ///< Negative distances of vertices, in reaches.
    std::vector<std::uint32_t> changed_; ///< Some vertices whose values differ from the farthest.
    std::vector<std::uint8_t> marks_;    ///< Of faces, during a search.
    double reach_ = 1;
};

/// Returns by which part of a distance that jobs test a halo has to be wider than it.
double halo_margin(const JobFrame& frame);

} // namespace geodisk
