// Timing the sampler beside the sequential reference.
#pragma once

#include <cstdint>
#include <string>

#include <geodisk/runner.hpp>

#include "geometry/mesh.hpp"

namespace geodisk::bench {

/// One mesh at one count. Seconds are medians; the sets of both sides were found equal before.
struct Measurement {
    std::string mesh;
    std::uint64_t triangles = 0;
    double wanted = 0; ///< Samples aimed at.
    double min_distance = 0;
    std::uint64_t samples = 0;
    struct {
        double prepare = 0; ///< PreparedMesh::prepare.
        double upload = 0;  ///< As RunReport, like sample and readback.
        double device = 0;  ///< From the candidates to the set, on the device.
        double readback = 0;
        double reference = 0; ///< The same as `device`, sequentially in double precision.
    } seconds;
    /// Least processor time of a run, over all cores. Other work on the machine hardly changes it.
    struct {
        double device = 0; ///< With upload and readback. Meaningful where the device is a CPU.
        double reference = 0;
    } cpu_seconds;
    RunReport run; ///< Report of the last run; only its seconds vary.

    double per_sample(double value) const { return value / static_cast<double>(samples); }
    double per_disk(double value) const { return value / static_cast<double>(run.disks); }
};

/// A mesh ready to be sampled, and how long that took.
struct BenchMesh {
    std::string name;
    PreparedMesh prepared;
    double prepare_seconds = 0; ///< Median.
};

/// Prepares `mesh` `repeats` times. Throws UserError(bad_input) if it is rejected.
BenchMesh prepare_mesh(const std::string& name, const tools::MeshFile& mesh, int repeats);

/// Returns parameters that give about `count` samples.
SampleParams params_for(const BenchMesh& mesh, double count, std::uint64_t seed);

/// "bunny.ply, 1,000 samples", for messages.
std::string case_text(const BenchMesh& mesh, double count);

/// One run. Throws UserError: `out_of_memory` if the job does not fit, or when interrupted.
SampleSet run_device(Runner& runner, const PreparedMesh& mesh, const SampleParams& params,
                     const std::string& what);

struct Repetition {
    int warm_ups = 1;
    int repeats = 5;
};

/// Samples `mesh` on the device and by the float reference and compares the sets. Then times the
/// device, all runs in one go after a warm-up of at least 0.1 s, and after that the reference in
/// double precision: a GPU that waits for the reference falls asleep.
///
/// Throws UserError: `internal` if the sets differ, `out_of_memory` if the job does not fit, or
/// when interrupted.
Measurement measure(Runner& runner, const BenchMesh& mesh, double count, std::uint64_t seed,
                    const Repetition& repetition);

} // namespace geodisk::bench
