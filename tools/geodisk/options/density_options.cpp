#include "geodisk/options/density_options.hpp"

#include <utility>

#include <geodisk/radius_field.hpp>

#include "program/arguments.hpp"
#include "program/command.hpp"
#include "program/failure.hpp"

namespace geodisk::tools {
namespace {

/// Few vertices are curved so much that a tenth is not small enough, and those are often noise.
constexpr double kCurvatureFloor = 0.1;

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
        fail_usage(given + " contradict each other; give just one of them");
    }
    if (count == 0 && !floor.empty()) {
        fail_usage("--density-floor raises the values of another --density option; give one");
    }
    least_factor();
    return count > 0;
}

std::optional<double> DensityOptions::least_factor() const {
    if (!floor.empty()) {
        return parse_ratio("--density-floor", floor, RadiusField::kLeastFactor, 1);
    }
    return curvature ? std::optional(kCurvatureFloor) : std::nullopt;
}

void DensityOptions::add_files(std::vector<NamedFile>& read, const std::string& what) const {
    for (const std::string& path : {file, map}) {
        if (!path.empty()) {
            read.push_back({what, path});
        }
    }
}

HeaderEntries DensityOptions::added_to(HeaderEntries entries) const {
    for (const auto& [name, value] : {std::pair{"density_attribute", attribute},
                                      {"density_file", file},
                                      {"density_map", map},
                                      {"density_curvature", std::string(curvature ? "mean" : "")},
                                      {"density_floor", floor}}) {
        if (!value.empty()) {
            entries.emplace_back(name, value);
        }
    }
    return entries;
}

void add_density_options(Command command, DensityOptions& options) {
    const char* const density =
        "Radii that vary: the largest times g, above 0 and up to 1; give one";
    command.add_option("--density-attribute", options.attribute, "NAME",
                       "g is this vertex property of a PLY", density);
    command.add_option("--density-file", options.file, "FILE",
                       "g is in this text file, one value per line and vertex", density);
    command.add_option("--density-map", options.map, "FILE",
                       "g is the grey of this image, black 0 and white 1, at the\n"
                       "texture coordinates of the vertices",
                       density);
    command.add_flag("--density-curvature", options.curvature,
                     "g is 1 where the mesh is flat, 1/2 where its mean curvature\n"
                     "is the average, and falls to 0.1",
                     density);
    command.add_option("--density-floor", options.floor, "G",
                       "Raise smaller g to this; for curvature 0.1 unless given", density);
}

} // namespace geodisk::tools
