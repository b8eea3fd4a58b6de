// Meshes and pools of candidates on them.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <geodisk/mesh.hpp>
#include <geodisk/params.hpp>
#include <geodisk/runner.hpp>

#include "geometry/mesh.hpp"
#include "lib/frame.hpp"
#include "lib/surface.hpp"

namespace geodisk::paper {

struct PaperMesh {
    std::string name; ///< Without its folder.
    tools::MeshFile file;
    PreparedMesh prepared;

    MeshView view() const { return {file.positions, file.triangles, file.dimension}; }
    double area() const { return prepared.statistics().area; }
};

PaperMesh load_mesh(const std::string& path);
std::vector<PaperMesh> load_meshes(const std::vector<std::string>& paths);

/// A run's candidates, as geodisk draws them.
struct Pool {
    SampleParams params;
    ref::Tolerances tolerances;
    std::vector<ref::FacePoint<double>> by_rank;
};

/// The parameters that should give about `count` samples of `ratio` times as many candidates.
SampleParams params_for(const PaperMesh& mesh, double count, double ratio, std::uint64_t seed);

Pool draw_pool(const PaperMesh& mesh, const SampleParams& params);

/// Samples by their places; those of a pool by their ranks.
std::vector<ref::FacePoint<double>> places_of(const Pool& pool,
                                              const std::vector<std::uint32_t>& ranks);
std::vector<ref::FacePoint<double>> places_of(const SampleSet& set);

/// As many candidates as draw_pool() has on average, drawn otherwise: one after the other, each
/// uniform by area over the whole surface and independent of the others.
Pool draw_independent_pool(const PaperMesh& mesh, const SampleParams& params);

} // namespace geodisk::paper
