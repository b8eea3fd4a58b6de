// The options that say how samples are spread over a mesh, the same for every command that takes
// them.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "files/samples/sample_file.hpp"
#include "geodisk/options/option_use.hpp"
#include "geodisk/options/run_options.hpp"
#include "geometry/mesh.hpp"

namespace geodisk::tools {

/// Least factor of curvature. Few vertices are curved so much that a tenth is not small enough, and
/// those are often noise.
inline constexpr double kCurvatureFloor = 0.1;

/// Source of the values at the vertices, and their meaning.
struct DensitySource {
    enum class Kind { attribute, file, map, curvature };

    std::string option;      ///< As given, for messages.
    bool is_density = false; ///< Else they are factors of the radius.
    Kind kind = Kind::attribute;
    std::string name;            ///< Property or file; empty for curvature.
    std::optional<double> floor; ///< Factors below it are raised to it.

    /// Returns true if it names a file.
    bool reads_file() const { return kind == Kind::file || kind == Kind::map; }
    /// As --density and --radius-factor take it.
    std::string text() const;
};

/// Reads a source as `option` takes it. Throws UserError(usage) for one that names nothing.
DensitySource parse_source(const std::string& option, const std::string& text);

/// As given on the command line.
struct DensityOptions {
    std::string density, radius_factor, factor_floor;
    /// Options of before, which gave factors.
    std::string attribute, file, map, floor;
    bool curvature = false;

    /// Returns true if radii vary at all. Throws UserError(usage) for options that contradict each
    /// other.
    bool is_given() const { return source().has_value(); }
    std::optional<DensitySource> source() const;
    /// Returns true if distances are those at the largest density.
    bool is_density() const { return !density.empty(); }
    /// Tells what took the place of an option of before, or nothing; of the mesh `path`.
    std::optional<MeshWarning> warning() const;
    /// Adds the files that are read, called `what`.
    void add_files(std::vector<NamedFile>& read, const std::string& what) const;
    /// Puts `place(name)` for the file that is named.
    void place_files(const std::function<std::string(const std::string&)>& place);
    /// With name and value of what is given, as the header of a sample file names it.
    HeaderEntries added_to(HeaderEntries entries) const;
    /// Name and value of each option that names a source, as on the command line; a flag has no
    /// value.
    HeaderEntries given() const;
};

void add_density_options(Command command, DensityOptions& options, OptionUse use);

} // namespace geodisk::tools
