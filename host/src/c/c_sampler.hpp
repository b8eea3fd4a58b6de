// Samplers of the C API.
#pragma once

#include <atomic>
#include <memory>
#include <optional>

#include <geodisk/geodisk.h>
#include <geodisk/runner.hpp>

#include "c/c_call.hpp"
#include "c/c_device.hpp"
#include "c/c_domain.hpp"
#include "c/c_request.hpp"
#include "support/try.hpp"

namespace geodisk::c {

struct NeighbourSearch;

struct SamplerState {
    SamplerState(std::shared_ptr<const Device> on, Runner made)
        : device(std::move(on)), runner(std::move(made)) {}

    std::shared_ptr<const Device> device;
    Runner runner;
    std::atomic<bool> is_held = false; ///< True while a call uses it.
    std::atomic<bool> is_cancelled = false;
    std::shared_ptr<const DomainState> running; ///< Domain of the run in progress, if one was
                                                ///< started.
    std::shared_ptr<RequestsState> requested;   ///< The requests in progress, likewise.
    std::shared_ptr<NeighbourSearch> searching; ///< The search in progress, likewise.

    bool is_busy() const { return running || requested || searching; }

    /// Returns what tells the caller's function of progress, if there is one, and stops the run
    /// once it is cancelled.
    ProgressCallback callback(geodisk_progress_fn progress, void* user);
};

/// Returns the error of a call that a run in progress does not allow.
Error run_in_progress();

geodisk_progress progress_of(const Progress& state);

/// Returns what calls `progress`, which may be null, with `user`.
ProgressCallback heard_by(geodisk_progress_fn progress, void* user);

} // namespace geodisk::c

struct geodisk_sampler {
    std::shared_ptr<geodisk::c::SamplerState> shared;
};

namespace geodisk::c {

/// Runs `body(state)` unless another call uses the sampler.
template <class Body>
geodisk_status with_sampler(geodisk_sampler* sampler, geodisk_error* error, const Body& body) {
    return answer(error, [&]() -> Result<Done> {
        if (sampler == nullptr) {
            return wrong("sampler is NULL");
        }
        const std::shared_ptr<SamplerState> state = sampler->shared;
        return hold(state->is_held, "the sampler", [&]() -> Result<Done> { return body(*state); });
    });
}

/// Returns what `find(progress)` does, unless a run is in progress or the validation layer objects.
template <class Find>
auto search(SamplerState& state, geodisk_progress_fn progress, void* user, const Find& find)
    -> decltype(find(ProgressCallback{})) {
    if (state.is_busy()) {
        return run_in_progress();
    }
    state.is_cancelled = false;
    auto found = find(state.callback(progress, user));
    if (found) {
        GEODISK_TRY(state.device->check_validation());
    }
    return found;
}

} // namespace geodisk::c
