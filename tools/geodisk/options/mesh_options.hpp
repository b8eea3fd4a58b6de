// The options that say what a mesh is, the same for every command that takes one.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "files/meshes/mesh_fields.hpp"
#include "files/samples/sample_file.hpp"
#include "geodisk/options/run_options.hpp"
#include "geometry/lift.hpp"
#include "program/arguments.hpp"

namespace geodisk::tools {

/// As given on the command line.
struct MeshOptions {
    std::string mesh, coordinates, edge_lengths;
    std::string format; ///< Format of the mesh; "" for that of its extension.
    std::vector<std::string> lifts;
    std::string weld; ///< A length, or what a flag without a value gets; "" for not at all.
    bool keep_seams = false;
    std::vector<std::string> walls; ///< As wall_rules() takes them.
    bool allows_outside = false;    ///< As in MeshSources.
    WantedFields fields;            ///< Attributes to read for samples.
    std::string texture;            ///< Image whose colours samples get, or "".

    /// Throws UserError(usage) for what is no lift, and where there is nothing to lift.
    std::vector<Lift> parsed_lifts() const;
    /// As for MeshSources::weld. Throws UserError(usage) for no length, and for one beside
    /// --keep-seams.
    std::optional<Length> weld_distance() const;
    /// Adds the files that are read, called `what`.
    void add_files(std::vector<NamedFile>& read, const std::string& what) const;
    /// Name and value of what shapes the surface besides the mesh file, as the header of a sample
    /// file names it.
    HeaderEntries additions() const;
};

/// Adds the argument `name`, described by `summary`.
void add_mesh_argument(Command command, MeshOptions& options, const std::string& summary,
                       const std::string& name = "MESH");

/// Adds the argument MESH, one or several.
void add_mesh_arguments(Command command, std::vector<std::string>& meshes,
                        const std::string& summary);

/// Adds the files beside the mesh `mesh_name`; `suffix` ends the options' names.
void add_sidecar_options(Command command, MeshOptions& options, const std::string& mesh_name,
                         const std::string& suffix = "");

/// Adds --mesh-format and --allow-outside, with `suffix`.
void add_reader_options(Command command, MeshOptions& options, const std::string& suffix = "");

/// Adds --lift, with `suffix`.
void add_lift_option(Command command, MeshOptions& options, const std::string& suffix = "");

/// Adds --weld and --keep-seams, with `suffix`.
void add_weld_options(Command command, MeshOptions& options, const std::string& suffix = "");

/// Adds --walls.
void add_walls_option(Command command, MeshOptions& options);

/// Adds all options besides MESH.
void add_mesh_options(Command command, MeshOptions& options);

} // namespace geodisk::tools
