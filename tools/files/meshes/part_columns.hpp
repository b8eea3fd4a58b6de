// Columns of samples that tell what part of the mesh file a sample lies in.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "files/samples/sample_file.hpp"
#include "geometry/mesh.hpp"

namespace geodisk::tools {

/// The names that --columns takes.
std::vector<std::string> part_column_names();

/// Splits "mesh,primitive" at its commas. Throws UserError(usage) for names that are unknown or
/// repeat.
std::vector<std::string> parse_part_columns(const std::string& text);

/// Throws UserError(bad_input) if the file `path`, which holds `mesh`, does not divide its faces in
/// the ways of `names`.
void check_parts(const std::string& path, const MeshFile& mesh,
                 const std::vector<std::string>& names);

/// Returns the columns of these names, which check_parts() has let pass, for `rows` on `mesh`.
std::vector<ExtraColumn> part_columns(const MeshFile& mesh, const std::vector<std::string>& names,
                                      std::span<const SampleRow> rows);

/// Returns entries for a header that name the numbers in these columns: "material: 0 wood".
HeaderEntries part_name_entries(const MeshFile& mesh, const std::vector<std::string>& columns);

/// Returns the values of one of them for all triangles of `mesh`; kNoPart for those without one.
std::vector<std::uint32_t> part_column_of_triangles(const MeshFile& mesh, const std::string& name);

} // namespace geodisk::tools
