// Requests sampled on a device of the caller.
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <type_traits>
#include <utility>

#include <geodisk/request.hpp>

#include "engine/neighbours/order_samples.hpp"
#include "engine/request/on_mesh.hpp"
#include "engine/run/runner_impl.hpp"
#include "support/guard.hpp"
#include "support/invalid.hpp"
#include "support/try.hpp"

namespace geodisk {
namespace {

/// Puts samples in farthest-point order, and leaves out those that are not to be kept.
void put_in_order(RequestedSet& found, FarthestOrder order) {
    const auto chosen = [&](const auto& values) {
        std::remove_cvref_t<decltype(values)> rows;
        for (const std::uint32_t index : order.indices) {
            if (index < values.size()) {
                rows.push_back(values[index]);
            }
        }
        return rows;
    };
    found.unkept = found.set.samples.size() - order.indices.size();
    found.set.samples = chosen(found.set.samples);
    found.set.classes = chosen(found.set.classes);
    found.features = chosen(found.features);
    found.ends = {found.set.samples.size()};
    found.farthest = std::move(order);
}

Result<std::vector<RequestedSet>> finished(Result<StartedRequests> started) {
    constexpr std::chrono::milliseconds kPatience(50);
    GEODISK_TRY(started);
    for (;;) {
        auto found = started->poll(kPatience);
        GEODISK_TRY(found);
        if (*found) {
            return std::move(**found);
        }
    }
}

/// Returns the only set.
Result<RequestedSet> only(Result<std::vector<RequestedSet>> found) {
    return found ? Result<RequestedSet>(std::move(found->front())) : found.error();
}

} // namespace

struct StartedRequests::Impl {
    Runner& runner;
    std::vector<MeshRequest> requests; ///< On meshes; none in a box.
    RequestRuns runs;
    ProgressCallback progress;
    std::vector<RequestedSet> found{}; ///< Once all runs are done.
    std::size_t ordered = 0;           ///< Sets that have their order.
    bool in_progress = false;          ///< A run or search.
    bool has_ended = false;            ///< poll() has returned samples or an error.

    Impl(Runner& with, std::span<const MeshRequest> of, RequestRuns made, ProgressCallback heard)
        : runner(with), requests(of.begin(), of.end()), runs(std::move(made)),
          progress(std::move(heard)) {}
    Impl(const Impl&) = delete;
    Impl& operator=(const Impl&) = delete;
    ~Impl() {
        if (in_progress) {
            runner.cancel();
        }
    }

    Runner::Impl& own_runner() const { return Runner::Impl::of(runner); }
    /// Begins the next run or search, if there is one.
    Result<Done> begin_next();
    Result<Done> begin_next_order();
    /// Goes on with the run or search in progress.
    Result<Done> go_on(std::chrono::milliseconds patience);
    /// Return true once it is done.
    Result<bool> go_on_sampling(std::chrono::milliseconds patience);
    Result<bool> go_on_ordering(std::chrono::milliseconds patience);
};

Result<Done> StartedRequests::Impl::begin_next() {
    if (const Domain* const job = runs.job()) {
        const auto started = runner.start(*job, progress);
        in_progress = static_cast<bool>(started);
        return started ? started : runs.named(started.error());
    }
    if (found.empty()) {
        auto made = std::move(runs).finish();
        GEODISK_TRY(made);
        found = std::move(*made);
    }
    return begin_next_order();
}

Result<Done> StartedRequests::Impl::begin_next_order() {
    for (; ordered < requests.size(); ++ordered) {
        const auto& [mesh, request] = requests[ordered];
        const std::vector<Sample>& samples = found[ordered].set.samples;
        if (request.order == SampleOrder::farthest && !samples.empty()) {
            FarthestParams params{request.keep};
            params.existing = static_cast<std::uint32_t>(request.params.existing.size());
            GEODISK_TRY(own_runner().begin(order_samples(own_runner(), *mesh, samples, params),
                                           chosen_of(samples, params), progress));
            in_progress = true;
            break;
        }
    }
    return Done{};
}

Result<bool> StartedRequests::Impl::go_on_sampling(std::chrono::milliseconds patience) {
    auto set = runner.poll(patience);
    if (!set) {
        return runs.named(set.error());
    }
    if (*set) {
        GEODISK_TRY(runs.take(std::move(**set)));
    }
    return set->has_value();
}

Result<bool> StartedRequests::Impl::go_on_ordering(std::chrono::milliseconds patience) {
    auto order = own_runner().poll<FarthestOrder>(patience);
    if (!order) {
        return on_mesh(ordered, requests.size(), order.error());
    }
    if (*order) {
        put_in_order(found[ordered++], std::move(**order));
    }
    return order->has_value();
}

Result<Done> StartedRequests::Impl::go_on(std::chrono::milliseconds patience) {
    const auto is_done = found.empty() ? go_on_sampling(patience) : go_on_ordering(patience);
    if (is_done && !*is_done) {
        return Done{};
    }
    in_progress = false;
    return is_done ? begin_next() : is_done.error();
}

StartedRequests::StartedRequests(std::unique_ptr<Impl> impl) noexcept : impl_(std::move(impl)) {}
StartedRequests::StartedRequests(StartedRequests&&) noexcept = default;
StartedRequests& StartedRequests::operator=(StartedRequests&&) noexcept = default;
StartedRequests::~StartedRequests() = default;

Result<StartedRequests> StartedRequests::begin(Runner& runner,
                                               std::span<const MeshRequest> requests,
                                               Result<RequestRuns> runs,
                                               const ProgressCallback& progress) {
    GEODISK_TRY(runs);
    StartedRequests started(std::make_unique<Impl>(runner, requests, std::move(*runs), progress));
    GEODISK_TRY(started.impl_->begin_next());
    return started;
}

Result<StartedRequests> StartedRequests::start(Runner& runner,
                                               std::span<const MeshRequest> requests,
                                               const ProgressCallback& progress) noexcept {
    return guarded([&]() -> Result<StartedRequests> {
        for (std::size_t i = 0; i < requests.size(); ++i) {
            const auto& [mesh, request] = requests[i];
            if (request.order == SampleOrder::farthest && mesh != nullptr) { // Before any work.
                const auto checked = check_farthest_order(runner, *mesh);
                if (!checked) {
                    return on_mesh(i, requests.size(), checked.error());
                }
            }
        }
        return begin(runner, requests, RequestRuns::create(requests), progress);
    });
}

Result<StartedRequests> StartedRequests::start(Runner& runner, const BoxRequest& request,
                                               const ProgressCallback& progress) noexcept {
    return guarded([&] { return begin(runner, {}, RequestRuns::create(request), progress); });
}

Result<std::optional<std::vector<RequestedSet>>>
StartedRequests::poll(std::chrono::milliseconds patience) noexcept {
    return guarded([&]() -> Result<std::optional<std::vector<RequestedSet>>> {
        if (impl_->has_ended) {
            return invalid("the requests have ended");
        }
        const auto gone_on = impl_->in_progress ? impl_->go_on(patience) : Done{};
        impl_->has_ended = !gone_on || !impl_->in_progress;
        GEODISK_TRY(gone_on);
        return impl_->has_ended ? std::optional(std::move(impl_->found)) : std::nullopt;
    });
}

Result<RequestedSet> sample(Runner& runner, const PreparedMesh& mesh, const SampleRequest& request,
                            const ProgressCallback& progress) noexcept {
    return guarded([&] {
        const MeshRequest one{&mesh, request};
        return only(sample(runner, std::span(&one, 1), progress));
    });
}

Result<RequestedSet> sample(Runner& runner, const BoxRequest& request,
                            const ProgressCallback& progress) noexcept {
    return guarded(
        [&] { return only(finished(StartedRequests::start(runner, request, progress))); });
}

Result<std::vector<RequestedSet>> sample(Runner& runner, std::span<const MeshRequest> requests,
                                         const ProgressCallback& progress) noexcept {
    return guarded([&] { return finished(StartedRequests::start(runner, requests, progress)); });
}

} // namespace geodisk
