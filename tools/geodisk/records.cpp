#include "geodisk/records.hpp"

#include <algorithm>
#include <string>

#include "files/samples/sample_fields.hpp"
#include "files/samples/sample_records.hpp"
#include "program/failure.hpp"

namespace geodisk::tools {

void check_record(const RecordOptions& options, const MeshInput& mesh) {
    const bool is_face = options.normal_kind() == NormalKind::face;
    if ((!is_face || !options.frames.empty()) && mesh.dimension() != 3) {
        fail_usage(std::string(is_face ? "--frames" : "--normals") +
                   " needs a mesh with 3 coordinates per vertex; this one has " +
                   (mesh.dimension() == 0 ? "none" : std::to_string(mesh.dimension())));
    }
}

void set_normals(const RecordOptions& options, const MeshInput& mesh, std::span<SampleRow> rows) {
    switch (options.normal_kind()) {
    case NormalKind::face:
        break;
    case NormalKind::file:
        set_file_normals(mesh.file, rows);
        break;
    case NormalKind::smooth:
        set_smooth_normals(mesh.file, rows);
        break;
    }
}

std::vector<SampleField> record_fields(const MeshInput& mesh, std::span<const SampleRow> rows,
                                       std::uint64_t seed, const std::optional<FrameStyle>& style) {
    std::vector<SampleField> fields = sample_fields(mesh.file, rows);
    if (mesh.textures) {
        fields.push_back(texture_colours(mesh.file, *mesh.textures, rows));
    }
    if (style) {
        fields.push_back(sample_frames(rows, seed, *style));
    }
    return fields;
}

} // namespace geodisk::tools
