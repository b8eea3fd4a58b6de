#include "picture/surface_content.hpp"

#include <optional>

#include "picture/nearest_windows.hpp"

namespace geodisk::tools::picture {
namespace {

/// Returns how much farther than the nearest sample, in its radii, those are that a style shows
/// anything of; nothing for all that reach a place.
std::optional<double> margin_of(Style style) {
    switch (style) {
    case Style::voronoi:
        return 1.0 / kBordersPerRadius;
    case Style::distance:
        return 0;
    default:
        return std::nullopt;
    }
}

} // namespace

SurfaceContent make_surface_content(const PreparedMesh& mesh, std::vector<SurfaceDisk> disks,
                                    Style style, const PartDone& tell) {
    const double spacing = 2 * median_radius(disks);
    const double reach = reach_of(style);
    const std::vector<SurfaceDisk> own = disks;
    for (SurfaceDisk& disk : disks) {
        disk.radius *= reach;
    }
    SurfaceContent content{make_window_table(mesh, disks, spacing, tell), {}};
    content.samples.reserve(own.size());
    std::vector<double> radii;
    radii.reserve(own.size());
    for (const SurfaceDisk& disk : own) {
        radii.push_back(disk.radius / content.table.unit);
        content.samples.push_back(
            {static_cast<float>(radii.back()), color_of(content.samples.size()), disk.kind});
    }
    if (const auto margin = margin_of(style)) {
        keep_nearest(content.table, radii, reach, *margin);
    }
    return content;
}

} // namespace geodisk::tools::picture
