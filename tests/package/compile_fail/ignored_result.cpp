#include <geodisk/mesh.hpp>

bool prepares(const geodisk::MeshView& mesh) {
#ifdef IGNORE_RESULT
    geodisk::PreparedMesh::prepare(mesh);
    return true;
#else
    return static_cast<bool>(geodisk::PreparedMesh::prepare(mesh));
#endif
}
