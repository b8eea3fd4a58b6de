#include "geodisk/outside_faces.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <cstddef>
#include <optional>

#include "mesh/checks.hpp"
#include "mesh/connectivity.hpp"
#include "mesh/ray_tree.hpp"
#include "support/blocks.hpp"
#include "support/guard.hpp"
#include "support/invalid.hpp"
#include "support/number_text.hpp"
#include "support/shared_run.hpp"
#include "support/try.hpp"

namespace geodisk {
namespace {

using Corners = std::array<Vec, 3>;

constexpr std::size_t kDirections = 64;
/// Faces of a part of the work.
constexpr std::size_t kPart = 1024;
/// Weights of the points of a face: its middle, and those of the parts at its corners.
constexpr std::array<Vec, 4> kPoints{{{1 / 3.0, 1 / 3.0, 1 / 3.0},
                                      {2 / 3.0, 1 / 6.0, 1 / 6.0},
                                      {1 / 6.0, 2 / 3.0, 1 / 6.0},
                                      {1 / 6.0, 1 / 6.0, 2 / 3.0}}};
/// Parts of the extent of the mesh by which rays pass faces that lie on each other.
constexpr double kGap = 1e-9;

/// Returns directions that are spread evenly over the sphere: a spiral of golden angles. None is
/// along an axis, in which the faces of many models lie.
std::array<Vec, kDirections> make_directions() {
    // Cosine and sine of the golden angle: no library of mathematics is asked, since they differ in
    // the last bit.
    constexpr double kCosine = -0.73736887807831985, kSine = 0.67549029426152362;
    std::array<Vec, kDirections> directions{};
    double x = 1, y = 0;
    for (std::size_t i = 0; i < kDirections; ++i) {
        const double z = 1 - (2.0 * static_cast<double>(i) + 1) / kDirections;
        const double radius = std::sqrt(1 - z * z);
        directions[i] = {radius * x, radius * y, z};
        const double turned = kCosine * x - kSine * y;
        y = kSine * x + kCosine * y;
        x = turned;
    }
    return directions;
}

/// The faces with area, scaled so that no product leaves the range of double.
struct ScaledFaces {
    std::vector<Corners> corners;
    std::vector<std::uint32_t> numbers;
};

ScaledFaces scaled_faces(const MeshView& mesh) {
    double largest = 0;
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
        for (std::size_t axis = 0; axis < 3; ++axis) {
            largest = std::max(largest, std::abs(mesh.coordinate(mesh.triangles[i], axis)));
        }
    }
    ScaledFaces faces;
    for (std::uint32_t f = 0; f < mesh.face_count(); ++f) {
        const std::array<std::uint32_t, 3> vertices = mesh.triangles.face(f);
        Corners corners{};
        for (std::size_t k = 0; k < 3; ++k) {
            for (std::size_t axis = 0; axis < 3; ++axis) {
                corners[k][axis] = mesh.coordinate(vertices[k], axis) / largest;
            }
        }
        const Vec normal = cross(corners[1] - corners[0], corners[2] - corners[0]);
        if (takes_part(vertices) && dot(normal, normal) > 0) {
            faces.corners.push_back(corners);
            faces.numbers.push_back(f);
        }
    }
    return faces;
}

/// Tells which faces are seen by enough rays.
class Watcher {
  public:
    Watcher(std::span<const Corners> faces, double share)
        : tree_(faces), directions_(make_directions()), share_(share) {}

    bool sees(const Corners& face) const {
        const Vec normal = cross(face[1] - face[0], face[2] - face[0]);
        std::array<std::size_t, 2> rays{};
        for (const Vec& direction : directions_) {
            if (const auto side = side_of(direction, normal)) {
                rays[*side] += kPoints.size();
            }
        }
        std::array<std::size_t, 2> free{}, left = rays, needed{};
        for (std::size_t side = 0; side < 2; ++side) {
            needed[side] = static_cast<std::size_t>(
                std::max(1.0, std::ceil(share_ * static_cast<double>(rays[side]))));
        }
        for (const Vec& weights : kPoints) {
            Vec origin{};
            for (std::size_t axis = 0; axis < 3; ++axis) {
                origin[axis] = weights[0] * face[0][axis] + weights[1] * face[1][axis] +
                               weights[2] * face[2][axis];
            }
            for (const Vec& direction : directions_) {
                const auto side = side_of(direction, normal);
                if (!side || free[*side] + left[*side]-- < needed[*side]) {
                    continue; // Too many are stopped on this side.
                }
                if (!tree_.is_met(origin, direction, kGap) && ++free[*side] >= needed[*side]) {
                    return true;
                }
            }
        }
        return false;
    }

  private:
    /// Returns the side of a face to which a ray leaves; none for a ray along the face.
    static std::optional<std::size_t> side_of(const Vec& direction, const Vec& normal) {
        const double along = dot(direction, normal);
        return along == 0 ? std::nullopt : std::optional<std::size_t>(along > 0 ? 0 : 1);
    }

    RayTree tree_;
    std::array<Vec, kDirections> directions_;
    double share_;
};

Result<Done> check(const MeshView& mesh, double share) {
    if (mesh.dimension != 3) {
        return invalid("the mesh has " + std::to_string(mesh.dimension) +
                       " coordinates per vertex, and only in space faces are seen");
    }
    if (!(share >= 0 && share <= 1)) {
        return invalid("the share of rays is " + number_text(share) + ", not from 0 to 1");
    }
    return check_mesh(mesh);
}

} // namespace

Result<std::vector<std::uint8_t>> outside_faces(const MeshView& mesh, double share,
                                                const ThreadOptions& threads,
                                                const ProgressCallback& progress) noexcept {
    return guarded([&]() -> Result<std::vector<std::uint8_t>> {
        GEODISK_TRY(check_threads(threads));
        GEODISK_TRY(check(mesh, share));
        std::vector<std::uint8_t> seen(mesh.face_count(), 0);
        const ScaledFaces faces = scaled_faces(mesh);
        if (faces.corners.empty()) {
            return seen;
        }
        const Watcher watcher(faces.corners, share);
        SharedRun run(progress);
        std::atomic<std::uint32_t> done = 0;
        const std::size_t count = faces.corners.size();
        for_parts(threads, (count + kPart - 1) / kPart, [&](std::size_t part) {
            const std::size_t end = std::min((part + 1) * kPart, count);
            for (std::size_t i = part * kPart; i < end && run.goes_on(); ++i) {
                seen[faces.numbers[i]] = watcher.sees(faces.corners[i]) ? 1 : 0;
            }
            done += static_cast<std::uint32_t>(end - part * kPart);
            run.tell(done, static_cast<std::uint32_t>(count));
        });
        GEODISK_TRY(run.result());
        return seen;
    });
}

} // namespace geodisk
