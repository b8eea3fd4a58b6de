// Requests sampled on a device of the caller.
#include <type_traits>
#include <utility>

#include <geodisk/request.hpp>

#include "engine/request/on_mesh.hpp"
#include "support/guard.hpp"

namespace geodisk {
namespace {

/// Puts the samples in farthest-point order, and leaves out those that are not to be kept.
Result<Done> put_farthest_first(Runner& runner, const PreparedMesh& mesh, std::uint32_t keep,
                                const ProgressCallback& progress, RequestedSet& found) {
    if (found.set.samples.empty()) {
        return Done{};
    }
    auto order = farthest_order(runner, mesh, found.set.samples, keep, progress);
    if (!order) {
        return order.error();
    }
    const auto chosen = [&](const auto& values) {
        std::remove_cvref_t<decltype(values)> rows;
        for (const std::uint32_t index : order->indices) {
            if (index < values.size()) {
                rows.push_back(values[index]);
            }
        }
        return rows;
    };
    found.unkept = found.set.samples.size() - order->indices.size();
    found.set.samples = chosen(found.set.samples);
    found.set.classes = chosen(found.set.classes);
    found.features = chosen(found.features);
    found.ends = {found.set.samples.size()};
    found.farthest = std::move(*order);
    return Done{};
}

/// Does what is left once all runs are done.
Result<Done> complete(Runner& runner, const PreparedMesh& mesh, const SampleRequest& request,
                      const ProgressCallback& progress, RequestedSet& found) {
    return request.order == SampleOrder::farthest
               ? put_farthest_first(runner, mesh, request.keep, progress, found)
               : Done{};
}

/// Samples all steps of a run.
Result<RequestedSet> finished(Runner& runner, Result<RequestRun> run,
                              const ProgressCallback& progress) {
    if (!run) {
        return run.error();
    }
    while (const RequestStep* step = run->step()) {
        auto set = runner.sample_and_wait(step->domain, progress);
        if (!set) {
            return set.error();
        }
        if (const auto taken = run->take(std::move(*set)); !taken) {
            return taken.error();
        }
    }
    return std::move(*run).finish();
}

} // namespace

Result<RequestedSet> sample(Runner& runner, const PreparedMesh& mesh, const SampleRequest& request,
                            const ProgressCallback& progress) noexcept {
    return guarded([&]() -> Result<RequestedSet> {
        auto found = finished(runner, RequestRun::create(mesh, request), progress);
        if (!found) {
            return found.error();
        }
        const auto completed = complete(runner, mesh, request, progress, *found);
        return completed ? std::move(found) : completed.error();
    });
}

Result<RequestedSet> sample(Runner& runner, const BoxRequest& request,
                            const ProgressCallback& progress) noexcept {
    return guarded([&] { return finished(runner, RequestRun::create(request), progress); });
}

Result<std::vector<RequestedSet>> sample(Runner& runner, std::span<const MeshRequest> requests,
                                         const ProgressCallback& progress) noexcept {
    return guarded([&]() -> Result<std::vector<RequestedSet>> {
        auto runs = RequestRuns::create(requests);
        if (!runs) {
            return runs.error();
        }
        while (const Domain* job = runs->job()) {
            auto set = runner.sample_and_wait(*job, progress);
            if (!set) {
                return runs->named(set.error());
            }
            if (const auto taken = runs->take(std::move(*set)); !taken) {
                return taken.error();
            }
        }
        auto found = std::move(*runs).finish();
        for (std::size_t i = 0; found && i < requests.size(); ++i) {
            const auto& [mesh, request] = requests[i];
            if (const auto completed = complete(runner, *mesh, request, progress, (*found)[i]);
                !completed) {
                return on_mesh(i, requests.size(), completed.error());
            }
        }
        return found;
    });
}

} // namespace geodisk
