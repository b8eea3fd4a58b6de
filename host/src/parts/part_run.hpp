// PartRun: decides the candidates of a part on a device.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include <geodisk/exchange.hpp>
#include <geodisk/runner.hpp>

#include "parts/darts.hpp"
#include "parts/part.hpp"
#include "parts/surroundings.hpp"

namespace geodisk {

class PartRun {
  public:
    /// What it refers to must outlive it. The part has its mesh where begin(), decide_first()
    /// and decide_all() are called.
    PartRun(Exchange& exchange, Part& part, Runner& runner, ProgressCallback progress);

    /// Draws the candidates of own and near faces in some stages. Samples of the stages before,
    /// which all processes have agreed upon, are settled.
    void begin(std::uint32_t first_stage, std::uint32_t stages);
    /// Returns the number of own candidates of these stages up to a stage and priority.
    std::uint64_t own_up_to(std::uint32_t stage, std::uint32_t priority) const;
    /// Leaves out candidates of these stages beyond a priority, of which there is only one.
    void end_at(std::uint32_t priority);

    // These implement Decide. Errors: those of listed_domain() and Runner::sample_and_wait().

    /// Decides own candidates without near samples. Does nothing if it has done so.
    Result<Darts> decide_first();
    /// Returns true if it has.
    bool is_decided() const { return is_decided_ || drawn_.empty(); }
    /// Decides own candidates around near samples that have changed. Returns nothing if samples
    /// farther away may change. border() has its mesh.
    Result<std::optional<Darts>> decide_border(const Darts& near);
    /// Decides all own candidates among near samples.
    Result<Darts> decide_all(const Darts& near);
    /// Returns true if near samples are not those that were decided among last.
    bool has_to_decide(const Darts& near) const { return !drawn_.empty() && near != near_; }
    /// Returns the own samples that were decided last, with these near ones.
    Darts decided(const Darts& near);
    /// Returns the part that decide_border() needs the mesh of.
    Part& border() { return border_ ? *border_ : part_; }

    /// Returns the stages of the job.
    const Stages& stages() const { return stages_; }
    /// Returns own samples of all stages, in dart order.
    Darts samples() const;
    /// Returns the number of own candidates of these stages.
    std::uint64_t own_candidates() const { return drawn_.size(); }
    /// Returns the work on the device so far.
    const RunReport& report() const { return report_; }
    /// Returns how often all own candidates were decided, and only those near others.
    std::uint32_t whole_runs() const { return whole_runs_; }
    std::uint32_t border_runs() const { return border_runs_; }

  private:
    bool is_own(const DrawnCandidate& dart) const;
    /// Does what needs the mesh and is done once.
    void prepare();
    /// Decides these candidates, in dart order, behind existing samples, on a part. Returns those
    /// that are accepted.
    Result<Darts> accepted_of(const Part& part, const Darts& candidates, const Settled& settled);
    /// Notes what was decided last.
    void note(Darts accepted);
    /// Returns both in dart order, which they are in.
    Darts merged(const Darts& some, const Darts& others) const;
    /// Takes candidates that were drawn on a face of the part.
    void take(std::span<const DrawnCandidate> darts, std::uint32_t face);
    /// Adds a settled sample, with its class.
    void settle(const Sample& sample, std::uint8_t number);
    void settle(const DrawnCandidate& dart);

    Exchange& exchange_;
    Part& part_;
    Runner& runner_;
    ProgressCallback progress_;
    DartOrder order_;
    Stages stages_;
    // Candidates, in dart order: own ones, those of near faces until decided, and own ones on
    // border().
    Darts drawn_, drawn_near_, drawn_in_border_;
    Darts settled_own_; ///< Own samples of earlier stages.
    Settled settled_;   ///< Existing samples, and own and near ones of earlier stages.
    Settled settled_in_border_;
    // As they were decided last: samples, of others too, and own ones. Near ones as they were told,
    // or guessed in the first place.
    Darts accepted_, own_, near_;
    std::unique_ptr<Part> border_;  ///< Faces around near ones with their mesh, or null.
    std::vector<double> from_near_; ///< Distances of the vertices of border() from near faces.
    bool is_prepared_ = false;
    bool is_decided_ = false; ///< The candidates of these stages.
    RunReport report_;
    std::uint32_t whole_runs_ = 0, border_runs_ = 0;
};

} // namespace geodisk
