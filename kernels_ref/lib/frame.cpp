#include "lib/frame.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace geodisk::ref {
namespace {

/// Packing density that dart throwing reaches (paper section 5.2), with 20 candidates per sample.
constexpr double kRho = 0.725;
/// Part of the distances met by which a crossing may be off.
constexpr double kCrossingError = 0x1p-22;
/// Factors of radii are floats, and sums of two radii are rounded to float.
constexpr double kRadiiError = 0x1p-21;
constexpr double kFewestCrossings = 64;
constexpr double kMaxCrossings = 65536;
/// Disks that cover this many faces take vertex events by distance (shaders/README.md).
constexpr double kFacesOfLargeDisk = 16384;

/// rho = r sqrt(2 sqrt(3) N / A), solved for N.
double samples_on(double area, double min_distance) {
    const double per_radius = 2 * kRho / min_distance;
    return per_radius * per_radius * area / std::sqrt(12.0);
}

/// x > 0 rounded up to a power of two.
double up_to_power_of_two(double x) {
    int exponent = 0;
    const double fraction = std::frexp(x, &exponent);
    return std::ldexp(1.0, fraction == 0.5 ? exponent - 1 : exponent);
}

/// The longest way from a first vertex down a tree of edges, of all components. A tree grows by the
/// vertices next to those that it has, oldest first, around each in the order of its corners.
double deepest_tree(const PreparedMesh& mesh) {
    struct Node {
        std::uint32_t vertex;
        double depth;
    };
    std::vector<Node> nodes;
    nodes.reserve(mesh.vertex_count());
    std::vector<bool> has(mesh.vertex_count(), false);
    double deepest = 0;
    const auto add = [&](std::uint32_t vertex, double depth) {
        if (!has[vertex]) {
            has[vertex] = true;
            nodes.push_back({vertex, depth});
            deepest = std::max(deepest, depth);
        }
    };
    std::size_t next = 0;
    for (std::uint32_t root = 0; root < mesh.vertex_count(); ++root) {
        add(root, 0);
        for (; next < nodes.size(); ++next) {
            const Node node = nodes[next];
            const VertexFan& fan = mesh.fans()[node.vertex];
            for (std::uint32_t i = 0; i < fan.corner_count; ++i) {
                const std::uint32_t out = mesh.corners()[fan.first_corner + i];
                const HalfEdge& leaving = mesh.half_edges()[out];
                const HalfEdge& arriving = mesh.half_edges()[previous_in_face(out)];
                add(mesh.half_edges()[next_in_face(out)].origin, node.depth + leaving.length);
                add(arriving.origin, node.depth + arriving.length);
            }
        }
    }
    return deepest;
}

/// Returns the area that the samples of a job fill: the part that the mask leaves, counted as often
/// as radii that vary are smaller there.
double area_for_samples(const PreparedMesh& mesh, const SampleParams& params) {
    double area = 0;
    for (std::uint32_t face = 0; face < mesh.face_count(); ++face) {
        if (takes_samples(params, face)) {
            const double denser = params.radii != nullptr ? params.radii->samples_in(face) : 1;
            area += area_of(mesh, face) * denser;
        }
    }
    return area;
}

double longest_edge_of(const PreparedMesh& mesh) {
    double longest = 0;
    for (const HalfEdge& edge : mesh.half_edges()) {
        longest = std::max(longest, edge.length);
    }
    return longest;
}

/// The minimum distance; where it exceeds all distances of the mesh, a little more than those are.
/// From any point a vertex is at most an edge away, and from it the root of its tree.
double unit_of(const PreparedMesh& mesh, double min_distance, double longest_edge) {
    if (min_distance <= mesh.statistics().diagonal) {
        return min_distance;
    }
    const double bound = 2 * (deepest_tree(mesh) + longest_edge);
    return std::min(min_distance, 1.01 * bound);
}

bool is_split_once(const PreparedMesh& mesh) {
    for (std::uint32_t h = 0; h < mesh.half_edges().size(); ++h) {
        const std::uint32_t other = around_half_edge(mesh.half_edges()[h].around);
        if (around_half_edge(mesh.half_edges()[other].around) != h) {
            return false;
        }
    }
    return true;
}

/// All but the stages.
Frame frame_without_pool(const PreparedMesh& mesh, double min_distance, double unit,
                         double longest_edge) {
    Frame frame;
    frame.unit = unit;
    frame.longest_edge = longest_edge / unit;
    double area = 0;
    for (std::uint32_t face = 0; face < mesh.face_count(); ++face) {
        area += area_of(mesh, face);
    }
    // A disk covers twice the faces that there are per sample, and a path crosses about as many
    // edges as faces lie across.
    const double faces = 2.0 * mesh.face_count() / std::max(1.0, samples_on(area, min_distance));
    frame.chain = static_cast<std::uint32_t>(
        std::clamp(8 + 4 * std::sqrt(faces), kFewestCrossings, kMaxCrossings));
    frame.splits_once = is_split_once(mesh);
    frame.straight_faces = mesh.statistics().diagonal > 0;
    frame.stages.samples = samples_on(area, unit);
    return frame;
}

} // namespace

double Frame::samples_on(double area) const {
    return ref::samples_on(area, unit);
}

float Frame::intensity(std::uint32_t stage) const {
    return static_cast<float>(stages.per_sample(stage) *
                              (ref::samples_on(1, 1) * candidates_of_classes));
}

double Frame::error_of(std::uint32_t crossings, bool trims) const {
    const double base =
        4 * kCrossingError * std::ceil(longest_edge) + (radii_vary ? kRadiiError : 0);
    // Half of a crossing's error is for windows that trim others. On long edges they take more.
    const double further = trims ? std::max(0.0, base / 16 - kCrossingError / 2) : 0;
    return base + (kCrossingError + further) * crossings;
}

double Frame::guard_for(double error_bound) const {
    const double of_radii = radii_vary ? kRadiiError : 0;
    const double least = radii_vary ? 0x1p-15 : 0x1p-13;
    return std::max(least, up_to_power_of_two(error_bound - of_radii)) + of_radii;
}

Tolerances Frame::tolerances(double error_bound) const {
    const double guard = guard_for(error_bound);
    const double reach = std::max(16.0, up_to_power_of_two(2 + longest_edge));
    return {static_cast<float>(1 + guard),
            static_cast<float>(error_bound),
            static_cast<float>(kCrossingError * reach),
            guard,
            error_bound,
            static_cast<float>(error_of(0)),
            static_cast<float>(kCrossingError)};
}

Frame frame_of(const PreparedMesh& mesh, double min_distance) {
    const double longest = longest_edge_of(mesh);
    return frame_without_pool(mesh, min_distance, unit_of(mesh, min_distance, longest), longest);
}

Frame frame_of(const PreparedMesh& mesh, const SampleParams& params) {
    const double distance = params.min_distance;
    const double longest = longest_edge_of(mesh);
    const bool vary = params.radii != nullptr;
    // The smaller distances may matter, however large the largest one is.
    const bool is_largest = vary || !params.class_factors.empty();
    const double unit = is_largest ? distance : unit_of(mesh, distance, longest);
    Frame frame = frame_without_pool(mesh, distance, unit, longest);
    frame.radii_vary = vary;
    double samples = frame.stages.samples;
    if (vary) {
        samples = samples_on(params.radii->effective_area(), unit);
    }
    const double full = samples * (unit / distance) * (unit / distance);
    if (!params.face_mask.empty()) {
        samples = samples_on(area_for_samples(mesh, params), unit);
    }
    frame.candidates_of_classes = ref::candidates_of_classes(params);
    samples *= frame.candidates_of_classes;
    frame.stages = StageRule::of(samples, params.pool_ratio, params.darts);
    frame.nearest_first = 2.0 * mesh.face_count() / std::max(2.0, full) >= kFacesOfLargeDisk;
    return frame;
}

double candidates_of_classes(const SampleParams& params) {
    double sum = params.class_factors.empty() ? 1 : 0;
    for (std::size_t at = 0, count = 0; at < params.class_factors.size(); at += count + 1) {
        count = count != 0 ? count
                           : static_cast<std::size_t>(
                                 std::lround(std::sqrt(double(params.class_factors.size()))));
        const double own = params.class_factors[at];
        sum += 1 / (own * own);
    }
    return sum;
}

double area_of(const PreparedMesh& mesh, std::uint32_t face) {
    double sides[3];
    for (std::uint32_t k = 0; k < 3; ++k) {
        sides[k] = mesh.half_edges()[std::size_t{3} * face + k].length;
    }
    std::sort(sides, sides + 3);
    const auto [c, b, a] = sides; // a >= b >= c
    // Heron's formula as Kahan orders it, so that needles lose nothing.
    const double product = (a + (b + c)) * (c - (a - b)) * (c + (a - b)) * (a + (b - c));
    return product > 0 ? std::sqrt(product) / 4 : 0;
}

} // namespace geodisk::ref
