// All figures, one after the other, as if each had been asked for by itself.
#include <iostream>
#include <string>
#include <vector>

#include "paper/commands.hpp"
#include "paper/options.hpp"
#include "program/command_text.hpp"
#include "program/program.hpp"

namespace geodisk::paper {
namespace {

struct Options {
    CommonOptions common;
    std::vector<std::string> meshes{"builtin:showpiece"};
    std::vector<std::string> resolutions{"builtin:showpiece:60", "builtin:showpiece:120",
                                         "builtin:showpiece:240"};
    std::string device;
    PanelSize size;
    bool is_quick = false;
};

using Arguments = std::vector<std::string>;

Arguments joined(Arguments arguments, const Arguments& more) {
    arguments.insert(arguments.end(), more.begin(), more.end());
    return arguments;
}

std::vector<Arguments> commands(const Options& options) {
    const auto on_meshes = [&](const char* name) { return joined({name}, options.meshes); };
    const auto quick = [&](Arguments arguments, const Arguments& when_quick) {
        return options.is_quick ? joined(std::move(arguments), when_quick) : arguments;
    };
    const Arguments size{"--size", options.size.text}, device{"--device", options.device};
    const Arguments on_device = options.device.empty() ? Arguments() : device;
    const Arguments pictured = joined(size, on_device);
    const Arguments once{"--repeats", "1"};
    return {
        joined(on_meshes("fig3"), pictured),
        joined(quick(on_meshes("fig4"), {"--harmonics", "1000", "--count", "100"}), on_device),
        joined(quick(on_meshes("fig5"), {"--repeats", "1", "--counts", "300,1000,3000,10000",
                                         "--ratio-count", "1000"}),
               on_device),
        joined(quick({"fig7"}, once), pictured),
        joined(quick(joined({"fig8"}, options.resolutions), once), pictured),
        joined(quick(on_meshes("fig9"), {"--repeats", "1", "--counts", "300,1000,3000"}), pictured),
        joined({"fig10"}, pictured),
        joined(on_meshes("fig11"), pictured),
        joined(quick({"fig12"}, {"--repeats", "3", "--spectrum", "0.008"}), pictured),
        quick(on_meshes("fig13"), {"--repeats", "1", "--counts", "300,1000,3000"}),
        quick({"fig14"}, {"--repeats", "1", "--radius", "0.01", "--ratios", "5,10,20,40"}),
    };
}

void run(const Options& options) {
    options.size.pixels(); // Fails before the first figure.
    for (Arguments arguments : commands(options)) {
        arguments.insert(arguments.end(), {"--out", options.common.out, "--seed",
                                           std::to_string(options.common.seed)});
        std::cout << "geodisk_paper";
        for (const std::string& argument : arguments) {
            std::cout << ' ' << tools::shell_word(argument);
        }
        std::cout << "\n\n";
        tools::run_arguments(add_commands, std::move(arguments));
        std::cout << '\n';
    }
}

} // namespace

void add_figures(tools::Command app) {
    add_figure<Options>(app, "figures", "All figures, one after the other, on a device", 1, run,
                        [](tools::Command command, Options& options) {
                            command
                                .add_option("MESH", options.meshes, "",
                                            "Meshes of figures 3, 4, 5, 9, 11 and 13")
                                .shows_default();
                            command
                                .add_option("--resolutions", options.resolutions, "MESH,...",
                                            "Meshes of figure 8, of one surface")
                                .takes_commas()
                                .shows_default();
                            add_panel_size(command, options.size);
                            command.add_flag("--quick", options.is_quick,
                                             "Use fewer samples and repetitions, for a quick look");
                            add_device(command, options.device);
                        });
}

} // namespace geodisk::paper
