// Timing the sampler beside the sequential reference.
#pragma once

#include <string>

#include <geodisk/runner.hpp>

#include "bench/measurement.hpp"
#include "geometry/mesh.hpp"
#include "program/failure.hpp"

namespace geodisk::bench {

/// A mesh ready to be sampled, and how long that took.
struct BenchMesh {
    std::string name;
    PreparedMesh prepared;
    double prepare_seconds = 0; ///< Median.
};

/// Prepares `mesh` `repeats` times. Throws UserError(bad_input) if it is rejected.
BenchMesh prepare_mesh(const std::string& name, const tools::MeshFile& mesh, int repeats);

/// What gives about `count` samples, with the seed of all measurements.
SampleParams params_for(const BenchMesh& mesh, double count);

/// "bunny.ply, 1,000 samples", for messages.
std::string case_text(const BenchMesh& mesh, double count);

/// One run. Throws UserError: `out_of_memory` if the job does not fit, or when interrupted.
SampleSet run_device(Runner& runner, const PreparedMesh& mesh, const SampleParams& params,
                     const std::string& what);

struct Repetition {
    int warm_ups = 1;
    int repeats = 5;
};

/// Samples `mesh` on the device and by the float reference and compares the sets, warms up, then
/// times the device and the reference in double precision in turn.
///
/// Throws UserError: `internal` if the sets differ, `out_of_memory` if the job does not fit, or
/// when interrupted.
Measurement measure(Runner& runner, const BenchMesh& mesh, double count,
                    const Repetition& repetition);

} // namespace geodisk::bench
