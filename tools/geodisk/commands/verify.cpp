
#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include <geodisk/params.hpp>
#include <geodisk/version.hpp>

#include "files/input_file.hpp"
#include "files/sample_columns.hpp"
#include "files/sample_file.hpp"
#include "geodisk/checks/feature_checks.hpp"
#include "geodisk/checks/gaps.hpp"
#include "geodisk/checks/intrusions.hpp"
#include "geodisk/checks/level_checks.hpp"
#include "geodisk/checks/sample_checks.hpp"
#include "geodisk/checks/sample_input.hpp"
#include "geodisk/checks/spacing.hpp"
#include "geodisk/commands/commands.hpp"
#include "geodisk/commands/help_text.hpp"
#include "geodisk/inputs/given_input.hpp"
#include "geodisk/inputs/mesh_input.hpp"
#include "geodisk/options/class_options.hpp"
#include "geodisk/options/constraint_options.hpp"
#include "geodisk/options/mesh_options.hpp"
#include "geodisk/options/tolerance_option.hpp"
#include "geodisk/outputs/outputs.hpp"
#include "geodisk/outputs/progress.hpp"
#include "geodisk/reports/json.hpp"
#include "geodisk/reports/mesh_report.hpp"
#include "program/arguments.hpp"
#include "program/command.hpp"
#include "program/failure.hpp"
#include "program/human_text.hpp"

namespace geodisk::tools {
namespace {

constexpr const char* kExamples[] = {
    "geodisk verify bunny.obj points.csv",
    "geodisk verify bunny.obj points.csv --min-distance 0.01",
    "geodisk verify box.csv",
};

constexpr std::size_t kNamedStrays = 10;

struct VerifyOptions {
    MeshOptions mesh;
    DensityOptions density;
    MaskOptions mask;
    ConstraintOptions constraints; ///< Points to avoid.
    std::string samples, min_distance, tolerance, classes;
    bool is_maximal = false; ///< Look for gaps as well.
    OutputOptions out;       ///< No samples.

    /// What makes the surface and the radii on it, as the header of a sample file names it.
    HeaderEntries additions() const {
        return with_entries(density.added_to(mesh.additions()), mask);
    }
};

/// Of two samples with the largest radius.
double distance_of(const VerifyOptions& options, const SampleFile& samples, const MeshInput& mesh) {
    const double given =
        options.min_distance.empty()
            ? header_distance(options.samples, samples.header)
            : distance_on_mesh(parse_length("--min-distance", options.min_distance),
                               mesh.prepared.statistics());
    return given / mesh.distance_part;
}

/// Returns the classes that the options say, or else the header; none if a distance is given alone.
ClassTable classes_of(const VerifyOptions& options, const SampleFile& samples) {
    if (!options.classes.empty()) {
        return parse_classes(options.classes);
    }
    const std::string* const entry = samples.header.find("classes");
    if (entry == nullptr || !options.min_distance.empty()) {
        return {};
    }
    if (names_class_file(*entry)) {
        fail_input(options.samples, "its header has the classes " + in_quotes(*entry) +
                                        ", which are none; give --classes");
    }
    return parse_classes(*entry);
}

/// Checks that every sample has one of the classes.
void check_classes(const std::string& path, const SampleFile& samples, std::size_t count) {
    const auto values = samples.extra_values(kClassColumn);
    if (values.size() != samples.rows.size()) {
        fail_input(path, "has no column class, so its classes cannot be verified; give "
                         "--min-distance to check one distance for all");
    }
    for (std::size_t i = 0; i < values.size(); ++i) {
        if (values[i] >= count) {
            fail_input(path, "sample " + std::to_string(i) + ": its class is " +
                                 std::to_string(values[i]) + ", but there are " +
                                 std::to_string(count) + ", numbered from 0");
        }
    }
}

/// How far samples must be apart.
struct Spacing {
    ClassTable classes;
    double min_distance = 0; ///< Of all pairs, or of two with the largest radius; 0 if not known.
    bool radii_vary = false;
    std::vector<double> radii; ///< By row.
    std::size_t wrong = 0;     ///< Rows whose own radius is another.
};

/// With density options the radii are computed again; without, those of the file count, unless a
/// distance is given.
Spacing spacing_of(const VerifyOptions& options, const SampleFile& samples, const MeshInput& mesh) {
    Spacing spacing;
    spacing.classes = classes_of(options, samples);
    if (spacing.classes.is_given()) {
        check_classes(options.samples, samples, spacing.classes.count);
        spacing.min_distance = spacing.classes.distances.empty()
                                   ? distance_of(options, samples, mesh)
                                   : spacing.classes.largest() / mesh.distance_part;
        return spacing;
    }
    spacing.radii_vary = mesh.radii || (has_radii(samples.rows) && options.min_distance.empty());
    if (mesh.radii || !spacing.radii_vary) {
        spacing.min_distance = distance_of(options, samples, mesh);
    }
    constexpr double kSame = 1e-6; // Of radii that other programs rounded.
    for (const SampleRow& row : samples.rows) {
        const double radius = mesh.radii ? mesh.radius(row.face, row.bary, spacing.min_distance)
                              : spacing.radii_vary ? row.radius
                                                   : spacing.min_distance / 2;
        if (mesh.radii && row.radius > 0 && !(std::abs(row.radius - radius) <= kSame * radius)) {
            ++spacing.wrong;
        }
        spacing.radii.push_back(radius);
    }
    return spacing;
}

/// What a check was given and what it found.
struct Check {
    const VerifyOptions& options;
    const SampleFile& samples;
    const MeshInput& mesh;
    std::vector<MeshWarning> warnings;
    Spacing spacing;
    std::vector<StrayRow> strays;
    SpacingResult result;              ///< Of all pairs but these:
    SpacingResult among_given;         ///< Of samples that were given.
    std::vector<std::uint32_t> masked; ///< Samples on faces that take none.
    std::size_t avoided = 0;           ///< Number of points to avoid.
    std::vector<Intrusion> intrusions;
    std::optional<GapCheck> gaps;
    std::vector<LevelSpacing> levels;          ///< Of samples in progressive order.
    std::vector<std::uint32_t> wrong_features; ///< Samples whose mark as feature is wrong.

    /// Number of samples that were given.
    std::size_t given() const {
        const auto values = samples.extra_values(kGivenColumn);
        return static_cast<std::size_t>(
            std::ranges::count_if(values, [](auto v) { return v != 0; }));
    }
    /// Of samples that a distance is known of.
    double rho() const {
        SampleParams params = mesh.with_fields({});
        const std::vector<float> factors = spacing.classes.factors();
        params.class_factors = factors;
        return packing_density(effective_area(mesh.prepared, params), spacing.min_distance,
                               static_cast<double>(samples.rows.size()));
    }
    /// Number of samples of each class.
    std::vector<std::size_t> class_counts() const {
        std::vector<std::size_t> counts(spacing.classes.count);
        const auto values = samples.extra_values(kClassColumn);
        for (std::size_t i = 0; i < values.size() && !counts.empty(); ++i) {
            ++counts[values[i]];
        }
        return counts;
    }
    /// What the distance of a pair is a part of.
    std::string least_text() const {
        return spacing.classes.is_given() ? "the distance of their classes"
               : spacing.radii_vary       ? "the sum of their radii"
                                          : rounded(spacing.min_distance, 9);
    }
};

std::string smallest_text(const Check& check) {
    const SpacingResult& result = check.result;
    if (check.spacing.radii_vary || check.spacing.classes.is_given()) {
        return (result.closest ? rounded(result.closest->ratio, 9)
                               : "> " + rounded(result.cut, 6)) +
               (check.spacing.radii_vary ? " of the sum of two radii"
                                         : " of the distance of two classes");
    }
    return smallest_text(result, check.spacing.min_distance);
}

std::string result_text(const Check& check) {
    const Spacing& spacing = check.spacing;
    const std::vector<StrayRow>& strays = check.strays;
    std::ostringstream out;
    out << mesh_lines("mesh", check.options.mesh.mesh, check.options.additions(), check.mesh)
        << "samples       " << grouped(check.samples.rows.size()) << " in "
        << one_line(check.options.samples) << '\n';
    if (spacing.min_distance > 0) {
        out << "min distance  " << rounded(spacing.min_distance * check.mesh.distance_part, 9)
            << " in mesh units\n"
            << "rho           " << rounded(check.rho(), 3) << '\n';
    }
    if (spacing.radii_vary && !spacing.radii.empty()) {
        const auto [least, most] = std::minmax_element(spacing.radii.begin(), spacing.radii.end());
        out << "radii         " << rounded(*least, 9) << " to " << rounded(*most, 9)
            << (check.mesh.radii ? "" : ", as the file has them") << '\n';
    }
    out << "smallest      " << smallest_text(check) << '\n';
    if (spacing.classes.is_given()) {
        std::string counts;
        for (const std::size_t count : check.class_counts()) {
            counts += (counts.empty() ? "" : ", ") + grouped(count);
        }
        out << "classes       " << counts << " samples\n";
    }
    const bool has_ratios = spacing.radii_vary || spacing.classes.is_given();
    print_violations(out, check.samples, check.result, has_ratios ? check.least_text() : "");
    out << level_lines(check.levels);
    if (const std::size_t given = check.given(); given > 0) {
        const std::size_t pairs = check.among_given.violations.size();
        out << "given         " << grouped(given) << " of them"
            << (pairs == 0 ? ""
                           : "; " + counted(pairs, "pair", "pairs") +
                                 " among these too close, no violation")
            << '\n';
    }
    if (check.avoided > 0) {
        out << "avoided       " << counted(check.avoided, "point", "points") << "; "
            << counted(check.intrusions.size(), "sample", "samples") << " within the radii\n";
    }
    for (std::size_t i = 0; i < std::min(check.intrusions.size(), kNamedStrays); ++i) {
        const Intrusion& one = check.intrusions[i];
        out << "              "
            << "sample " << one.row << ": " << rounded(one.distance, 9) << " from point "
            << one.point << '\n';
    }
    if (check.gaps) {
        out << "largest gap   " << gap_text(*check.gaps, check.mesh) << '\n';
    }
    if (spacing.wrong > 0) {
        out << "wrong radii   " << grouped(spacing.wrong) << '\n';
    }
    if (!check.wrong_features.empty()) {
        out << "features      " << grouped(check.wrong_features.size())
            << " with a wrong mark, first sample " << check.wrong_features.front() << '\n';
    }
    if (!check.masked.empty()) {
        out << "masked        " << grouped(check.masked.size()) << " on faces that "
            << check.options.mask.names() << " left out, first sample " << check.masked.front()
            << '\n';
    }
    if (!strays.empty()) {
        out << "off the mesh  " << grouped(strays.size()) << '\n';
    }
    for (std::size_t i = 0; i < std::min(strays.size(), kNamedStrays); ++i) {
        out << "              "
            << "sample " << strays[i].row << ": "
            << (check.samples.has_faces ? offset_text(strays[i])
                                        : rounded(strays[i].offset, 3) + " away from the surface")
            << '\n';
    }
    return out.str();
}

Json intrusions_json(const std::vector<Intrusion>& intrusions) {
    Json rows = Json::array(), points = Json::array(), distances = Json::array();
    for (const Intrusion& one : intrusions) {
        rows.push_back(one.row);
        points.push_back(one.point);
        distances.push_back(one.distance);
    }
    return {{"count", intrusions.size()},
            {"rows", std::move(rows)},
            {"points", std::move(points)},
            {"distances", std::move(distances)}};
}

std::string report_text(const Check& check) {
    const auto& [options, samples, mesh, warnings, spacing, strays, result, among_given, masked,
                 avoided, intrusions, gaps, levels, features] = check;
    const std::size_t given = check.given();
    const bool has_distance = spacing.min_distance > 0;
    return text_of(Json{
        {"version", GEODISK_VERSION_STRING},
        {"mesh", mesh_json(options.mesh.mesh, options.additions(), mesh)},
        {"warnings", warnings_json(warnings)},
        {"samples_file", options.samples},
        {"samples", samples.rows.size()},
        {"min_distance",
         has_distance ? Json(spacing.min_distance * check.mesh.distance_part) : Json(nullptr)},
        {"rho", has_distance ? Json(check.rho()) : Json(nullptr)},
        {"radii_vary", spacing.radii_vary},
        {"classes", spacing.classes.is_given() ? Json(check.class_counts()) : Json(nullptr)},
        {"cut", spacing.radii_vary ? Json(nullptr) : Json(result.cut * spacing.min_distance)},
        {"smallest", pair_json(result.closest)},
        {"smallest_ratio", result.closest ? Json(result.closest->ratio) : Json(nullptr)},
        {"violations", violations_json(result)},
        {"given", given == 0
                      ? Json(nullptr)
                      : Json{{"samples", given}, {"violations", violations_json(among_given)}}},
        {"avoided", avoided == 0
                        ? Json(nullptr)
                        : Json{{"points", avoided}, {"intrusions", intrusions_json(intrusions)}}},
        {"maximal", gap_json(gaps)},
        {"levels", levels_json(levels)},
        {"wrong_radii", spacing.wrong},
        {"wrong_features", features.size()},
        {"masked", mesh.face_mask.empty() ? Json(nullptr) : Json(masked.size())},
        {"off_the_mesh", strays.size()}});
}

/// Before the work: whether the report can be written.
void check_files(const VerifyOptions& options) {
    std::vector<NamedFile> read{{"the samples", options.samples}};
    options.mesh.add_files(read, "the mesh");
    options.density.add_files(read, "the density");
    options.mask.add_files(read);
    options.constraints.add_files(read);
    add_class_file(options.classes, read);
    check_outputs(options.out, "", read);
}

void fail_on_violations(const Check& check) {
    const Spacing& spacing = check.spacing;
    std::string message = violation_text(check.result, check.least_text());
    const auto add = [&message](std::size_t count, const std::string& one, const std::string& many,
                                const char* what) {
        if (count > 0) {
            message += (message.empty() ? "" : ", and ") + counted(count, one, many) + what;
        }
    };
    if (const std::string fault = level_fault(check.levels);
        !fault.empty() && check.result.violations.empty()) {
        message = fault;
    }
    if (check.samples.has_faces) {
        add(check.strays.size(), "position does", "positions do",
            " not agree with face and weights");
    } else {
        add(check.strays.size(), "point lies", "points lie",
            " farther off the mesh than --tolerance allows");
    }
    add(check.intrusions.size(), "sample is", "samples are",
        " within the radius of a point to avoid");
    add(spacing.wrong, "radius is", "radii are", " not what the density options give");
    add(check.wrong_features.size(), "sample has", "samples have",
        " a wrong mark in the column feature");
    add(check.masked.size(), "sample is", "samples are",
        (" on faces that " + check.options.mask.names() + " left out").c_str());
    if (check.gaps && !check.gaps->is_maximal()) {
        message += (message.empty() ? "" : ", and ") +
                   std::string("the set is not maximal, a sample fits in ") +
                   uncovered_text(*check.gaps, check.mesh);
    }
    if (!message.empty()) {
        throw UserError(ExitCode::violation, check.options.samples + ": " + message);
    }
}

/// A single file must be one of samples in a box, which has nothing of a surface.
void check_box(const VerifyOptions& options) {
    const std::string extension = lower_extension(options.mesh.mesh);
    constexpr std::string_view kOfSamples = ".ply .csv .xyz .npz .pcd "; // And of no mesh alone.
    const bool is_known =
        options.mesh.mesh == "-" ||
        (!extension.empty() && kOfSamples.find(extension + ' ') != std::string_view::npos);
    if (!is_known) {
        fail_usage("SAMPLES is required, except for samples in a box, which need no mesh");
    }
    if (!options.mesh.additions().empty() || options.density.is_given() ||
        options.mask.is_given() || options.constraints.is_given() || !options.classes.empty() ||
        options.is_maximal) {
        fail_usage(
            "options for surfaces need MESH and SAMPLES; a single file must hold samples in a box");
    }
}

void check_class_options(const VerifyOptions& options) {
    const ClassTable classes = parse_classes(options.classes);
    if (classes.is_given() && options.density.is_given()) {
        fail_usage("--classes takes no radii that vary, so neither --density nor --radius-factor");
    }
    if (!classes.distances.empty() && !options.min_distance.empty()) {
        fail_usage("the table of --classes has all distances, so it takes no --min-distance");
    }
}

void run_verify(const VerifyOptions& options) {
    if (!options.min_distance.empty()) {
        parse_length("--min-distance", options.min_distance); // Before the files are read.
    }
    check_tolerance(options.tolerance);
    options.mask.only_rules();
    options.mask.mask_rules();
    options.constraints.parsed_avoid();
    check_class_options(options);
    if (options.samples.empty()) {
        check_box(options);
        verify_box(options.mesh.mesh, options.min_distance, options.out);
        return;
    }
    check_files(options);
    ProgressLine progress(options.out.quiet);
    const MeshInput mesh = load_mesh(options.mesh, progress, options.density, options.mask);
    std::vector<MeshWarning> warnings = mesh.warnings;
    const HeaderEntries additions = options.mesh.additions();
    auto [samples, strays] = read_samples_on(options.samples, options.mesh.mesh, mesh, &additions,
                                             options.tolerance, warnings, progress);
    Spacing spacing = spacing_of(options, samples, mesh);
    if (options.is_maximal && !(spacing.min_distance > 0)) {
        fail_usage("--maximal needs the radii of all points; give the --radius-factor option that "
                   "the samples were made with");
    }
    if (options.is_maximal && spacing.classes.is_given()) {
        fail_usage("--maximal is for samples without classes");
    }
    PairDistances distances{spacing.radii};
    if (spacing.classes.is_given()) {
        distances = {{}, samples.extra_values(kClassColumn), spacing.classes, spacing.min_distance};
    }
    GivenSpacing found =
        check_spacing(mesh, samples.rows, distances, samples.extra_values(kGivenColumn), progress);
    ConstraintOptions constraints = options.constraints;
    constraints.tolerance = options.tolerance;
    const std::size_t before = warnings.size();
    const std::vector<KeepOut> avoided =
        load_avoided(constraints, options.mesh, mesh, warnings, progress);
    for (std::size_t i = before; i < warnings.size(); ++i) {
        print_warning(warnings[i].file + ": " + warnings[i].message);
    }
    std::vector<Intrusion> intrusions =
        find_intrusions(mesh, samples.rows, samples.extra_values(kGivenColumn), avoided, progress);
    std::optional<GapCheck> gaps;
    if (options.is_maximal) {
        gaps =
            find_gaps(mesh, samples.rows, spacing.radii, spacing.min_distance, avoided, progress);
    }
    std::vector<LevelSpacing> levels;
    if (options.min_distance.empty()) {
        levels =
            check_levels(options.samples, samples, mesh, spacing.radii, found.others, progress);
    }
    const Check check{options,
                      samples,
                      mesh,
                      std::move(warnings),
                      std::move(spacing),
                      std::move(strays),
                      std::move(found.others),
                      std::move(found.among_given),
                      masked_samples(samples, mesh),
                      avoided.size(),
                      std::move(intrusions),
                      std::move(gaps),
                      std::move(levels),
                      wrong_features(options.samples, samples, mesh)};
    publish(options.out, report_text(check), result_text(check));
    fail_on_violations(check);
}

} // namespace

void add_verify_command(Command app) {
    const Command command =
        app.add_command("verify", "Check the distances of samples (exact, CPU only)");
    const auto options = std::make_shared<VerifyOptions>();
    add_mesh_argument(command, options->mesh,
                      "Mesh that the samples were made on; or, without SAMPLES,\n"
                      "samples of geodisk box");
    command.add_option("SAMPLES", options->samples, "",
                       "Samples to check: *.ply, *.csv or *.pcd, or points of another\n"
                       "program, also *.obj and *.xyz");
    command.add_option("-d,--min-distance", options->min_distance, "D",
                       "Minimum distance along the surface, in mesh units or % of the\n"
                       "bounding-box diagonal (default: radii in the file, else the\n"
                       "distance in its header)");
    command.add_flag("--maximal", options->is_maximal,
                     "Check that no further sample fits, and tell the largest gap");
    add_avoid_option(command, options->constraints);
    add_class_option(command, options->classes);
    add_tolerance_option(command, options->tolerance);
    add_mesh_options(command, options->mesh);
    add_density_options(command, options->density);
    add_mask_options(command, options->mask);
    add_json_option(command, options->out);
    add_quiet_option(command, options->out, "No progress, no result; only the exit status");
    command.has_footer(help_footer(kExamples));
    command.calls([options] { run_verify(*options); });
}

} // namespace geodisk::tools
