// Samples in farthest-point order, for the commands that have --order farthest.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include <geodisk/farthest.hpp>

#include "files/samples/sample_file.hpp"
#include "geodisk/device_run.hpp"
#include "geodisk/inputs/mesh_input.hpp"
#include "geodisk/outputs/progress.hpp"
#include "geodisk/reports/json_type.hpp"

namespace geodisk::tools {

struct FarthestRun {
    FarthestOrder order;
    std::size_t samples = 0; ///< Those to choose from.
    double seconds = 0;      ///< All of the search.

    /// Puts what belongs to the samples in their order, and leaves out the others.
    template <class T>
    void apply(std::vector<T>& values) const {
        std::vector<T> chosen;
        chosen.reserve(order.indices.size());
        for (const std::uint32_t index : order.indices) {
            chosen.push_back(values[index]);
        }
        values = std::move(chosen);
    }
    /// Returns the columns cover and row.
    std::vector<SampleField> columns() const;
};

/// Opens the device where need be, and finds the order of samples of a mesh. Throws UserError,
/// DeviceLost among them.
FarthestRun order_farthest(const MeshInput& mesh, std::span<const SampleRow> rows,
                           const FarthestParams& params, RunDevice& device, ProgressLine& progress);

/// Entries of the header of a sample file.
HeaderEntries farthest_entries(const FarthestRun& run);
/// Returns the facts for programs.
Json farthest_json(const FarthestRun& run);
/// A line of the summary.
std::string farthest_line(const FarthestRun& run);

} // namespace geodisk::tools
