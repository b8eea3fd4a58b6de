#include <algorithm>
#include <iterator>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "c/c_call.hpp"
#include "c/c_mesh.hpp"
#include "files/vulkan_environment.hpp"
#include "geometry/set_warnings.hpp"
#include "geometry/shape_warnings.hpp"
#include "geometry/surface_warnings.hpp"
#include "source.hpp"

using namespace geodisk;
using namespace geodisk::c;
using namespace geodisk::tools;

struct geodisk_warnings {
    std::vector<MeshWarning> list;
};

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
        warn_of_slivers(file);
        warn_of_far_origin(file);
        std::ranges::move(file.warnings, std::back_inserter(warnings));
        warn_of_near_seams(mesh.view(), mesh.prepared.statistics(), warnings);
    }
    file.lengths.resize(1); // No reader has judged the areas.
    std::ranges::move(surface_warnings(file, mesh.prepared), std::back_inserter(warnings));
    return warnings;
}

std::vector<MeshWarning> warnings_of(const c::Mesh& mesh, const geodisk_source* source) {
    std::vector<MeshWarning> warnings;
    if (source == nullptr) {
        warnings = array_warnings(mesh);
    } else {
        warnings = source->mesh.warnings;
        std::ranges::move(surface_warnings(source->mesh, mesh.prepared),
                          std::back_inserter(warnings));
    }
    std::stable_partition(warnings.begin(), warnings.end(), is_about_seams);
    return warnings;
}

std::vector<MeshWarning> warnings_of_set(const geodisk_sampled_set& given) {
    SampledSet set{.samples = given.count,
                   .existing = given.existing,
                   .avoids = given.avoids != 0,
                   .min_distance = given.min_distance,
                   .wanted_count = given.wanted_count,
                   .cut = given.cut,
                   .stop_count = given.stop_count,
                   .has_darts = given.darts > 0,
                   .lacks_features = given.lacks_features};
    if (given.mesh == nullptr) {
        set.domain = "box";
        return set_warnings(set);
    }
    const PreparedMesh& mesh = given.mesh->shared->prepared;
    const std::size_t masked = given.face_mask != nullptr ? mesh.face_count() : 0;
    set.bare = parts_without(mesh, std::span(given.faces, given.count),
                             std::span(given.face_mask, masked));
    return set_warnings(set);
}

} // namespace

extern "C" {

geodisk_status geodisk_warnings_list(const geodisk_mesh* mesh, const geodisk_source* source,
                                     geodisk_warnings** warnings, geodisk_error* error) {
    return answer(error, [&]() -> Result<Done> {
        if (mesh == nullptr || warnings == nullptr) {
            return wrong("mesh or warnings is NULL");
        }
        *warnings = new geodisk_warnings{warnings_of(*mesh->shared, source)};
        return Done{};
    });
}

geodisk_status geodisk_warnings_of_set(const geodisk_sampled_set* set, geodisk_warnings** warnings,
                                       geodisk_error* error) {
    return answer(error, [&]() -> Result<Done> {
        const auto given = taken(set, "set");
        if (!given) {
            return given.error();
        }
        if (warnings == nullptr) {
            return wrong("warnings is NULL");
        }
        *warnings = new geodisk_warnings{warnings_of_set(*given)};
        return Done{};
    });
}

geodisk_status geodisk_warnings_of_drivers(geodisk_warnings** warnings, geodisk_error* error) {
    return answer(error, [&]() -> Result<Done> {
        if (warnings == nullptr) {
            return wrong("warnings is NULL");
        }
        std::vector<MeshWarning> list;
        for (const std::string& driver : left_out_drivers()) {
            list.push_back({"left_out_driver", 1, "", left_out_warning(driver), {}});
        }
        *warnings = new geodisk_warnings{std::move(list)};
        return Done{};
    });
}

size_t geodisk_warnings_count(const geodisk_warnings* warnings) {
    return warnings == nullptr ? 0 : warnings->list.size();
}

geodisk_status geodisk_warnings_get(const geodisk_warnings* warnings, size_t index,
                                    geodisk_warning* warning, geodisk_error* error) {
    return answer(error, [&]() -> Result<Done> {
        if (warnings == nullptr || index >= warnings->list.size()) {
            return wrong("there is no such warning");
        }
        const MeshWarning& found = warnings->list[index];
        geodisk_warning value{};
        value.kind = found.kind.c_str();
        value.count = found.count;
        value.message = found.message.c_str();
        return give(warning, "warning", value);
    });
}

void geodisk_warnings_release(geodisk_warnings* warnings) {
    delete warnings;
}

} // extern "C"
