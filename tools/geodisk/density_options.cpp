#include "geodisk/density_options.hpp"

#include <algorithm>
#include <cstdint>
#include <optional>
#include <utility>

#include <CLI/CLI.hpp>

#include "common/file_input.hpp"
#include "common/grey_image.hpp"
#include "common/mean_curvature.hpp"
#include "common/sidecar_files.hpp"
#include "common/text.hpp"
#include "common/user_error.hpp"
#include "program/arguments.hpp"
#include "program/failure.hpp"
#include "program/human_text.hpp"

namespace geodisk::tools {
namespace {

/// Few vertices are curved so much that a tenth is not small enough, and those are often noise.
constexpr double kCurvatureFloor = 0.1;

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
        throw UserError(ExitCode::usage, "--density-curvature needs a mesh with coordinates");
    }
    return {path, curvature_factors(file)};
}

/// The least factor, or nothing where values stay as they are.
std::optional<double> floor_of(const DensityOptions& options) {
    if (!options.floor.empty()) {
        return parse_ratio("--density-floor", options.floor, RadiusField::kLeastFactor, 1);
    }
    return options.curvature ? std::optional(kCurvatureFloor) : std::nullopt;
}

/// Positive values below the least factor count as that: disks only become larger, but not
/// silently. Returns a warning, or nothing.
std::string raise_small(Factors& factors, const PreparedMesh& mesh) {
    std::size_t count = 0;
    std::size_t first = 0;
    for (std::size_t v = 0; v < factors.values.size(); ++v) {
        double& value = factors.values[v];
        if (value > 0 && value < RadiusField::kLeastFactor) {
            value = RadiusField::kLeastFactor;
            if (mesh.fans()[v].corner_count > 0) {
                first = count == 0 ? v : first;
                ++count;
            }
        }
    }
    return count == 0 ? ""
                      : factors.source + ": g is below 0.001 at " +
                            counted(count, "vertex", "vertices") + ", first at vertex " +
                            std::to_string(first) + " (from 0), and counts as 0.001 there";
}

} // namespace

bool DensityOptions::is_given() const {
    std::string given;
    int count = 0;
    for (const auto& [name, has] : {std::pair{"--density-attribute", !attribute.empty()},
                                    {"--density-file", !file.empty()},
                                    {"--density-map", !map.empty()},
                                    {"--density-curvature", curvature}}) {
        if (has) {
            given += given.empty() ? name : std::string(" and ") + name;
            ++count;
        }
    }
    if (count > 1) {
        throw UserError(ExitCode::usage, given + " contradict each other; give just one of them");
    }
    if (count == 0 && !floor.empty()) {
        throw UserError(ExitCode::usage,
                        "--density-floor raises the values of another --density option; give one");
    }
    floor_of(*this);
    return count > 0;
}

std::vector<std::string> DensityOptions::files() const {
    std::vector<std::string> names;
    for (const std::string& name : {file, map}) {
        if (!name.empty()) {
            names.push_back(name);
        }
    }
    return names;
}

std::vector<std::pair<std::string, std::string>> DensityOptions::additions() const {
    std::vector<std::pair<std::string, std::string>> result;
    for (const auto& [name, value] : {std::pair{"density_attribute", attribute},
                                      {"density_file", file},
                                      {"density_map", map},
                                      {"density_curvature", std::string(curvature ? "mean" : "")},
                                      {"density_floor", floor}}) {
        if (!value.empty()) {
            result.emplace_back(name, value);
        }
    }
    return result;
}

void add_density_options(CLI::App& command, DensityOptions& options) {
    const char* const density =
        "Radii that vary: the largest times g, above 0 and up to 1; give one";
    command
        .add_option("--density-attribute", options.attribute, "g is this vertex property of a PLY")
        ->type_name("NAME")
        ->group(density);
    command
        .add_option("--density-file", options.file,
                    "g is in this text file, one value per line and vertex")
        ->type_name("FILE")
        ->group(density);
    command
        .add_option("--density-map", options.map,
                    "g is the grey of this image, black 0 and white 1, at the\n"
                    "texture coordinates of the vertices")
        ->type_name("FILE")
        ->group(density);
    command
        .add_flag("--density-curvature", options.curvature,
                  "g is 1 where the mesh is flat, 1/2 where its mean curvature\n"
                  "is the average, and falls to 0.1")
        ->group(density);
    command
        .add_option("--density-floor", options.floor,
                    "Raise smaller g to this; for curvature 0.1 unless given")
        ->type_name("G")
        ->group(density);
}

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
    // With edge lengths, unused vertices at the end are none.
    factors.values.resize(mesh.vertex_count());
    const std::optional<double> floor = floor_of(options);
    const bool all_zero = std::all_of(factors.values.begin(), factors.values.end(),
                                      [](double value) { return value == 0; });
    for (double& value : factors.values) {
        value = floor && value >= 0 && !all_zero ? std::max(value, *floor) : value;
    }
    std::string warning = raise_small(factors, mesh);
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
