// Options of a benchmark run.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "program/command.hpp"

#include <geodisk/runner.hpp>

namespace geodisk::bench {

/// The command line, checked as far as that is possible without meshes and device.
struct Options {
    std::vector<std::string> meshes;
    std::vector<double> counts; ///< Target number of samples; those of the sweep if `scaling`.
    int repeats = 5;
    int warm_ups = 1;
    std::uint64_t seed = 1; ///< Seed of all runs; copies count on from it.
    std::string device;
    RunnerOptions runner;

    bool tune = false;
    bool scaling = false;
    std::uint32_t copies = 0; ///< Copies of each mesh, to sample together; 0 for a table of meshes.
    double face_sweep_count = 0; ///< Target number of samples while triangles vary.
    std::uint64_t max_faces = 0; ///< Maximum in the sweep of triangles.

    std::string json, csv; ///< Files to write; empty for none.
};

/// Adds all options to `app`, and `run` as what to do with them once parsed. Values out of range
/// and contradictions throw UserError(usage) before `run` is called.
void add_options(tools::Command app, void (*run)(const Options&));

} // namespace geodisk::bench
