#include "picture/scene.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

namespace geodisk::tools::picture {
namespace {

/// Distance of the eye of a projection from the origin, where points are at most 1 from it.
constexpr double kEye = 1.5;
/// At a vertex of more faces nothing is smoothed: it is a tip, and each face would ask all others.
constexpr std::size_t kMaxSmoothed = 64;

/// Moves the middle of the bounding box to the origin, and scales to at most 1 from there. Returns
/// the factor.
double normalize_points(std::vector<double>& points, std::uint32_t dimension,
                        std::span<const std::uint32_t> used) {
    std::vector<double> low(dimension, std::numeric_limits<double>::infinity());
    std::vector<double> high(dimension, -std::numeric_limits<double>::infinity());
    for (const std::uint32_t v : used) {
        for (std::uint32_t axis = 0; axis < dimension; ++axis) {
            const double x = points[std::size_t{v} * dimension + axis];
            low[axis] = std::min(low[axis], x);
            high[axis] = std::max(high[axis], x);
        }
    }
    double largest = 0;
    for (std::uint32_t axis = 0; axis < dimension; ++axis) {
        largest = std::max(largest, high[axis] / 2 - low[axis] / 2);
    }
    const double scale = largest > 0 ? 1 / largest : 1;
    for (std::size_t i = 0; i < points.size(); ++i) {
        const std::size_t axis = i % dimension;
        points[i] = (points[i] - (low[axis] / 2 + high[axis] / 2)) * scale;
    }
    double farthest = 0;
    for (const std::uint32_t v : used) {
        double square = 0;
        for (std::uint32_t axis = 0; axis < dimension; ++axis) {
            const double x = points[std::size_t{v} * dimension + axis];
            square += x * x;
        }
        farthest = std::max(farthest, square);
    }
    if (!(farthest > 0)) {
        return scale;
    }
    const double rest = 1 / std::sqrt(farthest);
    std::transform(points.begin(), points.end(), points.begin(),
                   [rest](double x) { return x * rest; });
    return scale * rest;
}

/// Drops the last coordinate in perspective.
std::vector<double> project(const std::vector<double>& points, std::uint32_t dimension) {
    std::vector<double> projected;
    projected.reserve(points.size() / dimension * (dimension - 1));
    for (std::size_t at = 0; at < points.size(); at += dimension) {
        const double part = 1 / (kEye - std::clamp(points[at + dimension - 1], -1.0, 1.0));
        for (std::uint32_t axis = 0; axis + 1 < dimension; ++axis) {
            projected.push_back(points[at + axis] * part);
        }
    }
    return projected;
}

struct Normals {
    std::vector<glm::dvec3> faces;
    std::vector<double> weights; ///< The angle at each corner.
};

Normals face_normals(const std::vector<glm::dvec3>& points,
                     std::span<const std::uint32_t> triangles) {
    Normals normals;
    normals.faces.reserve(triangles.size() / 3);
    normals.weights.reserve(triangles.size());
    const auto direction = [](glm::dvec3 v) {
        const double size = glm::length(v);
        return size > 0 ? v / size : glm::dvec3(0);
    };
    for (std::size_t t = 0; t < triangles.size(); t += 3) {
        const glm::dvec3 at[3] = {points[triangles[t]], points[triangles[t + 1]],
                                  points[triangles[t + 2]]};
        normals.faces.push_back(
            direction(glm::cross(direction(at[1] - at[0]), direction(at[2] - at[0]))));
        for (std::size_t k = 0; k < 3; ++k) {
            const glm::dvec3 a = direction(at[(k + 1) % 3] - at[k]);
            const glm::dvec3 b = direction(at[(k + 2) % 3] - at[k]);
            normals.weights.push_back(std::acos(std::clamp(glm::dot(a, b), -1.0, 1.0)));
        }
    }
    return normals;
}

/// The corners at each vertex, one list after the other.
struct VertexCorners {
    std::vector<std::uint32_t> starts, corners;

    VertexCorners(std::span<const std::uint32_t> triangles, std::size_t vertices)
        : starts(vertices + 1, 0), corners(triangles.size()) {
        for (const std::uint32_t v : triangles) {
            ++starts[v + 1];
        }
        for (std::size_t v = 0; v < vertices; ++v) {
            starts[v + 1] += starts[v];
        }
        std::vector<std::uint32_t> cursor(starts.begin(), starts.end() - 1);
        for (std::uint32_t corner = 0; corner < triangles.size(); ++corner) {
            corners[cursor[triangles[corner]]++] = corner;
        }
    }
    std::span<const std::uint32_t> at(std::uint32_t v) const {
        return std::span(corners).subspan(starts[v], starts[v + 1] - starts[v]);
    }
};

/// The mean of the normals around the corner's vertex that are like its own. Faces that look the
/// other way round count turned over, so that a surface without an inside is smooth as well.
glm::dvec3 corner_normal(std::size_t corner, std::span<const std::uint32_t> around,
                         const Normals& normals) {
    const glm::dvec3 own = normals.faces[corner / 3];
    if (around.size() > kMaxSmoothed) {
        return own;
    }
    const double least = std::cos(glm::radians(kCrease));
    glm::dvec3 sum(0);
    for (const std::uint32_t other : around) {
        const glm::dvec3 normal = normals.faces[other / 3];
        const double likeness = glm::dot(normal, own);
        if (std::abs(likeness) >= least) {
            sum += normal * (likeness < 0 ? -normals.weights[other] : normals.weights[other]);
        }
    }
    const double size = glm::length(sum);
    return size > 0 ? sum / size : own;
}

} // namespace

Scene make_scene(std::span<const double> positions, std::uint32_t dimension,
                 std::span<const std::uint32_t> triangles) {
    std::vector<double> coordinates(positions.begin(), positions.end());
    Scene scene;
    scene.scale = normalize_points(coordinates, dimension, triangles);
    while (dimension > 3) {
        scene.scale = 0;
        coordinates = project(coordinates, dimension);
        --dimension;
        normalize_points(coordinates, dimension, triangles);
    }
    std::vector<glm::dvec3> points;
    points.reserve(coordinates.size() / dimension);
    for (std::size_t at = 0; at < coordinates.size(); at += dimension) {
        points.emplace_back(coordinates[at], coordinates[at + 1],
                            dimension > 2 ? coordinates[at + 2] : 0.0);
    }
    const Normals normals = face_normals(points, triangles);
    const VertexCorners vertices(triangles, points.size());
    scene.corners.reserve(triangles.size());
    for (std::size_t corner = 0; corner < triangles.size(); ++corner) {
        const std::uint32_t v = triangles[corner];
        const glm::vec3 at(points[v]);
        const glm::vec3 n(corner_normal(corner, vertices.at(v), normals));
        scene.corners.push_back({at.x, at.y, at.z, n.x, n.y, n.z, 0});
    }
    return scene;
}

} // namespace geodisk::tools::picture
