#include "geodisk/params.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "engine/domain/classes.hpp"
#include "engine/domain/existing.hpp"
#include "engine/domain/face_mask.hpp"
#include "engine/domain/stages.hpp"
#include "engine/request/check_fields.hpp"
#include "support/guard.hpp"
#include "support/invalid.hpp"
#include "support/number_text.hpp"
#include "support/try.hpp"

namespace geodisk {
namespace {

const double kTwoRootThree = 2 * std::sqrt(3.0);
// Mean packing density, for which counts of 300 to 10,000 samples on scanned and modelled meshes
// come out as requested. Stages use kExpectedRho, so that a distance keeps its samples.
constexpr double kCountedRho = 0.721;

/// Checks that no face expects more candidates than the kernels can count.
Result<Done> check_largest_face(const PreparedMesh& mesh, const SampleParams& params,
                                const Stages& stages) {
    const double most = std::max(stages.expected(0), stages.expected(kLastOtherStage)) /
                        effective_area(mesh, params);
    const double longest = mesh.statistics().longest_edge;
    const double densest =
        params.radii != nullptr ? params.radii->largest_density() : class_density(params);
    if (longest * longest * densest * most < kMaxPerFace) {
        return Done{};
    }
    for (std::uint32_t face = 0; face < mesh.face_count(); ++face) {
        const double expected = expected_in_face(mesh, params, face, most);
        if (!(expected <= kMaxPerFace)) {
            return Error{Status::invalid_argument,
                         "the minimum distance is too small for this mesh: face " +
                             std::to_string(face) + " alone expects " + number_text(expected) +
                             " candidates at once, the maximum is " + number_text(kMaxPerFace) +
                             "; split it",
                         face};
        }
    }
    return Done{};
}

/// Returns true if no other face at the edge takes samples.
bool is_at_border(const PreparedMesh& mesh, const SampleParams& params, std::uint32_t h) {
    const auto edges = mesh.half_edges();
    std::uint32_t other = around_half_edge(edges[h].around);
    while (other != h && !takes_samples(params, other / 3)) {
        other = around_half_edge(edges[other].around);
    }
    return other == h;
}

/// Returns the length of all borders of what takes samples; if radii vary, in multiples of the
/// largest one.
double border_length(const PreparedMesh& mesh, const SampleParams& params) {
    double length = 0;
    const auto edges = mesh.half_edges();
    for (std::uint32_t h = 0; h < edges.size(); ++h) {
        const std::uint32_t a = edges[h].origin, b = edges[next_in_face(h)].origin,
                            c = edges[previous_in_face(h)].origin;
        const bool takes_part = a != b && b != c && c != a;
        if (!takes_part || !takes_samples(params, h / 3) || !is_at_border(mesh, params, h)) {
            continue;
        }
        length += border_part(edges[h].length, params.radii, h);
    }
    return length;
}

} // namespace

double effective_area(const PreparedMesh& mesh, const SampleParams& params) noexcept {
    const double classes = class_density(params);
    if (params.face_mask.empty()) {
        return whole_area(mesh, params) * classes;
    }
    double area = 0;
    bool takes_all = true;
    for (std::uint32_t face = 0; face < mesh.face_count(); ++face) {
        if (!takes_samples(params, face)) {
            takes_all = false;
            continue;
        }
        const HalfEdge& edge = mesh.half_edges()[std::size_t{3} * face];
        const double density = params.radii != nullptr ? params.radii->samples_in(face) : 1;
        area += 0.5 * edge.length * edge.apex_y * density;
    }
    return (takes_all ? whole_area(mesh, params) : area) * classes;
}

double expected_count(double area, double min_distance) noexcept {
    const double radius = min_distance / 2;
    return kExpectedRho * kExpectedRho * area / (kTwoRootThree * radius * radius);
}

double distance_for_count(double area, double count) noexcept {
    return 2 * kExpectedRho * std::sqrt(area / (kTwoRootThree * count));
}

double border_part(double length, const RadiusField* radii, std::uint32_t h) {
    if (radii == nullptr) {
        return length;
    }
    const std::uint32_t next = next_in_face(h);
    const double factor = 0.5 * (double{radii->factors()[h]} + double{radii->factors()[next]});
    return length / factor * (0.5 * (radii->share_at(h) + radii->share_at(next)));
}

double distance_for_count(const PreparedMesh& mesh, const SampleParams& params,
                          double count) noexcept {
    return distance_for_count(effective_area(mesh, params), border_length(mesh, params), count);
}

double distance_for_count(double area, double borders, double count) noexcept {
    // count = a / D^2 + b / D.
    const double a =
        kCountedRho / kExpectedRho * (kCountedRho / kExpectedRho) * expected_count(area, 1);
    const double b = kBorderSamples * borders;
    return (b + std::sqrt(b * b + 4 * count * a)) / (2 * count);
}

double packing_density(double area, double min_distance, double count) noexcept {
    return min_distance / 2 * std::sqrt(kTwoRootThree * count / area);
}

Result<Done> check_params(const PreparedMesh& mesh, const SampleParams& params) {
    if (!(params.min_distance > 0) || !std::isfinite(params.min_distance)) {
        return invalid("the minimum distance must be a positive finite number, not " +
                       exact_text(params.min_distance));
    }
    if (!(params.pool_ratio >= 1 && params.pool_ratio <= 10000)) {
        return invalid("the pool ratio must be 1 to 10,000, not " + exact_text(params.pool_ratio));
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
    GEODISK_TRY(check_classes(params, mesh.face_count()));
    GEODISK_TRY(check_mask(mesh, params));
    GEODISK_TRY(check_fields(fields_of(params)));
    return check_existing(mesh, params);
}

Result<std::uint32_t> check_candidates(const PreparedMesh& mesh, const SampleParams& params,
                                       const Stages& stages) {
    if (!(stages.ratio <= kLargestRatio)) {
        const bool differs = params.radii != nullptr || !params.class_factors.empty();
        return invalid(!params.face_mask.empty()
                           ? "the minimum distance is too large for the faces that the face mask "
                             "leaves"
                       : differs
                           ? "the minimum distance is too large for this surface, where radii vary "
                             "or samples have classes"
                           : "the minimum distance is too large for this surface: it has hardly "
                             "any area");
    }
    const double wanted = stages.is_drawn() ? std::ceil(stages.candidates()) : 0;
    if (!(wanted <= kMaxCandidates)) {
        return invalid("the minimum distance is too small for this surface: the pool would take " +
                       number_text(wanted) + " candidates, the maximum is " +
                       number_text(kMaxCandidates));
    }
    const double longest = mesh.statistics().longest_edge / params.min_distance;
    if (!(longest <= kLongestEdge)) {
        return invalid(
            "the minimum distance is too small for this mesh: its longest edge is " +
            number_text(longest) + " times as long, and single precision resolves at most " +
            number_text(kLongestEdge) + " times; raise it, lower the count, or split long edges");
    }
    if (stages.is_drawn()) {
        GEODISK_TRY(check_largest_face(mesh, params, stages));
    }
    return static_cast<std::uint32_t>(wanted);
}

Result<std::uint32_t> pool_size(const PreparedMesh& mesh, const SampleParams& params) noexcept {
    return guarded([&]() -> Result<std::uint32_t> {
        GEODISK_TRY(check_params(mesh, params));
        return check_candidates(mesh, params, stages_of(mesh, params));
    });
}

} // namespace geodisk
