#include "geodisk/options/up_option.hpp"

#include "program/command.hpp"

namespace geodisk::tools {

std::optional<picture::Up> UpOption::parsed() const {
    return axis.empty() ? std::nullopt : std::optional(picture::parse_up("--up", axis));
}

void add_up_option(Command command, UpOption& option) {
    command
        .add_option("--up", option.axis, "AXIS",
                    "Axis that points up: x, y or z (default: guess from the mesh)")
        .offers({"x", "y", "z"});
}

} // namespace geodisk::tools
