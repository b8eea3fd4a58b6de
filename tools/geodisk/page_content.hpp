// Content of the page of a report: a mesh and its samples.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "analysis/surface_statistics.hpp"
#include "geodisk/inputs/mesh_input.hpp"
#include "geodisk/outputs/progress.hpp"
#include "geometry/surface_disk.hpp"
#include "picture/view.hpp"
#include "report/disk_data.hpp"
#include "report/page_array.hpp"

namespace geodisk::tools {

struct PageContent {
    std::vector<report::PageArray> arrays;
    std::vector<std::string> left_out; ///< Content that is not shown, and why, in sentences.
    bool has_surface = false;
    std::optional<report::DiskScale> disks; ///< Scale of the disks, if they are shown.
    std::size_t windows = 0;                ///< Number of windows of all disks.
    picture::Up up = picture::Up::y;
};

/// The surface with these disks, one for each sample. `up` is what points up, if it was given. What
/// a browser could not draw is left out. Throws UserError.
PageContent make_page_content(const MeshInput& mesh, const SampleDisks& samples,
                              std::span<const analysis::Neighbor> neighbors,
                              std::optional<picture::Up> up, ProgressLine& progress);

} // namespace geodisk::tools
