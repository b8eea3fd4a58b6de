#include "geodisk/options/distance_options.hpp"

#include "program/command.hpp"
#include "program/failure.hpp"

namespace geodisk::tools {

std::optional<Length> DistanceOptions::parsed() const {
    if (!min_distance.empty() && !radius.empty()) {
        fail_usage("--min-distance and --radius contradict each other; give just one of them");
    }
    if (!min_distance.empty()) {
        return parse_length("--min-distance", min_distance);
    }
    if (!radius.empty()) {
        Length length = parse_length("--radius", radius);
        length.value *= 2;
        return length;
    }
    return std::nullopt;
}

void add_distance_options(Command command, DistanceOptions& options) {
    command.add_option("-d,--min-distance", options.min_distance, "D",
                       "Minimum distance, in mesh units or % of the bounding-box\n"
                       "diagonal (default: radii or header of the samples)");
    command.add_option("-r,--radius", options.radius, "R", "Half the minimum distance instead");
}

void add_tolerance_option(Command command, std::string& tolerance, const std::string& group) {
    command.add_option("--tolerance", tolerance, "L",
                       "Maximum distance from the mesh for points without faces (of\n"
                       "other programs), in mesh units or % of the bounding-box\n"
                       "diagonal (default 0.1%)",
                       group);
}

void check_tolerance(const std::string& tolerance) {
    tolerance_on(tolerance, 1);
}

double tolerance_on(const std::string& tolerance, double diagonal) {
    constexpr const char* kUsual = "0.1%";
    return parse_length("--tolerance", tolerance.empty() ? kUsual : tolerance)
        .in_mesh_units(diagonal);
}

} // namespace geodisk::tools
