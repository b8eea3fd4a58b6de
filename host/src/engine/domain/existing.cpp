#include "engine/domain/existing.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <string>

#include "constants.h"
#include "engine/domain/tolerances.hpp"
#include "support/invalid.hpp"
#include "support/number_text.hpp"

namespace geodisk {
namespace {

// Smallest radius of a point to avoid, in units of the job: far below the guard.
constexpr double kMinRadius = 0x1p-20;
// Error of weights that other programs rounded.
constexpr double kWeightTolerance = 1e-5;

/// Returns a weight with two bits above it, see gpu::kKeptClassShift.
float with_bits(float weight, std::uint32_t bits) {
    return std::bit_cast<float>(std::bit_cast<std::uint32_t>(weight) | bits
                                                                           << gpu::kKeptClassShift);
}

double sum_of(const float (&weights)[3]) {
    return double{weights[0]} + double{weights[1]} + double{weights[2]};
}

} // namespace

std::string fault_of(const Sample& point, const PreparedMesh& mesh) {
    if (point.face >= mesh.face_count()) {
        return "is in face " + std::to_string(point.face) + ", but there are " +
               std::to_string(mesh.face_count());
    }
    const auto edges = mesh.half_edges().subspan(std::size_t{3} * point.face, 3);
    if (edges[0].origin == edges[1].origin || edges[1].origin == edges[2].origin ||
        edges[2].origin == edges[0].origin) {
        return "is in face " + std::to_string(point.face) +
               ", which repeats a vertex and holds no samples";
    }
    const double least = std::min({point.weights[0], point.weights[1], point.weights[2]});
    const bool are_weights =
        least >= -kWeightTolerance && std::abs(sum_of(point.weights) - 1) <= kWeightTolerance;
    return are_weights ? "" : "has weights that are negative or do not sum to 1";
}

std::array<float, 2> rounded_weights(const float (&weights)[3]) {
    const double sum = sum_of(weights);
    const auto steps_of = [sum](double weight, double most) {
        return std::clamp(std::round(weight / sum * 0x1p24), 0.0, most);
    };
    const double second = steps_of(weights[1], 0x1p24);
    const double third = steps_of(weights[2], 0x1p24 - second);
    return {static_cast<float>(second * 0x1p-24), static_cast<float>(third * 0x1p-24)};
}

Result<Done> check_stop_count(const SampleParams& params) {
    if (params.stop_count != 0 && params.existing.size() > params.stop_count) {
        return invalid("there are " + std::to_string(params.existing.size()) +
                       " existing samples, more than the stop count of " +
                       std::to_string(params.stop_count));
    }
    return Done{};
}

Result<Done> check_existing(const PreparedMesh& mesh, const SampleParams& params) {
    for (std::size_t i = 0; i < params.existing.size(); ++i) {
        if (const std::string fault = fault_of(params.existing[i], mesh); !fault.empty()) {
            return invalid("existing sample " + std::to_string(i) + " " + fault);
        }
    }
    for (std::size_t i = 0; i < params.avoid.size(); ++i) {
        const KeepOut& avoided = params.avoid[i];
        const std::string name = "point to avoid " + std::to_string(i);
        if (const std::string fault = fault_of(avoided.center, mesh); !fault.empty()) {
            return invalid(std::string(name).append(" ").append(fault));
        }
        if (!(avoided.radius > 0) || !std::isfinite(avoided.radius)) {
            return invalid(name + " has the radius " + number_text(avoided.radius) +
                           ", which is not positive and finite");
        }
    }
    return check_stop_count(params);
}

void add_existing(const SampleParams& params, std::uint32_t first_face,
                  std::vector<gpu::SampleRec>& settled) {
    for (std::size_t i = 0; i < params.existing.size(); ++i) {
        const Sample& sample = params.existing[i];
        const auto [second, third] = rounded_weights(sample.weights);
        const std::uint32_t order =
            params.existing_classes.empty() ? 0 : params.existing_classes[i];
        settled.push_back({order, first_face + sample.face, second, third});
    }
}

void add_avoided(const PlacedSurface& surface, std::vector<gpu::SampleRec>& settled) {
    const auto& classes = surface.params.avoid_classes;
    for (std::size_t i = 0; i < surface.params.avoid.size(); ++i) {
        const auto& [center, radius] = surface.params.avoid[i];
        const double length = working_distance(*surface.mesh, radius / surface.scale);
        const auto ratio = static_cast<float>(std::max(length / surface.frame.unit, kMinRadius));
        const auto [second, third] = rounded_weights(center.weights);
        const std::uint32_t kept =
            classes.empty() || classes[i] == kAllClasses ? 0 : classes[i] + 1u;
        settled.push_back({std::bit_cast<std::uint32_t>(ratio),
                           (surface.first_face + center.face) | gpu::kKeepsOut,
                           with_bits(second, kept >> 2), with_bits(third, kept & 3)});
    }
}

} // namespace geodisk
