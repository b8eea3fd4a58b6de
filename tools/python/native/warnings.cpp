#include <algorithm>
#include <iterator>
#include <span>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "warnings.hpp"

#include "c/c_mesh.hpp"
#include "files/vulkan_environment.hpp"
#include "geometry/set_warnings.hpp"
#include "geometry/shape_warnings.hpp"
#include "geometry/surface_warnings.hpp"
#include "source.hpp"

using namespace geodisk;
using namespace geodisk::tools;

namespace {

bool is_about_seams(const MeshWarning& warning) {
    return warning.kind == "unwelded" || warning.kind == "near_seams";
}

/// Warnings about arrays of the caller, of which only the prepared mesh knows.
std::vector<MeshWarning> array_warnings(const c::Mesh& mesh) {
    std::vector<MeshWarning> warnings;
    warn_of_repeated_vertices(warnings, mesh.prepared.statistics().repeated_index_faces, "");
    MeshFile file;
    if (mesh.dimension > 0) {
        file.positions = mesh.positions;
        file.triangles = mesh.triangles;
        file.dimension = mesh.dimension;
        warn_of_shapes(shapes_of(file), file);
        std::ranges::move(file.warnings, std::back_inserter(warnings));
        warn_of_near_seams(mesh.view(), mesh.prepared.statistics(), warnings);
    }
    file.lengths.resize(1); // No reader has judged the areas.
    std::ranges::move(surface_warnings(file, mesh.prepared), std::back_inserter(warnings));
    return warnings;
}

} // namespace

std::vector<MeshWarning> geodisk::tools::warnings_of_mesh(const geodisk_task& task) {
    const c::Mesh& mesh = *task.mesh->shared;
    std::vector<MeshWarning> warnings;
    if (task.source == nullptr) {
        warnings = array_warnings(mesh);
    } else {
        warnings = task.source->mesh.warnings;
        std::ranges::move(surface_warnings(task.source->mesh, mesh.prepared),
                          std::back_inserter(warnings));
    }
    std::stable_partition(warnings.begin(), warnings.end(), is_about_seams);
    return warnings;
}

std::vector<MeshWarning> geodisk::tools::warnings_of_set(const geodisk_task& task,
                                                         const Json& options) {
    SampledSet set{.samples = options.at("count"),
                   .existing = options.at("existing"),
                   .avoids = options.at("avoids"),
                   .min_distance = options.at("min_distance"),
                   .wanted_count = options.at("wanted_count"),
                   .cut = options.at("cut"),
                   .stop_count = options.at("stop_count"),
                   .has_darts = options.at("has_darts"),
                   .lacks_features = options.at("lacks_features")};
    if (task.mesh == nullptr) {
        set.domain = "box";
        return set_warnings(set);
    }
    const PreparedMesh& mesh = task.mesh->shared->prepared;
    const std::size_t masked = task.face_mask != nullptr ? mesh.face_count() : 0;
    set.bare =
        parts_without(mesh, std::span(task.faces, set.samples), std::span(task.face_mask, masked));
    return set_warnings(set);
}

std::vector<MeshWarning> geodisk::tools::warnings_of_drivers() {
    std::vector<MeshWarning> list;
    for (const std::string& driver : left_out_drivers()) {
        list.push_back({"left_out_driver", 1, "", left_out_warning(driver), {}});
    }
    return list;
}
