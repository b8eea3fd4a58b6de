// Fig. 12: boxes of two and three dimensions, and the spectrum of the former (section 5.9).
#include <geodisk/box.hpp>

#include "analysis/power_spectrum.hpp"
#include "paper/commands.hpp"
#include "paper/device.hpp"
#include "paper/options.hpp"
#include "paper/outputs.hpp"
#include "paper/painter.hpp"
#include "picture/power_picture.hpp"
#include "program/arguments.hpp"
#include "program/failure.hpp"
#include "program/human_text.hpp"
#include "program/interrupt.hpp"

namespace geodisk::paper {
namespace {

using tools::analysis::decibels;
using tools::analysis::mean_anisotropy;
using tools::analysis::PowerSpectrum;
using tools::analysis::SpectrumRing;

struct Options {
    CommonOptions common;
    std::string device;
    std::string square = "0.0147", cube = "0.023", spectrum = "0.00268";
    PanelSize size;
};

/// Waves per minimum distance.
constexpr double kReach = 4;

BoxParams box_of(std::size_t dimension, double radius, std::uint64_t seed) {
    BoxParams box;
    box.extents.assign(dimension, 1.0);
    box.min_distance = 2 * radius;
    box.seed = seed;
    return box;
}

LinePlot spectrum_plot(const char* title, const char* y_label, const char* y_unit) {
    LinePlot plot{.title = title,
                  .x_label = "waves per minimum distance",
                  .y_label = y_label,
                  .y_unit = y_unit,
                  .is_linear_y = true,
                  .is_linear_x = true};
    plot.lines.push_back({"geodisk", 0, false, {}, false});
    return plot;
}

void run(const Options& options) {
    const CommonOptions& common = options.common;
    Outputs outputs(common.out, "fig12");
    constexpr double kMin = 1e-4, kMax = 0.2;
    const double square = tools::parse_ratio("--square", options.square, kMin, kMax);
    const double cube = tools::parse_ratio("--cube", options.cube, 0.002, kMax);
    const double radius = tools::parse_ratio("--spectrum", options.spectrum, 0.001, kMax);
    PictureParams panel = square_panel(options.size);
    Device device(options.device, /* graphics */ true);
    const Painter painter(device.context());

    const BoxParams flat = box_of(2, square, common.seed), space = box_of(3, cube, common.seed);
    const SampleSet in_square = device.sample(flat), in_cube = device.sample(space);
    std::vector<Pixels> panels{painter.samples(flat, in_square, panel),
                               painter.samples(space, in_cube, panel)};
    panel.cuts = true;
    panels.push_back(painter.samples(space, in_cube, panel));
    outputs.add_picture("abc", side_by_side(panels));

    BoxParams torus = box_of(2, radius, 0);
    torus.is_periodic = true;
    PowerSpectrum spectrum(torus, kReach / torus.min_distance);
    double samples = 0;
    for (int i = 0; i < common.repeats; ++i) {
        torus.seed = common.seed_of(i);
        const SampleSet set = device.sample(torus);
        samples += static_cast<double>(set.points.size()) / 2 / common.repeats;
        spectrum.add(set.points, [](double) { tools::check_interrupted(); });
    }
    LinePlot mean = spectrum_plot("Radial mean of the power", "power", "");
    LinePlot anisotropy = spectrum_plot("Anisotropy", "anisotropy", "dB");
    Table table({"waves per D", "frequencies", "radial mean", "anisotropy dB"});
    const std::vector<SpectrumRing> rings = spectrum.rings();
    for (const SpectrumRing& ring : rings) {
        const double at = ring.frequency * torus.min_distance;
        const double anisotropy_there = decibels(ring.anisotropy);
        mean.lines[0].points.push_back({at, ring.mean});
        anisotropy.lines[0].points.push_back({at, anisotropy_there});
        table.add({tools::fixed(at, 4), std::to_string(ring.count), tools::fixed(ring.mean, 4),
                   tools::fixed(anisotropy_there, 3)});
    }
    const std::string circumstances = "square r = " + options.square +
                                      ", cube r = " + options.cube +
                                      ", spectrum r = " + options.spectrum;
    Table sizes({"box", "r", "samples", "the paper's"});
    sizes.add({"square", options.square, std::to_string(in_square.points.size() / 2), "787"});
    sizes.add({"cube", options.cube, std::to_string(in_cube.points.size() / 3), "6064"});
    sizes.add({"periodic square", options.spectrum, tools::fixed(samples, 1), "21886"});
    outputs.add_table(
        sizes, {"device " + device.name(), common.text(), circumstances},
        "Boxes of two and three dimensions, and the power spectrum of " +
            std::to_string(common.repeats) + " sets",
        "Anisotropy of the whole: " + tools::fixed(decibels(mean_anisotropy(rings)), 2) +
            " dB, and " + tools::fixed(decibels(1.0 / common.repeats), 2) +
            " dB without a preferred direction. The paper's squares are"
            "\nopen, as here but for the spectrum, and its samples r or 2 r apart, which it"
            "\ndoes not say.");
    outputs.add_data("-spectrum", table);
    outputs.add_picture("d", tools::picture::power_picture(spectrum));
    outputs.add_plot("e", mean);
    outputs.add_plot("f", anisotropy);
    outputs.write();
}

} // namespace

void add_fig12(tools::Command app) {
    add_figure<Options>(
        app, "fig12", "Fig. 12: pictures of boxes and spectra of a square, on a device", 10, run,
        [](tools::Command command, Options& options) {
            command.add_option("--square", options.square, "R", "Radius in the square")
                .shows_default();
            command.add_option("--cube", options.cube, "R", "Radius in the cube").shows_default();
            command
                .add_option("--spectrum", options.spectrum, "R",
                            "Radius in the periodic square whose spectrum is taken")
                .shows_default();
            add_panel_size(command, options.size);
            add_device(command, options.device);
        });
}

} // namespace geodisk::paper
