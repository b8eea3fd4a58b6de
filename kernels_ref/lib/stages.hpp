// The stages in which the candidates of a job come (host/docs/determinism.md, "Stages").
#pragma once

#include <cstdint>

namespace geodisk::ref {

struct StageRule {
    double samples = 0;      ///< Expected on the surface or in the box.
    double ratio = 0;        ///< Candidates of a pool per expected sample.
    std::uint32_t darts = 0; ///< Darts to throw; 0 for a pool.

    /// Returns the rule for a job that expects this many samples. No pool expects fewer than 64
    /// candidates.
    static StageRule of(double samples, double pool_ratio, std::uint32_t darts);

    /// Returns the number of stages of a pool.
    std::uint32_t pool_stages() const;
    /// Returns the candidates of a stage per expected sample.
    double per_sample(std::uint32_t stage) const;
    /// Returns the candidates that a stage expects.
    double expected(std::uint32_t stage) const { return per_sample(stage) * samples; }
};

} // namespace geodisk::ref
