// Fig. 4: spectra on surfaces of the paper's method and of phase groups, against dart throwing
// (section 5.3).
#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <string>
#include <vector>

#include <glm/vec3.hpp>

#include "analysis/surface_spectrum.hpp"
#include "baselines/geodesic_disks.hpp"
#include "baselines/phase_groups.hpp"
#include "baselines/space_disks.hpp"
#include "paper/commands.hpp"
#include "paper/device.hpp"
#include "paper/metrics.hpp"
#include "paper/options.hpp"
#include "paper/outputs.hpp"
#include "paper/two_sample.hpp"
#include "program/arguments.hpp"
#include "program/exact_text.hpp"
#include "program/failure.hpp"
#include "program/human_text.hpp"
#include "program/interrupt.hpp"

namespace geodisk::paper {
namespace {

using tools::analysis::decibels;
using tools::analysis::mean_anisotropy;
using tools::analysis::PlacedSamples;
using tools::analysis::SpectrumRing;
using tools::analysis::SurfaceSpectrum;

struct Options {
    CommonOptions common;
    std::vector<std::string> meshes;
    std::string device;
    std::string count = "300", harmonics = "4000", trials = "10", deals = "1000";
};

/// Lines of a group have one colour.
struct Method {
    const char* name;
    std::size_t group;
    bool is_dashed;
};
/// The first is what the others are compared with; the second must not differ.
constexpr std::array<Method, 6> kMethods{{{"dart throwing", 0, false},
                                          {"dart throwing again", 0, true},
                                          {"geodisk (exact)", 1, false},
                                          {"geodisk (closed form)", 1, true},
                                          {"phase groups (exact)", 3, false},
                                          {"phase groups (closed form)", 3, true}}};
/// Rings of fewer say little, and are not drawn.
constexpr std::uint32_t kDrawnRing = 10;

PlacedSamples throw_in_groups(const PaperMesh& mesh, const Pool& pool, Metric metric,
                              std::uint32_t trials) {
    tools::check_interrupted();
    const auto points = ref::oriented_points(mesh.view(), pool.by_rank);
    std::vector<glm::dvec3> positions;
    positions.reserve(points.size());
    std::transform(points.begin(), points.end(), std::back_inserter(positions),
                   [](const ref::OrientedPoint& point) { return point.position; });
    const double distance = pool.params.min_distance;
    const ref::PhaseGroups groups(positions, distance);
    if (metric == Metric::curve) {
        ref::SpaceDisks disks(points, distance, ref::curve_length);
        return places_of(pool, groups.throw_darts(disks, trials));
    }
    ref::GeodesicDisks disks(mesh.prepared, distance, pool.by_rank, pool.tolerances);
    return places_of(pool, groups.throw_darts(disks, trials));
}

/// By method, then repetition.
std::vector<PlacedSamples> sample(const PaperMesh& mesh, const Options& options, double distance,
                                  std::uint32_t trials, Device& device) {
    const CommonOptions& common = options.common;
    std::vector<PlacedSamples> sets;
    const auto repeat = [&](const auto& method) {
        for (int i = 0; i < common.repeats; ++i) {
            sets.push_back(method(SampleParams{distance, common.seed_of(i), kDefaultPoolRatio}));
        }
    };
    const auto throw_independent = [&](SampleParams params) {
        const Pool pool = draw_independent_pool(mesh, params);
        return places_of(pool, throw_darts(mesh, pool, Metric::exact));
    };
    const auto draw = [&](const SampleParams& params) { return draw_pool(mesh, params); };
    repeat(throw_independent);
    repeat([&](SampleParams params) {
        params.seed = common.seed_of(common.repeats) + params.seed;
        return throw_independent(params);
    });
    repeat([&](const SampleParams& params) { return places_of(device.sample(mesh, params)); });
    repeat([&](const SampleParams& params) {
        const Pool pool = draw(params);
        return places_of(pool, throw_darts(mesh, pool, Metric::curve));
    });
    for (const Metric metric : {Metric::exact, Metric::curve}) {
        repeat([&](const SampleParams& params) {
            return throw_in_groups(mesh, draw(params), metric, trials);
        });
    }
    return sets;
}

std::vector<std::size_t> sets_of(std::size_t method, const CommonOptions& common) {
    std::vector<std::size_t> sets;
    const auto repeats = static_cast<std::size_t>(common.repeats);
    for (std::size_t i = 0; i < repeats; ++i) {
        sets.push_back(method * repeats + i);
    }
    return sets;
}

struct Figure {
    Table table{{"mesh", "method", "samples", "anisotropy dB", "mean off %", "p", "detectable",
                 "anisotropy off dB", "p", "detectable"}};
    Table curves{{"mesh", "method", "waves per D", "harmonics", "radial mean", "anisotropy dB"}};
    std::vector<LinePlot> radial_means, anisotropies;

    void begin_mesh(const std::string& mesh) {
        radial_means.push_back({.title = "Power on " + mesh,
                                .x_label = "waves per minimum distance",
                                .y_label = "radial mean",
                                .is_linear_y = true,
                                .is_linear_x = true});
        anisotropies.push_back(radial_means.back());
        anisotropies.back().title = "Anisotropy on " + mesh;
        anisotropies.back().y_label = "anisotropy";
        anisotropies.back().y_unit = "dB";
    }

    void add_curve(const std::string& mesh, std::size_t method,
                   const std::vector<SpectrumRing>& rings, double distance) {
        const auto& [name, group, is_dashed] = kMethods[method];
        LinePlot::Line radial_mean{name, group, is_dashed, {}, false};
        LinePlot::Line anisotropy = radial_mean;
        for (const SpectrumRing& ring : rings) {
            const double frequency = ring.frequency * distance;
            if (ring.count >= kDrawnRing) {
                radial_mean.points.push_back({frequency, ring.mean});
                anisotropy.points.push_back({frequency, decibels(ring.anisotropy)});
            }
            curves.add({mesh, name, tools::exact_text(frequency), std::to_string(ring.count),
                        tools::exact_text(ring.mean),
                        tools::exact_text(decibels(ring.anisotropy))});
        }
        radial_means.back().lines.push_back(std::move(radial_mean));
        anisotropies.back().lines.push_back(std::move(anisotropy));
    }

    void add_row(const std::string& mesh, std::size_t method, double samples,
                 const std::vector<SpectrumRing>& rings, const SpectrumDifference* difference) {
        std::vector<std::string> row{mesh, kMethods[method].name, tools::fixed(samples, 1),
                                     tools::fixed(decibels(mean_anisotropy(rings)), 2)};
        const auto add = [&](const Difference& found, double scale) {
            row.push_back(tools::fixed(scale * found.size, 2));
            row.push_back(tools::fixed(found.p, 3));
            row.push_back(tools::fixed(scale * found.detectable, 2));
        };
        if (difference != nullptr) {
            add(difference->radial_mean, 100);
            add(difference->anisotropy, 1);
        } else {
            row.resize(row.size() + 6);
        }
        table.add(std::move(row));
    }
};

void add_mesh(Figure& figure, const PaperMesh& mesh, const Options& options, double count,
              std::size_t harmonic_count, std::uint32_t trials, std::uint32_t deals,
              Device& device) {
    const CommonOptions& common = options.common;
    const double distance = distance_for_count(mesh.area(), count);
    const auto laplacian = tools::analysis::make_laplacian(mesh.prepared, mesh.file.triangles);
    const tools::analysis::ManifoldHarmonics harmonics(laplacian);
    if (harmonic_count > harmonics.count()) {
        tools::fail_usage("--harmonics: " + mesh.name + " has only " +
                          tools::counted(harmonics.count(), "harmonic", "harmonics"));
    }
    const std::vector<PlacedSamples> sets = sample(mesh, options, distance, trials, device);
    const SurfaceSpectrum spectrum = tools::analysis::compute_spectrum(
        laplacian, harmonics, harmonic_count, sets, [](double) { tools::check_interrupted(); });
    figure.begin_mesh(mesh.name);
    const std::vector<std::size_t> truth = sets_of(0, common);
    for (std::size_t method = 0; method < kMethods.size(); ++method) {
        const std::vector<std::size_t> group = sets_of(method, common);
        const std::vector<SpectrumRing> rings = spectrum.rings(group);
        double samples = 0;
        for (const std::size_t set : group) {
            samples += static_cast<double>(sets[set].size()) / common.repeats;
        }
        if (method == 0) {
            figure.add_row(mesh.name, method, samples, rings, nullptr);
        } else {
            tools::check_interrupted();
            const SpectrumDifference difference =
                compare_groups(spectrum, group, truth, deals, common.seed);
            figure.add_row(mesh.name, method, samples, rings, &difference);
        }
        if (method != 1) { // It lies upon the first.
            figure.add_curve(mesh.name, method, rings, distance);
        }
    }
}

void run(const Options& options) {
    const CommonOptions& common = options.common;
    Outputs outputs(common.out, "fig4");
    const double count = tools::parse_count("--count", options.count);
    const auto harmonics =
        static_cast<std::size_t>(tools::parse_count("--harmonics", options.harmonics));
    const auto trials =
        static_cast<std::uint32_t>(std::min(tools::parse_count("--trials", options.trials), 4e9));
    const auto deals =
        static_cast<std::uint32_t>(std::min(tools::parse_count("--deals", options.deals), 1e6));
    const std::vector<PaperMesh> meshes = load_meshes(options.meshes);
    Device device(options.device);
    Figure figure;
    for (const PaperMesh& mesh : meshes) {
        add_mesh(figure, mesh, options, count, harmonics, trials, deals, device);
    }
    outputs.add_table(
        figure.table,
        {"device " + device.name(), common.text(),
         "count " + options.count + ", harmonics " + options.harmonics + ", trials " +
             options.trials + ", deals " + options.deals},
        "Spectra on surfaces, averaged over " + std::to_string(common.repeats) +
            " runs, against those of dart throwing",
        "Dart throwing has independent uniform candidates, not those that geodisk draws. Off"
        "\nis the root mean square over harmonics of what radial mean and anisotropy are off from"
        "\nthose of dart throwing, p how often chance makes it as large, by permutation of the"
        "\nruns; detectable is what would be found, with p < 0.05, nine times of ten."
        "\nIf no direction is another than the others the anisotropy is " +
            tools::fixed(decibels(2.0 / common.repeats), 2) +
            " dB.\n"
            "The paper: its method has the spectra of dart throwing, by exact distances and the"
            "\nclosed form of Bowers et al.; the anisotropy of phase groups deviates.");
    outputs.add_data("-curves", figure.curves);
    for (std::size_t i = 0; i < meshes.size(); ++i) {
        const std::string number = numbered(i, meshes.size());
        outputs.add_plot(number + "a", figure.radial_means[i]);
        outputs.add_plot(number + "b", figure.anisotropies[i]);
    }
    outputs.write();
}

} // namespace

void add_fig4(tools::Command app) {
    add_figure<Options>(
        app, "fig4", "Fig. 4: spectra of phase groups and dart throwing on surfaces, on a device",
        10, run, [](tools::Command command, Options& options) {
            add_meshes(command, options.meshes);
            command
                .add_option("-n,--count", options.count, "N",
                            "Approximate number of samples; the paper has 300 to 500")
                .shows_default();
            command
                .add_option("--harmonics", options.harmonics, "K",
                            "Waves of the surface; the paper has 10,000")
                .shows_default();
            command
                .add_option("--trials", options.trials, "K",
                            "Darts that phase groups throw into each cell")
                .shows_default();
            command.add_option("--deals", options.deals, "K", "Permutations of the tests")
                .shows_default();
            add_device(command, options.device);
        });
}

} // namespace geodisk::paper
