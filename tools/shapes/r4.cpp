#include <algorithm>
#include <array>
#include <map>
#include <set>

#include "geometry/angles.hpp"
#include "geometry/mesh.hpp"
#include "shapes/shape_makers.hpp"

namespace geodisk::tools {
namespace {

MeshFile empty_mesh() {
    MeshFile mesh;
    mesh.dimension = 4;
    return mesh;
}

void add_vertex(MeshFile& mesh, const Vec4& p) {
    mesh.positions.insert(mesh.positions.end(), {p.x, p.y, p.z, p.w});
}

/// The points of the icosphere with opposite ones as one.
class ProjectivePoints {
  public:
    explicit ProjectivePoints(const MeshFile& sphere) {
        for (std::size_t v = 0; v < sphere.positions.size() / 3; ++v) {
            const Vec3 p = direction(point_at(sphere.positions, v));
            const auto next = static_cast<std::uint32_t>(points_.size());
            const auto [entry, is_new] = known_.try_emplace({p.x, p.y, p.z}, next);
            if (is_new) {
                points_.push_back(p);
            }
            indices_.push_back(entry->second);
        }
    }

    const std::vector<Vec3>& points() const { return points_; }
    std::uint32_t of_vertex(std::uint32_t v) const { return indices_[v]; }

  private:
    /// The one of p and -p whose first coordinate that is not zero is positive. The icosphere is
    /// symmetric to the last bit, so opposite points agree.
    static Vec3 direction(Vec3 p) {
        const double first = p.x != 0 ? p.x : p.y != 0 ? p.y : p.z;
        return (first < 0 ? -p : p) + 0.0; // No negative zeros.
    }

    std::map<std::array<double, 3>, std::uint32_t> known_;
    std::vector<Vec3> points_;
    std::vector<std::uint32_t> indices_; ///< Index of each vertex of the sphere.
};

} // namespace

MeshFile make_clifford_torus(int resolution) {
    const auto around = static_cast<std::uint32_t>(resolution);
    MeshFile mesh = empty_mesh();
    for (std::uint32_t i = 0; i < around; ++i) {
        const double u = angle(i, around);
        for (std::uint32_t j = 0; j < around; ++j) {
            const double v = angle(j, around);
            add_vertex(mesh, {cosine(u), sine(u), cosine(v), sine(v)});
        }
    }
    add_grid(mesh, around, around,
             [&](std::uint32_t i, std::uint32_t j) { return (i % around) * around + j % around; });
    return mesh;
}

MeshFile make_klein_bottle(int resolution) {
    const auto around = static_cast<std::uint32_t>(resolution);
    const std::uint32_t along = 2 * around; // Nearly square quads.
    constexpr double kTubeRadius = 0.5;
    MeshFile mesh = empty_mesh();
    for (std::uint32_t i = 0; i < along; ++i) {
        const double u = angle(i, along);
        for (std::uint32_t j = 0; j < around; ++j) {
            const double v = angle(j, around);
            // Half a turn into the fourth dimension brings the tube back turned over.
            const double radius = 1 + kTubeRadius * cosine(v);
            const double up = kTubeRadius * sine(v);
            add_vertex(
                mesh, {radius * cosine(u), radius * sine(u), up * cosine(u / 2), up * sine(u / 2)});
        }
    }
    add_grid(mesh, along, around, [&](std::uint32_t i, std::uint32_t j) {
        return i < along ? i * around + j % around : (around - j) % around;
    });
    return mesh;
}

MeshFile make_veronese(int resolution) {
    const MeshFile sphere = make_icosphere(resolution);
    const ProjectivePoints projective(sphere);
    MeshFile mesh = empty_mesh();
    for (const Vec3& p : projective.points()) {
        add_vertex(mesh, {p.x * p.x - p.y * p.y, p.x * p.y, p.x * p.z, p.y * p.z});
    }
    // One of two opposite faces of the icosahedron is taken, with all that subdivision made of it.
    const MeshFile icosahedron = make_icosphere(0);
    const ProjectivePoints ends(icosahedron);
    const std::size_t parts = sphere.triangles.size() / icosahedron.triangles.size();
    std::set<std::array<std::uint32_t, 3>> taken;
    for (std::size_t face = 0; face < icosahedron.triangles.size(); face += 3) {
        std::array<std::uint32_t, 3> corners;
        for (std::size_t k = 0; k < 3; ++k) {
            corners[k] = ends.of_vertex(icosahedron.triangles[face + k]);
        }
        std::sort(corners.begin(), corners.end());
        if (!taken.insert(corners).second) {
            continue;
        }
        for (std::size_t i = face * parts; i < (face + 3) * parts; ++i) {
            mesh.triangles.push_back(projective.of_vertex(sphere.triangles[i]));
        }
    }
    return mesh;
}

} // namespace geodisk::tools
