#include "geodisk/options/tolerance_option.hpp"

#include "program/arguments.hpp"
#include "program/command.hpp"

namespace geodisk::tools {

void add_tolerance_option(Command command, std::string& tolerance, const std::string& group) {
    command.add_option("--tolerance", tolerance, "L",
                       "Maximum distance from the mesh for points without faces (of\n"
                       "other programs), in mesh units or % of the bounding-box\n"
                       "diagonal (default 0.1%)",
                       group);
}

void check_tolerance(const std::string& tolerance) {
    tolerance_on(tolerance, 1);
}

double tolerance_on(const std::string& tolerance, double diagonal) {
    constexpr const char* kUsual = "0.1%";
    return parse_length("--tolerance", tolerance.empty() ? kUsual : tolerance)
        .in_mesh_units(diagonal);
}

} // namespace geodisk::tools
