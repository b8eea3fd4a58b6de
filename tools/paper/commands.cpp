#include "paper/commands.hpp"

namespace geodisk::paper {

void add_commands(tools::Command app) {
    app.needs_command();
    add_table1(app);
    add_fig3(app);
    add_fig4(app);
    add_fig5(app);
    add_fig7(app);
    add_fig8(app);
    add_fig9(app);
    add_fig10(app);
    add_fig11(app);
    add_fig12(app);
    add_fig13(app);
    add_fig14(app);
    add_boxes(app);
}

} // namespace geodisk::paper
