// Borders of a surface of which no process holds the whole.
#pragma once

#include <cstdint>
#include <span>

#include <geodisk/mesh_range.hpp>

#include "mesh/radius_pieces.hpp"
#include "parts/ranges/examine.hpp"
#include "parts/ranges/talk.hpp"

namespace geodisk {

/// Returns the length of all borders of the faces that take samples, as distance_for_count() takes
/// it and a single process adds it up. All processes call it. `radii` are those of the vertices of
/// `faces`, or empty; `mask` is that of the range, or empty.
double border_length(Talk& talk, const MeshRange& range, const RangeFaces& faces,
                     const VertexRadii& radii, std::span<const std::uint8_t> mask);

} // namespace geodisk
