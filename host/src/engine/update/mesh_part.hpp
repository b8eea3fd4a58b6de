// MeshPart: some faces of a surface, prepared by themselves.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include <geodisk/mesh.hpp>
#include <geodisk/params.hpp>
#include <geodisk/radius_field.hpp>
#include <geodisk/status.hpp>
#include <geodisk/threads.hpp>

namespace geodisk {

/// A part of a surface. Faces and vertices come in the order of the whole, so that everything away
/// from the cut is as in the whole, to the bit.
class MeshPart {
  public:
    /// Prepares the part of `mesh` with these faces, which are in ascending order. If they have no
    /// area to speak of, prepares all faces. `params` is that of the whole. Errors: those of
    /// PreparedMesh::prepare().
    static Result<MeshPart> prepare(const MeshView& mesh, const SampleParams& params,
                                    std::vector<std::uint32_t> faces, const ThreadOptions& threads);

    const PreparedMesh& mesh() const { return mesh_; }
    /// Returns the faces in the numbers of the whole, by their numbers in the part.
    const std::vector<std::uint32_t>& faces() const { return faces_; }
    /// Returns the number in the part of a face of the whole, if it is there.
    std::optional<std::uint32_t> find(std::uint32_t face) const;

    /// Returns the parameters of the whole for the part: with its radii, keys and mask, and without
    /// existing samples and points to avoid. They refer to the part.
    SampleParams params() const;

  private:
    SampleParams params_; ///< Parameters of the whole.
    std::vector<std::uint32_t> faces_;
    PreparedMesh mesh_;
    std::optional<RadiusField> radii_;
    std::vector<std::uint32_t> keys_;
    std::vector<std::uint8_t> mask_;
};

} // namespace geodisk
