// Meshes and counts that a benchmark run goes through, and the growth of times with them.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include <geodisk/runner.hpp>

#include "bench/measure.hpp"
#include "bench/options.hpp"
#include "bench/statistics.hpp"
#include "geometry/mesh.hpp"

namespace geodisk::bench {

/// Quantity that a series varies. `listed` are the counts asked for, and no sweep.
enum class Sweep { listed, samples, triangles };

const char* to_string(Sweep sweep);

/// Growth of one quantity along a sweep.
struct Growth {
    const char* quantity;        ///< "device", "reference" or "prepare": which seconds.
    std::optional<PowerLaw> law; ///< Nothing if the sweep has fewer than two steps.
};

/// The rows of one mesh.
struct Series {
    Sweep sweep = Sweep::listed;
    std::string mesh;
    std::vector<Measurement> rows;
    std::vector<Growth> growth; ///< Empty unless a sweep.
};

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
/// about equal ratios, none of which makes more than `max_faces` triangles.
std::vector<std::uint32_t> edge_parts(std::uint64_t faces, std::uint64_t max_faces);

} // namespace geodisk::bench
