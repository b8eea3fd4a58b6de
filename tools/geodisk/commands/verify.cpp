#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "files/samples/sample_columns.hpp"
#include "files/samples/sample_file.hpp"
#include "geodisk/checks/feature_checks.hpp"
#include "geodisk/checks/gaps.hpp"
#include "geodisk/checks/intrusions.hpp"
#include "geodisk/checks/level_checks.hpp"
#include "geodisk/checks/sample_checks.hpp"
#include "geodisk/checks/sample_classes.hpp"
#include "geodisk/checks/sample_input.hpp"
#include "geodisk/checks/spacing.hpp"
#include "geodisk/checks/wanted_spacing.hpp"
#include "geodisk/commands/commands.hpp"
#include "geodisk/commands/help_text.hpp"
#include "geodisk/commands/verify.hpp"
#include "geodisk/inputs/existing_input.hpp"
#include "geodisk/inputs/mesh_input.hpp"
#include "geodisk/options/verify_options.hpp"
#include "geodisk/outputs/outputs.hpp"
#include "geodisk/outputs/progress.hpp"
#include "geodisk/reports/verify_report.hpp"
#include "program/command.hpp"
#include "program/failure.hpp"

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
