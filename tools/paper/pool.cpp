#include "paper/pool.hpp"

#include <filesystem>
#include <utility>

#include "engine/tolerances.hpp"
#include "files/mesh_file.hpp"
#include "kernels/pool.hpp"
#include "program/failure.hpp"
#include "program/interrupt.hpp"

namespace geodisk::paper {

PaperMesh load_mesh(const std::string& path) {
    tools::MeshFile file = tools::read_mesh(path);
    PreparedMesh prepared =
        tools::take(PreparedMesh::prepare({file.positions, file.triangles}), path);
    return {std::filesystem::path(path).filename().string(), std::move(file), std::move(prepared)};
}

std::vector<PaperMesh> load_meshes(const std::vector<std::string>& paths) {
    std::vector<PaperMesh> meshes;
    meshes.reserve(paths.size());
    for (const std::string& path : paths) {
        meshes.push_back(load_mesh(path));
    }
    return meshes;
}

SampleParams params_for(const PaperMesh& mesh, double count, double ratio, std::uint64_t seed) {
    return {distance_for_count(mesh.area(), count), seed, ratio};
}

Pool draw_pool(const PaperMesh& mesh, const SampleParams& params) {
    tools::check_interrupted();
    tools::take(pool_size(mesh.prepared, params), mesh.name); // Fails where a parameter is wrong.
    const ref::Surface<double> surface(mesh.prepared, params);
    return {params, first_tolerances(mesh.prepared, params),
            ref::draw_pool(surface, mesh.prepared, params).by_rank()};
}

} // namespace geodisk::paper
