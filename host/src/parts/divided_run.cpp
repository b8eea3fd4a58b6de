#include "parts/divided_run.hpp"

#include <algorithm>
#include <utility>

#include "parts/cut.hpp"
#include "support/guard.hpp"
#include "support/try.hpp"

namespace geodisk {
namespace {

Result<std::vector<std::uint32_t>> cut_by_work(const PreparedMesh& mesh, const SampleParams& params,
                                               std::uint32_t parts) {
    return halved_parts(mesh, work_of_faces(mesh, params), parts);
}

/// Adds the progress of two runs.
Progress sum_of(const Progress& a, const Progress& b) {
    return {a.decided + b.decided, std::max(a.candidates, b.candidates), a.accepted + b.accepted,
            a.disks + b.disks, a.windows + b.windows};
}

} // namespace

DividedRun::DividedRun(Runner& runner, const WholeJob& job, std::uint32_t parts)
    : runner_(runner), cut_(cut_by_work), whole_{.mesh = *job.mesh,
                                                 .params = job.params,
                                                 .cut = cut_,
                                                 .frame = &job.frame,
                                                 .list = job.list,
                                                 .is_checked = true,
                                                 .is_shared = true},
      exchanges_(LocalExchange::create(parts)), working_(parts) {
    try {
        for (std::size_t part = 0; part < exchanges_.size(); ++part) {
            threads_.emplace_back([this, part] { work(part); });
        }
    } catch (...) {
        exchanges_.front()->give_up({Status::internal, "no thread"});
        for (std::thread& thread : threads_) {
            thread.join();
        }
        throw;
    }
}

DividedRun::~DividedRun() {
    cancel();
    for (std::thread& thread : threads_) {
        thread.join();
    }
}

void DividedRun::work(std::size_t part) {
    LocalExchange& exchange = *exchanges_[part];
    auto done = guarded([&]() -> Result<SharedSamples> {
        return sample_parts(exchange, runner_, &whole_,
                            [this, part](const Progress& now) { return note(part, now); });
    });
    if (!done) {
        exchange.give_up(done.error());
    }
    const std::scoped_lock lock(mutex_);
    if (!done && (!result_ || *result_)) {
        result_ = done.error();
    } else if (part == 0 && !result_) {
        result_ = std::move(done->set);
    }
    --working_;
    changed_.notify_all();
}

bool DividedRun::note(std::size_t part, const Progress& now) {
    const std::scoped_lock lock(mutex_);
    if (part != latest_ || now.decided < now_.decided) {
        done_ = sum_of(done_, now_);
        latest_ = part;
    }
    now_ = now;
    has_news_ = true;
    changed_.notify_all();
    return !is_cancelled_;
}

Result<std::optional<SampleSet>> DividedRun::poll(std::chrono::milliseconds patience) {
    std::unique_lock lock(mutex_);
    changed_.wait_for(lock, patience, [&] { return working_ == 0 || has_news_; });
    has_news_ = false;
    if (working_ > 0) {
        return std::optional<SampleSet>();
    }
    return *result_ ? Result<std::optional<SampleSet>>(std::move(**result_)) : result_->error();
}

Progress DividedRun::progress() {
    const std::scoped_lock lock(mutex_);
    return sum_of(done_, now_);
}

void DividedRun::cancel() {
    const std::scoped_lock lock(mutex_);
    is_cancelled_ = true;
}

} // namespace geodisk
