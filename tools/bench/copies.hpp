// Many copies of a mesh: sampled one by one, as one job, and as one mesh.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include <geodisk/runner.hpp>

#include "bench/options.hpp"
#include "bench/sweep.hpp"

namespace geodisk::bench {

/// One mesh at one count of samples for each copy. Seconds are medians of whole runs, from upload
/// to result.
struct CopiesRow {
    std::string mesh;
    std::uint64_t triangles = 0; ///< Triangles of all copies.
    std::uint64_t samples = 0;   ///< The same.
    struct {
        double one_by_one = 0;
        double one_job = 0;  ///< Seconds of all copies, each with a seed of its own.
        double one_mesh = 0; ///< Seconds of a mesh with all copies as parts, prepared before.
    } seconds;
};

/// Measures `options.copies` of each mesh at all counts; the samples of each copy were found equal
/// before, one by one and in one job. Throws UserError as measure().
void run_copies(Runner& runner, const Options& options, const std::vector<NamedMesh>& meshes,
                const std::function<void(const CopiesRow&)>& on_row);

} // namespace geodisk::bench
