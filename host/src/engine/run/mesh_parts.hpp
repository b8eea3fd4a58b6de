// MeshParts: a mesh whole, or in parts where a device cannot hold it.
#pragma once

#include <cstdint>
#include <vector>

#include <geodisk/domain.hpp>
#include <geodisk/job_frame.hpp>
#include <geodisk/mesh.hpp>
#include <geodisk/status.hpp>

#include "engine/run/runner_impl.hpp"
#include "parts/near_part.hpp"

namespace geodisk {

class MeshParts {
  public:
    /// Begins with the whole. Mesh and frame must outlive it.
    MeshParts(const PreparedMesh& mesh, const JobFrame& frame) : mesh_(mesh), frame_(frame) {}

    /// Returns the number of parts; 0 for the whole.
    std::uint32_t count() const { return count_; }
    /// Returns true if a face belongs to a part, and to no other.
    bool has(std::uint32_t part, std::uint32_t face) const { return owners_[face] == part; }
    /// Returns a part, with all that disks as large as `reach` cover. Errors: those of near_part().
    Result<NearPart> near(std::uint32_t part, double reach) const;

    /// Notes the domain of a run of such disks that failed, on the whole or on a part.
    void note_failed(const Runner::Impl& runner, const Domain& domain, double reach);
    /// Divides the mesh into more parts, after the error of the run noted last. Returns false if
    /// that does not help.
    bool divide(const Error& error);

  private:
    const PreparedMesh& mesh_;
    const JobFrame& frame_;
    std::vector<std::uint32_t> owners_; ///< Part of each face.
    std::uint32_t count_ = 0, max_count_ = 0;
    std::uint32_t count_that_helps_ = 0;
};

} // namespace geodisk
