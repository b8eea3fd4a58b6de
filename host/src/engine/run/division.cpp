#include "engine/run/division.hpp"

#include <algorithm>
#include <utility>

#include "engine/run/first_parts.hpp"
#include "engine/run/run.hpp"
#include "support/try.hpp"

namespace geodisk {
namespace {

constexpr std::uint32_t kMaxAttempts = 3;

} // namespace

Result<std::unique_ptr<Division>> Division::begin(const Runner::Impl& runner, const Domain& domain,
                                                  const Error& error) {
    const Domain::Impl& of = Domain::Impl::of(domain);
    std::uint32_t parts = 0;
    if (of.whole && is_too_large(error)) {
        const SampleParams& params = of.whole->params;
        parts =
            first_parts(runner, of, *of.whole->mesh, reach_with(params.min_distance, params.avoid));
    }
    if (parts == 0) {
        return std::unique_ptr<Division>();
    }
    auto own = Runner::create(runner.shared_sampler, runner.submitter->queue(), runner.options);
    GEODISK_TRY(own);
    std::unique_ptr<Division> division(new Division(std::move(*own), of, parts));
    division->begin_run();
    return division;
}

Division::Division(Runner runner, const Domain::Impl& of, std::uint32_t parts)
    : runner_(std::move(runner)), job_(*of.whole),
      candidates_(static_cast<std::uint32_t>(of.stages.candidates())),
      expected_(static_cast<std::uint32_t>(of.samples)), parts_(parts) {}

void Division::begin_run() {
    run_.reset();
    run_ = std::make_unique<DividedRun>(runner_, job_, parts_);
}

bool Division::divides_more(const Error& error) {
    ++attempts_;
    parts_ *= 2;
    return is_too_large(error) && attempts_ < kMaxAttempts && parts_ <= job_.mesh->face_count();
}

void Division::poll(std::chrono::milliseconds patience) {
    auto polled = run_->poll(patience);
    if (!polled && divides_more(polled.error())) {
        begin_run();
        return;
    }
    if (polled && !*polled) {
        return;
    }
    end_.emplace(polled ? Result<SampleSet>(std::move(**polled)) : polled.error());
    run_.reset();
    waiting_.resume(); // May destroy this.
}

Progress Division::progress() {
    Progress all = run_->progress();
    all.candidates = candidates_;
    all.decided = std::min(all.decided, candidates_);
    all.accepted = std::min(all.accepted, expected_);
    return all;
}

Task<Result<SampleSet>> run_or_divide(Runner::Impl& runner, const Domain& domain) {
    auto set = co_await run_job(runner, domain, nullptr);
    if (set) {
        co_return set;
    }
    auto division = Division::begin(runner, domain, set.error());
    GEODISK_CO_TRY(division);
    if (*division == nullptr) {
        co_return set;
    }
    co_return co_await (*division)->ended(runner);
}

} // namespace geodisk
