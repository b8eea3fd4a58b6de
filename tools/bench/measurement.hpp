// What one row of the benchmark says.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <geodisk/runner.hpp>

#include "bench/statistics.hpp"

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
    RunReport run; ///< Of the last run; only its seconds vary.

    double per_sample(double value) const { return value / static_cast<double>(samples); }
    double per_disk(double value) const { return value / static_cast<double>(run.disks); }
};

/// What a series varies. `listed` are the counts asked for, and no sweep.
enum class Sweep { listed, samples, triangles };

const char* to_string(Sweep sweep);

/// How one quantity grows along a sweep.
struct Growth {
    const char* quantity;        ///< "device", "reference" or "prepare": which seconds.
    std::optional<PowerLaw> law; ///< Nothing if the sweep has fewer than two steps.
};

/// The rows of one mesh.
struct Series {
    Sweep sweep = Sweep::listed;
    std::string mesh;
    std::vector<Measurement> rows;
    std::vector<Growth> growth; ///< Empty unless a sweep.
};

/// What `sweep` varies, of one row.
double swept_value(Sweep sweep, const Measurement& row);

/// Fits the exponents that make sense for `sweep`, which is one; those of samples from the count of
/// least time on.
std::vector<Growth> fit_growth(Sweep sweep, const std::vector<Measurement>& rows);

} // namespace geodisk::bench
