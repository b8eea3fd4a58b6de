// --walls: where no path leads.
#pragma once

#include <functional>
#include <string>
#include <variant>
#include <vector>

#include "files/output/files_in_use.hpp"
#include "geodisk/options/mask_options.hpp"

namespace geodisk::tools {

/// Edges where faces turn by more than an angle.
struct CreaseWalls {
    double degrees;
};

/// Edges that a text file names by their vertices.
struct EdgeWalls {
    std::string file;
};

/// One --walls: faces of a part, faces where a rule holds, or edges.
using WallRule = std::variant<OnlyRule, MaskRule, CreaseWalls, EdgeWalls>;

/// Returns the rules that values of --walls are. Throws UserError(usage) for one that is none.
std::vector<WallRule> wall_rules(const std::vector<std::string>& walls);

/// Returns those of them that compare values.
std::vector<MaskRule> mask_rules_of(const std::vector<WallRule>& walls);

/// Adds the files that walls are read from.
void add_wall_files(const std::vector<std::string>& walls, std::vector<NamedFile>& read);

/// Puts `place(name)` for each file that walls are read from.
void place_wall_files(std::vector<std::string>& walls,
                      const std::function<std::string(const std::string&)>& place);

} // namespace geodisk::tools
