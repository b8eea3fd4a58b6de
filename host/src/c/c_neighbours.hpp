// Queries for neighbours of the C API.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include <geodisk/geodisk.h>
#include <geodisk/neighbours.hpp>

#include "c/c_mesh.hpp"

namespace geodisk::c {

/// Places of the sources.
struct NeighbourSources {
    std::vector<Sample> points;
    std::vector<std::uint32_t> vertices; ///< Empty if sources are points.
};

/// Returns the vertices that the caller joined, or where `given` is NULL those that the mesh did.
std::span<const std::uint32_t> joined_of(const Mesh& mesh, const std::uint32_t* given);

/// Returns sources given as points or as vertices, which `joined` may have joined. Errors name the
/// parameter.
Result<NeighbourSources> sources_of(const Mesh& mesh, const geodisk_surface_point* points,
                                    const std::uint32_t* vertices, std::size_t count,
                                    std::span<const std::uint32_t> joined);

/// A query with all that it refers to, apart from the caller's arrays.
struct NeighbourSearch {
    std::shared_ptr<const Mesh> mesh;
    NeighbourSources sources;
    std::vector<Sample> points;
    std::vector<double> radii;
    std::vector<std::uint32_t> joined;
    NeighbourQuery query;
};

/// Returns what the caller asks for. Errors name the parameter.
Result<std::shared_ptr<NeighbourSearch>> search_for(const geodisk_mesh& mesh,
                                                    const geodisk_neighbour_params& params);

} // namespace geodisk::c
