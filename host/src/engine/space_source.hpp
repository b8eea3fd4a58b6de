// A surface in space, with straight-line distances, as the loop of a run needs it.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include <geodisk/mesh.hpp>

#include "engine/box_source.hpp"

namespace geodisk {

/// The bounding box of a mesh as a box to sample in, and the vertices in multiples of 2^-32 of its
/// sides.
struct SpaceFrame {
    BoxParams box;
    std::vector<std::array<std::uint32_t, 3>> vertices;
    std::vector<std::array<float, 3>> normals; ///< Of the vertices.

    SpaceFrame(const MeshView& view, const PreparedMesh& mesh, const SampleParams& params);
    /// Of conflicts, in minimum distances; covers that candidates are rounded to the frame.
    double guard() const;
};

class SpaceSource : public BoxSource {
  public:
    /// `view`, `mesh`, `params` and the sampler, made for surfaces in space, must outlive the
    /// source.
    SpaceSource(const Sampler::Impl& sampler, const MeshView& view, const PreparedMesh& mesh,
                const SampleParams& params, VkDeviceSize memory)
        : SpaceSource(sampler, view, mesh, params, SpaceFrame(view, mesh, params), memory) {}

    Result<WorkspaceNeeds> needs(const RunPlan& plan) const override;
    Result<std::vector<std::byte>> bytes(BufferRole role) const override;

  private:
    SpaceSource(const Sampler::Impl& sampler, const MeshView& view, const PreparedMesh& mesh,
                const SampleParams& params, SpaceFrame frame, VkDeviceSize memory);
    std::uint64_t drawn_by() const override { return mesh_.face_count(); }
    std::size_t corner_bytes() const;

    const MeshView& view_;
    const PreparedMesh& mesh_;
    const SampleParams& params_;
    SpaceFrame frame_;
};

} // namespace geodisk
