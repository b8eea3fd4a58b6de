#include "geodisk/mesh_options.hpp"

#include <CLI/CLI.hpp>

namespace geodisk::tools {

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

void add_mesh_argument(CLI::App& command, MeshOptions& options, const std::string& summary) {
    command.add_option("MESH", options.mesh, summary + ": *.obj, *.ply or builtin:NAME")
        ->type_name("")
        ->required();
}

void add_mesh_options(CLI::App& command, MeshOptions& options) {
    const char* const surface = "Surface";
    command
        .add_option("--coordinates", options.coordinates,
                    "Text file with 3 to 8 coordinates per line and vertex,\n"
                    "in place of those of MESH")
        ->type_name("FILE")
        ->group(surface);
    command
        .add_option("--edge-lengths", options.edge_lengths,
                    "Text file with a line VERTEX VERTEX LENGTH per edge, which\n"
                    "make the surface; vertices count from 1 in OBJ, 0 in PLY")
        ->type_name("FILE")
        ->group(surface);
    command
        .add_option("--lift", options.lifts,
                    "normals:W or attribute:NAME:W: measure along the surface with\n"
                    "W times the vertex normal or PLY property NAME as further\n"
                    "coordinates; may be given several times")
        ->type_name("LIFT")
        ->group(surface)
        ->allow_extra_args(false);
}

} // namespace geodisk::tools
