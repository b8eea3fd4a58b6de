#include "geodisk/options/tolerance_option.hpp"

#include "program/arguments.hpp"
#include "program/command.hpp"

namespace geodisk::tools {

void add_tolerance_option(Command command, std::string& tolerance) {
    command.add_option("--tolerance", tolerance, "L",
                       "Farthest that points of other programs, which have no faces,\n"
                       "may lie off the mesh, in mesh units or % of the diagonal (0.1%)");
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
