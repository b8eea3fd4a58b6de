#include "geodisk/cmd_verify.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <iostream>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include <geodisk/params.hpp>

#include "common/file_input.hpp"
#include "common/sample_file.hpp"
#include "common/text.hpp"
#include "common/user_error.hpp"
#include "geodisk/mesh_input.hpp"
#include "geodisk/mesh_options.hpp"
#include "geodisk/progress.hpp"
#include "geodisk/spacing_check.hpp"
#include "program/arguments.hpp"
#include "program/human_text.hpp"

namespace geodisk::tools {
namespace {

constexpr std::size_t kNamedViolations = 10;

struct VerifyOptions {
    MeshOptions mesh;
    std::string samples, min_distance;
    bool quiet = false;
};

/// A sample whose position is not where its face and weights put it.
struct StrayRow {
    std::uint32_t row;
    double offset;
};

std::string row_text(const SampleFile& samples, std::uint32_t row) {
    return "sample " + std::to_string(row) + " (candidate " +
           std::to_string(samples.rows[row].candidate) + ")";
}

std::string coordinates_text(std::uint32_t dimension) {
    return dimension == 0 ? "no coordinates" : std::to_string(dimension) + " coordinates";
}

void check_dimensions(const VerifyOptions& options, const SampleFile& samples,
                      const MeshInput& mesh) {
    if (samples.dimension != mesh.dimension()) {
        fail_input(options.samples, "its samples have " + coordinates_text(samples.dimension) +
                                        ", the vertices of " + options.mesh.mesh + " have " +
                                        coordinates_text(mesh.dimension()));
    }
}

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

/// The rows must at least name points of the mesh.
void check_rows(const VerifyOptions& options, const SampleFile& samples, const MeshInput& mesh) {
    constexpr double kTolerance = 1e-5; // Of weights that other programs rounded.
    for (std::uint32_t i = 0; i < samples.rows.size(); ++i) {
        const SampleRow& row = samples.rows[i];
        if (row.face >= mesh.prepared.face_count()) {
            fail_input(options.samples,
                       row_text(samples, i) + ": face " + std::to_string(row.face) +
                           " is out of range, " + options.mesh.mesh + " has " +
                           counted(mesh.prepared.face_count(), "triangle", "triangles"));
        }
        double sum = 0;
        double least = 1;
        for (const double weight : row.bary) {
            sum += weight;
            least = std::min(least, weight);
        }
        if (!(least >= -kTolerance && std::abs(sum - 1) <= kTolerance)) {
            fail_input(options.samples, row_text(samples, i) +
                                            ": the weights are not those of a point in a triangle");
        }
    }
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

/// Without coordinates there is nothing to be off.
std::vector<StrayRow> find_strays(const SampleFile& samples, const MeshInput& mesh) {
    double largest = 0;
    double diagonal = 0;
    for (std::size_t axis = 0; axis < mesh.dimension(); ++axis) {
        double low = HUGE_VAL, high = -HUGE_VAL;
        for (const std::uint32_t vertex : mesh.file.triangles) {
            const double x = mesh.file.positions[std::size_t{vertex} * mesh.dimension() + axis];
            low = std::min(low, x);
            high = std::max(high, x);
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

std::string smallest_text(const SpacingResult& spacing, double min_distance) {
    if (spacing.smallest > spacing.cut) {
        return "> " + rounded(spacing.cut, 6);
    }
    return rounded(spacing.smallest, 9) + ", " + rounded(spacing.smallest / min_distance, 9) +
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
    if (!strays.empty()) {
        out << "off the mesh  " << grouped(strays.size()) << '\n';
    }
    for (std::size_t i = 0; i < std::min(strays.size(), kNamedViolations); ++i) {
        out << "              " << row_text(samples, strays[i].row) << ": "
            << rounded(strays[i].offset, 3) << " away from where its face and weights put it\n";
    }
    out.flush();
    if (!out) {
        throw UserError(ExitCode::bad_output, "the result cannot be written to standard output");
    }
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
    ProgressLine progress(options.quiet);
    const MeshInput mesh = load_mesh(options.mesh, progress);
    progress.begin_stage("reading the samples");
    const SampleFile samples = read_samples(options.samples);
    progress.clear();
    const MeshStatistics& statistics = mesh.prepared.statistics();
    const double min_distance = distance_of(options, samples, statistics);
    check_dimensions(options, samples, mesh);
    check_rows(options, samples, mesh);
    warn_of_other_surface(options, samples);

    const std::vector<StrayRow> strays = find_strays(samples, mesh);
    const SpacingResult spacing = check_spacing(mesh, samples.rows, min_distance, progress);
    if (!options.quiet) {
        print_result(std::cout, options, samples, statistics, min_distance, spacing, strays);
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
    command->add_flag("-q,--quiet", options->quiet,
                      "No progress and no result but the exit status");
    command->callback([options] { run_verify(*options); });
}

} // namespace geodisk::tools
