#include "bench/tune.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "bench/measure.hpp"
#include "program/failure.hpp"

namespace geodisk::bench {
namespace {

/// Minimum gain of a change that is kept.
constexpr double kMinGain = 0.03;

struct Job {
    PreparedMesh mesh;
    SampleParams params;
    std::string what;
    std::vector<Sample> samples; ///< Samples of the first run, for all others to equal.
};

std::vector<Job> jobs_of(const Options& options, const std::vector<NamedMesh>& meshes) {
    std::vector<Job> jobs;
    for (const NamedMesh& mesh : meshes) {
        for (const double count : options.counts) {
            const BenchMesh prepared = prepare_mesh(mesh.name, mesh.file, 1);
            jobs.push_back({prepared.prepared,
                            params_for(prepared, count, options.seed),
                            case_text(prepared, count),
                            {}});
        }
    }
    return jobs;
}

bool is_same(const std::vector<Sample>& a, const std::vector<Sample>& b) {
    return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const Sample& x, const Sample& y) {
        return x.face == y.face && std::equal(x.weights, x.weights + 3, y.weights);
    });
}

/// Device seconds of one run of a job.
double run_once(Runner& runner, Job& job) {
    SampleSet set = run_device(runner, job.mesh, job.params, job.what);
    if (job.samples.empty()) {
        job.samples = std::move(set.samples);
    } else if (!is_same(set.samples, job.samples)) {
        throw tools::UserError(tools::ExitCode::internal,
                               job.what + ": two tunings gave different samples");
    }
    return set.report.seconds.sample;
}

/// Time of `runner` over that of `best`, both measured in turn.
double compare(Runner& best, Runner& runner, std::vector<Job>& jobs, const Repetition& repetition) {
    double log_ratio = 0;
    for (Job& job : jobs) {
        std::vector<double> before;
        std::vector<double> after;
        for (int i = -repetition.warm_ups; i < repetition.repeats; ++i) {
            const double best_seconds = run_once(best, job);
            const double seconds = run_once(runner, job);
            if (i >= 0) {
                before.push_back(best_seconds);
                after.push_back(seconds);
            }
        }
        log_ratio += std::log(median(after) / median(before));
    }
    return std::exp(log_ratio / static_cast<double>(jobs.size()));
}

struct Setting {
    const char* name;
    std::uint32_t Tuning::*field;
    std::vector<std::uint32_t> values;
};

std::vector<Setting> settings_for(const DeviceReport& device) {
    const std::uint32_t most =
        std::min(device.limits.max_workgroup_invocations, device.limits.max_workgroup_size_x);
    std::vector<std::uint32_t> sizes;
    for (std::uint32_t size = 8; size <= std::min(most, 256u); size *= 2) {
        sizes.push_back(size);
    }
    return {{"slot_local_size", &Tuning::slot_local_size, sizes},
            {"pool_block", &Tuning::pool_block, {1, 8, 16, 32, 64}},
            {"batches", &Tuning::batches, {4, 8, 12, 16, 24, 32, 48}},
            {"local_size", &Tuning::local_size, sizes}};
}

class Search {
  public:
    Search(const Context& context, const Options& options, std::vector<Job> jobs,
           const Tuning& start, const std::function<void(const Trial&)>& on_trial)
        : context_(context), options_(options), jobs_(std::move(jobs)), on_trial_(on_trial),
          best_(create(start)) {}

    const Tuning& best() const { return best_.sampler().tuning(); }

    void try_reads() {
        const Tuning start = best();
        for (const Reads reads : {Reads::storage, Reads::texels}) {
            Tuning tuning = start;
            tuning.reads = reads;
            if (reads != start.reads) {
                attempt(std::string("reads ") + to_string(reads), tuning);
            }
        }
    }

    void try_values(const Setting& setting) {
        const std::uint32_t start = best().*setting.field;
        for (const std::uint32_t value : setting.values) {
            Tuning tuning = best();
            tuning.*setting.field = value;
            if (value != start) {
                attempt(std::string(setting.name) + ' ' + std::to_string(value), tuning);
            }
        }
    }

  private:
    Runner create(const Tuning& tuning) const {
        RunnerOptions options = options_.runner;
        options.sampler.tuning = tuning;
        return tools::take(Runner::create(context_.device(), context_.queue(), options));
    }

    void attempt(const std::string& setting, const Tuning& tuning) {
        if (!chosen_tuning(tuning, context_.report())) {
            return; // Some devices cannot read texels.
        }
        Runner runner = create(tuning);
        const double ratio = compare(best_, runner, jobs_, {options_.warm_ups, options_.repeats});
        const bool is_kept = ratio < 1 - kMinGain;
        if (is_kept) {
            best_ = std::move(runner);
        }
        on_trial_({setting, ratio, is_kept});
    }

    const Context& context_;
    const Options& options_;
    std::vector<Job> jobs_;
    const std::function<void(const Trial&)>& on_trial_;
    Runner best_;
};

} // namespace

Tuning find_tuning(const Context& context, const Options& options,
                   const std::vector<NamedMesh>& meshes, const Tuning& start,
                   const std::function<void(const Trial&)>& on_trial) {
    const Tuning& given = options.runner.sampler.tuning;
    Search search(context, options, jobs_of(options, meshes), start, on_trial);
    if (given.reads == Reads::automatic) {
        search.try_reads();
    }
    for (const Setting& setting : settings_for(context.report())) {
        if (given.*setting.field == 0) {
            search.try_values(setting);
        }
    }
    return search.best();
}

} // namespace geodisk::bench
