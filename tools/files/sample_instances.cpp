#include "files/sample_instances.hpp"

#include <string>

#include "program/exact_text.hpp"

namespace geodisk::tools {

std::optional<double> common_radius(const SampleHeader& header, const SampleLayout& layout) {
    if (layout.has_radius) {
        return std::nullopt;
    }
    const std::string* const distance = header.find("min_distance");
    return (distance != nullptr ? parse_real(*distance) : std::nullopt).value_or(2) / 2;
}

} // namespace geodisk::tools
