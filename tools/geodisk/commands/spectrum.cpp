#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include <geodisk/version.hpp>

#include "analysis/power_spectrum.hpp"
#include "files/input_file.hpp"
#include "files/sample_file.hpp"
#include "geodisk/commands/commands.hpp"
#include "geodisk/inputs/box_input.hpp"
#include "geodisk/options/run_options.hpp"
#include "geodisk/outputs/outputs.hpp"
#include "geodisk/reports/box_report.hpp"
#include "geodisk/reports/json.hpp"
#include "picture/png.hpp"
#include "program/arguments.hpp"
#include "program/exact_text.hpp"
#include "program/failure.hpp"
#include "program/human_text.hpp"
#include "program/interrupt.hpp"
#include "program/program.hpp"
#include "program/table.hpp"

namespace geodisk::tools {
namespace {

using analysis::PowerSpectrum;

constexpr double kMostFrequencies = 0x1p24;
constexpr double kMostReach = 100;
/// Up to this part of a wave per minimum distance, blue noise has hardly any power.
constexpr double kLow = 0.5;
/// Power that is white in the picture.
constexpr double kWhite = 2;

struct SpectrumOptions {
    std::vector<std::string> samples;
    std::string reach = "4";
    OutputOptions out; ///< A picture or a table.
};

/// Spectrum of all files, and what they have in common.
struct BoxSpectrum {
    BoxParams box;
    double samples = 0; ///< On average.
    PowerSpectrum spectrum;
    std::vector<PowerSpectrum::Ring> rings;

    /// In waves per minimum distance.
    double relative(double frequency) const { return frequency * box.min_distance; }
};

double decibels(double ratio) {
    return 10 * std::log10(ratio);
}

void check_spectrum_path(const Path& path) {
    const std::string extension = lower_extension(path);
    if (extension != ".png" && extension != ".csv") {
        fail_usage(path.string() + ": spectra are written as *.png, a picture, or *.csv, the "
                                   "radial mean and anisotropy");
    }
    check_writable(path);
}

BoxParams read_box(const std::string& path, const SampleFile& samples) {
    BoxParams box = box_of(path, "", samples);
    if (box.extents.size() != 2) {
        fail_input(path, "its box has " + counted(box.extents.size(), "dimension", "dimensions") +
                             "; spectra are of those with 2");
    }
    if (samples.rows.empty()) {
        fail_input(path, "has no samples");
    }
    return box;
}

PowerSpectrum make_spectrum(const std::string& path, const BoxParams& box, double reach) {
    const double highest = reach / box.min_distance;
    if (2 * highest * box.extents[0] * highest * box.extents[1] > kMostFrequencies) {
        throw UserError(ExitCode::out_of_memory,
                        path + ": there are too many frequencies up to " + rounded(reach, 3) +
                            " waves per minimum distance; give less with --reach");
    }
    if (highest * std::min(box.extents[0], box.extents[1]) < 2) {
        fail_input(path, "its box is too small for its minimum distance: there are no two waves "
                         "along its sides up to the frequency of --reach");
    }
    return PowerSpectrum(box, highest);
}

BoxSpectrum compute(const SpectrumOptions& options, double reach, ProgressLine& progress) {
    std::optional<BoxSpectrum> result;
    for (const std::string& path : options.samples) {
        progress.begin_stage("reading the samples");
        const SampleFile samples = read_box_samples(path);
        const BoxParams box = read_box(path, samples);
        if (!result) {
            result = BoxSpectrum{box, 0, make_spectrum(path, box, reach), {}};
        } else if (box.extents != result->box.extents) {
            fail_input(path, "has a box of " + box_text(box) + ", " + options.samples.front() +
                                 " one of " + box_text(result->box));
        }
        std::vector<double> points;
        points.reserve(2 * samples.rows.size());
        for (const SampleRow& row : samples.rows) {
            points.insert(points.end(), {row.position[0], row.position[1]});
        }
        progress.begin_stage("computing the spectrum");
        result->spectrum.add(points, [&](double part) {
            check_interrupted();
            progress.update((result->spectrum.sets() + part) /
                                static_cast<double>(options.samples.size()),
                            grouped(samples.rows.size()) + " samples");
        });
        result->samples +=
            static_cast<double>(samples.rows.size()) / static_cast<double>(options.samples.size());
    }
    progress.clear();
    result->rings = result->spectrum.rings();
    return std::move(*result);
}

/// What people look for first.
struct Findings {
    double peak = 0, peak_at = 0; ///< Of the radial mean; the frequency relative.
    double low = 0;               ///< The mean power at low frequencies.
    double anisotropy = 0;        ///< Mean over rings, in decibels.
};

Findings find(const BoxSpectrum& result) {
    Findings found;
    double low_count = 0;
    for (const PowerSpectrum::Ring& ring : result.rings) {
        if (ring.mean > found.peak) {
            found.peak = ring.mean;
            found.peak_at = result.relative(ring.frequency);
        }
        if (result.relative(ring.frequency) < kLow) {
            found.low += ring.mean * ring.count;
            low_count += ring.count;
        }
        found.anisotropy +=
            decibels(std::max(ring.anisotropy, 1e-12)) / static_cast<double>(result.rings.size());
    }
    found.low /= std::max(1.0, low_count);
    return found;
}

std::string text_of_spectrum(const BoxSpectrum& result) {
    const Findings found = find(result);
    const double sets = result.spectrum.sets();
    std::ostringstream out;
    out << "box           " << box_text(result.box) << '\n'
        << "samples       " << rounded(result.samples, 6)
        << (sets > 1 ? " on average in " + grouped(result.spectrum.sets()) + " sets" : "") << '\n'
        << "power         " << rounded(found.low, 3) << " below " << rounded(kLow, 2)
        << " waves per minimum distance, peak " << rounded(found.peak, 3) << " at "
        << rounded(found.peak_at, 3) << "; 1 is white noise\n"
        << "anisotropy    " << fixed(found.anisotropy, 2) << " dB on average over "
        << counted(result.rings.size(), "ring", "rings") << "; " << fixed(decibels(1 / sets), 2)
        << " dB if all directions are alike\n";
    return out.str();
}

std::string json_of_spectrum(const SpectrumOptions& options, const BoxSpectrum& result) {
    const Findings found = find(result);
    Json frequency = Json::array(), power = Json::array(), anisotropy = Json::array();
    for (const PowerSpectrum::Ring& ring : result.rings) {
        frequency.push_back(result.relative(ring.frequency));
        power.push_back(ring.mean);
        anisotropy.push_back(decibels(std::max(ring.anisotropy, 1e-12)));
    }
    return text_of(Json{
        {"version", GEODISK_VERSION_STRING},
        {"box", {{"extents", result.box.extents}, {"periodic", result.box.is_periodic}}},
        {"samples_files", options.samples},
        {"min_distance", result.box.min_distance},
        {"samples", result.samples},
        {"sets", result.spectrum.sets()},
        {"low_power", found.low},
        {"peak", {{"power", found.peak}, {"frequency", found.peak_at}}},
        {"mean_anisotropy_db", found.anisotropy},
        {"expected_anisotropy_db", decibels(1.0 / result.spectrum.sets())},
        {"rings", {{"frequency", frequency}, {"power", power}, {"anisotropy_db", anisotropy}}}});
}

/// Of the power around frequency 0: black for none, white for kWhite.
picture::Pixels picture_of(const PowerSpectrum& spectrum) {
    picture::Pixels pixels{2 * spectrum.columns() + 1, 2 * spectrum.rows() + 1, {}};
    pixels.rgba.reserve(std::size_t{4} * pixels.width * pixels.height);
    const std::int64_t columns = spectrum.columns(), rows = spectrum.rows();
    for (std::int64_t row = rows; row >= -rows; --row) {
        for (std::int64_t column = -columns; column <= columns; ++column) {
            const double part = std::min(1.0, spectrum.power(column, row) / kWhite);
            const auto grey = static_cast<std::uint8_t>(std::lround(255 * part));
            pixels.rgba.insert(pixels.rgba.end(), {grey, grey, grey, 255});
        }
    }
    return pixels;
}

std::string table_of(const BoxSpectrum& result) {
    Table table({"frequency", "frequencies", "power", "anisotropy_db"});
    for (const PowerSpectrum::Ring& ring : result.rings) {
        table.add({exact_text(result.relative(ring.frequency)), std::to_string(ring.count),
                   exact_text(ring.mean), exact_text(decibels(std::max(ring.anisotropy, 1e-12)))});
    }
    return table.csv();
}

void run_spectrum(const SpectrumOptions& options) {
    const double reach = parse_ratio("--reach", options.reach, kLow, kMostReach);
    std::vector<NamedFile> read;
    for (const std::string& samples : options.samples) {
        read.push_back({"the samples", samples});
    }
    check_outputs(options.out, "the spectrum", read, check_spectrum_path);
    ProgressLine progress(options.out.quiet);
    const BoxSpectrum result = compute(options, reach, progress);
    const std::string report = json_of_spectrum(options, result);
    const std::string text = text_of_spectrum(result);
    if (options.out.output.empty()) {
        publish(options.out, report, text);
        return;
    }
    AtomicFile file(options.out.output);
    if (lower_extension(options.out.output) == ".png") {
        picture::write_png(file, picture_of(result.spectrum));
    } else {
        file.write(table_of(result));
    }
    file.sync();
    publish(options.out, file, report, text);
}

} // namespace

void add_spectrum_command(CLI::App& app) {
    CLI::App* command = app.add_subcommand(
        "spectrum", "Compute the power spectrum of samples in a box of 2 dimensions");
    const auto options = std::make_shared<SpectrumOptions>();
    command
        ->add_option("SAMPLES", options->samples,
                     "Samples of geodisk box --dim 2: *.ply or *.csv; of\n"
                     "several the mean is taken")
        ->type_name("")
        ->required();
    add_option(*command, "-o,--output", options->out.output, "OUT",
               "Spectrum to write: *.png, a picture with frequency 0 in the\n"
               "middle, or *.csv, radial mean and anisotropy");
    add_option(*command, "--reach", options->reach, "F",
               "Highest frequency, in waves per minimum distance")
        ->capture_default_str();
    add_json_option(*command, options->out);
    command->add_flag("-q,--quiet", options->out.quiet, "No progress and no result");
    command->callback([options] { run_spectrum(*options); });
}

} // namespace geodisk::tools
