#include "geodisk/outputs/map_output.hpp"

#include "picture/distinct_colors.hpp"
#include "picture/map_picture.hpp"
#include "picture/png.hpp"
#include "program/failure.hpp"
#include "program/suggestion.hpp"

namespace geodisk::tools {

const std::vector<std::string>& map_style_names() {
    static const std::vector<std::string> names{"voronoi", "distance"};
    return names;
}

const std::vector<std::string>& map_depths() {
    static const std::vector<std::string> depths{"8", "16"};
    return depths;
}

MapTarget parse_map_target(const Path& path, const std::string& style, const std::string& depth) {
    MapTarget target;
    target.format = map_format(path);
    check_choice("--style", style, map_style_names());
    target.style = picture::parse_style("--style", style);
    check_choice("--depth", depth, map_depths());
    target.is_deep = depth == map_depths()[1];
    if (target.is_deep && (target.format != MapFormat::png || target.has_cells())) {
        fail_usage(
            "--depth 16 is for *.png with --style distance; *.npy and *.npz have distances as "
            "floats");
    }
    return target;
}

void write_map(AtomicFile& file, const MapTarget& target, SampleMap& map, std::size_t samples,
               std::span<const std::array<std::uint32_t, 2>> touching) {
    switch (target.format) {
    case MapFormat::npz:
        write_arrays(file, map);
        return;
    case MapFormat::npy:
        write_distances(file, map);
        return;
    case MapFormat::png:
        break;
    }
    const auto write = [&](const auto& pixels) {
        map = {map.width, map.height, {}, {}, {}}; // Room for what writing takes.
        file.write(picture::png_of(pixels));
    };
    if (target.has_cells()) {
        write(picture::cell_pixels(map, picture::distinct_colors(samples, touching)));
    } else if (target.is_deep) {
        write(picture::deep_distance_pixels(map));
    } else {
        write(picture::distance_pixels(map));
    }
}

} // namespace geodisk::tools
