#include "geometry/lift.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string_view>

#include "files/meshes/sidecar_files.hpp"
#include "geometry/vec.hpp"
#include "geometry/vertex_normals.hpp"
#include "geometry/vertex_numbers.hpp"
#include "program/exact_text.hpp"
#include "program/failure.hpp"
#include "program/human_text.hpp"

namespace geodisk::tools {
namespace {

/// One column to append: `count` numbers per vertex.
struct Columns {
    std::vector<double> values;
    std::uint32_t count;
};

std::vector<bool> used_vertices(const MeshFile& mesh) {
    std::vector<bool> used(mesh.positions.size() / mesh.dimension, false);
    for (std::size_t corner = 0; corner < mesh.triangles.size(); ++corner) {
        if (mesh.takes_part(corner / 3)) {
            used[mesh.triangles[corner]] = true;
        }
    }
    return used;
}

Columns normal_columns(const std::string& path, const MeshFile& mesh, double weight) {
    if (mesh.dimension != 3) {
        fail_usage("--lift normals needs a mesh with 3 coordinates; " + path + " has " +
                   std::to_string(mesh.dimension));
    }
    const std::vector<Vec3> sums = normal_sums(mesh);
    const std::vector<bool> used = used_vertices(mesh);
    constexpr double kCancelled = 1e-9; // Rounding of a sum of angles that should be zero.
    Columns columns{{}, 3};
    for (std::size_t v = 0; v < sums.size(); ++v) {
        const bool has_normal = length(sums[v]) > kCancelled;
        if (used[v] && !has_normal) {
            fail_input(path, "vertex " + std::to_string(v) +
                                 " (from 0) has no normal: its faces have no area, or are "
                                 "turned over against each other");
        }
        const Vec3 added = weight * (has_normal ? normalize(sums[v]) : Vec3{});
        columns.values.insert(columns.values.end(), {added.x, added.y, added.z});
    }
    return columns;
}

Columns attribute_columns(const std::string& path, const MeshFile& mesh, const Lift& lift,
                          std::vector<double> values) {
    const std::vector<bool> used = used_vertices(mesh);
    if (values.size() != used.size()) {
        fail_input(path, "has " + std::to_string(values.size()) + " values of " +
                             in_quotes(lift.attribute) + " for " + std::to_string(used.size()) +
                             " vertices");
    }
    for (std::size_t v = 0; v < values.size(); ++v) {
        if (used[v] && !std::isfinite(values[v])) {
            fail_input(path, "element vertex, record " + std::to_string(v) + ": " +
                                 in_quotes(lift.attribute) + " is not finite");
        }
        values[v] *= lift.weight;
    }
    return {std::move(values), 1};
}

} // namespace

Lift parse_lift(const std::string& option, const std::string& text) {
    constexpr std::string_view kAttribute = "attribute:";
    const std::size_t colon = text.rfind(':');
    const std::string_view kind = std::string_view(text).substr(0, std::min(colon, text.size()));
    Lift lift;
    if (kind.starts_with(kAttribute)) {
        lift.attribute = kind.substr(kAttribute.size());
    }
    if (colon == std::string::npos || (kind != "normals" && lift.attribute.empty())) {
        fail_usage(option + ": " + in_quotes(text) +
                   " is not a lift; write normals:W or attribute:NAME:W");
    }
    const std::string_view weight = std::string_view(text).substr(colon + 1);
    const std::optional<double> value = parse_real(weight);
    if (!value || !std::isfinite(*value)) {
        fail_usage(option + ": " + in_quotes(weight) + " is not a finite weight, as in " +
                   std::string(kind) + ":0.1");
    }
    lift.weight = *value;
    return lift;
}

std::vector<std::string> lift_attributes(std::span<const Lift> lifts) {
    std::vector<std::string> names;
    for (const Lift& lift : lifts) {
        if (!lift.attribute.empty()) {
            names.push_back(lift.attribute);
        }
    }
    return names;
}

LiftedPositions lifted_positions(const std::string& path, const MeshFile& mesh,
                                 std::span<const Lift> lifts) {
    std::vector<Columns> parts{{mesh.positions, mesh.dimension}};
    LiftedPositions result;
    result.dimension = mesh.dimension;
    for (const Lift& lift : lifts) {
        result.dimension += lift.attribute.empty() ? 3u : 1u;
    }
    if (result.dimension > kMaxCoordinates) {
        fail_usage("--lift makes " + std::to_string(result.dimension) + " coordinates of " +
                   std::to_string(mesh.dimension) + "; at most 8 are possible");
    }
    for (const Lift& lift : lifts) {
        parts.push_back(lift.attribute.empty()
                            ? normal_columns(path, mesh, lift.weight)
                            : attribute_columns(path, mesh, lift,
                                                vertex_numbers(mesh, mesh.number(lift.attribute))));
    }
    const std::size_t vertices = mesh.positions.size() / mesh.dimension;
    result.positions.reserve(vertices * result.dimension);
    for (std::size_t v = 0; v < vertices; ++v) {
        for (const Columns& part : parts) {
            const auto first = part.values.begin() + static_cast<std::ptrdiff_t>(v * part.count);
            result.positions.insert(result.positions.end(), first, first + part.count);
        }
    }
    return result;
}

} // namespace geodisk::tools
