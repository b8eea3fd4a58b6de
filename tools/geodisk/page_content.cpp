#include "geodisk/page_content.hpp"

#include <iterator>
#include <utility>

#include "picture/scene.hpp"
#include "picture/window_table.hpp"
#include "program/human_text.hpp"
#include "program/interrupt.hpp"
#include "report/sample_data.hpp"
#include "report/surface_data.hpp"

namespace geodisk::tools {
namespace {

/// Maximum that a browser opens within seconds, as pages of about 200 MB.
constexpr std::size_t kMaxTriangles = std::size_t{1} << 22;
/// The same of windows, as 64 MB.
constexpr std::size_t kMaxWindows = std::size_t{1} << 22;

void append(std::vector<report::PageArray>& to, std::vector<report::PageArray> arrays) {
    to.insert(to.end(), std::make_move_iterator(arrays.begin()),
              std::make_move_iterator(arrays.end()));
}

void add_disks(const MeshInput& mesh, std::span<const SurfaceDisk> disks, ProgressLine& progress,
               PageContent& content) {
    progress.begin_stage("computing the disks");
    const auto tell = [&](double part) {
        check_interrupted();
        progress.update(part, grouped(disks.size()) + " disks");
    };
    auto table = picture::try_window_table(mesh.prepared, disks, 2 * median_radius(disks), tell,
                                           kMaxWindows);
    if (!table) {
        content.left_out.push_back("The disks, as they light more than " + grouped(kMaxWindows) +
                                   " places of the surface, too many for a page. Samples are "
                                   "shown as points.");
        return;
    }
    report::DiskData data = report::disk_data(*table);
    append(content.arrays, std::move(data.arrays));
    content.disks = data.scale;
    content.windows = table->windows.size();
}

} // namespace

PageContent make_page_content(const MeshInput& mesh, const SampleDisks& samples,
                              std::span<const analysis::Neighbor> neighbors,
                              std::optional<picture::Up> up, ProgressLine& progress) {
    PageContent content;
    content.arrays = report::sample_arrays(samples, neighbors);
    if (mesh.dimension() == 0) {
        content.left_out.emplace_back("The surface, as the mesh has edge lengths without "
                                      "coordinates, so that there is nothing to look at.");
        return content;
    }
    if (mesh.file.triangle_count() > kMaxTriangles) {
        content.left_out.push_back("The surface, as it has more than " + grouped(kMaxTriangles) +
                                   " triangles, too many for a page.");
        return content;
    }
    add_disks(mesh, samples.disks, progress, content);
    progress.begin_stage("preparing the page");
    const picture::Scene scene =
        picture::make_scene(mesh.file.positions, mesh.dimension(), mesh.file.triangles);
    append(content.arrays, report::surface_arrays(scene, mesh.file.triangles));
    content.has_surface = true;
    content.up = up.value_or(picture::likely_up(scene));
    progress.clear();
    return content;
}

} // namespace geodisk::tools
