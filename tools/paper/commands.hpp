// The subcommands, each of which draws a figure or table of the paper.
#pragma once

#include "program/command.hpp"

namespace geodisk::paper {

/// All that follow, up to add_figures().
void add_commands(tools::Command app);

void add_table1(tools::Command app);
void add_boxes(tools::Command app);
void add_fig3(tools::Command app);
void add_fig4(tools::Command app);
void add_fig5(tools::Command app);
void add_fig7(tools::Command app);
void add_fig8(tools::Command app);
void add_fig9(tools::Command app);
void add_fig10(tools::Command app);
void add_fig11(tools::Command app);
void add_fig12(tools::Command app);
void add_fig13(tools::Command app);
void add_fig14(tools::Command app);

/// Runs the others.
void add_figures(tools::Command app);

} // namespace geodisk::paper
