// A vertex of any angle sum with all distances known: equal triangles around one apex.
#pragma once

#include "support/meshes.hpp"

namespace geodisk::test {

/// `sectors` equal isosceles triangles with legs of length 1 around vertex 0, each cut into
/// 4^subdivisions faces. Distances follow from the total angle alone.
class Cone {
  public:
    /// The apex has the angle sum `angle`, well below pi * sectors. `zigzag` lifts and lowers the
    /// spokes in turns by so many radians, which keeps even a flat vertex from being plane; it
    /// needs 2 * sectors * zigzag < angle.
    Cone(std::uint32_t sectors, double angle, double zigzag, int subdivisions);

    const TestMesh& mesh() const { return mesh_; }
    double distance(const Point& a, const Point& b) const;

  private:
    struct Polar {
        double radius, angle;
    };
    Polar polar(const Point& p) const;

    TestMesh mesh_;
    std::vector<Vec3> rim_;
    double angle_;
    std::uint32_t faces_per_sector_;
};

} // namespace geodisk::test
