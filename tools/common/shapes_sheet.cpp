#include "common/shape_makers.hpp"

#include <cstdint>
#include <vector>

namespace geodisk::tools {

namespace {

/// One flat strip of the sheet: how long it is and which way it leads in the x-z plane.
struct Strip {
    double length;
    double x;
    double z;
};

constexpr int kLayers = 5;
constexpr double kLayerGap = 0.01;
constexpr int kStripsPerTurn = 4;

/// Layers of length 1 that lead back and forth above each other, joined by turns that go half
/// around a polygon. As every strip stays flat, folding keeps all distances within the sheet.
std::vector<Strip> fold_pattern(int parts_per_layer) {
    const double turn_length = kLayerGap * std::sin(kPi / (2 * kStripsPerTurn));
    std::vector<Strip> strips;
    for (int layer = 0; layer < kLayers; ++layer) {
        const double direction = layer % 2 == 0 ? 1 : -1;
        for (int i = 0; i < parts_per_layer; ++i) {
            strips.push_back({1.0 / parts_per_layer, direction, 0});
        }
        for (int i = 0; i < kStripsPerTurn && layer + 1 < kLayers; ++i) {
            const double heading = kPi * (i + 0.5) / kStripsPerTurn;
            strips.push_back({turn_length, direction * std::cos(heading), std::sin(heading)});
        }
    }
    return strips;
}

MeshFile make_sheet(int parts_per_layer, bool folded) {
    MeshFile mesh;
    const std::vector<Strip> strips = fold_pattern(parts_per_layer);
    const std::uint32_t rows = static_cast<std::uint32_t>(parts_per_layer);
    double x = 0;
    double z = 0;
    const auto add_column = [&] {
        for (std::uint32_t j = 0; j <= rows; ++j) {
            add_vertex(mesh, {x, static_cast<double>(j) / rows, z});
        }
    };
    add_column();
    for (const Strip& strip : strips) {
        x += folded ? strip.length * strip.x : strip.length;
        z += folded ? strip.length * strip.z : 0;
        add_column();
    }
    add_grid(mesh, static_cast<std::uint32_t>(strips.size()), rows,
             [&](std::uint32_t i, std::uint32_t j) { return i * (rows + 1) + j; });
    return mesh;
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
    return make_sheet(resolution, true);
}

MeshFile make_unfolded_sheet(int resolution) {
    return make_sheet(resolution, false);
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
