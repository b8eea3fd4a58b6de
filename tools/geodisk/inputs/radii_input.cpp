#include "geodisk/inputs/radii_input.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "files/images/image.hpp"
#include "files/meshes/sidecar_files.hpp"
#include "files/meshes/value_files.hpp"
#include "geometry/mean_curvature.hpp"
#include "geometry/vertex_numbers.hpp"
#include "geometry/weld_mesh.hpp"
#include "program/exact_text.hpp"
#include "program/failure.hpp"
#include "program/human_text.hpp"

namespace geodisk::tools {
namespace {

/// Values at the vertices, and where they come from for messages.
struct Values {
    std::string source;
    std::vector<double> values;
};

/// Returns the values of all but images, one for each vertex of the file.
Values values_of(const DensitySource& of, const std::string& path, const MeshFile& file,
                 std::size_t vertex_count) {
    switch (of.kind) {
    case DensitySource::Kind::attribute:
        return {path + ": " + in_quotes(of.name), vertex_numbers(file, file.number(of.name))};
    case DensitySource::Kind::file: {
        VertexValues read = read_values(of.name, vertex_count);
        if (!read.names.empty()) {
            fail_usage(of.option + ": the values of " + in_quotes(of.text()) +
                       " are labels, whose numbers are no amounts");
        }
        return {of.name, std::move(read.values)};
    }
    case DensitySource::Kind::map:
    case DensitySource::Kind::curvature:
        break;
    }
    if (file.positions.empty()) {
        fail_usage("curvature needs a mesh with coordinates");
    }
    return {path, curvature_factors(file)};
}

/// Positive values below the least factor count as that: disks only become larger, but not
/// silently. Returns a warning, or nothing.
std::optional<MeshWarning> raise_small(Values& factors, const PreparedMesh& mesh) {
    Found raised;
    for (std::size_t v = 0; v < factors.values.size(); ++v) {
        double& value = factors.values[v];
        if (value > 0 && value < RadiusField::kMinFactor) {
            value = RadiusField::kMinFactor;
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

/// Returns what to give instead, if values are no factors of a radius. Many a mask or density is
/// tried as one.
std::string density_hint(const DensitySource& of) {
    return "; for a density, where 0 means no samples, give --density " + of.text();
}

/// Warns of a density that is the same at all vertices of faces.
std::optional<MeshWarning> warning_of_constant(const Values& density, const PreparedMesh& mesh) {
    double least = HUGE_VAL, most = -HUGE_VAL;
    for (std::size_t v = 0; v < density.values.size(); ++v) {
        if (mesh.fans()[v].corner_count > 0) {
            least = std::min(least, density.values[v]);
            most = std::max(most, density.values[v]);
        }
    }
    if (least < most) {
        return std::nullopt;
    }
    return MeshWarning{"constant_density", 1, "",
                       "the density is " + rounded(most, 6) +
                           " everywhere, so it leaves out nothing",
                       density.source};
}

RadiusField field_of(const DensitySource& of, Values& values, const PreparedMesh& mesh,
                     std::optional<MeshWarning>& warning) {
    // Curvature as a density is that of its factors.
    if (of.is_density && of.kind != DensitySource::Kind::curvature) {
        auto field = RadiusField::from_density(mesh, values.values);
        if (!field && field.error().status == Status::invalid_argument) {
            fail_input(values.source, field.error().message);
        }
        warning = warning_of_constant(values, mesh);
        return take(std::move(field));
    }
    const bool all_zero = std::all_of(values.values.begin(), values.values.end(),
                                      [](double value) { return value == 0; });
    for (double& value : values.values) {
        value = of.floor && value >= 0 && !all_zero ? std::max(value, *of.floor) : value;
    }
    warning = raise_small(values, mesh);
    auto field = RadiusField::prepare(mesh, values.values);
    if (!field && field.error().status == Status::invalid_argument) {
        fail_input(values.source, field.error().message + density_hint(of));
    }
    return take(std::move(field));
}

} // namespace

std::vector<double> map_values(const GreyImage& image, const MeshFile& file,
                               const SplitFaces* split, std::size_t vertex_count) {
    const std::vector<VertexUv> of_file =
        split == nullptr ? vertex_uvs(file) : std::vector<VertexUv>();
    const std::span<const VertexUv> uvs = split == nullptr ? of_file : split->uvs();
    std::vector<double> sums(vertex_count, 0.0);
    std::vector<std::uint32_t> counts(vertex_count, 0);
    for (const auto& [vertex, u, v] : uvs) {
        sums[vertex] += image.at(u, v);
        ++counts[vertex];
    }
    for (std::size_t v = 0; v < vertex_count; ++v) {
        sums[v] = counts[v] > 0 ? sums[v] / counts[v] : 1;
    }
    return sums;
}

namespace {

/// Returns the values at the vertices of `mesh`.
Values loaded_values(const DensitySource& of, const std::string& path, const MeshFile& file,
                     const PreparedMesh& mesh, const SplitFaces* split) {
    using Kind = DensitySource::Kind;
    const std::size_t vertex_count =
        file.positions.empty() ? mesh.vertex_count() : file.positions.size() / file.dimension;
    Values values;
    if (of.kind == Kind::map) {
        values = {of.name, map_values(GreyImage(of.name), file, split,
                                      split ? mesh.vertex_count() : vertex_count)};
    } else {
        values = values_of(of, path, file, file.file_vertices(vertex_count));
        // Of a file there is what each of its vertices has.
        const std::size_t wanted =
            of.kind == Kind::file ? file.file_vertices(vertex_count) : vertex_count;
        if (values.values.size() != wanted) {
            fail_input(values.source, "has " + counted(values.values.size(), "value", "values") +
                                          " for the " + counted(wanted, "vertex", "vertices") +
                                          " of the mesh");
        }
        if (of.kind == Kind::file) {
            values.values = values_at_vertices(file, std::move(values.values));
        }
        values.values = split ? split->parts().extended(values.values) : values.values;
    }
    // With edge lengths, unused vertices at the end are none.
    values.values.resize(mesh.vertex_count());
    return values;
}

} // namespace

LoadedRadii load_radii(const DensitySource& of, const std::string& path, const MeshFile& file,
                       const PreparedMesh& mesh, const SplitFaces* split) {
    Values values = loaded_values(of, path, file, mesh, split);
    std::optional<MeshWarning> warning;
    RadiusField field = field_of(of, values, mesh, warning);
    return {std::move(field), std::move(warning)};
}

std::vector<double> density_parts(const DensitySource& of, const std::string& path,
                                  const MeshFile& file, const PreparedMesh& mesh,
                                  const SplitFaces* split) {
    Values values = loaded_values(of, path, file, mesh, split);
    double largest = 0;
    for (std::size_t v = 0; v < values.values.size(); ++v) {
        double& value = values.values[v];
        if (mesh.fans()[v].corner_count == 0) {
            value = 0;
        } else if (of.kind == DensitySource::Kind::curvature) { // A factor of radii.
            const double factor = std::max(value, kCurvatureFloor);
            value = 1 / (factor * factor);
        } else if (!(value >= 0) || !std::isfinite(value)) {
            fail_input(values.source, "the density of vertex " + std::to_string(v) + " is " +
                                          exact_text(value) + ", not a finite number from 0 on");
        }
        largest = std::max(largest, value);
    }
    if (largest == 0) {
        fail_input(values.source, "the density is 0 everywhere");
    }
    for (double& value : values.values) {
        value /= largest;
    }
    return std::move(values.values);
}

} // namespace geodisk::tools
