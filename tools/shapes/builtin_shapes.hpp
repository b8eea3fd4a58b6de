// Surfaces made by formula: for first steps without a mesh file, for tests and for benchmarks.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "geometry/mesh.hpp"

namespace geodisk::tools {

struct BuiltinShape {
    std::string_view name;
    std::string_view summary; ///< Summary of the shape and what the resolution counts, in one line.
    int default_resolution;
    int min_resolution;
    int max_resolution; ///< Keeps every shape below about 20 million triangles.
    MeshFile (*make)(int resolution);
};

/// All shapes, in the order to list them.
std::span<const BuiltinShape> builtin_shapes();

/// Their names, each behind `prefix`.
std::vector<std::string> builtin_names(const std::string& prefix);

/// Generates shape `name`. Every vertex is used, no triangle is degenerate, and neighbours agree in
/// orientation (but across a seam of those that are one-sided). Throws UserError(usage) for an
/// unknown name, listing the known ones, and for a resolution out of range.
MeshFile make_builtin(std::string_view name, std::optional<int> resolution);

} // namespace geodisk::tools
