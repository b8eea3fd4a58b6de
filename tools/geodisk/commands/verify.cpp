#include <algorithm>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include <geodisk/box.hpp>
#include <geodisk/features.hpp>
#include <geodisk/version.hpp>

#include "files/samples/sample_columns.hpp"
#include "files/samples/sample_file.hpp"
#include "geodisk/checks/gaps.hpp"
#include "geodisk/checks/intrusions.hpp"
#include "geodisk/checks/level_checks.hpp"
#include "geodisk/checks/sample_checks.hpp"
#include "geodisk/checks/sample_classes.hpp"
#include "geodisk/checks/sample_input.hpp"
#include "geodisk/checks/wanted_spacing.hpp"
#include "geodisk/commands/commands.hpp"
#include "geodisk/commands/help_text.hpp"
#include "geodisk/commands/verify.hpp"
#include "geodisk/inputs/box_input.hpp"
#include "geodisk/inputs/existing_input.hpp"
#include "geodisk/inputs/mesh_input.hpp"
#include "geodisk/options/verify_options.hpp"
#include "geodisk/outputs/outputs.hpp"
#include "geodisk/outputs/progress.hpp"
#include "geodisk/reports/box_report.hpp"
#include "geodisk/reports/json.hpp"
#include "geodisk/reports/verify_report.hpp"
#include "program/command.hpp"
#include "program/exact_text.hpp"
#include "program/failure.hpp"
#include "program/human_text.hpp"

namespace geodisk::tools {
namespace {

constexpr const char* kVerifyExamples[] = {
    "geodisk verify bunny.obj points.csv",
    "geodisk verify bunny.obj points.csv --min-distance 0.01",
    "geodisk verify bunny.obj points_of_another_program.npy",
    "geodisk verify box.csv",
};

/// Filtered files are checked as any other.
void warn_of_other_rows(const VerifyOptions& options, const SampleFile& samples,
                        std::vector<MeshWarning>& warnings) {
    if (fits_digest(samples)) {
        return;
    }
    warnings.push_back(
        {"other_rows", 1, "",
         std::string("its samples do not fit the digest in its header: ") + kOtherRows,
         options.samples});
    print_warning(options.samples + ": " + warnings.back().message);
}

/// Computes the distances of all pairs that may be too close, or finds the closest pair where
/// nothing says what is too close.
ExistingSpacing measure_spacing(const MeshInput& mesh, const SampleFile& samples,
                                const WantedSpacing& wanted, ProgressLine& progress,
                                const NotePairs& note) {
    if (!wanted.is_known) {
        ExistingSpacing found;
        found.others.closest = find_closest(mesh, samples.rows, progress, note);
        return found;
    }
    const auto classes = samples.extra_values(kClassColumn);
    const PairDistances distances =
        wanted.classes.is_given() ? PairDistances{{}, classes, wanted.classes, wanted.min_distance}
                                  : PairDistances{wanted.radii};
    return check_spacing(mesh, samples.rows, distances, samples.extra_values(kExistingColumn),
                         progress, note);
}

void warn_of_unknown_spacing(const VerifyOptions& options, std::vector<MeshWarning>& warnings) {
    warnings.push_back({"no_min_distance", 1, "",
                        "no minimum distance is known, so none was checked; give --min-distance",
                        options.samples});
    print_warning(options.samples + ": " + warnings.back().message);
}

/// Refuses to look for gaps without knowing all radii.
void check_maximal(const WantedSpacing& spacing) {
    if (!spacing.is_known) {
        fail_usage("--maximal needs a minimum distance; give --min-distance");
    }
    if (!(spacing.min_distance > 0)) {
        fail_usage("--maximal needs the radii of all points; give the --radius-factor option that "
                   "the samples were made with");
    }
    if (spacing.classes.is_given()) {
        fail_usage("--maximal is for samples without classes");
    }
}

Features features_in(const std::string& path, const std::string& text, const MeshInput& mesh) {
    const std::optional<double> angle = parse_real(text);
    if (!angle || !(*angle >= 1 && *angle <= 180)) {
        fail_input(path, "its header has features of " + in_quotes(text) +
                             ", not an angle of 1 to 180 degrees");
    }
    const MeshView view{mesh.file.positions, mesh.file.triangles, mesh.file.dimension};
    return take(Features::find(view, mesh.prepared, *angle));
}

/// Tells where samples lie among the features of a mesh.
class FeaturePlaces {
  public:
    FeaturePlaces(const Features& features, const PreparedMesh& mesh)
        : edges_(mesh.half_edges()), on_curve_(edges_.size()), at_curve_(mesh.fans().size()) {
        for (const std::uint32_t first : features.edges()) {
            std::uint32_t h = first;
            do {
                on_curve_[h] = true;
                at_curve_[edges_[h].origin] = true;
                at_curve_[edges_[next_in_face(h)].origin] = true;
                h = around_half_edge(edges_[h].around);
            } while (h != first);
        }
    }

    FeatureKind of(const SampleRow& row) const {
        const Sample sample = sample_of(row);
        const std::uint32_t corner = 3 * row.face;
        const FeatureKind kind = feature_of(sample);
        if (kind == FeatureKind::corner) {
            const auto k = static_cast<std::uint32_t>(std::ranges::max_element(sample.weights) -
                                                      sample.weights);
            return at_curve_[edges_[corner + k].origin] ? kind : FeatureKind::face;
        }
        if (kind == FeatureKind::curve) { // Opposite of the corner without weight.
            const auto k = static_cast<std::uint32_t>(std::ranges::min_element(sample.weights) -
                                                      sample.weights);
            return on_curve_[corner + (k + 1) % 3] ? kind : FeatureKind::face;
        }
        return kind;
    }

  private:
    std::span<const HalfEdge> edges_;
    std::vector<bool> on_curve_, at_curve_; ///< Indexed by half-edge and by vertex.
};

/// Returns the rows whose column `feature` is wrong for the angle in the header: marked samples
/// that are not on such a feature of the mesh, and samples without a mark on a corner or before
/// marked ones. Returns none without that column, and without an angle in the header. Throws
/// UserError(bad_input) for an angle out of range.
std::vector<std::uint32_t> wrong_features(const SampleFile& samples, const MeshInput& mesh) {
    std::vector<std::uint32_t> wrong;
    const std::string* const text = samples.header.find("features");
    const auto marks = samples.extra_values(kFeatureColumn);
    if (text == nullptr || marks.size() != samples.rows.size() || !samples.has_faces ||
        mesh.dimension() == 0) {
        return wrong;
    }
    const FeaturePlaces places(features_in(samples.path, *text, mesh), mesh.prepared);
    const auto existing = samples.extra_values(kExistingColumn);
    bool marks_follow = false;
    for (std::size_t i = samples.rows.size(); i-- > 0;) {
        if (!existing.empty() && existing[i] != 0) {
            continue;
        }
        const FeatureKind kind = places.of(samples.rows[i]);
        // A dart on a face may end on a curve by chance.
        const bool may_be_unmarked =
            kind == FeatureKind::face || (kind == FeatureKind::curve && !marks_follow);
        if (marks[i] != static_cast<std::uint32_t>(kind) && !(marks[i] == 0 && may_be_unmarked)) {
            wrong.push_back(static_cast<std::uint32_t>(i));
        }
        marks_follow = marks_follow || marks[i] != 0;
    }
    std::ranges::reverse(wrong);
    return wrong;
}

std::size_t count_outside(const BoxParams& box, const SampleFile& samples) {
    return static_cast<std::size_t>(
        std::count_if(samples.rows.begin(), samples.rows.end(), [&](const SampleRow& row) {
            bool outside = false;
            for (std::size_t axis = 0; axis < box.extents.size(); ++axis) {
                outside |= !(row.position[axis] >= 0 && row.position[axis] <= box.extents[axis]);
            }
            return outside;
        }));
}

std::string result_text(const SampleFile& samples, const BoxCheck& check) {
    const auto& [box, outside, result] = check;
    std::ostringstream out;
    out << "box           " << box_text(box) << '\n'
        << "samples       " << grouped(samples.rows.size()) << " in " << one_line(samples.path)
        << '\n'
        << "min distance  " << rounded(box.min_distance, 9) << '\n'
        << "smallest      " << smallest_text(result, box.min_distance) << '\n';
    print_violations(out, samples, result, "");
    if (outside > 0) {
        out << "outside       " << grouped(outside) << '\n';
    }
    return out.str();
}

/// Checks samples in a box. `min_distance` is that of the command line, or "".
void verify_box(const std::string& path, const std::string& min_distance,
                const OutputOptions& out) {
    check_outputs(out, "", {{"the samples", path}});
    ProgressLine progress(out.quiet);
    progress.begin_stage("reading the samples");
    const SampleFile samples = read_box_samples(path);
    progress.clear();
    const BoxCheck check = check_box(min_distance, samples, progress);
    const auto& [box, outside, result] = check;
    publish(out, report_json(samples, check), result_text(samples, check));
    std::string message = violation_text(result, rounded(box.min_distance, 9));
    if (outside > 0) {
        message += (message.empty() ? "" : ", and ") + counted(outside, "sample", "samples") +
                   (outside == 1 ? " lies" : " lie") + " outside the box";
    }
    if (!message.empty()) {
        throw UserError(ExitCode::violation, path + ": " + message);
    }
}

} // namespace

SampleCheck check_samples(const VerifyOptions& options, const MeshInput& mesh,
                          const SampleFile& samples, std::vector<StrayRow> strays,
                          WantedSpacing spacing, const Avoided& avoided,
                          std::vector<MeshWarning> warnings, ProgressLine& progress,
                          const NotePairs& note) {
    if (options.is_maximal) {
        check_maximal(spacing);
    }
    ExistingSpacing found = measure_spacing(mesh, samples, spacing, progress, note);
    std::vector<Intrusion> intrusions =
        find_intrusions(mesh, samples.rows, samples.extra_values(kExistingColumn),
                        samples.extra_values(kClassColumn), avoided, progress);
    std::optional<GapCheck> gaps;
    if (options.is_maximal) {
        gaps = find_gaps(mesh, samples.rows, spacing.radii, spacing.min_distance, avoided.disks,
                         progress);
    }
    std::vector<LevelSpacing> levels;
    if (options.min_distance.empty() && spacing.is_known) {
        levels = check_levels(samples, mesh, spacing.radii, found.others, progress, note);
    }
    return {options,
            samples,
            mesh,
            std::move(warnings),
            std::move(spacing),
            std::move(strays),
            std::move(found.others),
            std::move(found.among_existing),
            masked_samples(samples, mesh),
            avoided.points,
            avoided.length,
            std::move(intrusions),
            gaps,
            std::move(levels),
            wrong_features(samples, mesh)};
}

BoxCheck check_box(const std::string& min_distance, const SampleFile& samples,
                   ProgressLine& progress) {
    const BoxParams box = box_of(min_distance, samples);
    return {box, count_outside(box, samples), check_box_spacing(box, samples.rows, progress)};
}

std::string report_json(const SampleFile& samples, const BoxCheck& check) {
    const auto& [box, outside, result] = check;
    return text_of(Json{{"version", GEODISK_VERSION_STRING},
                        {"box", {{"extents", box.extents}, {"periodic", box.is_periodic}}},
                        {"samples_file", samples.path},
                        {"samples", samples.rows.size()},
                        {"min_distance", box.min_distance},
                        {"cut", result.cut * box.min_distance},
                        {"smallest", pair_json(result.closest)},
                        {"smallest_ratio", result.closest ? Json(result.closest->ratio) : Json()},
                        {"violations", violations_json(result)},
                        {"outside", outside}});
}

void verify_samples(const VerifyOptions& options, const NotePairs& note) {
    options.check();
    if (options.samples.empty()) {
        verify_box(options.mesh.mesh, options.min_distance, options.out);
        return;
    }
    check_outputs(options.out, "", options.files_read());
    ProgressLine progress(options.out.quiet);
    const MeshInput mesh = load_mesh(options.mesh, progress, options.density, options.mask);
    std::vector<MeshWarning> warnings = mesh.warnings;
    auto [samples, strays] =
        read_samples_on(options.samples, mesh, options.tolerance, warnings, progress);
    warn_of_no_samples(samples, warnings);
    warn_of_other_rows(options, samples, warnings);
    check_class_options(samples, options.mask, options.constraints);
    WantedSpacing spacing = wanted_spacing(options, samples, mesh);
    if (!spacing.is_known && !options.is_maximal) {
        warn_of_unknown_spacing(options, warnings);
    }
    ConstraintOptions constraints = options.constraints;
    constraints.tolerance = options.tolerance;
    const std::size_t before = warnings.size();
    const Avoided avoided = load_avoided(constraints, options.mesh, mesh, warnings, progress);
    for (std::size_t i = before; i < warnings.size(); ++i) {
        print_warning(warnings[i].file + ": " + warnings[i].message);
    }
    const SampleCheck check =
        check_samples(options, mesh, samples, std::move(strays), std::move(spacing), avoided,
                      std::move(warnings), progress, note);
    publish(options.out, report_json(check), report_text(check));
    if (const std::string fault = fault_text(check); !fault.empty()) {
        throw UserError(ExitCode::violation, options.samples + ": " + fault);
    }
}

void add_verify_command(Command app) {
    const Command command =
        app.add_command("verify", "Check the distances of samples (exact, CPU only)");
    const auto options = std::make_shared<VerifyOptions>();
    add_verify_options(command, *options);
    command.has_footer(help_footer(kVerifyExamples));
    command.calls([options] { verify_samples(*options); });
}

} // namespace geodisk::tools
