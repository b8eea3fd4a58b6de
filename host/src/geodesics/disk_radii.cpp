#include <geodisk/geodesics.hpp>

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <string>
#include <vector>

#include "engine/neighbours/check_query.hpp"
#include "geodesics/wavefront.hpp"
#include "mesh/checks.hpp"
#include "mesh/face_area.hpp"
#include "support/blocks.hpp"
#include "support/guard.hpp"
#include "support/invalid.hpp"
#include "support/number_text.hpp"
#include "support/shared_run.hpp"
#include "support/try.hpp"

namespace geodisk {
namespace {

using geodesics::kFar;
using geodesics::Wavefront;

/// Triangles that a disk is measured by at least: faces are divided if it has fewer of them.
constexpr double kTriangles = 1024;
/// Triangles that faces are divided into, at most.
constexpr double kMostTriangles = 0x1p18;
/// Halvings that lead to a radius.
constexpr int kHalvings = 52;
/// Factor on the distance of the farthest point, so that a search in single precision finds it.
constexpr double kBeyond = 1 + 0x1p-10;
/// Factor from a radius that is too small to the next one.
constexpr double kGrowth = 1.5;

/// A triangle with the distances of its corners, ascending. Within it they are linear.
struct Level {
    std::array<double, 3> distances;
    double area;

    /// Returns the area that is no farther than `radius`.
    double within(double radius) const {
        const auto [a, b, c] = distances;
        if (radius <= a) {
            return 0;
        }
        if (radius >= c) {
            return area;
        }
        return radius < b ? area * (radius - a) / (b - a) * ((radius - a) / (c - a))
                          : area * (1 - (c - radius) / (c - a) * ((c - radius) / (c - b)));
    }
};

/// Measures the disks around one source.
class DiskArea {
  public:
    DiskArea(const PreparedMesh& mesh, const PathPoint& source) : mesh_(mesh), source_(source) {}

    /// Returns the radius of the disk that holds this area, or all that a path reaches. Errors:
    /// those of Wavefront::spread().
    Result<double> radius_of(double area, const std::function<bool()>& goes_on) {
        if (const double radius = flat_radius(area); radius > 0) {
            return radius;
        }
        for (double radius = kGrowth * std::sqrt(area / std::numbers::pi);; radius *= kGrowth) {
            GEODISK_TRY(measure(radius, area, goes_on));
            double sum = 0, farthest = 0;
            for (const Level& level : levels_) {
                sum += level.within(radius);
                farthest = std::max(farthest, level.distances[2]);
            }
            if (sum >= area) {
                return halved(radius, area);
            }
            if (farthest <= radius) {
                return farthest * kBeyond; // The whole part of the mesh.
            }
        }
    }

  private:
    double halved(double most, double area) const {
        double least = 0;
        for (int i = 0; i < kHalvings; ++i) {
            const double middle = (least + most) / 2;
            double sum = 0;
            for (const Level& level : levels_) {
                sum += level.within(middle);
            }
            (sum < area ? least : most) = middle;
        }
        return most;
    }

    /// Returns the radius of a disk that lies within the face of the source, or within those around
    /// the vertex that it is at; 0 if it does not.
    double flat_radius(double area) const {
        const auto edges = mesh_.half_edges();
        double angle = 0, room = kFar;
        if (const std::uint32_t vertex = geodesics::vertex_at(mesh_, source_);
            vertex != geodesics::kNone) {
            const VertexFan& fan = mesh_.fans()[vertex];
            for (const std::uint32_t corner :
                 mesh_.corners().subspan(fan.first_corner, fan.corner_count)) {
                const Direction at = edges[corner].angle();
                angle += std::atan2(at.sine, at.cosine);
                room = std::min(room, edges[next_in_face(corner)].apex_y);
            }
        } else {
            angle = 2 * std::numbers::pi;
            for (std::uint32_t h = 3 * source_.face; h < 3 * source_.face + 3; ++h) {
                room = std::min(room, geodesics::point_in(edges[h], h, source_.weights).y);
            }
        }
        const double radius = std::sqrt(2 * area / angle);
        return radius <= room ? radius : 0;
    }

    /// Finds the triangles that a disk of this radius may reach, many for each that holds the area.
    Result<Done> measure(double radius, double wanted, const std::function<bool()>& goes_on) {
        const double reach = radius + mesh_.statistics().longest_edge * (1 + 0x1p-20);
        const auto asks = [&](std::uint32_t) { return goes_on(); };
        Wavefront front(mesh_, reach);
        front.add(source_, 0);
        GEODISK_TRY(front.spread(asks));
        const std::vector<std::uint32_t> faces = faces_within(front, radius);
        double area = 0;
        for (const std::uint32_t face : faces) {
            area += area_of(face);
        }
        const double most = std::min(kMostTriangles, kTriangles * std::max(1.0, area / wanted));
        divide(faces, static_cast<std::uint32_t>(std::ceil(std::sqrt(
                          most / static_cast<double>(std::max<std::size_t>(1, faces.size()))))));
        Wavefront fine(mesh_, reach);
        fine.aim_at(points_);
        fine.add(source_, 0);
        GEODISK_TRY(fine.spread(asks));
        levels_.clear();
        for (const Part& part : parts_) {
            Level level{{}, part.area};
            for (std::size_t k = 0; k < 3; ++k) {
                level.distances[k] = fine.targets()[part.points[k]].distance;
            }
            std::ranges::sort(level.distances);
            if (level.distances[2] < kFar) {
                levels_.push_back(level);
            }
        }
        return Done{};
    }

    double area_of(std::uint32_t face) const {
        const HalfEdge& edge = mesh_.half_edges()[std::size_t{3} * face];
        return edge.length * edge.apex_y / 2;
    }

    std::vector<std::uint32_t> faces_within(const Wavefront& front, double radius) const {
        std::vector<std::uint32_t> faces;
        for (std::uint32_t face = 0; face < mesh_.face_count(); ++face) {
            double nearest = kFar, longest = 0;
            for (std::uint32_t h = 3 * face; h < 3 * face + 3; ++h) {
                const HalfEdge& edge = mesh_.half_edges()[h];
                nearest = std::min(nearest, front.vertices()[edge.origin].distance);
                longest = std::max(longest, edge.length);
            }
            if (nearest - longest <= radius && has_area(mesh_, face)) {
                faces.push_back(face);
            }
        }
        return faces;
    }

    /// Divides faces into so many parts along each edge.
    void divide(const std::vector<std::uint32_t>& faces, std::uint32_t parts) {
        points_.clear();
        parts_.clear();
        for (const std::uint32_t face : faces) {
            const auto first = static_cast<std::uint32_t>(points_.size());
            const auto index = [&](std::uint32_t row, std::uint32_t column) {
                return first + row * (row + 1) / 2 + column;
            };
            for (std::uint32_t row = 0; row <= parts; ++row) {
                for (std::uint32_t column = 0; column <= row; ++column) {
                    const double second = (row - column) / static_cast<double>(parts);
                    const double third = column / static_cast<double>(parts);
                    points_.push_back(
                        {face, {1 - row / static_cast<double>(parts), second, third}});
                }
            }
            const double area = area_of(face) / parts / parts;
            for (std::uint32_t row = 0; row < parts; ++row) {
                for (std::uint32_t column = 0; column <= row; ++column) {
                    parts_.push_back(
                        {{index(row, column), index(row + 1, column), index(row + 1, column + 1)},
                         area});
                    if (column < row) {
                        parts_.push_back({{index(row, column), index(row + 1, column + 1),
                                           index(row, column + 1)},
                                          area});
                    }
                }
            }
        }
    }

    struct Part {
        std::array<std::uint32_t, 3> points;
        double area;
    };

    const PreparedMesh& mesh_;
    PathPoint source_;
    std::vector<PathPoint> points_;
    std::vector<Part> parts_;
    std::vector<Level> levels_;
};

} // namespace

Result<std::vector<double>> disk_radii(const PreparedMesh& mesh, std::span<const Sample> sources,
                                       double area, const ThreadOptions& threads,
                                       const ProgressCallback& progress) noexcept {
    return guarded([&]() -> Result<std::vector<double>> {
        GEODISK_TRY(check_threads(threads));
        if (!(area > 0) || !std::isfinite(area)) {
            return invalid("the area of disks is " + number_text(area) +
                           ", not positive and finite");
        }
        GEODISK_TRY(check_points(mesh, "source", sources));
        std::vector<double> radii(sources.size());
        const auto count = static_cast<std::uint32_t>(sources.size());
        SharedRun run(progress);
        std::atomic<std::uint32_t> done = 0;
        for_parts(threads, count, [&](std::size_t i) {
            if (!run.goes_on()) {
                return;
            }
            const auto found = DiskArea(mesh, geodesics::precise(sources[i])).radius_of(area, [&] {
                return run.tell(done, count);
            });
            if (run.check(found ? Result<Done>(Done{}) : Result<Done>(found.error()))) {
                radii[i] = *found;
                ++done;
            }
            run.tell(done, count);
        });
        GEODISK_TRY(run.result());
        return radii;
    });
}

} // namespace geodisk
