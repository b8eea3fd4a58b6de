#include <algorithm>
#include <cmath>
#include <filesystem>
#include <memory>
#include <numbers>
#include <string>
#include <system_error>
#include <vector>

#include <geodisk/version.hpp>

#include "analysis/surface_spectrum.hpp"
#include "files/input_file.hpp"
#include "files/ply_file.hpp"
#include "files/samples/sample_file.hpp"
#include "geodisk/checks/sample_checks.hpp"
#include "geodisk/checks/sample_input.hpp"
#include "geodisk/commands/commands.hpp"
#include "geodisk/commands/help_text.hpp"
#include "geodisk/inputs/mesh_input.hpp"
#include "geodisk/options/spectrum_options.hpp"
#include "geodisk/outputs/outputs.hpp"
#include "geodisk/reports/json.hpp"
#include "geodisk/reports/mesh_report.hpp"
#include "geodisk/reports/spectrum_report.hpp"
#include "geodisk/spectrum_run.hpp"
#include "program/command.hpp"
#include "program/failure.hpp"
#include "program/human_text.hpp"

namespace geodisk::tools {
namespace {

constexpr const char* kSpectrumExamples[] = {
    "geodisk spectrum bunny.obj points.csv --harmonics 200 -o spectrum.csv",
    "geodisk spectrum box.csv -o spectrum.png",
};

using analysis::PlacedSamples;
using analysis::SurfaceSpectrum;

/// Frequency at which the power of blue noise has gone up and down once.
constexpr double kWantedReach = 2;

void check_surface_spectrum_path(const Path& path) {
    if (lower_extension(path) != ".csv" && !output_stream(path)) {
        fail_usage(path.string() + ": spectra of surfaces are written as *.csv, the radial mean "
                                   "and anisotropy; they have no directions to show in a picture");
    }
    check_writable(path);
}

/// By extension, or what a PLY header says. A pipe is not read for that.
bool are_box_samples(const std::string& path) {
    const std::string extension = lower_extension(path);
    std::error_code ignored;
    if (extension != ".ply" || !std::filesystem::is_regular_file(Path(path), ignored)) {
        return extension == ".csv";
    }
    const PlyFile file(path);
    return std::any_of(file.comments().begin(), file.comments().end(),
                       [](const std::string& comment) { return comment.starts_with("box:"); });
}

/// The sets of all files, and the distance that they have in common.
struct SurfaceSets {
    std::vector<PlacedSamples> sets;
    double samples = 0, min_distance = 0;
};

SurfaceSets read_sets(const SpectrumOptions& options, const MeshInput& mesh,
                      std::vector<MeshWarning>& warnings, ProgressLine& progress) {
    SurfaceSets result;
    for (const std::string& path : options.samples) {
        const SampleFile file =
            read_samples_exactly_on(path, mesh, options.tolerance, warnings, progress);
        if (file.rows.empty()) {
            fail_input(path, "has no samples");
        }
        PlacedSamples& places = result.sets.emplace_back();
        const SampleDisks samples =
            sample_disks(file, mesh, options.distance.parsed(), warnings, progress);
        for (const SurfaceDisk& disk : samples.disks) {
            // All classes together have the largest distance for a unit.
            const double min_distance = samples.classes.count > 0
                                            ? std::ranges::max(samples.classes.distances)
                                            : 2 * disk.radius;
            if (result.min_distance == 0) {
                result.min_distance = min_distance;
            }
            check_same_distance(path, min_distance, options.samples.front(), result.min_distance);
            places.push_back({disk.face, disk.weight1, disk.weight2});
        }
        result.samples += static_cast<double>(places.size());
    }
    result.samples /= static_cast<double>(result.sets.size());
    return result;
}

std::string harmonics_line(const SurfaceSpectrum& spectrum, double min_distance, double seconds) {
    const double reach = spectrum.frequencies.back() * min_distance;
    std::string line = "harmonics     " + grouped(spectrum.frequencies.size()) + " up to " +
                       rounded(reach, 3) + " waves per minimum distance, in " +
                       seconds_text(seconds);
    if (reach < kWantedReach) {
        // Weyl's law.
        const double wanted =
            std::numbers::pi * spectrum.area * std::pow(kWantedReach / min_distance, 2);
        line += "; up to " + rounded(kWantedReach, 2) + " takes --harmonics " +
                fixed(std::ceil(wanted / 100) * 100, 0);
    }
    return line + '\n';
}

void spectrum_of_surface(const SpectrumOptions& options) {
    if (!options.reach.empty()) {
        fail_usage("--reach is for samples in boxes; on a mesh, give --harmonics");
    }
    parse_harmonics(options.harmonics); // Before the files are read.
    check_tolerance(options.tolerance);
    options.distance.parsed();
    std::vector<NamedFile> read;
    for (const std::string& samples : options.samples) {
        read.push_back({"the samples", samples});
    }
    options.mesh.add_files(read, "the mesh");
    check_outputs(options.out, "the spectrum", read, check_surface_spectrum_path);
    ProgressLine progress(options.out.quiet);
    const MeshInput mesh = load_mesh(options.mesh, progress);
    std::vector<MeshWarning> warnings = mesh.warnings;
    const SurfaceSets sets = read_sets(options, mesh, warnings, progress);
    const SpectrumRun run =
        compute_spectrum_on(mesh, sets.sets, options.harmonics, warnings, progress);
    const SurfaceSpectrum& spectrum = run.spectrum;

    const SpectrumReport report{options.samples, sets.samples, sets.min_distance, spectrum.rings(),
                                2.0 / static_cast<double>(sets.sets.size())};
    Json json{{"version", GEODISK_VERSION_STRING},
              {"mesh", mesh_json(mesh)},
              {"warnings", warnings_json(warnings)},
              {"harmonics",
               {{"count", spectrum.frequencies.size()},
                {"highest_frequency", spectrum.frequencies.back() * sets.min_distance},
                {"seconds", run.seconds},
                {"expected_seconds", run.expected_seconds},
                {"expected_bytes", run.expected_bytes}}}};
    report.add_to(json);
    const std::string text = mesh_lines("mesh", mesh) +
                             harmonics_line(spectrum, sets.min_distance, run.seconds) +
                             report.text();
    if (options.out.output.empty()) {
        publish(options.out, text_of(json), text);
        return;
    }
    AtomicFile file(options.out.output);
    file.write(report.csv());
    file.sync();
    publish(options.out, {&file}, text_of(json), text);
}

} // namespace

void add_spectrum_command(Command app) {
    const Command command =
        app.add_command("spectrum", "Compute the power spectrum of samples on a mesh or in a box");
    const auto options = std::make_shared<SpectrumOptions>();
    const auto files = std::make_shared<std::vector<std::string>>();
    add_spectrum_options(command, *options, *files);
    command.has_footer(help_footer(kSpectrumExamples));
    command.calls([options, files] {
        if ((files->size() == 1 && files->front() == "-") || are_box_samples(files->front())) {
            options->samples = *files;
            spectrum_of_boxes(*options);
            return;
        }
        options->mesh.mesh = files->front();
        options->samples.assign(files->begin() + 1, files->end());
        if (options->samples.empty()) {
            fail_usage("SAMPLES: " + files->front() + " is a mesh; give samples on it after it");
        }
        spectrum_of_surface(*options);
    });
}

} // namespace geodisk::tools
