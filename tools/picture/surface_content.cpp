#include "picture/surface_content.hpp"

namespace geodisk::tools::picture {

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
    for (const SurfaceDisk& disk : own) {
        content.samples.push_back({static_cast<float>(disk.radius / content.table.unit),
                                   color_of(content.samples.size()), disk.kind});
    }
    return content;
}

} // namespace geodisk::tools::picture
