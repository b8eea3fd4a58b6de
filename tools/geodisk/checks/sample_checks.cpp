#include "geodisk/checks/sample_checks.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string>

#include <geodisk/version.hpp>

#include "files/samples/fingerprint.hpp"
#include "files/samples/sample_columns.hpp"
#include "geodisk/checks/near_pairs.hpp"
#include "geodisk/checks/sample_classes.hpp"
#include "geodisk/outputs/outputs.hpp"
#include "program/exact_text.hpp"
#include "program/failure.hpp"
#include "program/human_text.hpp"

namespace geodisk::tools {
namespace {

std::string coordinates_text(std::uint32_t dimension) {
    return dimension == 0 ? "no coordinates" : std::to_string(dimension) + " coordinates";
}

/// Why there is no sample on the row's face, or "".
std::string face_fault(const SampleRow& row, const MeshInput& mesh) {
    const std::string face = "face " + std::to_string(row.face);
    if (row.face >= mesh.prepared.face_count()) {
        return face + " is out of range, " + mesh.path + " has " +
               counted(mesh.prepared.face_count(), "triangle", "triangles") +
               "; is it of another mesh?";
    }
    if (!mesh.file.takes_part(row.face)) {
        return face + " repeats a vertex, is a copy or a wall in " + mesh.path +
               ", so it holds no samples";
    }
    const auto polygon = mesh.polygon(row.face);
    if (row.polygon && polygon && *row.polygon != *polygon) {
        return "polygon_index is " + std::to_string(*row.polygon) + ", but " + face + " is of " +
               "face " + std::to_string(*polygon) + " in " + mesh.path;
    }
    return {};
}

/// Returns the distance of the closest pair, with a warning.
double closest_distance(const SampleFile& samples, const MeshInput& mesh,
                        std::vector<MeshWarning>& warnings, ProgressLine& progress) {
    const std::optional<ClosePair> closest = find_closest(mesh, samples.rows, progress);
    if (!closest || !(closest->distance > 0)) {
        fail_usage(samples.path + ": its header has no minimum distance, and " +
                   (closest ? "samples " + std::to_string(closest->row_a) + " and " +
                                  std::to_string(closest->row_b) + " lie at one place"
                            : "no path joins two of its samples") +
                   "; give --min-distance");
    }
    warnings.push_back(
        {"closest_distance", 1, "",
         "its header has no minimum distance, so that of the closest pair is used, " +
             rounded(closest->distance, 6) + "; give --min-distance for another",
         samples.path});
    return closest->distance;
}

} // namespace

double header_distance(const SampleFile& samples) {
    const std::string* const value = samples.header.find("min_distance");
    if (value == nullptr) {
        fail_usage(samples.path + ": its header has no minimum distance; give --min-distance");
    }
    const std::optional<double> distance = parse_positive(trimmed(*value));
    if (!distance) {
        fail_input(samples.path, "its header has the minimum distance " + in_quotes(*value) +
                                     ", not a positive number; give --min-distance");
    }
    return *distance;
}

void check_dimensions(const SampleFile& samples, const MeshInput& mesh) {
    if (samples.dimension != mesh.dimension()) {
        fail_input(samples.path, "its samples have " + coordinates_text(samples.dimension) +
                                     ", the vertices of " + mesh.path + " have " +
                                     coordinates_text(mesh.dimension()));
    }
}

void check_rows(const SampleFile& samples, const MeshInput& mesh, const std::string& noun) {
    constexpr double kTolerance = 1e-5; // Of weights that other programs rounded.
    for (std::uint32_t i = 0; i < samples.rows.size(); ++i) {
        const SampleRow& row = samples.rows[i];
        if (const std::string fault = face_fault(row, mesh); !fault.empty()) {
            fail_input(
                samples.path,
                std::string(noun).append(" ").append(std::to_string(i)).append(": ").append(fault));
        }
        double sum = 0;
        double least = 1;
        for (const double weight : row.bary) {
            sum += weight;
            least = std::min(least, weight);
        }
        if (!(least >= -kTolerance && std::abs(sum - 1) <= kTolerance)) {
            fail_input(samples.path, noun + " " + std::to_string(i) +
                                         ": its weights do not name a point in a triangle");
        }
    }
}

std::vector<StrayRow> find_strays(const SampleFile& samples, const MeshInput& mesh) {
    double largest = 0;
    double diagonal = 0;
    for (std::size_t axis = 0; axis < mesh.dimension(); ++axis) {
        double low = HUGE_VAL, high = -HUGE_VAL;
        for (std::size_t corner = 0; corner < mesh.file.triangles.size(); ++corner) {
            if (mesh.file.takes_part(corner / 3)) {
                const std::size_t vertex = mesh.file.triangles[corner];
                const double x = mesh.file.positions[vertex * mesh.dimension() + axis];
                low = std::min(low, x);
                high = std::max(high, x);
            }
        }
        largest = std::max({largest, std::abs(low), std::abs(high)});
        diagonal = std::hypot(diagonal, high - low);
    }
    // Files hold floats, or doubles where the mesh is farther from the origin than this.
    const double allowed = 0x1p-22 * std::min(largest, 16 * diagonal);
    std::vector<StrayRow> strays;
    for (std::uint32_t i = 0; i < samples.rows.size(); ++i) {
        const SampleRow& row = samples.rows[i];
        const std::array<double, 8> point = mesh.point(row.face, row.bary);
        double offset = 0;
        for (std::size_t axis = 0; axis < point.size(); ++axis) {
            offset = std::hypot(offset, row.position[axis] - point[axis]);
        }
        if (!(offset <= allowed)) {
            strays.push_back({i, offset});
        }
    }
    return strays;
}

std::vector<std::uint32_t> masked_samples(const SampleFile& samples, const MeshInput& mesh) {
    const auto existing = samples.extra_values(kExistingColumn);
    const auto classes = samples.extra_values(kClassColumn);
    const auto edges = mesh.sampled().half_edges();
    const auto takes = [&](std::uint32_t row, const Sample& at) {
        return (mesh.face_mask.empty() || mesh.face_mask[at.face] != 0) &&
               (classes.empty() || mesh.has_room(classes[row], at));
    };
    const auto is_beside_mask = [&](std::uint32_t row, const Sample& at) {
        constexpr float kAtEdge = 1e-4f; // Weight of the corner opposite to it.
        for (std::uint32_t corner = 0; corner < 3; ++corner) {
            const std::uint32_t edge = next_in_face(3 * at.face + corner);
            for (std::uint32_t other = around_half_edge(edges[edge].around);
                 at.weights[corner] < kAtEdge && other != edge;
                 other = around_half_edge(edges[other].around)) {
                if (takes(row, {other / 3, {1 / 3.0f, 1 / 3.0f, 1 / 3.0f}})) {
                    return true;
                }
            }
        }
        return false;
    };
    std::vector<std::uint32_t> masked;
    for (std::uint32_t i = 0; i < samples.rows.size() && mesh.leaves_out(); ++i) {
        const SampleRow& row = samples.rows[i];
        const bool is_existing = i < existing.size() && existing[i] != 0;
        const Sample at = mesh.sampled_of(row);
        const bool is_exact = samples.has_faces && !mesh.split; // Else it was moved.
        if (!takes(i, at) && !is_existing && (is_exact || !is_beside_mask(i, at))) {
            masked.push_back(i);
        }
    }
    return masked;
}

std::string other_sampling_text(const SampleHeader& header) {
    const std::string own = std::to_string(GEODISK_SAMPLING_VERSION);
    const std::string* const version = header.find(kSamplingVersion);
    return version == nullptr || *version == own
               ? ""
               : "was made by sampling version " + *version + ", and this is " + own +
                     ", in which a seed gives other sets";
}

void warn_of_other_surface(const SampleFile& samples, const MeshInput& mesh,
                           std::vector<MeshWarning>& warnings) {
    const auto options_of = [](const auto& entries) {
        std::string text;
        for (const auto& [key, value] : entries) {
            if (key == "keep_seams") {
                text.append(" --keep-seams");
            } else if (key == "lift" || key == "weld" || key == "walls") {
                text.append(" --").append(key).append(key == "weld" ? "=" : " ").append(value);
            }
        }
        return text.empty() ? " no --lift, --weld, --keep-seams and --walls" : text;
    };
    const std::string used = options_of(samples.header.entries);
    if (used == options_of(mesh.additions)) {
        return;
    }
    warnings.push_back(
        {"other_surface", 1, "",
         "made with" + used + ", but this command has other options; distances may differ",
         samples.path});
}

bool fits_digest(const SampleFile& samples) {
    const std::string* const digest = samples.header.find(kDigest);
    return digest == nullptr || !samples.has_faces || trimmed(*digest) == digest_of(samples.rows);
}

SampleDisks sample_disks(const SampleFile& samples, const MeshInput& mesh,
                         const std::optional<Length>& min_distance,
                         std::vector<MeshWarning>& warnings, ProgressLine& progress) {
    std::vector<MeshWarning> found;
    SampleDisks disks = sample_disks_silently(samples, mesh, min_distance, found, progress);
    print_warnings(found);
    warnings.insert(warnings.end(), found.begin(), found.end());
    return disks;
}

SampleDisks sample_disks_silently(const SampleFile& samples, const MeshInput& mesh,
                                  const std::optional<Length>& min_distance,
                                  std::vector<MeshWarning>& warnings, ProgressLine& progress) {
    if (min_distance) {
        return disks_of(samples.rows,
                        distance_on_mesh(*min_distance, mesh.prepared.statistics()) / 2);
    }
    const ClassTable classes = classes_in_header(samples);
    if (classes.count > 1) {
        check_classes(samples, classes.count);
        return disks_of(samples.rows, classes, samples.extra_values(kClassColumn),
                        classes.distances.empty() ? header_distance(samples) : classes.largest());
    }
    if (has_radii(samples.rows) || samples.rows.empty()) {
        return disks_of(samples.rows, 0);
    }
    return disks_of(samples.rows, (samples.header.find("min_distance") != nullptr
                                       ? header_distance(samples)
                                       : closest_distance(samples, mesh, warnings, progress)) /
                                      2);
}

SampleDisks disks_of(std::span<const SampleRow> rows, double radius) {
    SampleDisks all;
    all.disks.reserve(rows.size());
    for (const SampleRow& row : rows) {
        all.disks.push_back({row.face, static_cast<double>(row.bary[1]),
                             static_cast<double>(row.bary[2]), radius > 0 ? radius : row.radius});
    }
    return all;
}

SampleDisks disks_of(std::span<const SampleRow> rows, const ClassTable& table,
                     std::span<const std::uint32_t> classes, double min_distance) {
    SampleDisks all = disks_of(rows, has_radii(rows) ? 0 : min_distance / 2);
    all.classes = table.in_mesh_units(min_distance);
    for (std::size_t i = 0; i < rows.size() && all.classes.count > 0; ++i) {
        all.disks[i].radius = table.radius(classes[i], min_distance);
        all.disks[i].kind = 1 + classes[i];
    }
    return all;
}

void check_same_distance(const std::string& samples_path, double min_distance,
                         const std::string& first_path, double first_distance) {
    constexpr double kSameDistance = 1e-6; // Of what headers and weights round.
    if (std::abs(min_distance - first_distance) > kSameDistance * first_distance) {
        const std::string other =
            samples_path == first_path ? " and of " : ", " + first_path + " one of ";
        fail_input(samples_path, "has a minimum distance of " + rounded(min_distance, 6) + other +
                                     rounded(first_distance, 6) +
                                     "; a spectrum needs samples with the same minimum distance");
    }
}

std::string offset_text(const StrayRow& stray) {
    return rounded(stray.offset, 3) + " from the point given by its face and weights";
}

} // namespace geodisk::tools
