#include "geodisk/inputs/existing_input.hpp"

#include <cmath>
#include <string>
#include <utility>

#include "files/samples/sample_columns.hpp"
#include "geodisk/checks/sample_input.hpp"
#include "geometry/covered_parts.hpp"
#include "program/exact_text.hpp"
#include "program/failure.hpp"
#include "program/human_text.hpp"

namespace geodisk::tools {
namespace {

void check_count(const SampleJob& job, std::size_t existing) {
    const double wanted =
        job.method.params.stop_count != 0 ? job.method.params.stop_count : job.wanted_count.samples;
    if (wanted > 0 && static_cast<double>(existing) >= wanted) {
        fail_usage("--count: " + counted(existing, "sample", "samples") + " of --existing count " +
                   "too, so ask for more than " + grouped(existing));
    }
}

/// Takes the points to avoid that matter. Throws UserError if they leave no room, unless there are
/// samples to keep.
void take_avoided(const Avoided& avoided, const MeshInput& mesh, bool keeps_samples,
                  ExistingInput& existing) {
    std::vector<KeepOut> of_all;
    for (std::size_t i = 0; i < avoided.disks.size(); ++i) {
        if (avoided.classes[i] == kAllClasses) {
            of_all.push_back(avoided.disks[i]);
        }
    }
    CoveredParts covered = covered_parts(mesh.sampled(), of_all);
    if (!avoided.empty() && !keeps_samples && covered.cover_all(mesh.sampled(), mesh.face_mask)) {
        fail_usage("--avoid: the points leave no room for samples; lower their radii");
    }
    existing.points_to_avoid = avoided.points;
    existing.lines_to_avoid = avoided.length;
    existing.avoided = std::move(covered.needed);
    if (of_all.size() == avoided.disks.size()) {
        return;
    }
    existing.avoid_classes.assign(existing.avoided.size(), kAllClasses);
    for (std::size_t i = 0; i < avoided.disks.size(); ++i) {
        if (avoided.classes[i] != kAllClasses) {
            existing.avoided.push_back(avoided.disks[i]);
            existing.avoid_classes.push_back(avoided.classes[i]);
        }
    }
}

/// Says that a file of points of an option has none.
void warn_if_empty(const SampleFile& file, const char* message,
                   std::vector<MeshWarning>& warnings) {
    if (file.rows.empty()) {
        warnings.push_back({"no_points", 1, "", message, file.path});
    }
}

/// Returns the classes of samples to keep: those of the file, or 0.
std::vector<std::uint8_t> classes_in(const SampleFile& file, std::size_t count,
                                     std::vector<MeshWarning>& warnings) {
    const auto values = file.extra_values(kClassColumn);
    std::vector<std::uint8_t> classes(file.rows.size(), 0);
    if (values.empty()) {
        warnings.push_back({"no_classes", file.rows.size(), "",
                            "has no column class; its samples get class 0", file.path});
    }
    for (std::size_t i = 0; i < values.size(); ++i) {
        if (values[i] >= count) {
            fail_input(file.path, "sample " + std::to_string(i) + ": its class is " +
                                      std::to_string(values[i]) + ", but --classes has " +
                                      std::to_string(count) + ", numbered from 0");
        }
        classes[i] = static_cast<std::uint8_t>(values[i]);
    }
    return classes;
}

/// Adds the points of a file, and the points along its lines.
void avoid_file(const AvoidOption& option, const std::string& tolerance, const MeshOptions& of_mesh,
                const MeshInput& mesh, std::vector<MeshWarning>& warnings, ProgressLine& progress,
                Avoided& avoided, std::vector<KeepOut>& along_lines) {
    const std::string& path = option.points;
    const SampleFile file =
        read_samples_silently_on(path, mesh, tolerance, warnings, progress,
                                 {"point", option.column, true, of_mesh.allows_outside});
    warn_if_empty(file, "has no points to avoid, so --avoid does nothing", warnings);
    const std::size_t first = avoided.disks.size();
    for (std::size_t i = 0; i < file.rows.size(); ++i) {
        const double radius = option.radius
                                  ? distance_on_mesh(*option.radius, mesh.prepared.statistics())
                                  : file.numbers[i];
        if (!(radius > 0) || !std::isfinite(radius)) {
            fail_input(path, "point " + std::to_string(i) + ": its " + option.column +
                                 (std::isnan(radius) ? " is blank or not a number"
                                                     : " is " + exact_text(radius)) +
                                 ", not a positive radius");
        }
        avoided.disks.push_back({sample_of(file.rows[i]), radius});
    }
    avoided.length +=
        LineCover(mesh, path, tolerance).cover(file, first, avoided.disks, along_lines);
}

/// Adds points along edges of the mesh.
void avoid_edges(const AvoidOption& option, const MeshInput& mesh,
                 std::vector<MeshWarning>& warnings, Avoided& avoided,
                 std::vector<KeepOut>& along_lines) {
    const double radius = distance_on_mesh(*option.radius, mesh.prepared.statistics());
    const double length = cover_edges(mesh, option.kind, radius, along_lines);
    if (length == 0) {
        const bool is_border = option.kind == AvoidOption::Kind::border;
        warnings.push_back(
            {"nothing_to_avoid", 1, "",
             std::string("has no ") + (is_border ? "border" : "creases") + " to avoid", mesh.path});
    }
    avoided.length += length;
}

} // namespace

Avoided load_avoided(const ConstraintOptions& options, const MeshOptions& of_mesh,
                     const MeshInput& mesh, std::vector<MeshWarning>& warnings,
                     ProgressLine& progress) {
    Avoided avoided;
    std::vector<KeepOut> along_lines;
    std::vector<std::uint8_t> of_lines;
    for (const AvoidOption& option : options.parsed_avoid()) {
        if (option.kind == AvoidOption::Kind::file) {
            avoid_file(option, options.tolerance, of_mesh, mesh, warnings, progress, avoided,
                       along_lines);
        } else {
            avoid_edges(option, mesh, warnings, avoided, along_lines);
        }
        avoided.classes.resize(avoided.disks.size(), option.only_class);
        of_lines.resize(along_lines.size(), option.only_class);
    }
    avoided.points = avoided.disks.size();
    avoided.disks.insert(avoided.disks.end(), along_lines.begin(), along_lines.end());
    avoided.classes.insert(avoided.classes.end(), of_lines.begin(), of_lines.end());
    for (KeepOut& disk : avoided.disks) {
        disk.center = mesh.on_sampled(disk.center);
    }
    return avoided;
}

ExistingInput load_existing(const SampleJob& job, const MeshInput& mesh, ProgressLine& progress) {
    ExistingInput existing;
    const ConstraintOptions& options = job.constraints;
    take_avoided(load_avoided(options, job.mesh, mesh, existing.warnings, progress), mesh,
                 !options.existing.empty(), existing);
    if (options.existing.empty()) {
        return existing;
    }
    const SampleFile file = read_samples_silently_on(options.existing, mesh, options.tolerance,
                                                     existing.warnings, progress);
    warn_if_empty(file, "has no samples to keep, so --existing does nothing", existing.warnings);
    check_count(job, file.rows.size());
    for (const SampleRow& row : file.rows) {
        existing.samples.push_back(mesh.sampled_of(row));
    }
    if (job.classes.count > 1 && !file.rows.empty()) {
        existing.classes = classes_in(file, job.classes.count, existing.warnings);
    }
    return existing;
}

} // namespace geodisk::tools
