// Requests sampled on a device of the caller.
#include <cstdint>
#include <type_traits>
#include <utility>

#include <geodisk/request.hpp>

#include "engine/request/on_mesh.hpp"
#include "support/guard.hpp"
#include "support/try.hpp"

namespace geodisk {
namespace {

/// Puts the samples in farthest-point order, and leaves out those that are not to be kept.
Result<Done> put_farthest_first(Runner& runner, const PreparedMesh& mesh,
                                const SampleRequest& request, const ProgressCallback& progress,
                                RequestedSet& found) {
    if (found.set.samples.empty()) {
        return Done{};
    }
    FarthestParams params{request.keep};
    params.existing = static_cast<std::uint32_t>(request.params.existing.size());
    auto order = farthest_order(runner, mesh, found.set.samples, params, progress);
    GEODISK_TRY(order);
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
               ? put_farthest_first(runner, mesh, request, progress, found)
               : Done{};
}

/// Samples all jobs of runs.
Result<std::vector<RequestedSet>> finished(Runner& runner, Result<RequestRuns> runs,
                                           const ProgressCallback& progress) {
    GEODISK_TRY(runs);
    while (const Domain* job = runs->job()) {
        auto set = runner.sample_and_wait(*job, progress);
        if (!set) {
            return runs->named(set.error());
        }
        GEODISK_TRY(runs->take(std::move(*set)));
    }
    return std::move(*runs).finish();
}

/// Returns the only set.
Result<RequestedSet> only(Result<std::vector<RequestedSet>> found) {
    return found ? Result<RequestedSet>(std::move(found->front())) : found.error();
}

} // namespace

Result<RequestedSet> sample(Runner& runner, const PreparedMesh& mesh, const SampleRequest& request,
                            const ProgressCallback& progress) noexcept {
    return guarded([&] {
        const MeshRequest one{&mesh, request};
        return only(sample(runner, std::span(&one, 1), progress));
    });
}

Result<RequestedSet> sample(Runner& runner, const BoxRequest& request,
                            const ProgressCallback& progress) noexcept {
    return guarded([&] { return only(finished(runner, RequestRuns::create(request), progress)); });
}

Result<std::vector<RequestedSet>> sample(Runner& runner, std::span<const MeshRequest> requests,
                                         const ProgressCallback& progress) noexcept {
    return guarded([&]() -> Result<std::vector<RequestedSet>> {
        for (std::size_t i = 0; i < requests.size(); ++i) {
            const auto& [mesh, request] = requests[i];
            if (request.order == SampleOrder::farthest && mesh != nullptr) { // Before any work.
                const auto checked = check_farthest_order(runner, *mesh);
                if (!checked) {
                    return on_mesh(i, requests.size(), checked.error());
                }
            }
        }
        auto found = finished(runner, RequestRuns::create(requests), progress);
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
