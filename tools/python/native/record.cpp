// Data that samples get from their mesh besides attributes: normals, colours of textures, frames.
#include <algorithm>
#include <span>
#include <vector>

#include "c/c_call.hpp"
#include "files/images/textures.hpp"
#include "files/meshes/mesh_fields.hpp"
#include "files/samples/frame_style.hpp"
#include "files/samples/sample_fields.hpp"
#include "files/samples/sample_records.hpp"
#include "program/failure.hpp"
#include "source.hpp"

using namespace geodisk;
using namespace geodisk::c;
using namespace geodisk::tools;

namespace {

std::vector<SampleRow> rows_of(const geodisk_record_params& params) {
    std::vector<SampleRow> rows(params.count);
    for (std::size_t i = 0; i < params.count; ++i) {
        rows[i].face = params.faces[i];
        for (std::size_t k = 0; k < 3; ++k) {
            rows[i].bary[k] = static_cast<float>(params.weights[3 * i + k]);
            rows[i].normal[k] = static_cast<float>(params.normals[3 * i + k]);
        }
    }
    return rows;
}

bool has_materials(const geodisk_record_params& params) {
    return params.texture == kAutoTexture;
}

/// Returns true if what the texture needs was read.
bool has_colours(const MeshFile& mesh, const geodisk_record_params& params) {
    return has_materials(params) ? mesh.materials.has_value() : mesh.texture_uvs && !mesh.materials;
}

/// Fails for what the mesh lacks, before it is looked up.
Result<Done> check(const MeshFile& mesh, const geodisk_record_params& params) {
    if (params.normal_kind == GEODISK_FILE_NORMALS && !mesh.normals) {
        return wrong("the normals of the file were not read");
    }
    if (params.texture != nullptr && (params.colours == nullptr || !has_colours(mesh, params))) {
        return wrong("a texture needs texture coordinates or materials, and room for colours");
    }
    const bool is_in_mesh = std::ranges::all_of(std::span(params.faces, params.count),
                                                [&](auto f) { return f < mesh.triangle_count(); });
    if (!is_in_mesh || mesh.dimension != 3) {
        return wrong("samples are not of this mesh, or it is not in space");
    }
    return Done{};
}

void record(const MeshFile& mesh, const geodisk_record_params& params) {
    std::vector<SampleRow> rows = rows_of(params);
    if (params.normal_kind != GEODISK_FACE_NORMALS) {
        params.normal_kind == GEODISK_FILE_NORMALS ? set_file_normals(mesh, rows)
                                                   : set_smooth_normals(mesh, rows);
        for (std::size_t i = 0; i < rows.size(); ++i) {
            std::ranges::copy(rows[i].normal, params.normals + 3 * i);
        }
    }
    if (params.texture != nullptr) {
        const Textures textures =
            has_materials(params) ? Textures(mesh) : Textures(mesh, Path(params.texture));
        std::ranges::copy(texture_colours(mesh, textures, rows).values, params.colours);
    }
    if (params.frames != nullptr) {
        FrameStyle style = parse_frame_style("frames", params.frame_style);
        style.world = find_up(params.up).value_or(style.world);
        std::ranges::copy(sample_frames(rows, params.seed, style).values, params.frames);
    }
}

} // namespace

extern "C" geodisk_status geodisk_source_record(const geodisk_source* source,
                                                const geodisk_record_params* params,
                                                geodisk_error* error) {
    return answer(error, [&]() -> Result<Done> {
        if (source == nullptr) {
            return wrong("source is NULL");
        }
        const auto given = taken(params, "params");
        if (!given) {
            return given.error();
        }
        if (const auto checked = check(source->mesh, *given); !checked) {
            return checked.error();
        }
        try {
            record(source->mesh, *given);
        } catch (const UserError& failure) {
            return failure.code() == ExitCode::out_of_memory
                       ? Error{Status::out_of_host_memory, failure.what()}
                       : wrong(failure.what());
        }
        return Done{};
    });
}
