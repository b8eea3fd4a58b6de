#include "geodisk/mesh_options.hpp"

#include <CLI/CLI.hpp>

namespace geodisk::tools {
namespace {

constexpr const char* kSurfaceGroup = "Surface";

} // namespace

std::vector<std::string> MeshOptions::files() const {
    std::vector<std::string> names{mesh};
    for (const std::string& sidecar : {coordinates, edge_lengths}) {
        if (!sidecar.empty()) {
            names.push_back(sidecar);
        }
    }
    return names;
}

std::vector<std::pair<std::string, std::string>> MeshOptions::additions() const {
    std::vector<std::pair<std::string, std::string>> result;
    if (!coordinates.empty()) {
        result.emplace_back("coordinates", coordinates);
    }
    if (!edge_lengths.empty()) {
        result.emplace_back("edge_lengths", edge_lengths);
    }
    for (const std::string& lift : lifts) {
        result.emplace_back("lift", lift);
    }
    return result;
}

void add_mesh_argument(CLI::App& command, MeshOptions& options, const std::string& summary,
                       const std::string& name) {
    command.add_option(name, options.mesh, summary + ": *.obj, *.ply or builtin:NAME")
        ->type_name("")
        ->required();
}

void add_sidecar_options(CLI::App& command, MeshOptions& options, const std::string& mesh_name,
                         const std::string& suffix) {
    command
        .add_option("--coordinates" + suffix, options.coordinates,
                    "Text file with 3 to 8 coordinates per line and vertex,\n"
                    "in place of those of " +
                        mesh_name)
        ->type_name("FILE")
        ->group(kSurfaceGroup);
    command
        .add_option("--edge-lengths" + suffix, options.edge_lengths,
                    "Text file with a line VERTEX VERTEX LENGTH per edge, which\n"
                    "make the surface; vertices count from 1 in OBJ, 0 in PLY")
        ->type_name("FILE")
        ->group(kSurfaceGroup);
}

void add_lift_option(CLI::App& command, MeshOptions& options, const std::string& suffix) {
    command
        .add_option("--lift" + suffix, options.lifts,
                    "normals:W or attribute:NAME:W: measure along the surface with\n"
                    "W times the vertex normal or PLY property NAME as further\n"
                    "coordinates; may be given several times")
        ->type_name("LIFT")
        ->group(kSurfaceGroup)
        ->allow_extra_args(false);
}

void add_mesh_options(CLI::App& command, MeshOptions& options) {
    add_sidecar_options(command, options, "MESH");
    add_lift_option(command, options);
}

} // namespace geodisk::tools
