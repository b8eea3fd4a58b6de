#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

#include "geometry/angles.hpp"
#include "geometry/mesh.hpp"
#include "shapes/shape_makers.hpp"

namespace geodisk::tools {
namespace {

/// A grid closed in both directions. `position(i, j)` is the vertex of step i along the surface
/// and step j around it.
template <typename Position>
MeshFile make_closed_grid(std::uint32_t along, std::uint32_t around, const Position& position) {
    MeshFile mesh;
    for (std::uint32_t i = 0; i < along; ++i) {
        for (std::uint32_t j = 0; j < around; ++j) {
            add_vertex(mesh, position(i, j));
        }
    }
    add_grid(mesh, along, around,
             [&](std::uint32_t i, std::uint32_t j) { return (i % along) * around + j % around; });
    return mesh;
}

/// A point of the cross-section: x outwards from the ring, y across.
using Section = Vec2;

/// Control points of one half of the showpiece's cross-section: from the tip of the fin along its
/// side over the body to the mouth of the fold and down its wall. The other half mirrors them.
constexpr std::array<Section, 17> kHalfSection{{{2.60, 0.02},
                                                {2.50, 0.05},
                                                {2.20, 0.05},
                                                {1.90, 0.06},
                                                {1.60, 0.07},
                                                {1.30, 0.10},
                                                {1.00, 0.30},
                                                {0.75, 0.75},
                                                {0.30, 1.05},
                                                {-0.25, 1.10},
                                                {-0.75, 0.85},
                                                {-1.05, 0.50},
                                                {-1.10, 0.15},
                                                {-0.90, 0.03},
                                                {-0.50, 0.03},
                                                {-0.05, 0.03},
                                                {0.30, 0.10}}};

constexpr std::size_t kSectionPoints = 2 * kHalfSection.size();

Section control_point(std::size_t i) {
    if (i < kHalfSection.size()) {
        return kHalfSection[i];
    }
    const Section& mirrored = kHalfSection[kSectionPoints - 1 - i];
    return {mirrored.x, -mirrored.y};
}

/// The closed uniform cubic B-spline of the control points at parameter `t` in [0, kSectionPoints).
Section section_at(double t) {
    const std::size_t span = std::min(static_cast<std::size_t>(t), kSectionPoints - 1);
    const double f = t - static_cast<double>(span);
    const double weights[4] = {(1 - f) * (1 - f) * (1 - f) / 6, (3 * f * f * f - 6 * f * f + 4) / 6,
                               (-3 * f * f * f + 3 * f * f + 3 * f + 1) / 6, f * f * f / 6};
    Section sum;
    for (std::size_t i = 0; i < 4; ++i) {
        sum += weights[i] * control_point((span + i) % kSectionPoints);
    }
    return sum;
}

/// `count` points of the cross-section, spread by length, but denser where control points are.
std::vector<Section> sample_section(std::uint32_t count) {
    constexpr std::size_t kSteps = 64 * kSectionPoints;
    const auto parameter = [](double step) { return step * kSectionPoints / kSteps; };
    std::vector<double> measure{0};
    for (std::size_t i = 0; i < kSteps; ++i) {
        const Section from = section_at(parameter(static_cast<double>(i)));
        const Section to = section_at(parameter(static_cast<double>((i + 1) % kSteps)));
        constexpr double kParameterWeight = 0.1;
        measure.push_back(measure.back() + distance(from, to) +
                          kParameterWeight * kSectionPoints / kSteps);
    }
    std::vector<Section> points;
    for (std::uint32_t j = 0; j < count; ++j) {
        const double target = measure.back() * j / count;
        const auto after = std::upper_bound(measure.begin(), measure.end(), target);
        const std::size_t step = static_cast<std::size_t>(after - measure.begin()) - 1;
        const double fraction = (target - measure[step]) / (measure[step + 1] - measure[step]);
        points.push_back(section_at(parameter(static_cast<double>(step) + fraction)));
    }
    return points;
}

/// The fin waves more the farther out it is.
Section ruffled(Section p, double u) {
    constexpr double kRoot = 1.1;
    constexpr double kWaves = 14;
    const double outward = std::max(0.0, p.x - kRoot);
    p.y += 0.14 * outward * outward * sine(kWaves * u);
    return p;
}

} // namespace

MeshFile make_torus_knot(int resolution) {
    // The tube is about ten times as long as it is around.
    const std::uint32_t around = static_cast<std::uint32_t>(resolution);
    const std::uint32_t along = 10 * around;
    constexpr double kMinorRadius = 0.45; // Of the torus, of radius 1, that the knot lies on.
    constexpr double kTubeRadius = 0.24;
    return make_closed_grid(along, around, [&](std::uint32_t i, std::uint32_t j) {
        const double t = angle(i, along);
        const double c2 = cosine(2 * t), s2 = sine(2 * t);
        const double c3 = cosine(3 * t), s3 = sine(3 * t);
        const double radius = 1 + kMinorRadius * c3;
        const Vec3 centre{radius * c2, radius * s2, kMinorRadius * s3};
        const Vec3 tangent =
            2 * radius * Vec3{-s2, c2, 0} + 3 * kMinorRadius * Vec3{-s3 * c2, -s3 * s2, c3};
        // The torus normal is a frame that closes without twist.
        const Vec3 normal{c3 * c2, c3 * s2, s3};
        const Vec3 binormal = cross(normal, normalize(tangent));
        const double s = angle(j, around);
        return centre + kTubeRadius * (cosine(s) * normal + sine(s) * binormal);
    });
}

MeshFile make_moebius(int resolution) {
    const std::uint32_t across = static_cast<std::uint32_t>(resolution);
    const std::uint32_t along = 9 * across; // Nearly square quads.
    constexpr double kHalfWidth = 0.35;
    MeshFile mesh;
    for (std::uint32_t i = 0; i < along; ++i) {
        const double u = angle(i, along);
        for (std::uint32_t j = 0; j <= across; ++j) {
            const double v = kHalfWidth * (2.0 * j / across - 1);
            const double radius = 1 + v * cosine(u / 2);
            add_vertex(mesh, {radius * cosine(u), radius * sine(u), v * sine(u / 2)});
        }
    }
    add_grid(mesh, along, across, [&](std::uint32_t i, std::uint32_t j) {
        return i < along ? i * (across + 1) + j : across - j; // The end meets the start reversed.
    });
    return mesh;
}

MeshFile make_showpiece(int resolution) {
    const std::uint32_t around = static_cast<std::uint32_t>(resolution);
    const std::uint32_t along = 2 * around;
    constexpr double kRingRadius = 3.8;
    const std::vector<Section> section = sample_section(around);
    return make_closed_grid(along, around, [&](std::uint32_t i, std::uint32_t j) {
        const double u = angle(i, along);
        const Section p = ruffled(section[j], u);
        const double twist = u; // One full turn on the way around.
        const double out = p.x * cosine(twist) - p.y * sine(twist);
        const double up = p.x * sine(twist) + p.y * cosine(twist);
        const double radius = kRingRadius + out;
        return (1 / kRingRadius) * Vec3{radius * cosine(u), radius * sine(u), up};
    });
}

} // namespace geodisk::tools
