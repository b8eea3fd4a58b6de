// Checks that samples lie on a mesh, as their file says.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "files/samples/sample_file.hpp"
#include "geodisk/inputs/mesh_input.hpp"
#include "geodisk/options/class_options.hpp"
#include "geodisk/outputs/progress.hpp"
#include "geometry/surface_disk.hpp"

namespace geodisk::tools {

/// A sample whose position is not where its face and weights put it.
struct StrayRow {
    std::uint32_t row;
    double offset;
};

/// The minimum distance that the header tells. Throws UserError if it tells none, or nonsense.
double header_distance(const SampleFile& samples);

/// Throws UserError(bad_input) if the samples have not as many coordinates as the mesh.
void check_dimensions(const SampleFile& samples, const MeshInput& mesh);

/// The rows must at least name points of the mesh. Throws UserError(bad_input) naming the first
/// that does not, a `noun`.
void check_rows(const SampleFile& samples, const MeshInput& mesh, const std::string& noun);

/// The samples whose positions differ from those of their faces and weights by more than a sample
/// file rounds. The rows must have passed check_rows(); without coordinates there are none.
std::vector<StrayRow> find_strays(const SampleFile& samples, const MeshInput& mesh);

/// Returns the samples on faces that the mask of the mesh leaves out, except existing ones. A point
/// that was put on the nearest face may also lie at the edge of a face that the mask leaves.
std::vector<std::uint32_t> masked_samples(const SampleFile& samples, const MeshInput& mesh);

/// Returns what is to be said of samples by another version of the sampling; "" of all others.
std::string other_sampling_text(const SampleHeader& header);

/// Adds a warning where the samples' header tells of another --lift, --weld, --keep-seams or
/// --walls than the mesh here: samples of another surface would show as violations, or worse, would
/// not.
void warn_of_other_surface(const SampleFile& samples, const MeshInput& mesh,
                           std::vector<MeshWarning>& warnings);

/// Why rows may differ from those of a digest.
inline constexpr const char* kOtherRows = "samples of the run are missing, others were added, or "
                                          "numbers were changed, for example rounded";

/// Returns true unless the rows differ from those that the digest in the header is of.
bool fits_digest(const SampleFile& samples);

/// The disk of each sample. Its radius is half of `min_distance` if that is given, else that of its
/// class, else its own, else half of the header's distance, else half the distance of the closest
/// pair, which is a warning. Throws UserError if no distance follows from that either, for samples
/// without the classes of their header, and as header_distance() and distance_on_mesh().
SampleDisks sample_disks(const SampleFile& samples, const MeshInput& mesh,
                         const std::optional<Length>& min_distance,
                         std::vector<MeshWarning>& warnings, ProgressLine& progress);

/// The same, but leaves the warnings to the caller to print.
SampleDisks sample_disks_silently(const SampleFile& samples, const MeshInput& mesh,
                                  const std::optional<Length>& min_distance,
                                  std::vector<MeshWarning>& warnings, ProgressLine& progress);

/// The disk of each row, of this radius in mesh units, or of the row's own where that is 0.
SampleDisks disks_of(std::span<const SampleRow> rows, double radius);

/// The disk of each row: of the radius of its class, or without several classes of its own, else of
/// half of `min_distance`. That is the largest distance, in mesh units.
SampleDisks disks_of(std::span<const SampleRow> rows, const ClassTable& table,
                     std::span<const std::uint32_t> classes, double min_distance);

/// Throws UserError(bad_input) if samples have another distance than those of the first file, both
/// in mesh units: what is told of all is told in minimum distances.
void check_same_distance(const std::string& samples_path, double min_distance,
                         const std::string& first_path, double first_distance);

/// Returns how far `stray` is off, as the end of a sentence.
std::string offset_text(const StrayRow& stray);

} // namespace geodisk::tools
