#include "geodisk/cmd_verify.hpp"

#include <algorithm>
#include <cmath>
#include <iostream>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include <geodisk/params.hpp>
#include <geodisk/version.hpp>

#include "common/file_input.hpp"
#include "common/sample_file.hpp"
#include "common/text.hpp"
#include "common/user_error.hpp"
#include "geodisk/json_text.hpp"
#include "geodisk/mesh_input.hpp"
#include "geodisk/mesh_options.hpp"
#include "geodisk/outputs.hpp"
#include "geodisk/progress.hpp"
#include "geodisk/sample_checks.hpp"
#include "geodisk/spacing_check.hpp"
#include "program/arguments.hpp"
#include "program/human_text.hpp"

namespace geodisk::tools {
namespace {

constexpr std::size_t kNamedViolations = 10;

struct VerifyOptions {
    MeshOptions mesh;
    std::string samples, min_distance, json;
    bool quiet = false;
};

/// A sample of another surface would show as a violation, or worse, would not.
void warn_of_other_surface(const VerifyOptions& options, const SampleFile& samples) {
    const auto lifts_of = [](const auto& entries) {
        std::vector<std::string> lifts;
        for (const auto& [key, value] : entries) {
            if (key == "lift") {
                lifts.push_back(value);
            }
        }
        return lifts;
    };
    const std::vector<std::string> used = lifts_of(samples.header.entries);
    if (used == lifts_of(options.mesh.additions())) {
        return;
    }
    std::string text;
    for (const std::string& lift : used) {
        text += " --lift " + lift;
    }
    print_warning(options.samples + ": made with" + (used.empty() ? " no --lift" : text) +
                  ", which is not what is verified here");
}

double distance_of(const VerifyOptions& options, const SampleFile& samples,
                   const MeshStatistics& mesh) {
    if (!options.min_distance.empty()) {
        return distance_on_mesh(parse_length("--min-distance", options.min_distance), mesh);
    }
    for (const auto& [key, value] : samples.header.entries) {
        if (key != "min_distance") {
            continue;
        }
        const std::optional<double> distance = parse_real(trimmed(value));
        if (!distance || !(*distance > 0) || !std::isfinite(*distance)) {
            fail_input(options.samples,
                       "its header has the minimum distance " + in_quotes(value) +
                           ", which is not a positive number; give --min-distance");
        }
        return *distance;
    }
    throw UserError(ExitCode::usage, options.samples + ": its header has no minimum distance; give "
                                                       "--min-distance");
}

std::string smallest_text(const SpacingResult& spacing, double min_distance) {
    if (!spacing.closest) {
        return "> " + rounded(spacing.cut, 6);
    }
    const double smallest = spacing.closest->distance;
    return rounded(smallest, 9) + ", " + rounded(smallest / min_distance, 9) +
           " of the minimum distance";
}

std::string count_text(std::size_t count, bool is_complete) {
    return (is_complete ? "" : "at least ") + grouped(count);
}

void print_result(std::ostream& out, const VerifyOptions& options, const SampleFile& samples,
                  const MeshStatistics& mesh, double min_distance, const SpacingResult& spacing,
                  const std::vector<StrayRow>& strays) {
    out << "mesh          " << one_line(options.mesh.mesh) << '\n'
        << "samples       " << grouped(samples.rows.size()) << " in " << one_line(options.samples)
        << '\n'
        << "min distance  " << rounded(min_distance, 9) << " in mesh units\n"
        << "rho           "
        << rounded(
               packing_density(mesh.area, min_distance, static_cast<double>(samples.rows.size())),
               3)
        << '\n'
        << "smallest      " << smallest_text(spacing, min_distance) << '\n'
        << "violations    " << count_text(spacing.violations.size(), spacing.is_complete) << '\n';
    for (std::size_t i = 0; i < std::min(spacing.violations.size(), kNamedViolations); ++i) {
        const ClosePair& pair = spacing.violations[i];
        out << "              " << row_text(samples, pair.row_a) << " and "
            << row_text(samples, pair.row_b) << ": " << rounded(pair.distance, 9) << '\n';
    }
    if (!spacing.violations.empty()) {
        out << "too close     " << count_text(spacing.violating_samples(), spacing.is_complete)
            << " of " << counted(samples.rows.size(), "sample", "samples") << '\n';
    }
    if (!strays.empty()) {
        out << "off the mesh  " << grouped(strays.size()) << '\n';
    }
    for (std::size_t i = 0; i < std::min(strays.size(), kNamedViolations); ++i) {
        out << "              " << row_text(samples, strays[i].row) << ": "
            << offset_text(strays[i]) << '\n';
    }
}

std::string report_text(const VerifyOptions& options, const SampleFile& samples,
                        const MeshStatistics& mesh, double min_distance,
                        const SpacingResult& spacing, const std::vector<StrayRow>& strays) {
    const double rho =
        packing_density(mesh.area, min_distance, static_cast<double>(samples.rows.size()));
    return text_of(Json{{"version", GEODISK_VERSION_STRING},
                        {"mesh", options.mesh.mesh},
                        {"samples_file", options.samples},
                        {"samples", samples.rows.size()},
                        {"min_distance", min_distance},
                        {"rho", rho},
                        {"cut", spacing.cut},
                        {"smallest", pair_json(samples, spacing.closest)},
                        {"violations",
                         {{"pairs", spacing.violations.size()},
                          {"samples", spacing.violating_samples()},
                          {"complete", spacing.is_complete}}},
                        {"off_the_mesh", strays.size()}});
}

/// Before the work: whether the report can be written.
void check_report(const VerifyOptions& options) {
    std::vector<NamedFile> read{{"the samples", options.samples}};
    for (const std::string& file : options.mesh.files()) {
        read.push_back({"the mesh", file});
    }
    check_distinct({{"the report", options.json}}, read);
    check_report_path(options.json);
}

void fail_on_violations(const VerifyOptions& options, double min_distance,
                        const SpacingResult& spacing, const std::vector<StrayRow>& strays) {
    std::string message;
    if (const std::size_t count = spacing.violations.size(); count > 0) {
        message = count_text(count, spacing.is_complete) +
                  (count == 1 ? " pair of samples is" : " pairs of samples are") + " closer than " +
                  rounded(min_distance, 9);
    }
    if (const std::size_t count = strays.size(); count > 0) {
        message += (message.empty() ? "" : ", and ") + grouped(count) +
                   (count == 1 ? " position does" : " positions do") +
                   " not agree with face and weights";
    }
    if (!message.empty()) {
        throw UserError(ExitCode::violation, options.samples + ": " + message);
    }
}

void run_verify(const VerifyOptions& options) {
    if (!options.min_distance.empty()) {
        parse_length("--min-distance", options.min_distance); // Before the files are read.
    }
    check_report(options);
    ProgressLine progress(options.quiet);
    const MeshInput mesh = load_mesh(options.mesh, progress);
    progress.begin_stage("reading the samples");
    const SampleFile samples = read_samples(options.samples);
    progress.clear();
    const MeshStatistics& statistics = mesh.prepared.statistics();
    const double min_distance = distance_of(options, samples, statistics);
    check_rows(options.samples, samples, options.mesh.mesh, mesh);
    warn_of_other_surface(options, samples);

    const std::vector<StrayRow> strays = find_strays(samples, mesh);
    const SpacingResult spacing = check_spacing(mesh, samples.rows, min_distance, progress);
    ReportFile report(options.json,
                      report_text(options, samples, statistics, min_distance, spacing, strays));
    report.commit();
    if (!options.quiet && options.json != "-") {
        print_result(std::cout, options, samples, statistics, min_distance, spacing, strays);
        flush_or_fail("the result");
    }
    fail_on_violations(options, min_distance, spacing, strays);
}

} // namespace

void add_verify_command(CLI::App& app) {
    CLI::App* command = app.add_subcommand(
        "verify", "Check the distances in a sample file, exactly and without a device");
    const auto options = std::make_shared<VerifyOptions>();
    add_mesh_argument(*command, options->mesh, "Mesh they were made on");
    command->add_option("SAMPLES", options->samples, "Samples to check: *.ply or *.csv")
        ->type_name("")
        ->required();
    command
        ->add_option("-d,--min-distance", options->min_distance,
                     "Least distance along the surface, in mesh units,\n"
                     "or with % of the bounding-box diagonal;\n"
                     "without it, that of the file's header")
        ->type_name("D");
    add_mesh_options(*command, options->mesh);
    command->add_option("--json", options->json, "Write a report as JSON, - for standard output")
        ->type_name("FILE");
    command->add_flag("-q,--quiet", options->quiet,
                      "No progress and no result but the exit status");
    command->callback([options] { run_verify(*options); });
}

} // namespace geodisk::tools
