// Pictures of samples, for figures that show them.
#pragma once

#include <string>
#include <vector>

#include <geodisk/box.hpp>
#include <geodisk/context.hpp>
#include <geodisk/runner.hpp>

#include "geometry/surface_disk.hpp"
#include "paper/options.hpp"
#include "paper/pool.hpp"
#include "picture/gpu.hpp"
#include "picture/picture.hpp"

namespace geodisk::paper {

using tools::picture::PictureParams;
using tools::picture::Pixels;

/// Draws on a device that has a queue for graphics.
class Painter {
  public:
    /// The context was opened for graphics, and must outlive the object.
    explicit Painter(const Context& context) : gpu_(context.device(), context.queue()) {}

    /// `disks` on the surface, each as large as its radius.
    Pixels surface(const PaperMesh& mesh, std::vector<tools::SurfaceDisk> disks,
                   const PictureParams& params) const;

    /// Samples of `box`, of two or three dimensions, with their disks or balls.
    Pixels samples(const BoxParams& box, const SampleSet& set, PictureParams params) const;

  private:
    tools::picture::Gpu gpu_;
};

/// The disks of samples, with half of `min_distance` as radius.
std::vector<tools::SurfaceDisk> disks_of(const std::vector<ref::FacePoint<double>>& samples,
                                         double min_distance);

/// A square picture of the given size.
PictureParams square_panel(const PanelSize& size);

/// Pictures side by side, aligned at the top, with white between.
Pixels side_by_side(const std::vector<Pixels>& pictures);

} // namespace geodisk::paper
