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
    /// The part and the runner must outlive it. The part has its mesh where this, begin() and
    /// decide() are called, unless decide() has nothing to do.
    PartRun(const Part& part, Runner& runner, ProgressCallback progress);

    /// Draws the candidates of own and near faces in some stages. Samples of the stages before,
    /// which all processes have agreed upon, are settled.
    void begin(std::uint32_t first_stage, std::uint32_t stages);
    /// Returns the number of own candidates of these stages up to a stage and priority.
    std::uint64_t own_up_to(std::uint32_t stage, std::uint32_t priority) const;
    /// Leaves out candidates of these stages beyond a priority, of which there is only one.
    void end_at(std::uint32_t priority);

    /// Implements Decide; decides once without near samples. From the second time on, only own
    /// candidates near others are decided anew, or all if that changes samples farther away.
    /// Errors: those of listed_domain() and Runner::sample_and_wait().
    Result<Darts> decide(const Darts* near);
    /// Returns true if decide() is not sure to give what it gave before.
    bool has_to_decide(const Darts* near) const;

    /// Returns the stages of the job.
    const Stages& stages() const { return stages_; }
    /// Returns own samples of all stages, in dart order.
    Darts samples() const;
    /// Returns the number of own candidates of these stages.
    std::uint64_t own_candidates() const { return own_count_; }
    /// Returns the work on the device so far.
    const RunReport& report() const { return report_; }
    /// Returns how often all own candidates were decided, and only those near others.
    std::uint32_t whole_runs() const { return whole_runs_; }
    std::uint32_t border_runs() const { return border_runs_; }

  private:
    std::uint32_t local(const DrawnCandidate& dart) const;
    bool is_own(const DrawnCandidate& dart) const;
    /// Samples that are settled, and their classes; those may be empty.
    struct Settled {
        std::vector<Sample> samples;
        std::vector<std::uint8_t> classes;
    };
    /// Decides these candidates, in dart order, behind existing samples. Returns those that are
    /// accepted.
    Result<Darts> accepted_of(const Darts& candidates, const Settled& settled);
    /// Adds a settled sample, with its class.
    void settle(const Sample& sample, std::uint8_t number);
    void settle(const DrawnCandidate& dart);
    /// Counts own candidates.
    void count_own();
    /// Decides all own candidates among near samples.
    Result<Darts> decide_all(const Darts& near);
    /// Decides own candidates near others. Returns nothing if other samples may change.
    Result<std::optional<Darts>> decide_border(const Darts& near);

    const Part& part_;
    Runner& runner_;
    ProgressCallback progress_;
    DartOrder order_;
    CandidateDraw draw_;
    Stages stages_;
    Darts drawn_; ///< Candidates of own faces, in dart order. Those of near faces until decided.
    Darts settled_own_;    ///< Own samples of earlier stages.
    Settled settled_;      ///< Existing samples, and own and near ones of earlier stages.
    Settled settled_near_; ///< Those of them that reach the border.
    Darts own_;            ///< Own samples as they were decided last, among these near ones.
    Darts near_;
    std::vector<double> from_near_; ///< Lower bounds on the distance of vertices from near faces.
    double border_reach_ = 0; ///< Maximum distance of samples that reject candidates in the border.
    bool is_decided_ = false; ///< The candidates of these stages.
    std::uint64_t own_count_ = 0;
    RunReport report_;
    std::uint32_t whole_runs_ = 0, border_runs_ = 0;
};

} // namespace geodisk
