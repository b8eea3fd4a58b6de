#include "geodisk/records.hpp"

#include <algorithm>
#include <utility>

#include "files/block_writer.hpp"
#include "files/sample_columns.hpp"
#include "files/sample_fields.hpp"
#include "geometry/frames.hpp"
#include "geometry/vertex_normals.hpp"
#include "program/failure.hpp"

namespace geodisk::tools {
namespace {

/// Returns the unit normals of vertices.
std::vector<Vec3> vertex_normals(const MeshFile& mesh) {
    std::vector<Vec3> normals = normal_sums(mesh);
    std::ranges::transform(normals, normals.begin(), direction);
    return normals;
}

Vec3 smooth_normal(const MeshFile& mesh, const std::vector<Vec3>& of_vertices,
                   const SampleRow& row) {
    Vec3 normal{};
    for (std::size_t k = 0; k < 3; ++k) {
        normal += double{row.bary[k]} * of_vertices[mesh.triangles[std::size_t{3} * row.face + k]];
    }
    return normal;
}

SampleField frames_of(std::span<const SampleRow> rows, std::uint64_t seed) {
    const std::size_t size = kFrameColumnNames.size();
    SampleField frames{std::string(kFramesField),
                       {kFrameColumnNames.begin(), kFrameColumnNames.end()},
                       false,
                       false,
                       std::vector<double>(rows.size() * size)};
    frames.is_float = true;
    for_rows(rows.size(), [&](std::size_t i) {
        const SampleRow& row = rows[i];
        const Vec3 normal = direction({row.normal[0], row.normal[1], row.normal[2]});
        std::ranges::copy(frame_of(normal, frame_angle(seed, row.face, row.bary)),
                          &frames.values[i * size]);
    });
    return frames;
}

} // namespace

void check_record(const RecordOptions& options, const MeshInput& mesh) {
    const bool is_face = options.normal_kind() == NormalKind::face;
    if ((!is_face || options.frames) && mesh.dimension() != 3) {
        fail_usage(std::string(is_face ? "--frames" : "--normals") +
                   " needs a mesh with 3 coordinates per vertex; this one has " +
                   (mesh.dimension() == 0 ? "none" : std::to_string(mesh.dimension())));
    }
    const bool has_colours = std::ranges::find(mesh.file.fields, kColourField, &MeshField::name) !=
                             mesh.file.fields.end();
    if (mesh.texture && has_colours) {
        fail_usage("--texture and the attribute color are both the columns red, green and blue; "
                   "name the other attributes in place of all");
    }
}

void set_normals(const RecordOptions& options, const MeshInput& mesh, std::span<SampleRow> rows) {
    const NormalKind kind = options.normal_kind();
    if (kind == NormalKind::face) {
        return;
    }
    const std::vector<Vec3> smooth =
        kind == NormalKind::smooth ? vertex_normals(mesh.file) : std::vector<Vec3>();
    for_rows(rows.size(), [&](std::size_t i) {
        SampleRow& row = rows[i];
        const Vec3 sum = kind == NormalKind::smooth ? smooth_normal(mesh.file, smooth, row)
                                                    : file_normal(mesh.file, row);
        constexpr double kCancelled = 1e-9; // Rounding of a sum that should be zero.
        if (length(sum) > kCancelled) {
            const Vec3 normal = normalize(sum);
            row.normal[0] = static_cast<float>(normal.x);
            row.normal[1] = static_cast<float>(normal.y);
            row.normal[2] = static_cast<float>(normal.z);
        }
    });
}

std::vector<SampleField> record_fields(const RecordOptions& options, const MeshInput& mesh,
                                       std::span<const SampleRow> rows, std::uint64_t seed) {
    std::vector<SampleField> fields = sample_fields(mesh.file, rows);
    if (mesh.texture) {
        fields.push_back(texture_colours(mesh.file, *mesh.texture, rows));
    }
    if (options.frames) {
        fields.push_back(frames_of(rows, seed));
    }
    return fields;
}

} // namespace geodisk::tools
