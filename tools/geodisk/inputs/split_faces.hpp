// Faces split where an image shows more than their corners tell.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "files/images/image.hpp"
#include "geometry/bisected_mesh.hpp"
#include "geometry/mesh.hpp"
#include "geometry/vertex_uvs.hpp"

namespace geodisk::tools {

/// An image that is read on faces, and what of it matters.
struct ReadImage {
    std::shared_ptr<const GreyImage> image;
    std::string name;
    /// Returns true if a grey inside a part of a face matters whose corners have the greys
    /// `corners`, which are `linear` there.
    std::function<bool(double grey, double linear, const std::array<double, 3>& corners)> matters;
};

/// The parts of split faces.
class SplitFaces {
  public:
    SplitFaces(const MeshFile& mesh, BisectedMesh parts);

    const BisectedMesh& parts() const { return parts_; }
    /// Returns the texture coordinates of all corners of parts, as vertex_uvs().
    std::span<const VertexUv> uvs() const { return uvs_; }
    /// Returns keys of the parts: whole faces, and the first parts of others, have their numbers.
    std::span<const std::uint32_t> keys() const { return keys_; }

  private:
    BisectedMesh parts_;
    std::vector<VertexUv> uvs_;
    std::vector<std::uint32_t> keys_;
};

/// Splits the faces of a mesh with MeshFile::texture_uvs and coordinates until all parts show what
/// matters, down to pixels or to FacePart::kSteps parts along an edge, into at most a million
/// triangles more. Returns nothing if none is to be split. Adds a warning for each image that is
/// finer than that.
std::optional<SplitFaces> split_for_images(const MeshFile& mesh,
                                           const std::vector<ReadImage>& images,
                                           std::vector<MeshWarning>& warnings);

} // namespace geodisk::tools
