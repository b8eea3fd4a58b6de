// Files of maps, as options of `bake` ask for them.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "files/output/output_file.hpp"
#include "files/samples/map_file.hpp"
#include "picture/picture.hpp"

namespace geodisk::tools {

/// Names of the styles of maps, and their depths: bits of a channel.
const std::vector<std::string>& map_style_names();
const std::vector<std::string>& map_depths();

/// What a file of a map holds.
struct MapTarget {
    MapFormat format = MapFormat::npz;
    picture::Style style = picture::Style::voronoi;
    bool is_deep = false; ///< 16 bits rather than 8.

    /// Returns true for a picture of cells, whose colours need the pairs of samples that touch.
    bool has_cells() const { return format == MapFormat::png && style == picture::Style::voronoi; }
};

/// Returns what a file of that path, --style and --depth holds. Throws UserError(usage).
MapTarget parse_map_target(const Path& path, const std::string& style, const std::string& depth);

/// Writes a map of `samples` samples, and drops its arrays once it needs them no longer.
void write_map(AtomicFile& file, const MapTarget& target, SampleMap& map, std::size_t samples,
               std::span<const std::array<std::uint32_t, 2>> touching);

} // namespace geodisk::tools
