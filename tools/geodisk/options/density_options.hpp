// The options that say how radii vary over a mesh, the same for every command that takes them.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "files/sample_file.hpp"
#include "geodisk/options/run_options.hpp"

namespace geodisk::tools {

/// As given on the command line.
struct DensityOptions {
    std::string attribute, file, map, floor;
    bool curvature = false;

    /// Whether radii vary at all. Throws UserError(usage) for options that contradict each other.
    bool is_given() const;
    /// The least factor, or nothing where values stay as they are.
    std::optional<double> least_factor() const;
    /// Adds the files that are read, called `what`.
    void add_files(std::vector<NamedFile>& read, const std::string& what) const;
    /// With name and value of what is given, as the header of a sample file names it.
    HeaderEntries added_to(HeaderEntries entries) const;
};

void add_density_options(Command command, DensityOptions& options);

} // namespace geodisk::tools
