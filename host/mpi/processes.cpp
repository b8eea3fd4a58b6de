#include <algorithm>
#include <utility>

#include "cut_surface.hpp"
#include "ending_all.hpp"
#include "geodisk/mpi.hpp"
#include "mpi_exchange.hpp"
#include "parts/sample_parts.hpp"
#include "support/guard.hpp"
#include "support/invalid.hpp"
#include "support/try.hpp"

namespace geodisk {
namespace {

// With the buffers of the device, a part of so many faces takes about 300 MB, and it fits the
// bindings of all devices.
constexpr std::uint64_t kFacesOfPart = std::uint64_t{1} << 20;

} // namespace

Processes::Processes(MPI_Comm communicator, ProcessOptions options,
                     std::unique_ptr<Exchange> exchange)
    : communicator_(communicator), options_(std::move(options)), exchange_(std::move(exchange)) {}

Result<Processes> Processes::create(MPI_Comm communicator, ProcessOptions options) noexcept {
    return guarded([&]() -> Result<Processes> {
        auto lanes = MpiExchange::create_lanes(communicator, 1, options.goes_on);
        GEODISK_TRY(lanes);
        return Processes(communicator, std::move(options), std::move(lanes->front()));
    });
}

Result<SharedSamples> Processes::sample(Runner& runner, const PreparedMesh* mesh,
                                        const SampleParams* params, const Checkpoints* checkpoints,
                                        const ProgressCallback& progress) const noexcept {
    return ending_all(options_, [&]() -> Result<SharedSamples> {
        const bool is_first = exchange_->rank() == 0;
        const bool is_given = mesh != nullptr && params != nullptr;
        const Error wrong = invalid(is_first ? "process 0 must give the mesh and the parameters"
                                             : "only process 0 gives a mesh and parameters");
        GEODISK_TRY(exchange_->check_all(is_first == is_given ? nullptr : &wrong));
        if (!is_first) {
            return sample_parts(*exchange_, runner, nullptr, progress);
        }
        const Cut cut = cut_surface;
        WholeSurface whole{*mesh, *params, cut};
        whole.checkpoints = checkpoints;
        return sample_parts(*exchange_, runner, &whole, progress);
    });
}

std::uint32_t Processes::parts_for(std::uint64_t faces, std::uint32_t wanted) const noexcept {
    int level = MPI_THREAD_SINGLE;
    MPI_Query_thread(&level);
    if (level < MPI_THREAD_SERIALIZED) {
        return 1;
    }
    const std::uint64_t own = faces / exchange_->size();
    const std::uint64_t parts = wanted != 0 ? wanted : (own + kFacesOfPart - 1) / kFacesOfPart;
    const std::uint64_t most = std::min<std::uint64_t>(own, SharedSurface::kMaxParts);
    return static_cast<std::uint32_t>(std::max<std::uint64_t>(1, std::min(parts, most)));
}

Result<SharedSamples> sample_together(MPI_Comm communicator, Runner& runner,
                                      const PreparedMesh* mesh, const SampleParams* params,
                                      const ProgressCallback& progress) noexcept {
    return guarded([&]() -> Result<SharedSamples> {
        const auto processes = Processes::create(
            communicator, {[&] { return !progress || progress(runner.progress()); }, {}});
        GEODISK_TRY(processes);
        return processes->sample(runner, mesh, params, nullptr, progress);
    });
}

} // namespace geodisk
