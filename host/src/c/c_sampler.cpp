#include "c/c_sampler.hpp"

#include <algorithm>
#include <chrono>
#include <memory>
#include <utility>
#include <vector>

#include "c/c_call.hpp"
#include "c/c_samples.hpp"
#include "support/try.hpp"

namespace geodisk::c {

Error run_in_progress() {
    return Error{Status::busy, "the sampler has a run in progress; poll until it ends"};
}

geodisk_progress progress_of(const Progress& state) {
    return {sizeof(geodisk_progress), state.decided, state.candidates,
            state.accepted,           state.disks,   state.windows};
}

ProgressCallback heard_by(geodisk_progress_fn progress, void* user) {
    if (progress == nullptr) {
        return {};
    }
    return [=](const Progress& state) {
        const geodisk_progress told = progress_of(state);
        return progress(user, &told) == 0;
    };
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
    GEODISK_TRY(state.device->check_validation());
    *samples = new geodisk_samples(std::move(made));
    return Done{};
}

/// Hands over the samples of requests, each with its surface or box at their distance.
Result<Done> hand_over(const SamplerState& state, RequestsState& requests,
                       std::vector<RequestedSet> found, geodisk_samples** samples) {
    GEODISK_TRY(state.device->check_validation());
    std::vector<std::unique_ptr<geodisk_samples>> made;
    for (std::size_t i = 0; i < found.size(); ++i) {
        SampleSet set = std::move(found[i].set);
        found[i].set = {};
        auto of = at_found_distance(*requests.each[i], found[i]);
        GEODISK_TRY(of);
        made.emplace_back(new geodisk_samples{std::move(*of), std::move(set), std::move(found[i])});
    }
    for (std::size_t i = 0; i < made.size(); ++i) {
        samples[i] = made[i].release();
    }
    return Done{};
}

/// Samples what requests ask for, and waits.
Result<Done> serve(SamplerState& state, RequestsState& requests, geodisk_progress_fn progress,
                   void* user, geodisk_samples** samples) {
    state.is_cancelled = false;
    auto found = requests.sample(state.runner, state.callback(progress, user));
    return found ? hand_over(state, requests, std::move(*found), samples) : found.error();
}

/// Begins to serve requests.
Result<Done> start(SamplerState& state, std::shared_ptr<RequestsState> requests) {
    state.is_cancelled = false;
    const auto go_on = [&state](const Progress&) { return !state.is_cancelled; };
    auto started = requests->start(state.runner, go_on);
    GEODISK_TRY(started);
    requests->started.emplace(std::move(*started));
    state.requested = std::move(requests);
    return Done{};
}

/// Goes on with the domain in progress, as geodisk_poll().
Result<Done> poll_domain(SamplerState& state, std::chrono::milliseconds patience,
                         geodisk_samples** samples) {
    auto polled = state.runner.poll(patience);
    if (polled && !*polled) {
        *samples = nullptr;
        return Done{};
    }
    const auto domain = std::exchange(state.running, nullptr);
    return polled ? hand_over(state, {domain, std::move(**polled)}, samples) : polled.error();
}

/// Goes on with the requests in progress, as geodisk_poll().
Result<Done> poll_requests(SamplerState& state, std::chrono::milliseconds patience,
                           geodisk_samples** samples) {
    auto found = state.requested->started->poll(patience);
    if (found && !*found) {
        std::fill_n(samples, state.requested->each.size(), nullptr);
        return Done{};
    }
    const auto requests = std::exchange(state.requested, nullptr);
    return found ? hand_over(state, *requests, std::move(**found), samples) : found.error();
}

/// Samples what the requests that `copy()` returns ask for, and waits.
template <class Copy>
geodisk_status sample_all(geodisk_sampler* sampler, const Copy& copy, geodisk_progress_fn progress,
                          void* user, geodisk_samples** samples, geodisk_error* error) {
    return with_sampler(sampler, error, [&](SamplerState& state) -> Result<Done> {
        if (samples == nullptr) {
            return wrong("samples is NULL");
        }
        if (state.is_busy()) {
            return run_in_progress();
        }
        const auto wanted = copy();
        return wanted ? serve(state, **wanted, progress, user, samples) : wanted.error();
    });
}

/// Begins to serve the requests that `copy()` returns.
template <class Copy>
geodisk_status start_all(geodisk_sampler* sampler, const Copy& copy, geodisk_error* error) {
    return with_sampler(sampler, error, [&](SamplerState& state) -> Result<Done> {
        if (state.is_busy()) {
            return run_in_progress();
        }
        const auto wanted = copy();
        return wanted ? start(state, *wanted) : wanted.error();
    });
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
        GEODISK_TRY(wanted);
        const auto shared = device->shared->sampler();
        GEODISK_TRY(shared);
        auto runner = Runner::create(*shared, device->shared->queue(), options_of(*wanted));
        GEODISK_TRY(runner);
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
        GEODISK_TRY(set);
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
        GEODISK_TRY(state.runner.start(*domain->shared->domain, go_on));
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
        const std::chrono::milliseconds patience(milliseconds);
        return state.requested ? poll_requests(state, patience, samples)
                               : poll_domain(state, patience, samples);
    });
}

geodisk_status geodisk_sample_request(geodisk_sampler* sampler, const geodisk_mesh* mesh,
                                      const geodisk_request* request, geodisk_progress_fn progress,
                                      void* user, geodisk_samples** samples, geodisk_error* error) {
    const geodisk_mesh_request one{sizeof one, mesh, request};
    return geodisk_sample_requests(sampler, &one, 1, progress, user, samples, error);
}

geodisk_status geodisk_sample_requests(geodisk_sampler* sampler,
                                       const geodisk_mesh_request* requests, size_t count,
                                       geodisk_progress_fn progress, void* user,
                                       geodisk_samples** samples, geodisk_error* error) {
    return sample_all(
        sampler, [&] { return requests_of(requests, count); }, progress, user, samples, error);
}

geodisk_status geodisk_start_request(geodisk_sampler* sampler, const geodisk_mesh* mesh,
                                     const geodisk_request* request, geodisk_error* error) {
    const geodisk_mesh_request one{sizeof one, mesh, request};
    return geodisk_start_requests(sampler, &one, 1, error);
}

geodisk_status geodisk_start_requests(geodisk_sampler* sampler,
                                      const geodisk_mesh_request* requests, size_t count,
                                      geodisk_error* error) {
    return start_all(
        sampler, [&] { return requests_of(requests, count); }, error);
}

geodisk_status geodisk_sample_box_request(geodisk_sampler* sampler,
                                          const geodisk_box_request* request,
                                          geodisk_progress_fn progress, void* user,
                                          geodisk_samples** samples, geodisk_error* error) {
    return sample_all(
        sampler, [&] { return requests_of(request); }, progress, user, samples, error);
}

geodisk_status geodisk_start_box_request(geodisk_sampler* sampler,
                                         const geodisk_box_request* request, geodisk_error* error) {
    return start_all(
        sampler, [&] { return requests_of(request); }, error);
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
