#include "parts/reach.hpp"

#include <cstddef>
#include <utility>

#include "mesh/slopes.hpp"

namespace geodisk {

std::vector<double> reaches(const PreparedMesh& mesh, const RadiusField& radii,
                            double min_distance) {
    std::vector<double> values(mesh.vertex_count(), 0.0);
    for (std::size_t h = 0; h < radii.factors().size(); ++h) {
        double& value = values[mesh.half_edges()[h].origin];
        value = std::max(value, 0.5 / kReachSlope * static_cast<double>(radii.factors()[h]));
    }
    values = raised_to_slope(mesh, min_distance, std::move(values));
    for (double& value : values) {
        value = reach_of(kReachSlope * value);
    }
    return values;
}

} // namespace geodisk
