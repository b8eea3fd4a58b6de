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

} // namespace geodisk::tools
