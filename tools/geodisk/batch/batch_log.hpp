// The log of a batch: a JSON object on a line for each mesh that is done.
#pragma once

#include <cstdint>
#include <set>
#include <string>
#include <vector>

#include "files/output/line_log.hpp"

namespace geodisk::tools {

/// Throws UserError(usage) where a log is there and the batch is not to go on with it.
void check_no_log(const std::string& path);

/// The commands that the logs of all shards in the folder tell are done. Lines that are none of a
/// log, as where a program was killed while it wrote, are passed over.
std::set<std::string> commands_done(const std::string& folder);

/// Result of a mesh.
struct BatchEntry {
    std::string mesh, output, command;
    int exit_code = 0; ///< As `geodisk sample` would have ended.
    std::string error; ///< Error of a job that failed.
    std::uint64_t samples = 0;
    double min_distance = 0; ///< In mesh units.
    double seconds = 0;      ///< From reading the mesh to its samples on the disk.
    std::string device;
    std::vector<std::string> warnings; ///< About the mesh.

    bool is_ok() const { return exit_code == 0; }
};

/// Appends `entry` as one line. Throws UserError(bad_output).
void append_entry(LineLog& log, const BatchEntry& entry);

} // namespace geodisk::tools
