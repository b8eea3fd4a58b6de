#include "engine/device_mesh.hpp"

#include <algorithm>
#include <bit>
#include <cstring>
#include <string>

#include <geodisk/params.hpp>

#include "constants.h"
#include "engine/stages.hpp"
#include "engine/tolerances.hpp"
#include "records.h"

namespace geodisk {
namespace {

/// A length in units of the working distance; what is too small to be told from zero is zero, so
/// that no product on the device becomes denormal.
float scaled(double length, double unit) {
    const double x = length / unit;
    return static_cast<float>(x < 0x1p-40 && x > -0x1p-40 ? 0.0 : x);
}

float direction(double cosine_or_sine) {
    return scaled(cosine_or_sine, 1);
}

constexpr std::uint64_t kTooMany = std::uint64_t{1} << 31;

struct Grid {
    std::uint64_t columns, rows;
    std::uint32_t corner;
};

float previous_length(const PreparedMesh& mesh, std::uint32_t h, double unit) {
    return scaled(mesh.half_edges()[previous_in_face(h)].length, unit);
}

/// The same arithmetic as in shaders/lib: apex_of, then cell_count.
std::uint64_t cell_count(float extent, float cells_per_unit) {
    const float scaled = extent * cells_per_unit;
    return scaled < 0x1p30f ? static_cast<std::uint64_t>(scaled) + 1 : kTooMany;
}

/// The radii of a face, but for the bound; all half of the unit where they do not vary.
gpu::RadiiRec radii_of(const SampleParams& params, std::uint32_t face) {
    if (params.radii == nullptr) {
        return {0.5f, 0.5f, 0.5f, 0, 0, 0, 0, 0};
    }
    const float* const g = &params.radii->factors()[std::size_t{3} * face];
    const float* const s = &params.radii->spreads()[std::size_t{3} * face];
    return {0.5f * g[0], 0.5f * g[1], 0.5f * g[2], 0,
            s[0],        s[1],        s[2],        params.radii->densities()[face]};
}

/// As shaders/lib/radii.glsl has it.
float cells_per_unit(const gpu::RadiiRec& radii) {
    const float largest = std::max({radii.radius0, radii.radius1, radii.radius2});
    return std::bit_cast<float>(0x7f000000u -
                                (std::bit_cast<std::uint32_t>(largest) & 0x7f800000u));
}

Grid face_grid(const PreparedMesh& mesh, const SampleParams& params, std::uint32_t face,
               double unit) {
    const float per_unit = cells_per_unit(radii_of(params, face));
    const auto edges = mesh.half_edges().subspan(std::size_t{3} * face, 3);
    std::uint32_t corner = 0;
    for (std::uint32_t k = 1; k < 3; ++k) {
        corner = scaled(edges[k].length, unit) > scaled(edges[corner].length, unit) ? k : corner;
    }
    const float height =
        previous_length(mesh, 3 * face + corner, unit) * direction(edges[corner].sine);
    return {cell_count(scaled(edges[corner].length, unit), per_unit), cell_count(height, per_unit),
            corner};
}

/// Rows of the fans buffer: fans, pairs of corner and angles, angles by half-edge, radii by face.
struct FanRows {
    std::size_t fans, corners, angles, radii;
    FanRows(const PreparedMesh& mesh, bool adaptive)
        : fans(mesh.fans().size()), corners((mesh.half_edges().size() + 1) / 2),
          angles((mesh.half_edges().size() + 3) / 4),
          radii(adaptive ? gpu::kRadiiRows * std::size_t{mesh.face_count()} : 0) {}
    std::size_t bytes() const { return (fans + corners + angles + radii) * 16; }
};

bool shared_by_many(const PreparedMesh& mesh, std::uint32_t h) {
    const std::uint32_t next = around_half_edge(mesh.half_edges()[h].around);
    return around_half_edge(mesh.half_edges()[next].around) != h;
}

template <class Record>
void store(std::span<std::byte> out, std::size_t index, const Record& record) {
    std::memcpy(out.data() + index * sizeof(Record), &record, sizeof record);
}

} // namespace

Result<std::uint32_t> count_cells(const PreparedMesh& mesh, const SampleParams& params) {
    if (has_small_faces(mesh, params)) {
        return 0u;
    }
    const double unit = working_distance(mesh, params);
    std::uint64_t cells = 0;
    for (std::uint32_t f = 0; f < mesh.face_count(); ++f) {
        const Grid grid = face_grid(mesh, params, f, unit);
        cells += grid.columns * grid.rows; // At most 2^62, and 2^30 before.
        if (cells > gpu::kFirstCellMask) {
            return Error{Status::invalid_argument,
                         "the minimum distance is too small: face " + std::to_string(f) +
                             " alone or with those before it takes more than 2^30 grid cells",
                         f};
        }
    }
    return cells == mesh.face_count() ? 0 : static_cast<std::uint32_t>(cells);
}

float face_area(const PreparedMesh& mesh, std::uint32_t face, double unit) {
    const HalfEdge& edge = mesh.half_edges()[std::size_t{3} * face];
    const float height = previous_length(mesh, 3 * face, unit) * direction(edge.sine);
    return 0.5f * (scaled(edge.length, unit) * height);
}

std::size_t face_bytes(const PreparedMesh& mesh) {
    return mesh.face_count() * (3 * sizeof(gpu::HalfEdgeRec) + sizeof(gpu::FaceLinksRec));
}

std::size_t fan_bytes(const PreparedMesh& mesh, bool adaptive) {
    return FanRows(mesh, adaptive).bytes();
}

std::size_t key_bytes(const SampleParams& params) {
    return std::max<std::size_t>(params.face_keys.size_bytes(), sizeof(std::uint32_t));
}

void write_faces(const PreparedMesh& mesh, const SampleParams& params, bool one_cell_each,
                 std::span<std::byte> out) {
    const double unit = working_distance(mesh, params);
    std::uint32_t first_cell = 0;
    for (std::uint32_t f = 0; f < mesh.face_count(); ++f) {
        for (std::uint32_t k = 0; k < 3; ++k) {
            const std::uint32_t h = 3 * f + k;
            const HalfEdge& e = mesh.half_edges()[h];
            const bool bends = (mesh.fans()[e.origin].flags & gpu::kFanBends) != 0;
            store(out, gpu::kFaceRows * f + k,
                  gpu::HalfEdgeRec{scaled(e.length, unit), direction(e.cosine), direction(e.sine),
                                   e.origin | (bends ? gpu::kOriginBends : 0u) |
                                       (shared_by_many(mesh, h) ? gpu::kManyFaces : 0u)});
        }
        const Grid grid = one_cell_each ? Grid{1, 1, 0} : face_grid(mesh, params, f, unit);
        const bool single = grid.columns * grid.rows == 1;
        const auto edges = mesh.half_edges().subspan(std::size_t{3} * f, 3);
        store(out, gpu::kFaceRows * f + 3,
              gpu::FaceLinksRec{edges[0].around, edges[1].around, edges[2].around,
                                first_cell | (single ? gpu::kSingleCell : grid.corner)
                                                 << gpu::kFaceCornerShift});
        first_cell += static_cast<std::uint32_t>(grid.columns * grid.rows);
    }
}

Result<Done> write_fans(const PreparedMesh& mesh, const SampleParams& params,
                        std::span<std::byte> out) {
    const FanRows rows(mesh, params.radii != nullptr);
    std::memset(out.data(), 0, out.size());
    for (std::size_t v = 0; v < mesh.fans().size(); ++v) {
        const VertexFan& fan = mesh.fans()[v];
        store(out, v, gpu::FanRec{fan.first_corner, fan.corner_count, fan.total_angle, fan.flags});
    }
    struct CornerRec {
        std::uint32_t half_edge, angles;
    };
    const auto corners = out.subspan(rows.fans * 16);
    for (std::size_t i = 0; i < mesh.corners().size(); ++i) {
        const std::uint32_t h = mesh.corners()[i];
        store(corners, i, CornerRec{h, mesh.half_edges()[h].fan_angles});
    }
    const auto angles = corners.subspan(rows.corners * 16);
    for (std::size_t h = 0; h < mesh.half_edges().size(); ++h) {
        store(angles, h, mesh.half_edges()[h].fan_angles);
    }
    if (params.radii == nullptr) {
        return Done{};
    }
    const auto bounds = params.radii->reach_bounds(mesh, params.min_distance);
    if (!bounds) {
        return bounds.error();
    }
    const auto radii = angles.subspan(rows.angles * 16);
    for (std::uint32_t f = 0; f < mesh.face_count(); ++f) {
        gpu::RadiiRec record = radii_of(params, f);
        record.bound = (*bounds)[f];
        store(radii, f, record);
    }
    return Done{};
}

void write_keys(const SampleParams& params, std::span<std::byte> out) {
    std::memset(out.data(), 0, out.size());
    if (!params.face_keys.empty()) {
        std::memcpy(out.data(), params.face_keys.data(), params.face_keys.size_bytes());
    }
}

} // namespace geodisk
