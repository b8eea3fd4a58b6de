#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <geodisk/version.hpp>

#include "analysis/power_spectrum.hpp"
#include "files/input_file.hpp"
#include "files/samples/sample_file.hpp"
#include "geodisk/checks/sample_checks.hpp"
#include "geodisk/commands/commands.hpp"
#include "geodisk/inputs/box_input.hpp"
#include "geodisk/options/spectrum_options.hpp"
#include "geodisk/outputs/outputs.hpp"
#include "geodisk/reports/box_report.hpp"
#include "geodisk/reports/json.hpp"
#include "geodisk/reports/spectrum_report.hpp"
#include "picture/png.hpp"
#include "picture/power_picture.hpp"
#include "program/arguments.hpp"
#include "program/failure.hpp"
#include "program/human_text.hpp"
#include "program/interrupt.hpp"

namespace geodisk::tools {
namespace {

using analysis::PowerSpectrum;

constexpr double kMaxFrequencies = 0x1p25; ///< 8 bytes each, and as many again.
constexpr double kReach = 4, kMinReach = 0.5, kMaxReach = 100;

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

BoxSpectrum compute(const SpectrumOptions& options, double reach, ProgressLine& progress) {
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

} // namespace

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
    std::vector<NamedFile> read;
    for (const std::string& samples : options.samples) {
        read.push_back({"the samples", samples});
    }
    check_outputs(options.out, "the spectrum", read, check_box_spectrum_path);
    ProgressLine progress(options.out.quiet);
    const BoxSpectrum result = compute(options, reach, progress);
    Json json{{"version", GEODISK_VERSION_STRING},
              {"box", {{"extents", result.box.extents}, {"periodic", result.box.is_periodic}}}};
    result.report.add_to(json);
    const std::string text = "box           " + box_text(result.box) + '\n' + result.report.text();
    if (options.out.output.empty()) {
        publish(options.out, text_of(json), text);
        return;
    }
    AtomicFile file(options.out.output);
    if (lower_extension(options.out.output) == ".png") {
        picture::write_png(file, picture::power_picture(result.spectrum));
    } else {
        file.write(result.report.csv());
    }
    file.sync();
    publish(options.out, {&file}, text_of(json), text);
}

} // namespace geodisk::tools
