// Options that the subcommands share.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

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
    std::uint64_t seed = 1; ///< Of the first repetition; the others follow it.
    int repeats = 1;
};

/// Where to write, how often to repeat, with which seed.
void add_common_options(CLI::App& command, CommonOptions& options);

void add_meshes(CLI::App& command, std::vector<std::string>& meshes);

/// Adds an option that takes numbers with commas between; `list.texts` are the defaults.
void add_list(CLI::App& command, NumberList& list, const std::string& option,
              const std::string& what);

void add_device(CLI::App& command, std::string& device);

} // namespace geodisk::paper
