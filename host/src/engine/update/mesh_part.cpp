#include "engine/update/mesh_part.hpp"

#include <algorithm>
#include <array>
#include <numeric>
#include <utility>

#include "engine/domain/face_mask.hpp"
#include "support/try.hpp"

namespace geodisk {
namespace {

/// Coordinates and corners of some faces, with their vertices numbered in the order of the whole.
struct Shape {
    std::vector<double> positions;
    std::vector<std::uint32_t> triangles;
};

Shape shape_of(const MeshView& mesh, std::span<const std::uint32_t> faces) {
    Shape shape;
    shape.triangles.reserve(3 * faces.size());
    for (const std::uint32_t face : faces) {
        for (const std::uint32_t vertex : mesh.triangles.face(face)) {
            shape.triangles.push_back(vertex);
        }
    }
    std::vector<std::uint32_t> vertices = shape.triangles;
    std::ranges::sort(vertices);
    vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
    for (std::uint32_t& vertex : shape.triangles) {
        vertex = static_cast<std::uint32_t>(std::ranges::lower_bound(vertices, vertex) -
                                            vertices.begin());
    }
    shape.positions.reserve(mesh.dimension * vertices.size());
    for (const std::uint32_t vertex : vertices) {
        for (std::uint32_t axis = 0; axis < mesh.dimension; ++axis) {
            shape.positions.push_back(mesh.coordinate(vertex, axis));
        }
    }
    return shape;
}

Result<PreparedMesh> prepare_shape(const MeshView& mesh, std::span<const std::uint32_t> faces,
                                   const ThreadOptions& threads) {
    const Shape shape = shape_of(mesh, faces);
    return PreparedMesh::prepare({shape.positions, shape.triangles, mesh.dimension, true}, threads);
}

} // namespace

Result<MeshPart> MeshPart::prepare(const MeshView& mesh, const SampleParams& params,
                                   std::vector<std::uint32_t> faces, const ThreadOptions& threads) {
    MeshPart part;
    part.params_ = params;
    part.params_.existing = {};
    part.params_.avoid = {};
    part.faces_ = std::move(faces);
    auto prepared = prepare_shape(mesh, part.faces_, threads);
    if (!prepared && prepared.error().status == Status::mesh_rejected) {
        part.faces_.resize(mesh.face_count());
        std::iota(part.faces_.begin(), part.faces_.end(), 0u);
        prepared = prepare_shape(mesh, part.faces_, threads);
    }
    GEODISK_TRY(prepared);
    part.mesh_ = std::move(*prepared);
    if (params.radii != nullptr) {
        part.radii_ = params.radii->on_part(part.mesh_, part.faces_);
    }
    for (const std::uint32_t face : part.faces_) {
        part.keys_.push_back(params.face_keys.empty() ? face : params.face_keys[face]);
        part.mask_.push_back(takes_samples(params, face) ? 1 : 0);
    }
    return part;
}

std::optional<std::uint32_t> MeshPart::find(std::uint32_t face) const {
    const auto found = std::ranges::lower_bound(faces_, face);
    return found != faces_.end() && *found == face
               ? std::optional(static_cast<std::uint32_t>(found - faces_.begin()))
               : std::nullopt;
}

SampleParams MeshPart::params() const {
    SampleParams params = params_;
    params.radii = radii_ ? &*radii_ : nullptr;
    params.face_keys = keys_;
    params.face_mask = mask_;
    return params;
}

} // namespace geodisk
