#include "mesh/joined_vertices.hpp"

#include <algorithm>

#include "mesh/connectivity.hpp"
#include "support/guard.hpp"

namespace geodisk {

WeldedMesh with_joined(const MeshView& mesh, VertexSets& sets) {
    WeldedMesh result;
    result.vertices.reserve(mesh.vertex_count());
    for (std::uint32_t v = 0; v < mesh.vertex_count(); ++v) {
        result.vertices.push_back(sets.lowest(v));
        result.merged_vertices += result.vertices[v] != v;
    }
    result.triangles.resize(mesh.triangles.size());
    for (std::size_t f = 0; f < mesh.face_count(); ++f) {
        const auto before = mesh.triangles.face(f);
        auto face = before;
        if (result.merged_vertices > 0) {
            for (std::uint32_t& v : face) {
                v = result.vertices[v];
            }
            result.degenerate_faces += takes_part(before) && !takes_part(face);
        }
        std::ranges::copy(face, &result.triangles[3 * f]);
    }
    return result;
}

Result<std::vector<double>> means_of_joined(std::span<const std::uint32_t> vertices,
                                            std::span<const double> values) noexcept {
    return guarded([&]() -> Result<std::vector<double>> {
        if (vertices.size() != values.size()) {
            return Error{Status::invalid_argument, "there must be one value for each vertex"};
        }
        std::vector<double> means(values.size(), 0.0);
        std::vector<std::uint32_t> counts(values.size(), 0);
        for (std::size_t v = 0; v < values.size(); ++v) {
            if (vertices[v] >= values.size()) {
                return Error{Status::invalid_argument, "a vertex is out of range", v};
            }
            ++counts[vertices[v]];
        }
        // Divide each term first: the sum of large values could overflow double.
        for (std::size_t v = 0; v < values.size(); ++v) {
            means[vertices[v]] += values[v] / counts[vertices[v]];
        }
        for (std::size_t v = 0; v < values.size(); ++v) {
            means[v] = means[vertices[v]];
        }
        return means;
    });
}

} // namespace geodisk
