// The subcommands, each of which draws a figure or table of the paper.
#pragma once

#include <CLI/CLI.hpp>

namespace geodisk::paper {

/// All that follow, up to add_figures().
void add_commands(CLI::App& app);

void add_table1(CLI::App& app);
void add_boxes(CLI::App& app);
void add_fig3(CLI::App& app);
void add_fig4(CLI::App& app);
void add_fig5(CLI::App& app);
void add_fig7(CLI::App& app);
void add_fig8(CLI::App& app);
void add_fig9(CLI::App& app);
void add_fig10(CLI::App& app);
void add_fig11(CLI::App& app);
void add_fig12(CLI::App& app);
void add_fig13(CLI::App& app);
void add_fig14(CLI::App& app);

/// Runs the others.
void add_figures(CLI::App& app);

} // namespace geodisk::paper
