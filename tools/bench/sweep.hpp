// Which meshes and counts a benchmark run goes through.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include <geodisk/runner.hpp>

#include "bench/measurement.hpp"
#include "bench/options.hpp"
#include "files/mesh_file.hpp"
#include "geometry/mesh.hpp"
#include "program/failure.hpp"

namespace geodisk::bench {

/// Called with each row as it is measured, and with each series once it is complete.
struct Observer {
    std::function<void(const Measurement&)> on_row;
    std::function<void(const Series&)> on_series;
};

struct NamedMesh {
    std::string name; ///< A file's without its folders, which say nothing to others.
    tools::MeshFile file;
};

/// Throws UserError as read_mesh().
std::vector<NamedMesh> read_meshes(const std::vector<std::string>& paths);

/// All series that `options` ask for, mesh by mesh: the counts, then, if scaling, the triangles.
/// Throws UserError as measure().
std::vector<Series> run_all(Runner& runner, const Options& options,
                            const std::vector<NamedMesh>& meshes, const Observer& observer);

/// Into how many parts to cut the edges of a mesh of `faces` triangles: 1 and up to six more, in
/// about equal ratios, none of which makes more than `most_faces` triangles.
std::vector<std::uint32_t> edge_parts(std::uint64_t faces, std::uint64_t most_faces);

} // namespace geodisk::bench
