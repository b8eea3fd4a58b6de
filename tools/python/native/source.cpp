#include "source.hpp"

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "c/c_call.hpp"
#include "files/meshes/mesh_file.hpp"
#include "files/meshes/part_columns.hpp"
#include "files/meshes/polygon_mesh.hpp"
#include "files/samples/told_samples.hpp"
#include "program/failure.hpp"

using namespace geodisk;
using namespace geodisk::c;
using namespace geodisk::tools;

namespace {

/// Ends the reading of a file whose reader was asked to stop.
struct Stopped {};

Status status_of(ExitCode code) {
    switch (code) {
    case ExitCode::usage:
        return Status::invalid_argument;
    case ExitCode::out_of_memory:
        return Status::out_of_host_memory;
    case ExitCode::internal:
        return Status::internal;
    default:
        return Status::mesh_rejected;
    }
}

std::string text_of(const char* text) {
    return text == nullptr ? "" : text;
}

PolygonMesh polygons_of(const geodisk_source_params& params) {
    PolygonMesh polygons;
    polygons.dimension = params.dimension;
    polygons.positions.assign(params.positions,
                              params.positions + params.vertex_count * params.dimension);
    polygons.face_ends.assign(params.face_ends, params.face_ends + params.face_count);
    const std::size_t corners = params.face_count == 0 ? 0 : polygons.face_ends.back();
    polygons.corners.assign(params.corners, params.corners + corners);
    return polygons;
}

MeshFile mesh_of(const geodisk_source_params& params) {
    MeshSources sources;
    if (params.weld != 0) {
        sources.weld = Length{params.weld_distance, false};
    }
    sources.keep_seams = params.keep_seams != 0;
    sources.allows_outside = params.allow_outside != 0;
    if (params.path == nullptr) {
        sources.mesh = "mesh";
        return split_into_triangles(sources, polygons_of(params));
    }
    sources.mesh = params.path;
    sources.format = text_of(params.mesh_format);
    for (const char* const name : std::span(params.attributes, params.attribute_count)) {
        sources.fields.names.emplace_back(name);
    }
    if (sources.fields.names == std::vector<std::string>{"all"}) {
        sources.fields = parse_fields("all");
    }
    sources.fields.normals = params.has_normals != 0;
    sources.fields.uvs = params.has_uvs != 0;
    sources.fields.materials = params.has_materials != 0;
    sources.fields.has_texture = sources.fields.uvs || sources.fields.materials;
    sources.progress = [stop = params.stop](double) {
        if (stop != nullptr && *stop != 0) {
            throw Stopped();
        }
    };
    return read_unless_samples(sources.mesh, "", [&] { return read_mesh(sources); });
}

std::unique_ptr<geodisk_source> source_of(const geodisk_source_params& params) {
    const std::vector<std::string> names = parse_part_columns(text_of(params.columns));
    auto source = std::make_unique<geodisk_source>();
    source->mesh = mesh_of(params);
    source->is_y_up =
        params.path != nullptr && has_y_up(Path(params.path), text_of(params.mesh_format));
    check_parts(text_of(params.path), source->mesh, names);
    for (const std::string& name : names) {
        source->columns.push_back(part_column_of_triangles(source->mesh, name));
    }
    return source;
}

Result<std::unique_ptr<geodisk_source>> read(const geodisk_source_params& params) {
    try {
        return source_of(params);
    } catch (const UserError& error) {
        return Error{status_of(error.code()), error.what()};
    } catch (const Stopped&) {
        return Error{Status::cancelled, "reading was stopped"};
    }
}

} // namespace

extern "C" {

geodisk_status geodisk_source_read(const geodisk_source_params* params, geodisk_source** source,
                                   geodisk_error* error) {
    return answer(error, [&]() -> Result<Done> {
        if (source == nullptr) {
            return wrong("source is NULL");
        }
        const auto given = taken(params, "params");
        if (!given) {
            return given.error();
        }
        auto made = read(*given);
        if (!made) {
            return made.error();
        }
        *source = made->release();
        return Done{};
    });
}

void geodisk_source_release(geodisk_source* source) {
    delete source;
}

} // extern "C"
