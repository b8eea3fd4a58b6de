// Pairs of samples found by all processes, each on its part of the surface.
#pragma once

#include <vector>

#include "geodisk/checks/near_pairs.hpp"
#include "geodisk/outputs/progress.hpp"

namespace geodisk::tools {

struct Process;

struct NoteCall {
    const PairSearch& search;
    ProgressLine& progress;
};

/// Does what note_pairs() does, by all processes. The result of the first one alone has pairs.
/// Throws SharedError: `usage` for more processes than faces, and what note_pairs() throws.
std::vector<NotedPair> note_together(Process& process, const NoteCall* call);

} // namespace geodisk::tools
