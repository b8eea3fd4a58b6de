// The vertices of a mesh as candidates, for the list of a domain.
#pragma once

#include <vector>

#include <geodisk/domain.hpp>
#include <geodisk/export.hpp>
#include <geodisk/mesh.hpp>
#include <geodisk/params.hpp>
#include <geodisk/status.hpp>

#include "engine/domain/listed.hpp"

namespace geodisk {

/// Returns the vertices of faces with area that take samples, in the order in which darts find
/// them: each dart hits one with a probability by its share of the area, a third of each of its
/// faces. A function of the seed and of the numbers of vertices. Points are in faces that take
/// samples.
GEODISK_API std::vector<ListedCandidate> vertex_darts(const PreparedMesh& mesh,
                                                      const SampleParams& params);

/// Makes the domain of samples at vertices alone. The pool ratio has no effect. `mesh` and `params`
/// as for Domain::surface().
///
/// Errors: those of listed_domain(); `invalid_argument` for what `at_vertices` excludes.
Result<Domain> vertex_domain(const PreparedMesh& mesh, const SampleParams& params);

} // namespace geodisk
