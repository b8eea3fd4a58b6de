// A surface with distances through space.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include <geodisk/mesh.hpp>

#include "engine/domain/box_domain.hpp"

namespace geodisk {

/// Bounding box of a mesh as a box to sample in, and the vertices in multiples of 2^-32 of its
/// sides.
struct SpaceFrame {
    BoxParams box;
    std::vector<std::array<std::uint32_t, 3>> vertices;
    std::vector<std::array<float, 3>> normals; ///< Normals of the vertices.

    SpaceFrame(const MeshView& view, const PreparedMesh& mesh, const SampleParams& params);
    /// Returns the guard of conflicts, in minimum distances. It covers the rounding of candidates
    /// to the frame.
    double guard() const;
};

class SpaceDomain : public GridDomain {
  public:
    /// Makes the domain of a mesh that pool_size() accepts, prepared from `view`. Both must outlive
    /// the domain.
    SpaceDomain(const MeshView& view, const PreparedMesh& mesh, const SampleParams& params,
                Metric metric, SpaceFrame frame);

    void set_constants(gpu::JobRec& job, const RunPlan& plan) const override;
    void add_needs(WorkspaceNeeds& needs, std::uint32_t candidates,
                   const RunPlan& plan) const override;
    std::string beside_candidates() const override;
    const char* name_of(BufferRole role) const override {
        return role == BufferRole::corners ? "corners" : GridDomain::name_of(role);
    }
    std::size_t upload_size(BufferRole role) const override;
    Result<UploadParts> upload_parts(const RunPlan& plan, BufferRole role) const override;

  private:
    MeshView view_;
    const PreparedMesh& mesh_;
    SampleParams params_;
    SpaceFrame frame_;
};

} // namespace geodisk
