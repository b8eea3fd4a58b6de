// Report of `geodisk batch` at its end: to people and to programs.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "geodisk/batch/batch_run.hpp"
#include "geodisk/options/batch_options.hpp"

namespace geodisk::tools {

struct BatchResult {
    std::size_t meshes = 0;  ///< Number of meshes of the shard.
    std::size_t skipped = 0; ///< Number of these that were done before.
    BatchTotals totals;
    std::vector<std::string> devices; ///< None where nothing was left to do.
    std::string log;
    int jobs = 0;
};

/// One JSON object and a line break.
std::string batch_json(const BatchOptions& options, const BatchResult& result);

/// Lines for people.
std::string batch_summary(const BatchOptions& options, const BatchResult& result);

} // namespace geodisk::tools
