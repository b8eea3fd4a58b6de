// Submissions of one run: what its job records, each as much work as takes about the time it
// should.
#pragma once

#include <cstdint>
#include <functional>

#include <geodisk/runner.hpp>

#include "engine/domain/domain_impl.hpp"
#include "engine/job/record.hpp"
#include "engine/run/pace.hpp"
#include "engine/run/run_memory.hpp"
#include "engine/run/runner_impl.hpp"
#include "engine/run/task.hpp"

namespace geodisk {

class Submissions {
  public:
    /// The arguments must outlive it.
    Submissions(Runner::Impl& runner, RunMemory& memory, const Domain::Impl& of);
    Submissions(const Submissions&) = delete;
    Submissions& operator=(const Submissions&) = delete;

    /// Goes on with a job and its plan.
    void use(Job& job, const RunPlan& plan);
    /// The plan of the job but for dispatches that have to be shorter.
    RunPlan& plan() { return plan_; }
    /// Returns the latest report of the device.
    const gpu::ControlRec& control() const { return control_; }

    using Passes = bool (*)(VkCommandBuffer, Job::Impl&, Budget&);
    /// Records what follows passes that one submission does for. Returns the rounds in it.
    using InOne = std::function<std::uint32_t(VkCommandBuffer, Budget&)>;
    /// Submits passes in as many parts as the time asks for; where one will do, with what `in_one`
    /// records, if anything.
    Task<Result<Done>> run_passes(Passes record, const InOne& in_one);
    /// Submits rounds, behind a rewind or not. An error once the device makes no progress.
    Task<Result<Done>> run_rounds(bool rewind);
    /// Records as many rounds as the time allows, or as are expected to do where all disks together
    /// are little work. Returns how many.
    std::uint32_t record_rounds(VkCommandBuffer commands);

  private:
    Result<Done> submit(const std::function<void(VkCommandBuffer)>& record);
    /// Reads the control record at the end of a submission. Returns the seconds that it took.
    Result<double> took(Result<Done> end);
    /// Notes the time of a submission with this many rounds.
    void took_rounds(double seconds, std::uint32_t rounds, const gpu::ControlRec& before);
    /// Sets dispatches within the time there is.
    Result<Done> shorten();
    Result<Done> check_progress(const gpu::ControlRec& before);
    Progress how_far() const;
    Job::Impl& job() { return Job::Impl::of(*job_); }
    const Job::Impl& job() const { return Job::Impl::of(*job_); }

    Runner::Impl& runner_;
    RunMemory& memory_;
    const Domain::Impl& of_;
    Job* job_ = nullptr;
    RunPlan plan_;
    Paces* paces_ = nullptr;         ///< Paces of the job's kernels.
    std::uint64_t items_of_new_ = 0; ///< Maximum of items of a pass that begins.
    double submitted_ = 0;           ///< When.
    std::uint32_t idle_ = 0;         ///< Submissions of late that left no trace.
    gpu::ControlRec control_{};
    double steps_ = 0;     ///< Steps of all rounds so far.
    double all_steps_ = 0; ///< Steps expected in all.
};

} // namespace geodisk
