#include "files/samples/sample_instances.hpp"

#include <algorithm>
#include <iterator>
#include <map>
#include <string>
#include <utility>

#include "files/images/srgb_encoding.hpp"
#include "files/meshes/mesh_fields.hpp"
#include "files/samples/frame_style.hpp"
#include "program/exact_text.hpp"

namespace geodisk::tools {
namespace {

struct Colour {
    double red, green, blue;
};
constexpr Colour vec3(double red, double green, double blue) {
    return {red, green, blue};
}
constexpr Colour kColours[] = {
#include "picture/shaders/class_colors.h"
};

} // namespace

Marker marker_of(const SampleHeader& header) {
    constexpr float kMarker[3][2] = {{1, 0}, {-0.5F, 0.8660254F}, {-0.5F, -0.8660254F}};
    const std::string* const frames = header.find("frames");
    const Up up = frames != nullptr ? parse_frame_style("frames", *frames).model : Up::z;
    const std::size_t first = (std::size_t(up) + 1) % 3;
    Marker marker{};
    for (std::size_t i = 0; i < marker.size(); ++i) {
        marker[i][first] = kMarker[i][0];
        marker[i][(first + 1) % 3] = kMarker[i][1];
    }
    return marker;
}

std::optional<double> common_radius(const SampleHeader& header, const SampleLayout& layout) {
    if (layout.has_radius) {
        return std::nullopt;
    }
    const std::string* const distance = header.find("min_distance");
    return (distance != nullptr ? parse_real(*distance) : std::nullopt).value_or(2) / 2;
}

bool has_colours(const SampleLayout& layout) {
    return std::ranges::any_of(layout.further.fields,
                               [](const SampleField& field) { return field.name == kColourField; });
}

std::vector<SampleClass> sample_classes(std::span<const SampleRow> rows,
                                        const SampleLayout& layout) {
    const auto column = std::ranges::find(layout.further.numbers, kClassColumn, &ExtraColumn::name);
    if (column == layout.further.numbers.end()) {
        return {};
    }
    std::map<std::uint32_t, std::vector<std::uint32_t>> members;
    for (std::uint32_t i = 0; i < rows.size(); ++i) {
        members[column->values[i]].push_back(i);
    }
    std::vector<SampleClass> classes;
    for (auto& [number, own] : members) {
        const Colour& encoded = kColours[number % std::size(kColours)];
        classes.push_back({"Class" + std::to_string(number),
                           {light_of(encoded.red), light_of(encoded.green), light_of(encoded.blue)},
                           std::move(own)});
    }
    return classes;
}

} // namespace geodisk::tools
