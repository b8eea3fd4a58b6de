#include <algorithm>
#include <cmath>
#include <filesystem>
#include <memory>
#include <numbers>
#include <optional>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include <geodisk/version.hpp>

#include "analysis/power_spectrum.hpp"
#include "analysis/surface_spectrum.hpp"
#include "files/input_file.hpp"
#include "files/ply_file.hpp"
#include "files/samples/sample_file.hpp"
#include "geodisk/checks/sample_checks.hpp"
#include "geodisk/checks/sample_input.hpp"
#include "geodisk/commands/commands.hpp"
#include "geodisk/commands/help_text.hpp"
#include "geodisk/inputs/box_input.hpp"
#include "geodisk/inputs/mesh_input.hpp"
#include "geodisk/options/distance_options.hpp"
#include "geodisk/options/mesh_options.hpp"
#include "geodisk/options/run_options.hpp"
#include "geodisk/outputs/outputs.hpp"
#include "geodisk/reports/box_report.hpp"
#include "geodisk/reports/json.hpp"
#include "geodisk/reports/mesh_report.hpp"
#include "geodisk/reports/spectrum_report.hpp"
#include "geodisk/spectrum_run.hpp"
#include "picture/png.hpp"
#include "picture/power_picture.hpp"
#include "program/arguments.hpp"
#include "program/command.hpp"
#include "program/failure.hpp"
#include "program/human_text.hpp"
#include "program/interrupt.hpp"

namespace geodisk::tools {
namespace {

constexpr const char* kSpectrumExamples[] = {
    "geodisk spectrum bunny.obj points.csv --harmonics 200 -o spectrum.csv",
    "geodisk spectrum box.csv -o spectrum.png",
};

using analysis::PlacedSamples;
using analysis::PowerSpectrum;
using analysis::SurfaceSpectrum;

/// Frequency at which the power of blue noise has gone up and down once.
constexpr double kWantedReach = 2;
constexpr double kMaxFrequencies = 0x1p25; ///< 8 bytes each, and as many again.
constexpr double kReach = 4, kMinReach = 0.5, kMaxReach = 100;

/// As given on the command line.
struct SpectrumOptions {
    MeshOptions mesh; ///< Its file is "" for samples in boxes.
    std::vector<std::string> samples;
    DistanceOptions distance;
    std::string tolerance;
    std::string reach, harmonics; ///< Reach for boxes, harmonics for surfaces; or "".
    OutputOptions out;            ///< A picture or a table.
};

/// Adds all options of the command; `files` are the mesh, if there is one, and the samples.
void add_spectrum_options(Command command, SpectrumOptions& options,
                          std::vector<std::string>& files) {
    command
        .add_option("MESH SAMPLES", files, "",
                    help_of_input("A mesh and samples on it",
                                  "; or samples of boxes without a mesh. "
                                  "Several files of samples give their mean"))
        .required();
    command.add_option("-o,--output", options.out.output, "OUT",
                       "File to write: *.csv with radial mean and anisotropy; or, for\n"
                       "boxes of 2 dimensions, a picture *.png with 0 in the middle");
    command.add_option("--harmonics", options.harmonics, "K",
                       "Number of waves of the surface, longest first (default 1000)");
    command.add_option("--reach", options.reach, "F",
                       "Maximum frequency in boxes, in waves per minimum distance\n"
                       "(default 4)");
    add_distance_options(command, options.distance);
    add_tolerance_option(command, options.tolerance);
    add_mesh_options(command, options.mesh);
    add_json_option(command, options.out);
    add_quiet_option(command, options.out, "No progress and no result");
}

/// Returns the samples that the command reads.
std::vector<NamedFile> samples_read(const SpectrumOptions& options) {
    std::vector<NamedFile> read;
    for (const std::string& samples : options.samples) {
        read.push_back({"the samples", samples});
    }
    return read;
}

/// Publishes what a spectrum is, and the file that `write` fills if there is one.
template <class Write>
void publish_spectrum(const OutputOptions& out, const Json& json, const std::string& text,
                      const Write& write) {
    if (out.output.empty()) {
        publish(out, text_of(json), text);
        return;
    }
    AtomicFile file(out.output);
    write(file);
    file.sync();
    publish(out, {&file}, text_of(json), text);
}

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
    std::vector<NamedFile> read = samples_read(options);
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
    publish_spectrum(options.out, json, text, [&](AtomicFile& file) { file.write(report.csv()); });
}

/// Spectrum of all files, and what they have in common.
struct BoxSpectrum {
    BoxParams box;
    PowerSpectrum spectrum;
    SpectrumReport report;
};

void check_box_spectrum_path(const Path& path) {
    const std::string extension = lower_extension(path);
    if (extension != ".png" && extension != ".csv" && !output_stream(path)) {
        fail_usage(path.string() + ": spectra are written as *.png, a picture, or *.csv, the "
                                   "radial mean and anisotropy");
    }
    check_writable(path);
}

BoxParams read_box(const SampleFile& samples) {
    BoxParams box = box_of("", samples);
    if (box.extents.size() < 2) {
        fail_input(samples.path, "its box has one dimension; a spectrum needs 2 or more");
    }
    if (samples.rows.empty()) {
        fail_input(samples.path, "has no samples");
    }
    return box;
}

PowerSpectrum make_spectrum(const std::string& path, const BoxParams& box, double reach) {
    const double highest = reach / box.min_distance;
    if (PowerSpectrum::count(box, highest) > kMaxFrequencies) {
        throw UserError(ExitCode::out_of_memory, path + ": too many frequencies up to " +
                                                     rounded(reach, 3) +
                                                     " waves per minimum distance; lower --reach");
    }
    if (highest * *std::min_element(box.extents.begin(), box.extents.end()) < 2) {
        fail_input(path, "its box is too small for its minimum distance: fewer than two waves fit "
                         "along a side; raise --reach");
    }
    return PowerSpectrum(box, highest);
}

BoxSpectrum compute_in_boxes(const SpectrumOptions& options, double reach, ProgressLine& progress) {
    std::optional<BoxSpectrum> result;
    const auto sets = static_cast<double>(options.samples.size());
    for (const std::string& path : options.samples) {
        progress.begin_stage("reading the samples");
        const SampleFile samples = read_box_samples(path);
        const BoxParams box = read_box(samples);
        if (!result) {
            if (box.extents.size() != 2 && lower_extension(options.out.output) == ".png") {
                fail_usage(options.out.output + ": pictures are of spectra in two dimensions; " +
                           "write *.csv, the radial mean and anisotropy");
            }
            result = BoxSpectrum{box, make_spectrum(path, box, reach), {}};
        } else if (box.extents != result->box.extents) {
            fail_input(path, "has a box of " + box_text(box) + ", " + options.samples.front() +
                                 " one of " + box_text(result->box));
        }
        check_same_distance(path, box.min_distance, options.samples.front(),
                            result->box.min_distance);
        std::vector<double> points;
        points.reserve(box.extents.size() * samples.rows.size());
        for (const SampleRow& row : samples.rows) {
            points.insert(points.end(), row.position, row.position + box.extents.size());
        }
        progress.begin_stage("computing the spectrum");
        result->spectrum.add(points, [&](double part) {
            check_interrupted();
            progress.update((result->spectrum.sets() + part) / sets,
                            grouped(samples.rows.size()) + " samples");
        });
        result->report.samples += static_cast<double>(samples.rows.size()) / sets;
    }
    progress.clear();
    result->report.samples_files = options.samples;
    result->report.min_distance = result->box.min_distance;
    result->report.rings = result->spectrum.rings();
    result->report.expected_anisotropy = 1 / sets;
    return std::move(*result);
}

void spectrum_of_boxes(const SpectrumOptions& options) {
    const double reach = options.reach.empty()
                             ? kReach
                             : parse_ratio("--reach", options.reach, kMinReach, kMaxReach);
    if (!options.harmonics.empty()) {
        fail_usage("--harmonics is for samples on a mesh; give the mesh before them");
    }
    if (options.distance.parsed()) {
        fail_usage("--min-distance and --radius are for samples on a mesh; the header of a box has "
                   "its own");
    }
    check_outputs(options.out, "the spectrum", samples_read(options), check_box_spectrum_path);
    ProgressLine progress(options.out.quiet);
    const BoxSpectrum result = compute_in_boxes(options, reach, progress);
    Json json{{"version", GEODISK_VERSION_STRING},
              {"box", {{"extents", result.box.extents}, {"periodic", result.box.is_periodic}}}};
    result.report.add_to(json);
    const std::string text = "box           " + box_text(result.box) + '\n' + result.report.text();
    publish_spectrum(options.out, json, text, [&](AtomicFile& file) {
        if (lower_extension(options.out.output) == ".png") {
            picture::write_png(file, picture::power_picture(result.spectrum));
        } else {
            file.write(result.report.csv());
        }
    });
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
