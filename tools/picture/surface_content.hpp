// Content that is drawn of the samples on a surface.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <geodisk/mesh.hpp>

#include "geometry/surface_disk.hpp"
#include "picture/picture.hpp"
#include "picture/window_table.hpp"
#include "picture_records.h"
#include "program/batches.hpp"

namespace geodisk::tools::picture {

/// Besides the scene, what the Content of a surface refers to.
struct SurfaceContent {
    WindowTable table;
    std::vector<SampleRec> samples;
};

/// Returns the content for samples with their own disks, each as large as its radius in mesh units;
/// at least one. Looks as far around them as `style` does. Throws as make_window_table().
SurfaceContent make_surface_content(const PreparedMesh& mesh, std::vector<SurfaceDisk> disks,
                                    Style style, const PartDone& tell);

/// Neighbours in a file get any colours.
inline std::uint32_t color_of(std::size_t sample) {
    return static_cast<std::uint32_t>(sample) * 2654435761u >> 8;
}

} // namespace geodisk::tools::picture
