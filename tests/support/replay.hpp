// The float run judged by double precision: every decision must be right but for ties within the
// guard, and a tie decided the float way is followed, so that what comes after is judged as well.
#pragma once

#include <cstdint>
#include <string>

#include <geodisk/params.hpp>

namespace geodisk::test {

struct ReplayReport {
    std::uint32_t accepted = 0;
    std::uint32_t ties = 0; ///< Decisions where double would differ, within the guard of the limit.
    std::uint32_t wrong = 0; ///< Decisions where double differs by more.
    double largest_gap = 0;  ///< Largest gap of the ties, in units of the minimum distance.
    /// Maximum deviation of the float distances of conflicts from those in double precision, in
    /// units of the guard.
    double largest_deviation = 0;
};

/// Sequential dart throwing as the float twin decides, with every disk checked in double precision.
ReplayReport replay(const PreparedMesh& mesh, const SampleParams& params, double error_bound);

/// Prints how far the run named so deviates; a failure where the guard does not cover it.
void check_deviation(const std::string& name, const ReplayReport& report);

} // namespace geodisk::test
