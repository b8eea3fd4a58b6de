// PartRun: decides the candidates of a part on a device.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include <geodisk/runner.hpp>

#include "parts/darts.hpp"
#include "parts/part.hpp"

namespace geodisk {

class PartRun {
  public:
    /// Draws the candidates of own and near faces. The part and the runner must outlive it.
    PartRun(const Part& part, Runner& runner, ProgressCallback progress);

    /// Implements Decide. From the second time on, only own candidates near others are decided
    /// anew, or all if that changes samples farther away. Errors: those of listed_domain() and
    /// Runner::sample_and_wait().
    Result<Darts> decide(const Darts* near);

    /// Returns the number of own candidates.
    std::uint64_t own_candidates() const { return own_count_; }
    /// Returns the work on the device so far.
    const RunReport& report() const { return report_; }
    /// Returns how often all own candidates were decided, and only those near others.
    std::uint32_t whole_runs() const { return whole_runs_; }
    std::uint32_t border_runs() const { return border_runs_; }

  private:
    std::uint32_t local(const DrawnCandidate& dart) const;
    bool is_own(const DrawnCandidate& dart) const;
    /// Decides these candidates, in dart order. Returns those that are accepted.
    Result<Darts> accepted_of(const Darts& candidates);
    /// Decides all own candidates among near samples.
    Result<Darts> decide_all(const Darts& near);
    /// Decides own candidates near others. Returns nothing if other samples may change.
    Result<std::optional<Darts>> decide_border(const Darts& near);

    const Part& part_;
    Runner& runner_;
    ProgressCallback progress_;
    DartOrder order_;
    Darts drawn_; ///< Candidates of own faces, in dart order. Those of near faces until decided.
    Darts own_;   ///< Own samples as they were decided last, among these near ones.
    Darts near_;
    std::vector<double> from_near_; ///< Lower bounds on the distance of vertices from near faces.
    std::uint64_t own_count_ = 0;
    RunReport report_;
    std::uint32_t whole_runs_ = 0, border_runs_ = 0;
};

} // namespace geodisk
