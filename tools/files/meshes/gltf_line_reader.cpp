// Points and lines of glTF.
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "files/meshes/file_scope.hpp"
#include "files/meshes/gltf_chunks.hpp"
#include "files/meshes/gltf_data.hpp"
#include "files/meshes/gltf_extensions.hpp"
#include "files/meshes/gltf_json.hpp"
#include "files/meshes/gltf_materials.hpp"
#include "files/meshes/gltf_mesh.hpp"
#include "files/meshes/gltf_placing.hpp"
#include "files/meshes/gltf_scene.hpp"
#include "files/samples/sample_rows.hpp"
#include "files/text_file.hpp"

namespace geodisk::tools {
namespace {

class GltfLineReader {
  public:
    GltfLineReader(const Path& path, GltfChunks&& chunks, const FileScope& scope)
        : document_(path, std::move(chunks.json)), data_(document_, chunks.binary, scope),
          scene_(document_, data_), materials_(document_, data_),
          meshes_(document_, data_, fields_, materials_, GltfKind::points_and_lines) {}

    SampleFile read() && {
        file_.has_faces = false;
        check_required_extensions(document_, false, file_.warnings);
        for (const GltfPlacement& placement : scene_.placements()) {
            const GltfMesh mesh = meshes_.read(placement.mesh, placement.weights);
            if (mesh.others > 0) {
                document_.fail("mesh " + std::to_string(placement.mesh) +
                               ": has triangles, but only points and lines can be avoided; leave "
                               "it out of the file");
            }
            for (const glm::dmat4& transform : placement.transforms) {
                add_placed(placement, mesh, transform);
            }
        }
        scene_.add_warnings(file_.warnings);
        file_.warnings.insert(file_.warnings.end(), data_.warnings().begin(),
                              data_.warnings().end());
        return std::move(file_);
    }

  private:
    static constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

    /// Adds a row for each vertex that a primitive uses.
    void add_placed(const GltfPlacement& placement, const GltfMesh& mesh,
                    const glm::dmat4& transform) {
        GltfPlacing placing(document_, scene_, placement, transform);
        std::vector<std::vector<std::uint32_t>> rows;
        for (const GltfVertices& vertices : mesh.vertices) {
            rows.emplace_back(vertices.points.size(), kNone);
        }
        for (const GltfPrimitive& primitive : mesh.primitives) {
            std::vector<std::uint32_t>& known = rows[primitive.vertices];
            for (const std::uint32_t vertex : primitive.corners) {
                if (known[vertex] == kNone) {
                    known[vertex] =
                        add_row(placing.place(mesh.vertices[primitive.vertices], vertex), placement,
                                vertex);
                }
            }
            for (std::size_t i = 0; primitive.has_lines && i + 1 < primitive.corners.size();
                 i += 2) {
                file_.segments.push_back(
                    {known[primitive.corners[i]], known[primitive.corners[i + 1]]});
            }
        }
    }

    std::uint32_t add_row(const glm::dvec3& point, const GltfPlacement& placement,
                          std::uint32_t vertex) {
        if (file_.rows.size() >= kNone) {
            document_.fail("has more points than a line can refer to");
        }
        SampleRow& row = file_.rows.emplace_back();
        for (int axis = 0; axis < 3; ++axis) {
            if (!std::isfinite(point[axis])) {
                document_.fail("mesh " + std::to_string(placement.mesh) + ": vertex " +
                               std::to_string(vertex) + " is not finite");
            }
            row.position[axis] = point[axis];
        }
        return static_cast<std::uint32_t>(file_.rows.size() - 1);
    }

    WantedFields fields_;
    GltfDocument document_;
    GltfData data_;
    GltfScene scene_;
    GltfMaterials materials_;
    GltfMeshReader meshes_;
    SampleFile file_;
};

} // namespace

SampleFile read_gltf_lines(const Path& path, const FileScope& scope) {
    const std::string bytes = read_text(path);
    return GltfLineReader(path, gltf_chunks(path, bytes), scope).read();
}

} // namespace geodisk::tools
