// The samples of a command, read and put on their mesh.
#pragma once

#include <string>
#include <vector>

#include "files/samples/sample_file.hpp"
#include "geodisk/checks/sample_checks.hpp"
#include "geodisk/inputs/mesh_input.hpp"
#include "geodisk/outputs/progress.hpp"

namespace geodisk::tools {

/// Samples on a mesh.
struct SampleInput {
    SampleFile file;
    std::vector<StrayRow> strays; ///< Not where they should be.
};

/// Purpose of reading a file of samples.
struct ReadAs {
    std::string noun = "sample";  ///< Names a row in errors.
    std::string numbers{};        ///< Column to read as well, see read_samples(), or "".
    bool has_lines = false;       ///< Formats of lines may be read, see read_points_and_lines().
    bool allows_outside = false;  ///< Files that a file of lines names may be anywhere.
    bool compares_surface = true; ///< Warns of samples of another surface.
};

/// Reads the samples in the file `path` of a mesh. Points without faces are put on the nearest
/// face, with a warning that says how far they lay away; those farther than `tolerance`, "" for a
/// thousandth of the diagonal, are strays. Samples with faces are strays if their positions are
/// elsewhere. Prints warnings, one of them about samples of another surface. Throws UserError for
/// rows that are not on the mesh at all.
SampleInput read_samples_on(const std::string& path, const MeshInput& mesh,
                            const std::string& tolerance, std::vector<MeshWarning>& warnings,
                            ProgressLine& progress, const ReadAs& as = {});

/// Does this with samples that were read, but prints no warnings.
void put_on_mesh(const MeshInput& mesh, const std::string& tolerance, SampleInput& input,
                 std::vector<MeshWarning>& warnings, ProgressLine& progress, const ReadAs& as = {});

/// Returns the samples. Throws UserError(bad_input) for strays.
SampleFile without_strays(const MeshInput& mesh, SampleInput input, const ReadAs& as = {});

/// Warns of a file without samples.
void warn_of_no_samples(const SampleFile& file, std::vector<MeshWarning>& warnings);

/// As read_samples_on(), and throws UserError(bad_input) for strays: samples of another mesh would
/// land anywhere.
SampleFile read_samples_exactly_on(const std::string& path, const MeshInput& mesh,
                                   const std::string& tolerance, std::vector<MeshWarning>& warnings,
                                   ProgressLine& progress, const ReadAs& as = {});

/// The same, but leaves the warnings to the caller to print.
SampleFile read_samples_silently_on(const std::string& path, const MeshInput& mesh,
                                    const std::string& tolerance,
                                    std::vector<MeshWarning>& warnings, ProgressLine& progress,
                                    const ReadAs& as = {});

} // namespace geodisk::tools
