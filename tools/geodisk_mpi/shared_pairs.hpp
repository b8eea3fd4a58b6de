// Pairs of samples found by all processes, each on its part of the surface.
#pragma once

#include <vector>

#include <geodisk/exchange.hpp>
#include <geodisk/status.hpp>

#include "geodisk/checks/near_pairs.hpp"
#include "geodisk/outputs/progress.hpp"

namespace geodisk::tools {

/// Does what note_pairs() does, by all processes; all call it. `search` is null on all but the
/// first one, whose result alone has pairs. Errors, the same on all processes: `invalid_argument`
/// for more processes than faces, and those of note_pairs().
Result<std::vector<NotedPair>> note_together(Exchange& exchange, const PairSearch* search,
                                             ProgressLine& progress);

} // namespace geodisk::tools
