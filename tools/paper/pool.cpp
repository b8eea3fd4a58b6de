#include "paper/pool.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <iterator>
#include <utility>

#include "baselines/random.hpp"
#include "files/meshes/mesh_file.hpp"
#include "kernels/pool.hpp"
#include "lib/frame.hpp"
#include "program/failure.hpp"
#include "program/interrupt.hpp"

namespace geodisk::paper {

PaperMesh load_mesh(const std::string& path) {
    tools::MeshFile file = tools::read_mesh(path);
    PreparedMesh prepared =
        tools::take(PreparedMesh::prepare({file.positions, file.triangles, file.dimension}), path);
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
    return {params, ref::frame_of(mesh.prepared, params).tolerances(),
            ref::draw_pool(surface, params).by_rank()};
}

std::vector<ref::FacePoint<double>> places_of(const Pool& pool,
                                              const std::vector<std::uint32_t>& ranks) {
    std::vector<ref::FacePoint<double>> places;
    places.reserve(ranks.size());
    for (const std::uint32_t rank : ranks) {
        places.push_back(pool.by_rank[rank]);
    }
    return places;
}

std::vector<ref::FacePoint<double>> places_of(const SampleSet& set) {
    std::vector<ref::FacePoint<double>> places;
    places.reserve(set.samples.size());
    for (const Sample& sample : set.samples) {
        places.push_back({sample.face, sample.weights[1], sample.weights[2]});
    }
    return places;
}

Pool draw_independent_pool(const PaperMesh& mesh, const SampleParams& params) {
    tools::check_interrupted();
    const auto size = tools::take(pool_size(mesh.prepared, params), mesh.name);
    std::vector<double> areas; // Of all faces up to each.
    double area = 0;
    const auto& edges = mesh.prepared.half_edges();
    for (std::size_t first = 0; first < edges.size(); first += 3) {
        area += edges[first].length * edges[first].apex_y / 2;
        areas.push_back(area);
    }
    ref::RandomStream random(params.seed);
    Pool pool{params, ref::frame_of(mesh.prepared, params).tolerances(), {}};
    for (std::uint64_t i = 0; i < size; ++i) {
        const auto above = std::upper_bound(areas.begin(), areas.end(), random.uniform() * area);
        const auto face = static_cast<std::uint32_t>(
            std::min<std::ptrdiff_t>(above - areas.begin(), std::ssize(areas) - 1));
        const double from_corner = std::sqrt(random.uniform()), along = random.uniform();
        pool.by_rank.push_back({face, from_corner * (1 - along), from_corner * along});
    }
    return pool;
}

} // namespace geodisk::paper
