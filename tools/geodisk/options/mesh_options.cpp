#include "geodisk/options/mesh_options.hpp"

#include "program/program.hpp"

namespace geodisk::tools {
namespace {

constexpr const char* kSurfaceGroup = "Surface";

} // namespace

void MeshOptions::add_files(std::vector<NamedFile>& read, const std::string& what) const {
    for (const std::string& path : {mesh, coordinates, edge_lengths}) {
        if (!path.empty()) {
            read.push_back({what, path});
        }
    }
}

HeaderEntries MeshOptions::additions() const {
    HeaderEntries result;
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
    add_option(command, name, options.mesh, "", summary + ": *.obj, *.ply or builtin:NAME")
        ->required();
}

void add_sidecar_options(CLI::App& command, MeshOptions& options, const std::string& mesh_name,
                         const std::string& suffix) {
    add_option(command, "--coordinates" + suffix, options.coordinates, "FILE",
               "Text file with 3 to 8 coordinates per line and vertex,\nin place of those of " +
                   mesh_name,
               kSurfaceGroup);
    add_option(command, "--edge-lengths" + suffix, options.edge_lengths, "FILE",
               "Text file with a line VERTEX VERTEX LENGTH per edge, which\n"
               "make the surface; vertices count from 1 in OBJ, 0 in PLY",
               kSurfaceGroup);
}

void add_lift_option(CLI::App& command, MeshOptions& options, const std::string& suffix) {
    add_option(command, "--lift" + suffix, options.lifts, "LIFT",
               "normals:W or attribute:NAME:W: measure along the surface with\n"
               "W times the vertex normal or PLY property NAME as further\n"
               "coordinates; may be given several times",
               kSurfaceGroup)
        ->allow_extra_args(false);
}

void add_mesh_options(CLI::App& command, MeshOptions& options) {
    add_sidecar_options(command, options, "MESH");
    add_lift_option(command, options);
}

} // namespace geodisk::tools
