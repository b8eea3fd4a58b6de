// ProcessReport, SharedSamples: what many processes give that sample a surface together.
// Experimental.
#pragma once

#include <cstdint>
#include <vector>

#include <geodisk/runner.hpp>

namespace geodisk {

/// Work and messages of one process.
struct ProcessReport {
    std::uint32_t parts = 0;      ///< Parts that it decides, one after another. Other counts add
                                  ///< up over them.
    std::uint64_t own_faces = 0;  ///< Faces whose candidates it decides.
    std::uint64_t faces = 0;      ///< Faces that it holds: those, and the surface around them.
    std::uint64_t candidates = 0; ///< Candidates of its own faces.
    std::uint64_t samples = 0;    ///< Samples on its own faces.
    std::uint64_t part_bytes = 0; ///< Size of the message with its part.
    std::uint64_t messages = 0;   ///< Messages to its neighbours.
    std::uint64_t bytes = 0;      ///< Size of those, in bytes.
    std::uint32_t rounds = 0; ///< Exchanges with all its neighbours, the same for all processes.
    std::uint32_t neighbours = 0;  ///< Number of parts with which it exchanges samples.
    std::uint32_t whole_runs = 0;  ///< Times it decided all its candidates.
    std::uint64_t peak_bytes = 0;  ///< Peak memory of the process so far; 0 if the system does
                                   ///< not report it.
    std::uint32_t border_runs = 0; ///< Times it decided only those near its neighbours.
};

/// Samples of many processes, at process 0 of them. Empty on the others.
struct SharedSamples {
    /// Samples of the whole surface: the set that Runner::sample_and_wait() returns for it. In its
    /// report, work adds up over all processes; seconds are those of process 0.
    SampleSet set;
    std::vector<ProcessReport> processes; ///< Share of each process.
};

} // namespace geodisk
