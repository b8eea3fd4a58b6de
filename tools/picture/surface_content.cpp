#include "picture/surface_content.hpp"

namespace geodisk::tools::picture {

SurfaceContent make_surface_content(const PreparedMesh& mesh, std::vector<SurfaceDisk> disks,
                                    Style style, const PartDone& tell) {
    const double spacing = 2 * median_radius(disks);
    const double reach = reach_of(style);
    std::vector<double> radii;
    radii.reserve(disks.size());
    for (SurfaceDisk& disk : disks) {
        radii.push_back(disk.radius);
        disk.radius *= reach;
    }
    SurfaceContent content{make_window_table(mesh, disks, spacing, tell), {}};
    content.samples.reserve(radii.size());
    for (const double radius : radii) {
        content.samples.push_back(
            {static_cast<float>(radius / content.table.unit), color_of(content.samples.size())});
    }
    return content;
}

} // namespace geodisk::tools::picture
