#include "geodisk/inputs/box_input.hpp"

#include <optional>
#include <string_view>
#include <vector>

#include "geodisk/checks/sample_checks.hpp"
#include "geodisk/options/box_options.hpp"
#include "program/arguments.hpp"
#include "program/exact_text.hpp"
#include "program/failure.hpp"
#include "program/human_text.hpp"

namespace geodisk::tools {
namespace {

/// "1 x 0.5": the sides; none if one is no positive number.
std::vector<double> parse_sides(std::string_view text) {
    std::vector<double> sides;
    for (bool more = true; more;) {
        const std::size_t end = text.find(" x ");
        const std::optional<double> side = parse_positive(trimmed(text.substr(0, end)));
        if (!side) {
            return {};
        }
        sides.push_back(*side);
        more = end != std::string_view::npos;
        text.remove_prefix(more ? end + 3 : text.size());
    }
    return sides;
}

} // namespace

BoxParams box_of(const std::string& min_distance, const SampleFile& samples) {
    const std::string* const sides = samples.header.find("box");
    if (sides == nullptr) {
        fail_input(samples.path, "its header has no box; for samples on a mesh, give MESH SAMPLES");
    }
    BoxParams box;
    box.extents = parse_sides(*sides);
    if (box.extents.empty() || box.extents.size() > kMaxBoxDimensions) {
        fail_input(samples.path, "its header has the box " + in_quotes(*sides) +
                                     ", which is not 1 to 6 positive sides");
    }
    if (box.extents.size() > samples.dimension) {
        fail_input(samples.path, "has " + std::to_string(samples.dimension) +
                                     " coordinates, but its box has " +
                                     std::to_string(box.extents.size()) + " sides");
    }
    const std::string* const kind = samples.header.find("sides");
    if (kind == nullptr || (*kind != "open" && *kind != "periodic")) {
        fail_input(samples.path, "its header does not say whether the box is open or periodic");
    }
    box.is_periodic = *kind == "periodic";
    box.min_distance =
        min_distance.empty()
            ? header_distance(samples)
            : parse_length("--min-distance", min_distance).in_mesh_units(diagonal_of(box));
    return box;
}

} // namespace geodisk::tools
