// The options of `geodisk batch`.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "geodisk/options/sample_options.hpp"
#include "program/path.hpp"

namespace geodisk::tools {

/// Each has a temporary file while it writes.
inline constexpr int kMaxJobs = 32;

/// One of several parts that a batch is divided into.
struct Shard {
    std::size_t index = 0, count = 1;

    bool has(std::size_t item) const { return item % count == index; }
};

/// As given on the command line.
struct BatchOptions {
    std::vector<std::string> inputs; ///< Folders, meshes and manifests.
    std::string folder;
    std::string format = "ply";
    SampleOptions sample; ///< For all meshes; of its outputs, all but the samples.
    std::vector<std::string> devices;
    int jobs = 0; ///< 0 for what suits the devices.
    std::string shard;
    bool resumes = false;
    bool keeps_extensions = false; ///< a.obj.ply rather than a.ply.

    /// The whole unless a part is given. Throws UserError(usage).
    Shard parsed_shard() const;
};

/// Adds all options of the command; `options` must outlive the parsing.
void add_batch_options(Command command, BatchOptions& options);

/// Line of a manifest.
struct LineOptions {
    SampleOptions sample; ///< Without an output.
    std::string mesh;     ///< As the line gives it.
    std::string name;     ///< Name of the output; "" for that of the mesh.
};

/// The job that `words`, the mesh and its options, ask for: they replace options of the same kind
/// in `common`. Files that they name are relative to `folder`. Throws UserError(usage).
LineOptions parse_line(const SampleOptions& common, const std::vector<std::string>& words,
                       const Path& folder);

/// The command, as a line for a shell, that gives the same samples in the same file. Options that
/// change neither are not in it, so equal commands give equal files.
std::string sample_command(const SampleOptions& options);

} // namespace geodisk::tools
