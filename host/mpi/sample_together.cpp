#include <utility>

#include "cut_surface.hpp"
#include "geodisk/mpi.hpp"
#include "mpi_exchange.hpp"
#include "parts/sample_parts.hpp"
#include "support/guard.hpp"
#include "support/invalid.hpp"
#include "support/try.hpp"

namespace geodisk {

Result<SharedSamples> sample_together(MPI_Comm communicator, Runner& runner,
                                      const PreparedMesh* mesh, const SampleParams* params,
                                      const ProgressCallback& progress) noexcept {
    return guarded([&]() -> Result<SharedSamples> {
        auto exchange = MpiExchange::create(
            communicator, [&] { return !progress || progress(runner.progress()); });
        GEODISK_TRY(exchange);
        const bool is_first = (*exchange)->rank() == 0;
        const bool is_given = mesh != nullptr && params != nullptr;
        const Error wrong = invalid(is_first ? "process 0 must give the mesh and the parameters"
                                             : "only process 0 gives a mesh and parameters");
        GEODISK_TRY((*exchange)->check_all(is_first == is_given ? nullptr : &wrong));
        const Cut cut = cut_surface;
        std::optional<WholeSurface> whole;
        if (is_first) {
            whole.emplace(WholeSurface{*mesh, *params, cut});
        }
        auto result = sample_parts(**exchange, runner, whole ? &*whole : nullptr, progress);
        GEODISK_TRY(result);
        return result;
    });
}

} // namespace geodisk
