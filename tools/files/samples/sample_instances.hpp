// Instances of a shape at samples, for the formats that scenes are made of.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "files/samples/sample_file.hpp"
#include "files/samples/sample_layout.hpp"

namespace geodisk::tools {

/// Corners of a triangle.
using Marker = std::array<std::array<float, 3>, 3>;

/// Returns a triangle with a circumradius of 1, across the axis of a model that points
/// up by the frames that `header` tells of. Its first corner lies on the axis after that, x after
/// z, so that it shows how a frame is turned.
Marker marker_of(const SampleHeader& header);

/// Returns the radius that all samples have, if the header says it; nothing if radii vary.
std::optional<double> common_radius(const SampleHeader& header, const SampleLayout& layout);

/// Returns true if each sample has a colour of its own.
bool has_colours(const SampleLayout& layout);

/// A class of samples, as scenes show it.
struct SampleClass {
    std::string name;                ///< "Class0" and so on.
    std::array<double, 3> colour;    ///< Linear.
    std::vector<std::uint32_t> rows; ///< Rows of the samples, at least one.
};

/// Returns the classes that have samples, in order; none if the samples have no classes.
std::vector<SampleClass> sample_classes(std::span<const SampleRow> rows,
                                        const SampleLayout& layout);

/// Returns the number of `row` by which a shape of radius 1 is scaled: the radius of the sample.
inline float scale_of(const SampleRow& row, const std::optional<double>& common) {
    return static_cast<float>(common.value_or(row.radius));
}

} // namespace geodisk::tools
