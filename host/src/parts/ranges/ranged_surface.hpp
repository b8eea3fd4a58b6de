// RangedSurface: a surface of which no process ever holds the whole.
//
// Each process reads a range of the faces and vertices. Faces then move to processes along a curve,
// so that each has those of a region. The coordinates of a vertex stay at its home, the process
// that read it, which also knows the processes with faces there. A part gets its halo by rings:
// homes name the holders of the vertices where it ends, and holders send rings of their faces.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include <geodisk/exchange.hpp>
#include <geodisk/export.hpp>
#include <geodisk/mesh.hpp>
#include <geodisk/mesh_range.hpp>
#include <geodisk/params.hpp>
#include <geodisk/status.hpp>

#include "parts/part.hpp"
#include "parts/ranges/directory.hpp"
#include "parts/ranges/ranged_fields.hpp"
#include "parts/ranges/ranged_halo.hpp"

namespace geodisk {

class GEODISK_API RangedSurface {
  public:
    /// Makes a surface of the ranges of all processes, which all call it. Errors, the same on all:
    /// `mesh_rejected` for a mesh that has to be read as a whole, with the reason; those of the
    /// exchange. Throws std::bad_alloc, as do the others.
    static Result<RangedSurface> create(Exchange& exchange, MeshRange range);

    const RangedStatistics& statistics() const { return statistics_; }
    /// Returns a mesh without faces, with the statistics of the whole.
    const PreparedMesh& outline() const { return outline_; }
    /// Returns radii without faces, with bounds and sums of the whole; null if they do not vary.
    const RadiusField* radii() const { return fields_.radii(); }
    /// Returns the number of own faces.
    std::size_t own_faces() const { return faces_.size(); }

    /// Returns the frame of a job on the surface. The parameters are of seed, distance and
    /// candidates alone; the surface itself has radii and the mask. Errors: `mesh_rejected` if it
    /// needs the whole; those of frame_of().
    Result<JobFrame> frame(const SampleParams& params) const;

    /// Returns the part of this process for a job in such a frame. All processes call it. At most
    /// so many candidates are expected to be drawn at a time, of all. It has no existing samples
    /// yet. Errors, the same on all: those of the exchange.
    Result<std::unique_ptr<Part>> part(Exchange& exchange, const SampleParams& params,
                                       const JobFrame& frame, double max_candidates,
                                       const CheckpointTerms& checkpoints) const;

    /// Returns the places and radii of own faces, given in ascending order. All processes call it,
    /// each with some of its own.
    Result<FacePlaces> places(Exchange& exchange, std::span<const std::uint32_t> own) const;

    const Directory& directory() const { return directory_; }
    /// Returns own faces, ascending.
    std::span<const WholeFace> faces() const { return faces_; }

  private:
    KnownSurface known() const;
    /// Returns parameters with the radii of the whole.
    SampleParams with_radii(const SampleParams& params) const;

    RangedStatistics statistics_;
    PreparedMesh outline_;
    RangedFields fields_;
    MeshBlocks vertices_, face_blocks_;
    std::vector<double> positions_; ///< Positions of the vertices that are at home here.
    std::vector<WholeFace> faces_;
    Directory directory_;
};

} // namespace geodisk
