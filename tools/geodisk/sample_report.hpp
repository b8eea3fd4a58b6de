// What `geodisk sample` tells about a run: to people, to programs, and in the sample file.
#pragma once

#include <cstdint>
#include <ostream>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <geodisk/device.hpp>
#include <geodisk/mesh.hpp>
#include <geodisk/params.hpp>
#include <geodisk/runner.hpp>

#include "common/sample_file.hpp"

namespace geodisk::tools {

struct SampleReport {
    std::string mesh_path;
    std::vector<std::pair<std::string, std::string>> mesh_additions; ///< MeshOptions::additions().
    std::string output_path;
    std::string metric; ///< "geodesic", or one that does not go along the surface.
    MeshStatistics mesh;
    SampleParams params;
    bool throws_darts = false; ///< --method pdts.
    bool counts_calls = false; ///< --count-calls: run.calls tells.
    double wanted_count = 0;   ///< Of --count, where it chose the distance; else 0.
    std::uint64_t samples = 0;
    double rho = 0; ///< Where radii vary, of the samples on a surface of the effective area.
    double least_radius = 0, most_radius = 0; ///< Of the samples, where radii vary; else 0.
    RunReport run;
    DeviceReport device;
    Tuning tuning; ///< As used.
    struct {
        double load = 0, prepare = 0, device = 0, pipelines = 0, write = 0;
    } seconds; ///< Those of upload, sample and readback are in `run`.

    /// Fills in least_radius and most_radius.
    void set_radii(std::span<const SampleRow> rows);
};

/// Nothing in it depends on when or how fast the run was, so equal runs give equal files.
SampleHeader sample_header(const SampleReport& report);

/// One JSON object and a line break.
std::string json_text(const SampleReport& report);

void print_summary(std::ostream& out, const SampleReport& report);

} // namespace geodisk::tools
