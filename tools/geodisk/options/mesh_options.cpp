#include "geodisk/options/mesh_options.hpp"

#include <utility>

#include "files/meshes/image_tiles.hpp"
#include "files/meshes/mesh_file.hpp"
#include "files/meshes/value_fields.hpp"
#include "geodisk/options/wall_options.hpp"
#include "program/command.hpp"
#include "program/failure.hpp"
#include "program/human_text.hpp"
#include "program/suggestion.hpp"
#include "shapes/builtin_shapes.hpp"

namespace geodisk::tools {
namespace {

constexpr const char* kSurfaceGroup = "Surface";

/// What a mesh may be, behind what an argument is for.
std::string mesh_kinds() {
    return ":\n" + wrapped(listed(mesh_extensions("*."), ", ") +
                           ", a surface of FreeSurfer or builtin:NAME");
}

/// What bare --weld means, in headers.
constexpr const char* kExact = "exact";

} // namespace

std::vector<Lift> MeshOptions::parsed_lifts() const {
    if (!lifts.empty() && !edge_lengths.empty()) {
        fail_usage("--lift and --edge-lengths contradict each other: lengths "
                   "leave no coordinates to lift");
    }
    std::vector<Lift> parsed;
    for (const std::string& text : lifts) {
        parsed.push_back(parse_lift("--lift", text));
    }
    return parsed;
}

std::optional<Length> MeshOptions::weld_distance() const {
    if (weld.empty()) {
        return std::nullopt;
    }
    if (keep_seams) {
        fail_usage("--weld and --keep-seams contradict each other; give just one");
    }
    return weld == kBareFlag || weld == kExact ? Length{} : parse_length("--weld", weld);
}

void MeshOptions::add_files(std::vector<NamedFile>& read, const std::string& what) const {
    read.push_back({what, mesh, format});
    for (const auto& [name, path] : {std::pair{what, coordinates}, std::pair{what, edge_lengths},
                                     std::pair{std::string("the texture"), texture}}) {
        if (!path.empty()) {
            read.push_back({name, path});
        }
    }
    for (const std::string& file : value_files(fields)) {
        read.push_back({"the attribute", file});
    }
    add_wall_files(walls, read);
    if (const auto tiles = tile_name(texture); tiles && tiles->is_pattern) {
        for (const auto& [number, image] : find_tiles("", *tiles)) {
            read.push_back({"the texture", image});
        }
    }
}

HeaderEntries MeshOptions::additions() const {
    HeaderEntries result;
    if (!format.empty()) {
        result.emplace_back("mesh_format", format);
    }
    if (!coordinates.empty()) {
        result.emplace_back("coordinates", coordinates);
    }
    if (!edge_lengths.empty()) {
        result.emplace_back("edge_lengths", edge_lengths);
    }
    for (const std::string& lift : lifts) {
        result.emplace_back("lift", lift);
    }
    if (!weld.empty()) {
        result.emplace_back("weld", weld == kBareFlag ? kExact : weld);
    }
    if (keep_seams) {
        result.emplace_back("keep_seams", "yes");
    }
    for (const std::string& wall : walls) {
        result.emplace_back("walls", wall);
    }
    return result;
}

void add_mesh_argument(Command command, MeshOptions& options, const std::string& summary,
                       const std::string& name) {
    command.add_option(name, options.mesh, "", summary + mesh_kinds())
        .offers(builtin_names("builtin:"))
        .required();
}

void add_mesh_arguments(Command command, std::vector<std::string>& meshes,
                        const std::string& summary) {
    command.add_option("MESH", meshes, "", summary + mesh_kinds())
        .offers(builtin_names("builtin:"))
        .required();
}

void add_sidecar_options(Command command, MeshOptions& options, const std::string& mesh_name,
                         const std::string& suffix) {
    command.add_option(
        "--coordinates" + suffix, options.coordinates, "FILE",
        "Text file with 3 to 8 coordinates per vertex, one vertex\nper line, which replace those "
        "of " +
            mesh_name,
        kSurfaceGroup);
    command.add_option("--edge-lengths" + suffix, options.edge_lengths, "FILE",
                       "Text file with a line VERTEX VERTEX LENGTH per edge, which\n"
                       "replace coordinates; vertices count from 1 in OBJ, else 0",
                       kSurfaceGroup);
}

void add_reader_options(Command command, MeshOptions& options, const std::string& suffix) {
    command
        .add_option("--mesh-format" + suffix, options.format, "NAME",
                    wrapped("Read the mesh as " + listed(mesh_formats(), " or ") +
                            ", ignoring its extension; MESH may then be - for standard input"),
                    kSurfaceGroup)
        .offers(mesh_formats());
    command.add_flag("--allow-outside" + suffix, options.allows_outside,
                     "Read files that the mesh names outside of its folder too: names\n"
                     "with .., whole paths, and links that lead out of it",
                     kSurfaceGroup);
}

void add_lift_option(Command command, MeshOptions& options, const std::string& suffix) {
    command
        .add_option("--lift" + suffix, options.lifts, "LIFT",
                    "Add W times the vertex normal (normals:W) or a PLY property\n"
                    "(attribute:NAME:W) as further coordinates, and measure along\n"
                    "the lifted surface; may be given several times",
                    kSurfaceGroup)
        .takes_one_value();
}

void add_weld_options(Command command, MeshOptions& options, const std::string& suffix) {
    // A flag: an option whose value may be absent would take the argument after it.
    command.add_flag("--weld" + suffix, options.weld,
                     "Join vertices at the same place; with --weld" + suffix +
                         "=EPS, also\nthose at most EPS apart, in mesh units or % of the\n"
                         "bounding-box diagonal",
                     kSurfaceGroup);
    command.add_flag("--keep-seams" + suffix, options.keep_seams,
                     "Do not join border edges that coincide exactly, as along seams\n"
                     "of texture coordinates (default: join them)",
                     kSurfaceGroup);
}

void add_walls_option(Command command, MeshOptions& options) {
    command
        .add_option("--walls", options.walls, "WALL",
                    "No path crosses these: faces of material:NAME, group:NAME,\n"
                    "node:NAME, part:N or outside, faces where PROPERTY<VALUE or\n"
                    "file:FILE<VALUE holds or that are white in map:FILE, edges of\n"
                    "creases[:DEGREES], or those in edges:FILE with a line VERTEX\n"
                    "VERTEX each; may be given several times",
                    kSurfaceGroup)
        .takes_one_value();
}

void add_mesh_options(Command command, MeshOptions& options) {
    add_reader_options(command, options);
    add_weld_options(command, options);
    add_sidecar_options(command, options, "MESH");
    add_lift_option(command, options);
    add_walls_option(command, options);
}

} // namespace geodisk::tools
