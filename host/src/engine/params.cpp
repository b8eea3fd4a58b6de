#include "geodisk/params.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "mesh/extent.hpp"
#include "support/number_text.hpp"

namespace geodisk {
namespace {

const double kTwoRootThree = 2 * std::sqrt(3.0);
constexpr double kMinimumPool = 64;
// Of candidates to the samples expected of a surface much smaller than a disk.
constexpr double kLargestRatio = 1e12;
constexpr double kMostDartsOfStage = 0x1p23;
constexpr double kMostDartsPerSample = 640;
// From it on all stages of darts are alike.
constexpr std::uint32_t kMostDartStages = 32;
// Edges longer than this many distances would need a guard of a percent.
constexpr double kLongestEdge = 4000;
constexpr std::uint32_t kMinimumChain = 64;
// Of the guard and of the slack, in units of 2^-22.
constexpr double kLeastRoundings = 512;
constexpr double kLeastSlack = 16;
constexpr std::uint32_t kMaximumChain = 1u << 16;

/// One disk covers about 2 F / N faces.
double faces_per_disk(const PreparedMesh& mesh, double min_distance) {
    return 2.0 * mesh.face_count() /
           std::max(1.0, expected_count(mesh.statistics().area, min_distance));
}

/// No face may expect more candidates than the kernels can count.
Result<Done> check_largest_face(const PreparedMesh& mesh, const SampleParams& params) {
    const Stages stages = stages_of(mesh, params);
    const double most = std::max(stages.expected(0), stages.expected(kMostDartStages)) /
                        effective_area(mesh, params);
    const double longest = mesh.statistics().longest_edge;
    const double densest = params.radii != nullptr ? params.radii->largest_density() : 1;
    if (longest * longest * densest * most < kMostPerFace) {
        return Done{};
    }
    for (std::uint32_t face = 0; face < mesh.face_count(); ++face) {
        const HalfEdge& edge = mesh.half_edges()[std::size_t{3} * face];
        const double density = params.radii != nullptr ? params.radii->densities()[face] : 1;
        const double expected = most * 0.5 * edge.length * edge.apex_y * density;
        if (!(expected <= kMostPerFace)) {
            return Error{Status::invalid_argument,
                         "the minimum distance is too small for this mesh: face " +
                             std::to_string(face) + " alone expects " + number_text(expected) +
                             " candidates at once, the most is " + number_text(kMostPerFace) +
                             "; split it",
                         face};
        }
    }
    return Done{};
}

double power_of_two_from(double x, double least) {
    double power = least;
    while (power < x) {
        power *= 2;
    }
    return power;
}

// What decides is in steps of two, and the same for most meshes, so that an edit somewhere changes
// nothing elsewhere.
Tolerances make_tolerances(double longest, std::uint32_t chain, double further) {
    Tolerances t{};
    t.chain = chain;
    const double roundings = chain + 4 * std::ceil(longest);
    t.guard = 0x1p-22 * power_of_two_from(roundings, kLeastRoundings) + further;
    t.limit = static_cast<float>(1 + t.guard);
    t.margin = static_cast<float>(0x1p-22 * roundings + further);
    t.slack = static_cast<float>(0x1p-22 * power_of_two_from(2 + longest, kLeastSlack));
    return t;
}

} // namespace

double working_distance(const PreparedMesh& mesh, double min_distance) noexcept {
    if (!(min_distance > mesh.statistics().diagonal)) {
        return min_distance;
    }
    // A little more than the bound, so that what is within it conflicts beyond doubt.
    return std::min(min_distance, 1.01 * distance_bound(mesh));
}

double working_distance(const PreparedMesh& mesh, const SampleParams& params) noexcept {
    return params.radii != nullptr ? params.min_distance
                                   : working_distance(mesh, params.min_distance);
}

double effective_area(const PreparedMesh& mesh, const SampleParams& params) noexcept {
    return params.radii != nullptr ? params.radii->effective_area() : mesh.statistics().area;
}

double expected_count(double area, double min_distance) noexcept {
    const double radius = min_distance / 2;
    return kExpectedRho * kExpectedRho * area / (kTwoRootThree * radius * radius);
}

double distance_for_count(double area, double count) noexcept {
    return 2 * kExpectedRho * std::sqrt(area / (kTwoRootThree * count));
}

double packing_density(double area, double min_distance, double count) noexcept {
    return min_distance / 2 * std::sqrt(kTwoRootThree * count / area);
}

Result<std::uint32_t> pool_size(const PreparedMesh& mesh, const SampleParams& params) noexcept {
    const auto invalid = [](std::string message) {
        return Error{Status::invalid_argument, std::move(message)};
    };
    if (!(params.min_distance > 0) || !std::isfinite(params.min_distance)) {
        return invalid("the minimum distance must be a positive finite number");
    }
    if (!(params.pool_ratio >= 1 && params.pool_ratio <= 10000)) {
        return invalid("the pool ratio must be 1 to 10,000");
    }
    if (params.radii != nullptr && params.radii->face_count() != mesh.face_count()) {
        return invalid("the radii are of a mesh with " +
                       std::to_string(params.radii->face_count()) + " faces, this one has " +
                       std::to_string(mesh.face_count()));
    }
    if (!params.face_keys.empty() && params.face_keys.size() != mesh.face_count()) {
        return invalid("there are " + std::to_string(params.face_keys.size()) + " face keys for " +
                       std::to_string(mesh.face_count()) + " faces");
    }
    const Stages stages = stages_of(mesh, params);
    if (!(stages.ratio <= kLargestRatio)) {
        return invalid("the minimum distance is too large for this surface, where radii vary");
    }
    const double wanted = std::ceil(stages.candidates());
    if (!(wanted <= kMostCandidates)) {
        return invalid("the minimum distance is too small for this surface: the pool would take " +
                       number_text(wanted) + " candidates, the most is " +
                       number_text(kMostCandidates));
    }
    const double longest = mesh.statistics().longest_edge / params.min_distance;
    if (!(longest <= kLongestEdge)) {
        return invalid("the minimum distance is too small for this mesh: its longest edge is " +
                       number_text(longest) +
                       " times as long, and single precision resolves at most " +
                       number_text(kLongestEdge) + " times; split long edges");
    }
    if (auto checked = check_largest_face(mesh, params); !checked) {
        return checked.error();
    }
    return static_cast<std::uint32_t>(wanted);
}

std::uint32_t Stages::pool_stages() const noexcept {
    return static_cast<std::uint32_t>(
        std::clamp(std::ceil(ratio / kStageRatio), 1.0, double{kMostPoolStages}));
}

double Stages::per_sample(std::uint32_t stage) const noexcept {
    if (throws == 0) {
        return ratio / pool_stages();
    }
    double darts = kStageRatio;
    const double most = std::min(kMostDartsPerSample, kMostDartsOfStage / samples);
    for (std::uint32_t s = 0; s < stage && 2 * darts <= most; ++s) {
        darts *= 2;
    }
    return std::max(darts, kMinimumPool / samples);
}

Stages stages_of(const PreparedMesh& mesh, const SampleParams& params) noexcept {
    // A distance beyond all those of the mesh is as good as one just beyond.
    const double samples =
        expected_count(effective_area(mesh, params), working_distance(mesh, params));
    return {samples, std::max(params.pool_ratio, kMinimumPool / samples), params.throws};
}

double samples_per_area() noexcept {
    return expected_count(1, 1);
}

// Of the distance alone, so that no edit elsewhere changes it.
float stage_intensity(const PreparedMesh& mesh, const SampleParams& params,
                      std::uint32_t stage) noexcept {
    return static_cast<float>(stages_of(mesh, params).per_sample(stage) * samples_per_area());
}

std::uint32_t provided_chain(const PreparedMesh& mesh, double min_distance) noexcept {
    // A straight path crosses about the square root of the faces.
    const double guess = 8 + 4 * std::sqrt(faces_per_disk(mesh, min_distance));
    return static_cast<std::uint32_t>(std::clamp<double>(guess, kMinimumChain, kMaximumChain));
}

Tolerances tolerances_for(const PreparedMesh& mesh, double min_distance,
                          std::uint32_t chain) noexcept {
    const double longest = mesh.statistics().longest_edge / working_distance(mesh, min_distance);
    return make_tolerances(longest, chain, 0);
}

Tolerances tolerances_for(const PreparedMesh& mesh, const SampleParams& params,
                          std::uint32_t chain) noexcept {
    // The factors are floats, and radii are summed in float: each errs by 2^-23 at most.
    constexpr double kRadii = 0x1p-21;
    const double longest = mesh.statistics().longest_edge / working_distance(mesh, params);
    return make_tolerances(longest, chain, params.radii != nullptr ? kRadii : 0);
}

} // namespace geodisk
