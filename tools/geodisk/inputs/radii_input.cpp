#include "geodisk/inputs/radii_input.hpp"

#include <algorithm>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "files/grey_image.hpp"
#include "files/sidecar_files.hpp"
#include "geometry/mean_curvature.hpp"
#include "geometry/weld_mesh.hpp"
#include "program/failure.hpp"
#include "program/human_text.hpp"

namespace geodisk::tools {
namespace {

/// Factors, and where they come from for messages.
struct Factors {
    std::string source;
    std::vector<double> values;
};

/// The mean over the texture coordinates of each vertex: where a seam runs through it, both sides
/// have a say. Vertices without any are unused.
std::vector<double> map_factors(const GreyImage& image, const MeshFile& file,
                                std::size_t vertex_count) {
    std::vector<double> sums(vertex_count, 0.0);
    std::vector<std::uint32_t> counts(vertex_count, 0);
    for (const auto& [vertex, u, v] : file.uvs) {
        sums[vertex] += image.at(u, v);
        ++counts[vertex];
    }
    for (std::size_t v = 0; v < vertex_count; ++v) {
        sums[v] = counts[v] > 0 ? sums[v] / counts[v] : 1;
    }
    return sums;
}

Factors factors_of(const DensityOptions& options, const std::string& path, const MeshFile& file,
                   std::size_t vertex_count) {
    if (!options.attribute.empty()) {
        return {path + ": " + in_quotes(options.attribute), file.attributes.back()};
    }
    if (!options.file.empty()) {
        return {options.file, read_values(options.file)};
    }
    if (!options.map.empty()) {
        return {options.map, map_factors(GreyImage(options.map), file, vertex_count)};
    }
    if (file.positions.empty()) {
        fail_usage("--density-curvature needs a mesh with coordinates");
    }
    return {path, curvature_factors(file)};
}

/// Positive values below the least factor count as that: disks only become larger, but not
/// silently. Returns a warning, or nothing.
std::optional<MeshWarning> raise_small(Factors& factors, const PreparedMesh& mesh) {
    Found raised;
    for (std::size_t v = 0; v < factors.values.size(); ++v) {
        double& value = factors.values[v];
        if (value > 0 && value < RadiusField::kLeastFactor) {
            value = RadiusField::kLeastFactor;
            if (mesh.fans()[v].corner_count > 0) {
                raised.add(v);
            }
        }
    }
    if (raised.count == 0) {
        return std::nullopt;
    }
    const std::string first = "vertex " + std::to_string(raised.first) + " (from 0)";
    return MeshWarning{"small_radii", raised.count, first,
                       "g is below 0.001 at " + counted(raised.count, "vertex", "vertices") +
                           ", first at " + first + ", and counts as 0.001 there",
                       factors.source};
}

} // namespace

LoadedRadii load_radii(const DensityOptions& options, const std::string& path, const MeshFile& file,
                       const PreparedMesh& mesh) {
    const std::size_t vertex_count =
        file.positions.empty() ? mesh.vertex_count() : file.positions.size() / file.dimension;
    Factors factors = factors_of(options, path, file, vertex_count);
    if (factors.values.size() != vertex_count) {
        fail_input(factors.source, "has " + counted(factors.values.size(), "value", "values") +
                                       " for the " + counted(vertex_count, "vertex", "vertices") +
                                       " of the mesh");
    }
    if (!options.attribute.empty() || !options.file.empty()) { // What each vertex of the file has.
        factors.values = values_of_joined(file, factors.values);
    }
    // With edge lengths, unused vertices at the end are none.
    factors.values.resize(mesh.vertex_count());
    const std::optional<double> floor = options.least_factor();
    const bool all_zero = std::all_of(factors.values.begin(), factors.values.end(),
                                      [](double value) { return value == 0; });
    for (double& value : factors.values) {
        value = floor && value >= 0 && !all_zero ? std::max(value, *floor) : value;
    }
    std::optional<MeshWarning> warning = raise_small(factors, mesh);
    auto field = RadiusField::prepare(mesh, factors.values);
    if (!field && field.error().status == Status::invalid_argument) {
        const std::uint64_t v = field.error().element;
        const bool is_zero = v < factors.values.size() && factors.values[v] == 0;
        fail_input(factors.source,
                   field.error().message + (is_zero ? ", or be raised by --density-floor" : ""));
    }
    return {take(std::move(field)), std::move(warning)};
}

} // namespace geodisk::tools
