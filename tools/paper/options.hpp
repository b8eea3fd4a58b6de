// Options that the subcommands share.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "program/command.hpp"

namespace geodisk::paper {

/// A list of numbers as given, like "1e4" or "0.5"; read once all options are known.
struct NumberList {
    std::string option;
    std::vector<std::string> texts;

    /// Whole numbers of at least 1.
    std::vector<double> counts() const;
    /// Numbers of [low, high].
    std::vector<double> ratios(double low, double high) const;
};

struct CommonOptions {
    std::string out = ".";  ///< Folder of the files.
    std::uint64_t seed = 1; ///< Seed of the first repetition; the others follow it.
    int repeats = 1;

    /// Repetitions and seed: "repeats 3 from seed 1".
    std::string text() const;
    /// Returns the seed of repetition `i`, from 0.
    std::uint64_t seed_of(int i) const { return seed + static_cast<std::uint64_t>(i); }
};

/// Adds options for where to write, how often to repeat, and with which seed.
void add_common_options(tools::Command command, CommonOptions& options);

void add_meshes(tools::Command command, std::vector<std::string>& meshes);

/// Adds an option that takes numbers with commas between; `list.texts` are the defaults.
void add_list(tools::Command command, NumberList& list, const std::string& option,
              const std::string& what);

void add_device(tools::Command command, std::string& device);

/// Pixels along each side of a picture.
struct PanelSize {
    std::string text = "640";

    /// Throws UserError(usage).
    std::uint32_t pixels() const;
};

void add_panel_size(tools::Command command, PanelSize& size);

/// Adds a subcommand that draws a figure: its own options, with `add(command, options)`, and the
/// common ones, with so many repetitions; when chosen, it calls `run(options)`.
template <class Options, class Run, class Add>
void add_figure(tools::Command app, const std::string& name, const std::string& summary,
                int repeats, const Run& run, const Add& add) {
    const auto options = std::make_shared<Options>();
    options->common.repeats = repeats;
    const tools::Command command = app.add_command(name, summary);
    add(command, *options);
    add_common_options(command, options->common);
    command.calls([options, run] { run(*options); });
}

} // namespace geodisk::paper
