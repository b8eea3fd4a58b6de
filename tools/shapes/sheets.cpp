#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "geometry/angles.hpp"
#include "geometry/mesh.hpp"
#include "shapes/shape_makers.hpp"

namespace geodisk::tools {
namespace {

/// One flat strip of a sheet: how long it is and where it leads in the x-z plane.
struct Strip {
    double length;
    double dx;
    double dz;
};

constexpr int kLayers = 5;
constexpr double kLayerGap = 0.01;
constexpr int kStripsPerTurn = 4;

/// Layers of length 1 that lead back and forth above each other, joined by turns that go half
/// around a polygon. As every strip stays flat, folding keeps all distances within the sheet.
std::vector<Strip> fold_pattern(int parts_per_layer) {
    const double turn_length = kLayerGap * sine(kPi / (2 * kStripsPerTurn));
    std::vector<Strip> strips;
    for (int layer = 0; layer < kLayers; ++layer) {
        const double direction = layer % 2 == 0 ? 1 : -1;
        for (int i = 0; i < parts_per_layer; ++i) {
            strips.push_back({1.0 / parts_per_layer, direction / parts_per_layer, 0});
        }
        for (int i = 0; i < kStripsPerTurn && layer + 1 < kLayers; ++i) {
            const double heading = kPi * (i + 0.5) / kStripsPerTurn;
            strips.push_back({turn_length, turn_length * (direction * cosine(heading)),
                              turn_length * sine(heading)});
        }
    }
    return strips;
}

/// Lengths are multiples of it where they are to be exact: sums of thousands, and of their squares,
/// fit a double.
constexpr double kGrain = 0x1p-24;

/// A strip that leads about as `step`. Its length and coordinates are in the proportion of whole
/// numbers, (n^2 - m^2)^2 + (2 m n)^2 = (n^2 + m^2)^2, so that bent and flat edges are equally long
/// to the last bit.
Strip exact_strip(Vec3 step) {
    constexpr double kN = 64;
    const double m = std::round(kN * step.z / (length(step) + std::abs(step.x)));
    const double whole = kN * kN + m * m;
    const double unit = std::max(1.0, std::round(length(step) / (whole * kGrain))) * kGrain;
    return {whole * unit, std::copysign((kN * kN - m * m) * unit, step.x), 2 * m * kN * unit};
}

/// Strips that follow the curve `point(0)`, ..., `point(count)` in the x-z plane.
template <typename Curve>
std::vector<Strip> strips_along(int count, const Curve& point) {
    std::vector<Strip> strips;
    Vec3 at = point(0);
    for (int i = 1; i <= count; ++i) {
        const Strip strip = exact_strip(point(i) - at);
        at = at + Vec3{strip.dx, 0, strip.dz};
        strips.push_back(strip);
    }
    return strips;
}

/// A spiral.
std::vector<Strip> roll_pattern(int parts_per_turn) {
    constexpr int kTurns = 3;
    constexpr double kTurnGap = 0.05;
    constexpr double kInnerRadius = 0.1;
    return strips_along(kTurns * parts_per_turn, [&](int i) {
        const double turns = static_cast<double>(i) / parts_per_turn;
        const double radius = kInnerRadius + kTurnGap * turns;
        return Vec3{radius * cosine(2 * kPi * turns), 0, radius * sine(2 * kPi * turns)};
    });
}

/// The curve x = t^2 - 1, z = t (t^2 - 1): a loop with straight ends that cross at a right angle
/// where t is -1 and 1.
std::vector<Strip> loop_pattern(int parts) {
    constexpr double kReach = 1.5; // Of t.
    return strips_along(6 * parts, [&](int i) {
        const double t = kReach * (i - 3 * parts) / (3 * parts);
        return Vec3{t * t - 1, 0, t * (t * t - 1)};
    });
}

/// A sheet of strips in a row, bent as they lead or flat.
MeshFile make_sheet(const std::vector<Strip>& strips, int rows, double width, bool bent) {
    MeshFile mesh;
    const auto count = static_cast<std::uint32_t>(rows);
    double x = 0;
    double z = 0;
    const auto add_column = [&] {
        for (std::uint32_t j = 0; j <= count; ++j) {
            add_vertex(mesh, {x, j * width / rows, z});
        }
    };
    add_column();
    for (const Strip& strip : strips) {
        x += bent ? strip.dx : strip.length;
        z += bent ? strip.dz : 0;
        add_column();
    }
    add_grid(mesh, static_cast<std::uint32_t>(strips.size()), count,
             [&](std::uint32_t i, std::uint32_t j) { return i * (count + 1) + j; });
    return mesh;
}

/// 1, to a grain for each of the rows, which then have exact lengths.
double exact_width(int rows) {
    return rows * std::round(1 / (rows * kGrain)) * kGrain;
}

/// A number in [-1, 1) for each grid point, the same on every machine.
double grid_noise(std::int32_t x, std::int32_t y) {
    std::uint32_t h = static_cast<std::uint32_t>(x) * 0x9E3779B1u;
    h = (h ^ static_cast<std::uint32_t>(y)) * 0x85EBCA77u;
    h = (h ^ (h >> 15)) * 0xC2B2AE3Du;
    h ^= h >> 13;
    return h * 0x1p-31 - 1;
}

/// Noise between the grid points, with continuous first and second derivatives.
double smooth_noise(double x, double y) {
    const double floor_x = std::floor(x);
    const double floor_y = std::floor(y);
    const auto ease = [](double t) { return t * t * t * (t * (6 * t - 15) + 10); };
    const double u = ease(x - floor_x);
    const double v = ease(y - floor_y);
    const std::int32_t i = static_cast<std::int32_t>(floor_x);
    const std::int32_t j = static_cast<std::int32_t>(floor_y);
    const double low = (1 - u) * grid_noise(i, j) + u * grid_noise(i + 1, j);
    const double high = (1 - u) * grid_noise(i, j + 1) + u * grid_noise(i + 1, j + 1);
    return (1 - v) * low + v * high;
}

/// Octaves of ridged noise. Each is turned by an angle with cosine 0.8 and sine 0.6, so that the
/// grid does not show.
double terrain_height(double x, double y) {
    double height = 0;
    double amplitude = 0.07;
    x *= 3;
    y *= 3;
    for (int octave = 0; octave < 6; ++octave) {
        const double noise = smooth_noise(x, y);
        height += amplitude * (octave < 3 ? 1 - 2 * std::abs(noise) : noise);
        amplitude *= 0.42;
        const double turned = 2 * (0.8 * x - 0.6 * y) + 17;
        y = 2 * (0.6 * x + 0.8 * y) + 31;
        x = turned;
    }
    return height;
}

} // namespace

MeshFile make_folded_sheet(int resolution) {
    return make_sheet(fold_pattern(resolution), resolution, 1, true);
}

MeshFile make_unfolded_sheet(int resolution) {
    return make_sheet(fold_pattern(resolution), resolution, 1, false);
}

MeshFile make_swiss_roll(int resolution) {
    return make_sheet(roll_pattern(resolution), resolution, exact_width(resolution), true);
}

MeshFile make_unrolled_sheet(int resolution) {
    return make_sheet(roll_pattern(resolution), resolution, exact_width(resolution), false);
}

MeshFile make_crossed_sheet(int resolution) {
    return make_sheet(loop_pattern(resolution), resolution, exact_width(resolution), true);
}

MeshFile make_uncrossed_sheet(int resolution) {
    return make_sheet(loop_pattern(resolution), resolution, exact_width(resolution), false);
}

MeshFile make_terrain(int resolution) {
    const std::uint32_t parts = static_cast<std::uint32_t>(resolution);
    MeshFile mesh;
    for (std::uint32_t i = 0; i <= parts; ++i) {
        for (std::uint32_t j = 0; j <= parts; ++j) {
            const double x = static_cast<double>(i) / parts;
            const double y = static_cast<double>(j) / parts;
            add_vertex(mesh, {x, y, terrain_height(x, y)});
        }
    }
    add_grid(mesh, parts, parts,
             [&](std::uint32_t i, std::uint32_t j) { return i * (parts + 1) + j; });
    return mesh;
}

} // namespace geodisk::tools
