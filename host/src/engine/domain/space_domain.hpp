// A surface in space, with straight-line distances.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include <geodisk/mesh.hpp>

#include "engine/domain/box_domain.hpp"

namespace geodisk {

/// The bounding box of a mesh as a box to sample in, and the vertices in multiples of 2^-32 of its
/// sides.
struct SpaceFrame {
    BoxParams box;
    std::vector<std::array<std::uint32_t, 3>> vertices;
    std::vector<std::array<float, 3>> normals; ///< Of the vertices.

    SpaceFrame(const MeshView& view, const SampleParams& params);
    /// Of conflicts, in minimum distances; covers that candidates are rounded to the frame.
    double guard() const;
};

class SpaceDomain : public GridDomain {
  public:
    /// `view` is of the mesh that pool_size() finds no fault with; both must outlive the domain.
    SpaceDomain(const MeshView& view, const PreparedMesh& mesh, const SampleParams& params,
                Metric metric, SpaceFrame frame);

    void add_needs(WorkspaceNeeds& needs, std::uint32_t candidates,
                   const RunPlan& plan) const override;
    std::string beside_candidates() const override;
    const char* name_of(BufferRole role) const override {
        return role == BufferRole::corners ? "corners" : GridDomain::name_of(role);
    }
    std::size_t upload_size(BufferRole role) const override;
    Result<Done> write_upload(const RunPlan& plan, BufferRole role, std::size_t from,
                              std::span<std::byte> out) const override;

  private:
    MeshView view_;
    const PreparedMesh& mesh_;
    SampleParams params_;
    SpaceFrame frame_;
};

} // namespace geodisk
