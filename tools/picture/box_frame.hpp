// A box of three dimensions and balls in it.
#pragma once

#include <array>
#include <vector>

#include <geodisk/box.hpp>

#include "picture/scene.hpp"
#include "picture/window_table.hpp"

namespace geodisk::tools::picture {

/// The twelve edges of a box, as thin bars.
class BoxFrame {
  public:
    /// `box` has three dimensions; balls are no larger than `radius`, in units of the box.
    BoxFrame(const BoxParams& box, double radius);

    const Scene& scene() const { return scene_; }
    /// Returns the table of no samples.
    const WindowTable& table() const { return table_; }

    /// The ball around a point of the box.
    BallRec ball(const std::array<double, 3>& at, double radius, std::uint32_t color) const;

  private:
    std::array<double, 3> middle_;
    Scene scene_;
    WindowTable table_;
};

} // namespace geodisk::tools::picture
