#include "c/c_sampler.hpp"

#include <chrono>
#include <utility>

#include "c/c_call.hpp"
#include "c/c_samples.hpp"

namespace geodisk::c {

Error run_in_progress() {
    return Error{Status::busy, "the sampler has a run in progress; poll until it ends"};
}

geodisk_progress progress_of(const Progress& state) {
    return {sizeof(geodisk_progress), state.decided, state.candidates,
            state.accepted,           state.disks,   state.windows};
}

ProgressCallback SamplerState::callback(geodisk_progress_fn progress, void* user) {
    return [this, progress, user](const Progress& so_far) {
        if (is_cancelled || progress == nullptr) {
            return !is_cancelled;
        }
        const geodisk_progress told = progress_of(so_far);
        return progress(user, &told) == 0;
    };
}

namespace {

Result<Done> hand_over(const SamplerState& state, geodisk_samples made, geodisk_samples** samples) {
    if (const auto checked = state.device->check_validation(); !checked) {
        return checked.error();
    }
    *samples = new geodisk_samples(std::move(made));
    return Done{};
}

/// The samples of a request, with the surface at their distance.
geodisk_samples samples_of(RequestState& request, RequestedSet found) {
    SampleSet set = std::move(found.set);
    found.set = {};
    auto surface = at_found_distance(request, found);
    return {std::move(surface), std::move(set), std::move(found)};
}

/// Begins the next run of the request in progress. Returns true if there is one.
Result<bool> start_step(SamplerState& state) {
    const RequestStep* const step = state.requested->run->step();
    if (step == nullptr) {
        return false;
    }
    const auto go_on = [&state](const Progress&) { return !state.is_cancelled; };
    if (const auto started = state.runner.start(step->domain, go_on); !started) {
        return started.error();
    }
    return true;
}

/// Takes the samples of a run of the request in progress. Returns the samples if it was the last
/// one.
Result<std::optional<RequestedSet>> go_on(SamplerState& state, SampleSet set) {
    RequestRun& run = *state.requested->run;
    if (const auto taken = run.take(std::move(set)); !taken) {
        return taken.error();
    }
    const auto is_started = start_step(state);
    if (!is_started) {
        return is_started.error();
    }
    return *is_started ? std::optional<RequestedSet>() : std::move(run).finish();
}

RunnerOptions options_of(const geodisk_sampler_options& given) {
    RunnerOptions options;
    options.device_bytes = given.device_bytes;
    options.submission_seconds = given.submission_seconds;
    options.stall_seconds = given.stall_seconds;
    return options;
}

} // namespace
} // namespace geodisk::c

using namespace geodisk;
using namespace geodisk::c;

extern "C" {

geodisk_status geodisk_sampler_create(const geodisk_device* device,
                                      const geodisk_sampler_options* options,
                                      geodisk_sampler** sampler, geodisk_error* error) {
    return answer(error, [&]() -> Result<Done> {
        if (device == nullptr || sampler == nullptr) {
            return wrong("device or sampler is NULL");
        }
        const auto wanted = taken_if_any(options, "options");
        if (!wanted) {
            return wanted.error();
        }
        const auto shared = device->shared->sampler();
        if (!shared) {
            return shared.error();
        }
        auto runner = Runner::create(*shared, device->shared->queue(), options_of(*wanted));
        if (!runner) {
            return runner.error();
        }
        *sampler =
            new geodisk_sampler{std::make_shared<SamplerState>(device->shared, std::move(*runner))};
        return Done{};
    });
}

geodisk_status geodisk_sample(geodisk_sampler* sampler, const geodisk_domain* domain,
                              geodisk_progress_fn progress, void* user, geodisk_samples** samples,
                              geodisk_error* error) {
    return with_sampler(sampler, error, [&](SamplerState& state) -> Result<Done> {
        if (domain == nullptr || samples == nullptr) {
            return wrong("domain or samples is NULL");
        }
        if (state.is_busy()) {
            return run_in_progress();
        }
        state.is_cancelled = false;
        auto set =
            state.runner.sample_and_wait(*domain->shared->domain, state.callback(progress, user));
        if (!set) {
            return set.error();
        }
        return hand_over(state, {domain->shared, std::move(*set)}, samples);
    });
}

geodisk_status geodisk_start(geodisk_sampler* sampler, const geodisk_domain* domain,
                             geodisk_error* error) {
    return with_sampler(sampler, error, [&](SamplerState& state) -> Result<Done> {
        if (domain == nullptr) {
            return wrong("domain is NULL");
        }
        if (state.is_busy()) {
            return run_in_progress();
        }
        state.is_cancelled = false;
        const auto go_on = [&state](const Progress&) { return !state.is_cancelled; };
        if (const auto started = state.runner.start(*domain->shared->domain, go_on); !started) {
            return started.error();
        }
        state.running = domain->shared;
        return Done{};
    });
}

geodisk_status geodisk_poll(geodisk_sampler* sampler, uint32_t milliseconds,
                            geodisk_samples** samples, geodisk_error* error) {
    return with_sampler(sampler, error, [&](SamplerState& state) -> Result<Done> {
        if (samples == nullptr) {
            return wrong("samples is NULL");
        }
        if (!state.running && !state.requested) {
            return wrong("the sampler has no run in progress");
        }
        auto polled = state.runner.poll(std::chrono::milliseconds(milliseconds));
        if (polled && !*polled) {
            *samples = nullptr;
            return Done{};
        }
        if (const auto domain = std::exchange(state.running, nullptr)) {
            return polled ? hand_over(state, {domain, std::move(**polled)}, samples)
                          : polled.error();
        }
        auto found = polled ? go_on(state, std::move(**polled)) : polled.error();
        if (found && !*found) {
            *samples = nullptr;
            return Done{};
        }
        const auto request = std::exchange(state.requested, nullptr);
        return found ? hand_over(state, samples_of(*request, std::move(**found)), samples)
                     : found.error();
    });
}

geodisk_status geodisk_sample_request(geodisk_sampler* sampler, const geodisk_mesh* mesh,
                                      const geodisk_request* request, geodisk_progress_fn progress,
                                      void* user, geodisk_samples** samples, geodisk_error* error) {
    return with_sampler(sampler, error, [&](SamplerState& state) -> Result<Done> {
        if (samples == nullptr) {
            return wrong("samples is NULL");
        }
        if (state.is_busy()) {
            return run_in_progress();
        }
        const auto wanted = request_of(mesh, request);
        if (!wanted) {
            return wanted.error();
        }
        state.is_cancelled = false;
        auto found = sample(state.runner, (*wanted)->of->parts[0].mesh->prepared,
                            (*wanted)->request, state.callback(progress, user));
        if (!found) {
            return found.error();
        }
        return hand_over(state, samples_of(**wanted, std::move(*found)), samples);
    });
}

geodisk_status geodisk_start_request(geodisk_sampler* sampler, const geodisk_mesh* mesh,
                                     const geodisk_request* request, geodisk_error* error) {
    return with_sampler(sampler, error, [&](SamplerState& state) -> Result<Done> {
        if (state.is_busy()) {
            return run_in_progress();
        }
        const auto wanted = request_of(mesh, request);
        if (!wanted) {
            return wanted.error();
        }
        if ((*wanted)->request.order == SampleOrder::farthest) {
            return wrong("request->order: call geodisk_farthest_order on the samples");
        }
        auto run = RequestRun::create((*wanted)->of->parts[0].mesh->prepared, (*wanted)->request);
        if (!run) {
            return run.error();
        }
        (*wanted)->run.emplace(std::move(*run));
        state.is_cancelled = false;
        state.requested = *wanted;
        if (const auto started = start_step(state); !started) {
            state.requested = nullptr;
            return started.error();
        }
        return Done{};
    });
}

geodisk_status geodisk_sampler_progress(geodisk_sampler* sampler, geodisk_progress* progress,
                                        geodisk_error* error) {
    return with_sampler(sampler, error, [&](SamplerState& state) {
        return give(progress, "progress",
                    state.is_busy() ? progress_of(state.runner.progress()) : geodisk_progress{});
    });
}

void geodisk_cancel(geodisk_sampler* sampler) {
    if (sampler != nullptr) {
        sampler->shared->is_cancelled = true;
    }
}

geodisk_status geodisk_sampler_trim(geodisk_sampler* sampler, geodisk_error* error) {
    return with_sampler(sampler, error, [](SamplerState& state) -> Result<Done> {
        if (state.is_busy()) {
            return run_in_progress();
        }
        state.runner.release_memory();
        return Done{};
    });
}

void geodisk_sampler_release(geodisk_sampler* sampler) {
    delete sampler;
}

} // extern "C"
