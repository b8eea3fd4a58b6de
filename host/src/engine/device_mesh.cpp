#include "engine/device_mesh.hpp"

#include <cstring>
#include <string>

#include <geodisk/params.hpp>

#include "constants.h"
#include "records.h"

namespace geodisk {
namespace {

/// A length in units of the working distance; what is too small to be told from zero is zero, so
/// that no product on the device becomes denormal.
float scaled(double length, double unit) {
    const double x = length / unit;
    return static_cast<float>(x < 0x1p-40 && x > -0x1p-40 ? 0.0 : x);
}

constexpr std::uint64_t kTooMany = std::uint64_t{1} << 31;

struct Grid {
    std::uint64_t columns, rows;
    std::uint32_t corner;
};

/// The same arithmetic as cell_count in shaders/lib/cells.glsl.
std::uint64_t cell_count(float extent) {
    if (!(extent < 0x1p30f)) {
        return kTooMany;
    }
    return static_cast<std::uint64_t>(extent * static_cast<float>(gpu::kCellsPerDistance)) + 1;
}

Grid face_grid(const PreparedMesh& mesh, std::uint32_t face, double unit) {
    const auto edges = mesh.half_edges().subspan(std::size_t{3} * face, 3);
    std::uint32_t corner = 0;
    for (std::uint32_t k = 1; k < 3; ++k) {
        corner = scaled(edges[k].length, unit) > scaled(edges[corner].length, unit)
                     ? k
                     : corner;
    }
    return {cell_count(scaled(edges[corner].length, unit)),
            cell_count(scaled(edges[corner].apex_y, unit)), corner};
}

template <class Record>
void store(std::span<std::byte> out, std::size_t index, const Record& record) {
    std::memcpy(out.data() + index * sizeof(Record), &record, sizeof record);
}

} // namespace

Result<std::uint32_t> count_cells(const PreparedMesh& mesh, double min_distance) {
    const double unit = working_distance(mesh, min_distance);
    std::uint64_t cells = 0;
    for (std::uint32_t f = 0; f < mesh.face_count(); ++f) {
        const Grid grid = face_grid(mesh, f, unit);
        cells += grid.columns * grid.rows; // At most 2^62, and 2^30 before.
        if (cells > gpu::kFirstCellMask) {
            return Error{Status::invalid_argument,
                         "the minimum distance is too small: face " + std::to_string(f) +
                             " alone or with those before it takes more than 2^30 grid cells",
                         f};
        }
    }
    return static_cast<std::uint32_t>(cells);
}

std::size_t half_edge_bytes(const PreparedMesh& mesh) {
    return mesh.half_edges().size() * sizeof(gpu::HalfEdgeRec);
}

std::size_t fan_bytes(const PreparedMesh& mesh) {
    // Corners follow the fans, in whole rows.
    return mesh.fans().size() * sizeof(gpu::FanRec) + (mesh.corners().size() + 3) / 4 * 16;
}

std::size_t alias_bytes(const PreparedMesh& mesh) {
    return mesh.alias_columns().size() * sizeof(gpu::AliasRec);
}

std::size_t face_word_bytes(const PreparedMesh& mesh) {
    return std::size_t{mesh.face_count()} * sizeof(std::uint32_t);
}

void write_half_edges(const PreparedMesh& mesh, double min_distance, std::span<std::byte> out) {
    const double unit = working_distance(mesh, min_distance);
    for (std::uint32_t h = 0; h < mesh.half_edges().size(); ++h) {
        const HalfEdge& e = mesh.half_edges()[h];
        const bool border = around_half_edge(e.around) == h;
        store(out, h,
              gpu::HalfEdgeRec{scaled(e.length, unit), scaled(e.apex_x, unit), scaled(e.apex_y, unit),
                               e.origin | (border ? gpu::kBorder : 0u),
                               static_cast<float>(e.cosine), static_cast<float>(e.sine), e.around,
                               e.fan_angles});
    }
}

void write_fans(const PreparedMesh& mesh, std::span<std::byte> out) {
    std::memset(out.data(), 0, out.size());
    for (std::size_t v = 0; v < mesh.fans().size(); ++v) {
        const VertexFan& fan = mesh.fans()[v];
        store(out, v,
              gpu::FanRec{fan.first_corner, fan.corner_count, fan.total_angle, fan.flags});
    }
    if (!mesh.corners().empty()) {
        std::memcpy(out.data() + mesh.fans().size() * sizeof(gpu::FanRec), mesh.corners().data(),
                    mesh.corners().size_bytes());
    }
}

void write_alias(const PreparedMesh& mesh, std::span<std::byte> out) {
    for (std::size_t f = 0; f < mesh.alias_columns().size(); ++f) {
        const AliasColumn& column = mesh.alias_columns()[f];
        store(out, f, gpu::AliasRec{column.threshold, column.alias});
    }
}

void write_face_words(const PreparedMesh& mesh, double min_distance, std::span<std::byte> out) {
    const double unit = working_distance(mesh, min_distance);
    std::uint32_t first = 0;
    for (std::uint32_t f = 0; f < mesh.face_count(); ++f) {
        const Grid grid = face_grid(mesh, f, unit);
        const bool single = grid.columns * grid.rows == 1;
        store(out, f, first | (single ? gpu::kSingleCell : grid.corner) << gpu::kFaceCornerShift);
        first += static_cast<std::uint32_t>(grid.columns * grid.rows);
    }
}

} // namespace geodisk
