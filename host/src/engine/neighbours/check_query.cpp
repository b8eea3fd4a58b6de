#include "engine/neighbours/check_query.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "engine/domain/existing.hpp"
#include "support/invalid.hpp"
#include "support/number_text.hpp"

namespace geodisk {
namespace {

// A float keeps the digits of distances from this part of the unit on.
constexpr double kSmallest = 0x1p-24;
// Room for the rounding of the longest distances.
constexpr double kRoom = 1.01;

} // namespace

Result<Done> check_range(double unit, double longest) {
    using Float = std::numeric_limits<float>;
    const bool is_small = !(kSmallest * unit >= double{Float::min()});
    const bool is_large = !(kRoom * longest <= double{Float::max()});
    if (!is_small && !is_large) {
        return Done{};
    }
    return Error{Status::mesh_rejected,
                 "distances of about " + number_text(is_large ? longest : unit) + " are too " +
                     (is_large ? "large" : "small") +
                     " for the single precision of results; rescale the mesh"};
}

Result<Done> check_points(const PreparedMesh& mesh, const char* name,
                          std::span<const Sample> points) {
    for (std::size_t i = 0; i < points.size(); ++i) {
        if (const std::string fault = fault_of(points[i], mesh); !fault.empty()) {
            return invalid(std::string(name) + " " + std::to_string(i) + " " + fault);
        }
    }
    return Done{};
}

Result<Done> check_joined(const PreparedMesh& mesh, std::span<const std::uint32_t> joined) {
    if (!joined.empty() && joined.size() != mesh.vertex_count()) {
        return invalid("joined vertices are told for " + std::to_string(joined.size()) +
                       " vertices, but there are " + std::to_string(mesh.vertex_count()));
    }
    const auto wrong = std::ranges::find_if(
        joined, [&](std::uint32_t to) { return to >= joined.size() || joined[to] != to; });
    return wrong == joined.end()
               ? Result<Done>(Done{})
               : invalid("vertex " + std::to_string(wrong - joined.begin()) +
                         " is joined with one that is joined itself, or that there is not");
}

Result<Done> check_query(const PreparedMesh& mesh, const NeighbourQuery& query) {
    const auto is_length = [](double length) { return length > 0 && std::isfinite(length); };
    if (query.sources.empty()) {
        return invalid("there is no source");
    }
    if (query.has_distances() && query.radii.empty() && !is_length(query.within)) {
        return invalid("the distance within which neighbours are is " + number_text(query.within) +
                       ", which is not positive and finite");
    }
    if (!query.radii.empty() && query.radii.size() != query.sources.size()) {
        return invalid("there are " + std::to_string(query.radii.size()) + " radii for " +
                       std::to_string(query.sources.size()) + " sources");
    }
    for (std::size_t i = 0; i < query.radii.size(); ++i) {
        if (!is_length(query.radii[i])) {
            return invalid("the radius of source " + std::to_string(i) + " is " +
                           number_text(query.radii[i]) + ", which is not positive and finite");
        }
    }
    if (query.kind == NeighbourKind::points && query.points.empty()) {
        return invalid("there is no point among which neighbours are");
    }
    auto checked = check_joined(mesh, query.joined);
    checked = checked ? check_points(mesh, "source", query.sources) : checked;
    return checked && query.kind == NeighbourKind::points
               ? check_points(mesh, "point", query.points)
               : checked;
}

} // namespace geodisk
