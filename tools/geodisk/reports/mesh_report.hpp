// Report of the commands on a mesh they were given: to people and to programs.
#pragma once

#include <cstdint>
#include <string>

#include "files/samples/sample_file.hpp"
#include "geodisk/inputs/mesh_input.hpp"
#include "geodisk/reports/json_type.hpp"

namespace geodisk::tools {

/// Lines of a summary, the first with `label`: its path, the options about it, its size and what is
/// particular about it.
std::string mesh_lines(const std::string& label, const MeshInput& input,
                       std::uint64_t components_without_samples = 0);

/// The same for programs.
Json mesh_json(const MeshInput& input);

/// Returns how many points, and what length of lines, are avoided; "" for none.
std::string avoided_text(std::size_t points, double length);

} // namespace geodisk::tools
