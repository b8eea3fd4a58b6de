#include "files/samples/sample_records.hpp"

#include <algorithm>
#include <string>
#include <vector>

#include "files/output/block_writer.hpp"
#include "files/samples/sample_columns.hpp"
#include "files/samples/sample_fields.hpp"
#include "geometry/vertex_normals.hpp"

namespace geodisk::tools {
namespace {

/// Replaces the normals by those along `sum_at(row)`.
template <class Sum>
void set_normals(std::span<SampleRow> rows, const Sum& sum_at) {
    for_rows(rows.size(), [&](std::size_t i) {
        SampleRow& row = rows[i];
        const Vec3 sum = sum_at(row);
        constexpr double kCancelled = 1e-9; // Rounding of a sum that should be zero.
        if (length(sum) > kCancelled) {
            const Vec3 normal = normalize(sum);
            row.normal[0] = static_cast<float>(normal.x);
            row.normal[1] = static_cast<float>(normal.y);
            row.normal[2] = static_cast<float>(normal.z);
        }
    });
}

} // namespace

void set_smooth_normals(const MeshFile& mesh, std::span<SampleRow> rows) {
    std::vector<Vec3> of_vertices = normal_sums(mesh);
    std::ranges::transform(of_vertices, of_vertices.begin(), direction);
    set_normals(rows, [&](const SampleRow& row) {
        Vec3 normal{};
        for (std::size_t k = 0; k < 3; ++k) {
            normal +=
                double{row.bary[k]} * of_vertices[mesh.triangles[std::size_t{3} * row.face + k]];
        }
        return normal;
    });
}

void set_file_normals(const MeshFile& mesh, std::span<SampleRow> rows) {
    set_normals(rows, [&](const SampleRow& row) { return file_normal(mesh, row); });
}

SampleField sample_frames(std::span<const SampleRow> rows, std::uint64_t seed,
                          const FrameStyle& style) {
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
        std::ranges::copy(frame_of(normal, frame_angle(seed, row.face, row.bary), style),
                          &frames.values[i * size]);
    });
    return frames;
}

} // namespace geodisk::tools
