// Fig. 5: speed against N, speed and packing density against |P|/|S| (sections 5.1 and 5.2).

#include "paper/commands.hpp"
#include "paper/device.hpp"
#include "paper/options.hpp"
#include "paper/outputs.hpp"
#include "program/arguments.hpp"
#include "program/human_text.hpp"

namespace geodisk::paper {
namespace {

struct Options {
    CommonOptions common;
    std::vector<std::string> meshes;
    std::string device;
    NumberList counts{"", {"300", "1000", "3000", "10000", "30000", "100000"}};
    std::string ratio_count = "10000";
    NumberList ratios{"", {"5", "10", "20", "40", "80", "160"}};
};

/// Draws the three parts of the figure while it fills the table.
struct Figure {
    Table table{{"mesh", "sweep", "|P|/|S|", "samples", "seconds", "samples/s", "rho"}};
    LinePlot speed_by_count, speed_by_ratio, rho_by_ratio;

    explicit Figure(const std::string& device) {
        speed_by_count.title = "Speed by samples, " + device;
        speed_by_count.x_label = "samples";
        speed_by_ratio.title = "Speed by candidates per sample, " + device;
        rho_by_ratio.title = "Packing density by candidates per sample";
        rho_by_ratio.y_label = "rho";
        rho_by_ratio.is_linear_y = true;
        for (LinePlot* const plot : {&speed_by_ratio, &rho_by_ratio}) {
            plot->x_label = "candidates per sample";
        }
        for (LinePlot* const plot : {&speed_by_count, &speed_by_ratio}) {
            plot->y_label = "samples per second";
        }
    }

    void begin_mesh(const std::string& name) {
        for (LinePlot* const plot : {&speed_by_count, &speed_by_ratio, &rho_by_ratio}) {
            plot->lines.push_back({name, plot->lines.size(), false, {}});
        }
    }

    void add(const std::string& mesh, bool by_ratio, const DeviceRun& run) {
        const double ratio = run.candidates / run.samples;
        const double speed = run.samples / run.seconds;
        table.add({mesh, by_ratio ? "candidates" : "samples", tools::fixed(ratio, 1),
                   tools::fixed(run.samples, 0), tools::fixed(run.seconds, 4),
                   tools::fixed(speed, 0), tools::fixed(run.rho, 4)});
        if (by_ratio) {
            speed_by_ratio.lines.back().points.push_back({ratio, speed});
            rho_by_ratio.lines.back().points.push_back({ratio, run.rho});
        } else {
            speed_by_count.lines.back().points.push_back({run.samples, speed});
        }
    }
};

void run(const Options& options) {
    Outputs outputs(options.common.out, "fig5");
    const std::vector<double> counts = options.counts.counts();
    const std::vector<double> ratios = options.ratios.ratios(1, 10000);
    const double ratio_count = tools::parse_count("--ratio-count", options.ratio_count);
    const std::vector<PaperMesh> meshes = load_meshes(options.meshes);
    Device device(options.device);

    Figure figure(device.name());
    for (const PaperMesh& mesh : meshes) {
        figure.begin_mesh(mesh.name);
        for (const double count : counts) {
            const SampleParams params =
                params_for(mesh, count, kDefaultPoolRatio, options.common.seed);
            figure.add(mesh.name, false, device.measure(mesh, params, options.common.repeats));
        }
        for (const double ratio : ratios) {
            const SampleParams params = params_for(mesh, ratio_count, ratio, options.common.seed);
            figure.add(mesh.name, true, device.measure(mesh, params, options.common.repeats));
        }
    }
    outputs.add_table(
        figure.table, {"device " + device.name(), options.common.text() + ", seconds are medians"},
        "Speed and packing density on " + tools::one_line(device.name()),
        "The paper: rho between 0.70 and 0.76 in all cases, growing very slowly beyond"
        "\n|P|/|S| = 80; speed grows with N until N nears the number of vertices, and falls"
        "\nin inverse proportion to |P|/|S|. It gives no other numbers for Fig. 5.");
    outputs.add_plot("a", figure.speed_by_count);
    outputs.add_plot("b", figure.speed_by_ratio);
    outputs.add_plot("c", figure.rho_by_ratio);
    outputs.write();
}

} // namespace

void add_fig5(tools::Command app) {
    add_figure<Options>(app, "fig5", "Fig. 5: speed by N, speed and rho by |P|/|S|, on a device", 3,
                        run, [](tools::Command command, Options& options) {
                            add_meshes(command, options.meshes);
                            add_list(command, options.counts, "--counts",
                                     "Sample counts of the first sweep");
                            add_list(command, options.ratios, "--ratios",
                                     "Candidates per sample of the second sweep, 1 to 10000");
                            command
                                .add_option("--ratio-count", options.ratio_count, "N",
                                            "Sample count of the second sweep")
                                .shows_default();
                            add_device(command, options.device);
                        });
}

} // namespace geodisk::paper
