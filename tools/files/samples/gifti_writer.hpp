// Values of vertices as GIFTI files: numbers (.shape.gii) and labels (.label.gii).
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "files/output/output_file.hpp"
#include "files/samples/distance_file.hpp"
#include "program/path.hpp"

namespace geodisk::tools {

/// Name and value of each entry of the metadata of a file or an array.
using GiftiEntries = std::vector<std::pair<std::string, std::string>>;

/// A label of vertices: its number in arrays, its name and its colour, red, green, blue and alpha
/// from 0 to 1.
struct GiftiLabel {
    std::int32_t key = 0;
    std::string name;
    std::array<double, 4> colour{};
};

/// Returns true for files named *.gii.
bool is_gifti(const Path& path);

/// Writes an array of numbers for each row of the table, in single precision, NaN where no path
/// leads. Its name tells the source.
void write_gifti_distances(AtomicFile& file, const DistanceTable& table,
                           const GiftiEntries& entries);

/// Writes the label of each vertex, which is one of `labels`.
void write_gifti_labels(AtomicFile& file, std::span<const std::int32_t> keys,
                        std::span<const GiftiLabel> labels, const GiftiEntries& entries);

} // namespace geodisk::tools
