#include "engine/domain/device_mesh.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <string>

#include <geodisk/radius_field.hpp>

#include "constants.h"
#include "engine/domain/stages.hpp"
#include "records.h"

namespace geodisk {
namespace {

/// Returns a length in units of the frame. Tiny lengths become zero, so that no product on the
/// device becomes denormal.
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

/// Counts cells with the same arithmetic as shaders/lib: apex_of, then cell_count.
std::uint64_t cell_count(float extent, float cells_per_unit) {
    const float scaled = extent * cells_per_unit;
    return scaled < 0x1p30f ? static_cast<std::uint64_t>(scaled) + 1 : kTooMany;
}

/// Returns the radii of a face without the bound; all are half of the unit if radii do not vary.
gpu::RadiiRec radii_of(const SampleParams& params, std::uint32_t face) {
    if (params.radii == nullptr) {
        return {0.5f, 0.5f, 0.5f, 0, 0, 0, 0, 0};
    }
    const float* const g = &params.radii->factors()[std::size_t{3} * face];
    const float* const s = &params.radii->spreads()[std::size_t{3} * face];
    const float density = params.radii->densities()[face];
    if (params.radii->packing().empty()) {
        return {0.5f * g[0], 0.5f * g[1], 0.5f * g[2], 0, s[0], s[1], s[2], density};
    }
    const float* const packing = &params.radii->packing()[std::size_t{3} * face];
    return {-packing[0], -packing[1], -packing[2], 0, s[0], s[1], s[2], density};
}

/// Same as in shaders/lib/radii.glsl.
float cells_per_unit(const gpu::RadiiRec& radii) {
    const float corner = std::max({radii.radius0, radii.radius1, radii.radius2});
    const float largest = corner < 0 ? 0.5f / std::sqrt(-corner) : corner;
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
        previous_length(mesh, 3 * face + corner, unit) * direction(edges[corner].angle().sine);
    return {cell_count(scaled(edges[corner].length, unit), per_unit), cell_count(height, per_unit),
            corner};
}

/// Rows of the fans buffer: fans, pairs of corner and angles, angles by half-edge.
struct FanRows {
    std::size_t fans, corners, angles;
    explicit FanRows(PlacedSurfaces surfaces)
        : fans(vertex_count(surfaces)), corners((std::size_t{3} * face_count(surfaces) + 1) / 2),
          angles((std::size_t{3} * face_count(surfaces) + 3) / 4) {}
    std::size_t bytes() const { return (fans + corners + angles) * kRowBytes; }
};

bool shared_by_many(const PreparedMesh& mesh, std::uint32_t h) {
    const std::uint32_t next = around_half_edge(mesh.half_edges()[h].around);
    return around_half_edge(mesh.half_edges()[next].around) != h;
}

template <class Record>
void store(std::span<std::byte> out, std::size_t index, const Record& record) {
    std::memcpy(out.data() + index * sizeof(Record), &record, sizeof record);
}

/// Returns a link to a half-edge, numbered through all surfaces.
std::uint32_t placed_around(const PlacedSurface& surface, std::uint32_t around) {
    return around + (3 * surface.first_face << 1);
}

/// Writes, for several surfaces, the keys of faces, the surface of each face, and a record per
/// surface.
void write_parts(PlacedSurfaces surfaces, std::span<std::byte> out) {
    const auto parts = out.subspan(face_count(surfaces) * sizeof(std::uint32_t));
    const auto records = parts.subspan(face_count(surfaces) * sizeof(std::uint32_t));
    for (std::uint32_t i = 0; i < surfaces.size(); ++i) {
        const PlacedSurface& surface = surfaces[i];
        const SampleParams& params = surface.params;
        for (std::uint32_t f = 0; f < surface.mesh->face_count(); ++f) {
            store(out, surface.first_face + f, params.face_keys.empty() ? f : params.face_keys[f]);
            store(parts, surface.first_face + f, i);
        }
        store(records, i,
              gpu::PartRec{static_cast<std::uint32_t>(params.seed),
                           static_cast<std::uint32_t>(params.seed >> 32),
                           stage_intensity(surface.stages, 0), surface.stages.pool_stages(),
                           static_cast<float>(params.min_distance / 2), surface.first_face, 0, 0});
    }
}

} // namespace

Result<std::uint32_t> count_cells(PlacedSurfaces surfaces) {
    FaceCrowding crowding;
    for (const PlacedSurface& surface : surfaces) {
        crowding.add(*surface.mesh, surface.params, surface.stages);
    }
    if (crowding.is_small()) {
        return 0u;
    }
    std::uint64_t cells = 0;
    for (const PlacedSurface& surface : surfaces) {
        for (std::uint32_t f = 0; f < surface.mesh->face_count(); ++f) {
            const Grid grid = face_grid(*surface.mesh, surface.params, f, surface.frame.unit);
            cells += grid.columns * grid.rows; // Cannot overflow: at most 2^62 is added to 2^30.
            if (cells > gpu::kFirstCellMask) {
                const auto part = &surface - surfaces.data();
                return Error{
                    Status::invalid_argument,
                    (surfaces.size() == 1 ? "" : "surface " + std::to_string(part) + ": ") +
                        "the minimum distance is too small: face " + std::to_string(f) +
                        " alone or with those before it takes more than 2^30 grid cells",
                    f};
            }
        }
    }
    return cells == face_count(surfaces) ? 0 : static_cast<std::uint32_t>(cells);
}

float face_area(const PreparedMesh& mesh, std::uint32_t face, double unit) {
    const HalfEdge& edge = mesh.half_edges()[std::size_t{3} * face];
    const float height = previous_length(mesh, 3 * face, unit) * direction(edge.angle().sine);
    return 0.5f * (scaled(edge.length, unit) * height);
}

std::size_t half_edge_bytes(PlacedSurfaces surfaces) {
    return face_count(surfaces) * (gpu::kFaceRows * sizeof(gpu::HalfEdgeRec));
}

std::size_t length_bytes(PlacedSurfaces surfaces) {
    return face_count(surfaces) * sizeof(gpu::FaceLengthsRec);
}

std::size_t fan_bytes(PlacedSurfaces surfaces) {
    return FanRows(surfaces).bytes();
}

std::size_t radii_bytes(PlacedSurfaces surfaces) {
    return has_radii(surfaces) ? face_count(surfaces) * sizeof(gpu::RadiiRec) : 0;
}

std::size_t key_bytes(PlacedSurfaces surfaces) {
    const std::size_t bytes = surfaces.size() > 1
                                  ? std::size_t{2} * face_count(surfaces) * sizeof(std::uint32_t) +
                                        surfaces.size() * sizeof(gpu::PartRec)
                                  : surfaces[0].params.face_keys.size_bytes();
    return (bytes + kRowBytes - 1) / kRowBytes * kRowBytes;
}

void write_half_edges(PlacedSurfaces surfaces, std::span<std::byte> out) {
    for (const PlacedSurface& surface : surfaces) {
        const PreparedMesh& mesh = *surface.mesh;
        const auto own = out.subspan(std::size_t{surface.first_face} * gpu::kFaceRows * kRowBytes);
        for (std::uint32_t h = 0; h < mesh.half_edges().size(); ++h) {
            const HalfEdge& e = mesh.half_edges()[h];
            const bool bends = (mesh.fans()[e.origin].flags & gpu::kFanBends) != 0;
            const Direction angle = e.angle();
            store(own, h,
                  gpu::HalfEdgeRec{direction(angle.cosine), direction(angle.sine),
                                   (e.origin + surface.first_vertex) |
                                       (bends ? gpu::kOriginBends : 0u) |
                                       (shared_by_many(mesh, h) ? gpu::kManyFaces : 0u),
                                   placed_around(surface, e.around)});
        }
    }
}

void write_lengths(PlacedSurfaces surfaces, bool one_cell_each, std::span<std::byte> out) {
    std::uint32_t first_cell = 0;
    for (const PlacedSurface& surface : surfaces) {
        const auto own = out.subspan(surface.first_face * sizeof(gpu::FaceLengthsRec));
        for (std::uint32_t f = 0; f < surface.mesh->face_count(); ++f) {
            const Grid grid = one_cell_each
                                  ? Grid{1, 1, 0}
                                  : face_grid(*surface.mesh, surface.params, f, surface.frame.unit);
            const bool single = grid.columns * grid.rows == 1;
            const HalfEdge* const edges = &surface.mesh->half_edges()[std::size_t{3} * f];
            store(own, f,
                  gpu::FaceLengthsRec{scaled(edges[0].length, surface.frame.unit),
                                      scaled(edges[1].length, surface.frame.unit),
                                      scaled(edges[2].length, surface.frame.unit),
                                      first_cell | (single ? gpu::kSingleCell : grid.corner)
                                                       << gpu::kFaceCornerShift});
            first_cell += static_cast<std::uint32_t>(grid.columns * grid.rows);
        }
    }
}

void write_fans(PlacedSurfaces surfaces, std::span<std::byte> out) {
    struct CornerRec {
        std::uint32_t half_edge, angles;
    };
    const FanRows rows(surfaces);
    const auto corners = out.subspan(rows.fans * kRowBytes);
    const auto angles = corners.subspan(rows.corners * kRowBytes);
    std::memset(out.data(), 0, out.size());
    for (const PlacedSurface& surface : surfaces) {
        const PreparedMesh& mesh = *surface.mesh;
        const std::uint32_t first_half_edge = 3 * surface.first_face;
        for (std::size_t v = 0; v < mesh.fans().size(); ++v) {
            const VertexFan& fan = mesh.fans()[v];
            store(out, surface.first_vertex + v,
                  gpu::FanRec{fan.first_corner + surface.first_corner, fan.corner_count,
                              fan.total_angle, fan.flags});
        }
        for (std::size_t i = 0; i < mesh.corners().size(); ++i) {
            const std::uint32_t h = mesh.corners()[i];
            store(corners, surface.first_corner + i,
                  CornerRec{h + first_half_edge, mesh.half_edges()[h].fan_angles});
        }
        for (std::size_t h = 0; h < mesh.half_edges().size(); ++h) {
            store(angles, first_half_edge + h, mesh.half_edges()[h].fan_angles);
        }
    }
}

Result<Done> write_radii(PlacedSurfaces surfaces, std::span<std::byte> out) {
    for (const PlacedSurface& surface : surfaces) {
        const SampleParams& params = surface.params;
        const auto bounds = params.radii->reach_bounds(*surface.mesh, params.min_distance);
        if (!bounds) {
            return bounds.error();
        }
        for (std::uint32_t f = 0; f < surface.mesh->face_count(); ++f) {
            gpu::RadiiRec record = radii_of(params, f);
            record.bound = (*bounds)[f];
            store(out, surface.first_face + f, record);
        }
    }
    return Done{};
}

void write_keys(PlacedSurfaces surfaces, std::span<std::byte> out) {
    std::ranges::fill(out, std::byte{0}); // Where the last row ends early.
    if (surfaces.size() > 1) {
        write_parts(surfaces, out);
        return;
    }
    const auto keys = std::as_bytes(surfaces[0].params.face_keys);
    std::ranges::copy(keys, out.begin());
}

} // namespace geodisk
