// Certificate that samples leave no gap: every point of a surface is within reach of one, in double
// precision. It splits faces into cells of its own and shares no code with the library's maximal
// sets.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "kernels/detect.hpp"
#include "lib/surface.hpp"

namespace geodisk::ref {

/// Findings about the gaps. A ratio is a distance over the one that covers: that of two samples at
/// the place, or the radius around a point to avoid.
struct Coverage {
    double largest = 0;      ///< Maximum ratio, of all points tested, to the nearest disk.
    bool is_beyond = false;  ///< There are points beyond all disks, with larger ratios.
    std::uint64_t cells = 0; ///< Cells tested.
    /// The point of that ratio, if it is not covered.
    std::optional<FacePoint<double>> uncovered;
};

class CoverageCheck {
  public:
    /// Points are covered if their ratio is below `allowed`. Radii at the corners, three per face,
    /// are in units of the surface; empty if they do not vary. Then they are half of it. The
    /// surface must outlive the check.
    CoverageCheck(const Surface<double>& surface, std::vector<double> corner_radii, double allowed);

    /// Adds the disk of a sample with this radius. Throws as Detector::run().
    void add_sample(FacePoint<double> center, double radius);
    /// Adds a disk that covers by itself.
    void add_avoided(FacePoint<double> center, double radius);
    /// Sorts the disks by faces, once all are added.
    void sort();
    /// Tests all points of a face.
    void test(std::uint32_t face);
    const Coverage& result() const { return result_; }

  private:
    struct Light {
        std::uint32_t edge;
        bool is_whole, keeps_out;
        double x, y, low, high, sigma; ///< The source is at (x, y) in the frame of the edge.
        double radius;
    };
    using Corners = std::array<FacePoint<double>, 3>;
    struct Measure {
        double distance; ///< From the centroid, whether lit or not.
        double aside;    ///< Distance of the centroid from what is lit.
    };
    void add(FacePoint<double> center, double radius, bool keeps_out);
    Measure measure(const Light& light, FacePoint<double> point) const;
    double radius_at(FacePoint<double> point) const;
    double limit_of(const Light& light, double radius) const;
    bool covers_corners(const Light& light, const Corners& cell, double min_radius) const;
    void visit(const Corners& cell, std::size_t first);
    void note(FacePoint<double> point, double ratio);
    /// Returns the ratio from which a cell may hold a larger gap than those found.
    double worth_a_look() const;

    const Surface<double>& surface_;
    std::vector<double> corner_radii_;
    double allowed_;
    double largest_radius_;
    Bins<double> bins_;
    Detector<double, false> detector_;
    std::vector<Light> lights_;
    std::vector<std::size_t> starts_;
    std::vector<std::uint32_t> stack_; ///< Lights of the cells in work.
    Coverage result_;
};

} // namespace geodisk::ref
