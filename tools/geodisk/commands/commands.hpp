// The subcommands of `geodisk`. Each function adds one to `app`; when the user chooses it, it does
// its work, which throws UserError on failure.
#pragma once

#include <functional>
#include <string>
#include <vector>

namespace geodisk::tools {

class AtomicFile;
class Command;
class SurfaceSampler;

struct SampleOptions;

/// Samples a mesh on a Vulkan device and writes the samples to a file.
void add_sample_command(Command app);

/// Samples many meshes, each to a file of its own, on all GPUs. UserError(some_failed) if some
/// could not be.
void add_batch_command(Command app);

/// Settles the names of samples and picture once both files are written, samples first.
using NameOutputs = std::function<void(const std::vector<AtomicFile*>& files, std::string& output,
                                       std::string& picture)>;

/// Files that `sample` writes but the user has not named.
struct UnnamedOutputs {
    NameOutputs name;              ///< If set, names them in the end.
    bool may_lack_picture = false; ///< Leaves the picture out if the device cannot draw.
};

/// Runs `sample`, by `sampler` if it is not null.
void sample_to_files(const SampleOptions& options, const UnnamedOutputs& unnamed = {},
                     SurfaceSampler* sampler = nullptr);

/// Runs `sample`. Without -o it writes a file of the current folder that is named by the mesh and
/// replaces none; if it `draws`, also a picture unless the user names one.
void sample_as_named(const SampleOptions& options, bool draws);

/// Samples a mesh and draws the samples, into files of the current folder named by the mesh.
void add_quick_command(Command app);

/// Makes a mesh alone the arguments of a command, `quick`. UserError(usage)
/// for what is neither a command nor a mesh.
void choose_command(Command app, std::vector<std::string>& arguments);

/// Checks a sample file against its mesh or box, without a device. UserError(violation) if samples
/// are too close or off the mesh.
void add_verify_command(Command app);

/// Tells how samples on a mesh are spread, without a device.
void add_analyze_command(Command app);

/// Computes the power spectrum of samples on a mesh or in a box of two dimensions, without a
/// device.
void add_spectrum_command(Command app);

/// Draws samples on a mesh or in a box on a Vulkan device and writes the picture to a file.
void add_render_command(Command app);

/// Samples a mesh on a Vulkan device and writes a page that shows the samples and tells of them.
void add_report_command(Command app);

/// Finds what is near each vertex or point along the surface, on a Vulkan device.
void add_neighbours_command(Command app);

/// Measures distances from sources to all vertices along the surface, on the CPU.
void add_distances_command(Command app);

/// Finds the nearest sample of each texel of a texture.
void add_bake_command(Command app);

/// Finds the geodesic Voronoi cells of samples: areas, and the mesh of those whose cells meet.
void add_cells_command(Command app);

/// Carries samples over to another mesh of the same connectivity.
void add_transfer_command(Command app);

/// Samples a box of R^n on a Vulkan device.
void add_box_command(Command app);

/// Lists the built-in surfaces, which need no mesh file, or writes one of them to a PLY file.
void add_shapes_command(Command app);

/// Lists the Vulkan devices and whether they can run geodisk. UserError(no_device) if none can.
void add_info_command(Command app);

/// Compares the sets that a Vulkan device gives with those that every device gives.
/// UserError(violation) if some differ.
void add_conformance_command(Command app);

/// Prints the script by which a shell completes the program's commands and options. Hidden.
void add_completion_command(Command app);

/// Writes the manual pages of the program and its commands to a folder. Hidden.
void add_manual_command(Command app);

} // namespace geodisk::tools
