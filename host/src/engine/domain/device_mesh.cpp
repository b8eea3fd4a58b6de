#include "engine/domain/device_mesh.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <memory>
#include <string>
#include <type_traits>
#include <utility>

#include <geodisk/radius_field.hpp>

#include "constants.h"
#include "engine/domain/classes.hpp"
#include "engine/domain/stages.hpp"
#include "records.h"
#include "support/blocks.hpp"
#include "support/try.hpp"

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

/// Same as in shaders/lib/radii.glsl.
float cells_per_unit(const gpu::RadiiRec& radii) {
    const float corner = std::max({radii.radius0, radii.radius1, radii.radius2});
    const float largest = corner < 0 ? 0.5f / std::sqrt(-corner) : corner;
    return std::bit_cast<float>(0x7f000000u -
                                (std::bit_cast<std::uint32_t>(largest) & 0x7f800000u));
}

/// Returns the cells per unit of length over a face.
float cells_per_unit(const SampleParams& params, std::uint32_t face) {
    return params.class_factors.empty() ? cells_per_unit(radii_of(params, face))
                                        : class_cells_per_unit(params);
}

Grid face_grid(const PreparedMesh& mesh, const SampleParams& params, std::uint32_t face,
               double unit) {
    const float per_unit = cells_per_unit(params, face);
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
void store(std::byte*& out, const Record& record) {
    std::memcpy(out, &record, sizeof record);
    out += sizeof record;
}

std::uint32_t first_half_edge(const PlacedSurface& surface) {
    return 3 * surface.first_face;
}

/// Calls `visit(surface, i)` for each element `begin` to `end` of those numbered through all
/// surfaces; those of a surface begin at `first_of(surface)`, and i counts from there.
template <class FirstOf, class Visit>
void for_elements(PlacedSurfaces surfaces, std::size_t begin, std::size_t end,
                  const FirstOf& first_of, const Visit& visit) {
    auto surface = std::ranges::upper_bound(surfaces, begin, {}, first_of) - 1;
    while (begin < end) {
        const auto next = surface + 1;
        const std::size_t first = first_of(*surface);
        const std::size_t last =
            next == surfaces.end() ? end : std::min<std::size_t>(end, first_of(*next));
        for (; begin < last; ++begin) {
            visit(*surface, static_cast<std::uint32_t>(begin - first));
        }
        surface = next;
    }
}

/// Appends a part of `records` records: `record_of(surface, i)` is that of element i, as
/// for_elements() counts them. Where there are more records than the `count` elements, the last are
/// zero.
template <class FirstOf, class RecordOf>
void add_part(UploadParts& parts, PlacedSurfaces surfaces, std::size_t records, std::size_t count,
              FirstOf first_of, RecordOf record_of) {
    using Record = std::invoke_result_t<RecordOf, const PlacedSurface&, std::uint32_t>;
    parts.push_back(
        {sizeof(Record), records, [=](std::size_t begin, std::size_t end, std::byte* out) {
             const std::size_t last = std::min(end, count);
             for_elements(surfaces, begin, last, first_of,
                          [&](const PlacedSurface& surface, std::uint32_t i) {
                              store(out, record_of(surface, i));
                          });
             std::memset(out, 0, (end - std::max(begin, last)) * sizeof(Record));
         }});
}

/// Returns a link to a half-edge, numbered through all surfaces.
std::uint32_t placed_around(const PlacedSurface& surface, std::uint32_t around) {
    return around + (first_half_edge(surface) << 1);
}

gpu::PartRec part_of(const PlacedSurface& surface) {
    const SampleParams& params = surface.params;
    return {static_cast<std::uint32_t>(params.seed),
            static_cast<std::uint32_t>(params.seed >> 32),
            stage_intensity(surface.stages, 0),
            surface.stages.pool_stages(),
            static_cast<float>(params.min_distance / 2),
            surface.first_face,
            surface.lag,
            0};
}

} // namespace

Result<FaceCells> count_cells(PlacedSurfaces surfaces) {
    FaceCrowding crowding;
    for (const PlacedSurface& surface : surfaces) {
        crowding.add(*surface.mesh, surface.params, surface.stages);
    }
    if (crowding.is_small()) {
        return FaceCells{};
    }
    std::uint64_t cells = 0;
    std::vector<std::uint32_t> firsts;
    firsts.reserve(block_count(face_count(surfaces)));
    for (const PlacedSurface& surface : surfaces) {
        for (std::uint32_t f = 0; f < surface.mesh->face_count(); ++f) {
            if ((surface.first_face + f) % kBlock == 0) {
                firsts.push_back(static_cast<std::uint32_t>(cells));
            }
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
    return cells == face_count(surfaces)
               ? FaceCells{}
               : FaceCells{static_cast<std::uint32_t>(cells), std::move(firsts)};
}

std::uint32_t FaceGrid::cell_of(const PreparedMesh& mesh, std::uint32_t face, double weight1,
                                double weight2) const {
    const double weights[3] = {1 - weight1 - weight2, weight1, weight2};
    const HalfEdge& edge = mesh.half_edges()[std::size_t{3} * face + corner];
    const double apex = weights[(corner + 2) % 3];
    const double x = weights[(corner + 1) % 3] * edge.length + apex * edge.apex_x;
    const auto index = [this](double length, std::uint32_t count) {
        return static_cast<std::uint32_t>(std::clamp(length / cell, 0.0, count - 1.0));
    };
    return first + index(apex * edge.apex_y, rows) * columns + index(x, columns);
}

void for_face_grids(const PlacedSurface& surface,
                    const std::function<void(std::uint32_t face, const FaceGrid&)>& visit) {
    const double unit = surface.frame.unit;
    std::uint32_t first = 0;
    for (std::uint32_t f = 0; f < surface.mesh->face_count(); ++f) {
        const auto [columns, rows, corner] = face_grid(*surface.mesh, surface.params, f, unit);
        const FaceGrid grid{first, static_cast<std::uint32_t>(columns),
                            static_cast<std::uint32_t>(rows), corner,
                            unit / cells_per_unit(surface.params, f)};
        visit(f, grid);
        first += grid.columns * grid.rows;
    }
}

float face_area(const PreparedMesh& mesh, std::uint32_t face, double unit) {
    const HalfEdge& edge = mesh.half_edges()[std::size_t{3} * face];
    const float height = previous_length(mesh, 3 * face, unit) * direction(edge.angle().sine);
    return 0.5f * (scaled(edge.length, unit) * height);
}

std::uint32_t key_of(const PlacedSurface& surface, std::uint32_t face) {
    const auto keys = surface.params.face_keys;
    return keys.empty() ? face : keys[face];
}

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

void add_half_edges(PlacedSurfaces surfaces, UploadParts& parts) {
    const std::size_t count = std::size_t{3} * face_count(surfaces);
    add_part(parts, surfaces, count, count, first_half_edge,
             [](const PlacedSurface& surface, std::uint32_t h) {
                 const PreparedMesh& mesh = *surface.mesh;
                 const HalfEdge& e = mesh.half_edges()[h];
                 const bool bends = (mesh.fans()[e.origin].flags & gpu::kFanBends) != 0;
                 const Direction angle = e.angle();
                 return gpu::HalfEdgeRec{direction(angle.cosine), direction(angle.sine),
                                         (e.origin + surface.first_vertex) |
                                             (bends ? gpu::kOriginBends : 0u) |
                                             (shared_by_many(mesh, h) ? gpu::kManyFaces : 0u),
                                         placed_around(surface, e.around)};
             });
}

void add_lengths(PlacedSurfaces surfaces, const FaceCells& cells, UploadParts& parts) {
    const auto grid_of = [&cells](const PlacedSurface& surface, std::uint32_t f) {
        return cells.count == 0 ? Grid{1, 1, 0}
                                : face_grid(*surface.mesh, surface.params, f, surface.frame.unit);
    };
    const auto first_face = [](const PlacedSurface& surface) { return surface.first_face; };
    const auto write = [=, &cells](std::size_t begin, std::size_t end, std::byte* out) {
        // The cells of faces in the same block, before the first one.
        const std::size_t block = cells.count == 0 ? begin : begin / kBlock * kBlock;
        std::uint32_t first_cell =
            cells.count == 0 ? static_cast<std::uint32_t>(begin) : cells.firsts[begin / kBlock];
        for_elements(
            surfaces, block, end, first_face, [&](const PlacedSurface& surface, std::uint32_t f) {
                const Grid grid = grid_of(surface, f);
                const bool single = grid.columns * grid.rows == 1;
                const HalfEdge* const edges = &surface.mesh->half_edges()[std::size_t{3} * f];
                if (surface.first_face + f >= begin) {
                    store(out,
                          gpu::FaceLengthsRec{scaled(edges[0].length, surface.frame.unit),
                                              scaled(edges[1].length, surface.frame.unit),
                                              scaled(edges[2].length, surface.frame.unit),
                                              first_cell | (single ? gpu::kSingleCell : grid.corner)
                                                               << gpu::kFaceCornerShift});
                }
                first_cell += static_cast<std::uint32_t>(grid.columns * grid.rows);
            });
    };
    parts.push_back({sizeof(gpu::FaceLengthsRec), face_count(surfaces), write});
}

void add_fans(PlacedSurfaces surfaces, UploadParts& parts) {
    struct CornerRec {
        std::uint32_t half_edge, angles;
    };
    const FanRows rows(surfaces);
    const std::size_t half_edges = std::size_t{3} * face_count(surfaces);
    add_part(
        parts, surfaces, rows.fans, rows.fans,
        [](const PlacedSurface& surface) { return surface.first_vertex; },
        [](const PlacedSurface& surface, std::uint32_t v) {
            const VertexFan& fan = surface.mesh->fans()[v];
            return gpu::FanRec{fan.first_corner + surface.first_corner, fan.corner_count,
                               fan.total_angle, fan.flags};
        });
    // Triangles that take no part have no corners.
    const std::size_t corners =
        surfaces.back().first_corner + surfaces.back().mesh->corners().size();
    add_part(
        parts, surfaces, rows.corners * kRowBytes / sizeof(CornerRec), corners,
        [](const PlacedSurface& surface) { return surface.first_corner; },
        [](const PlacedSurface& surface, std::uint32_t i) {
            const std::uint32_t h = surface.mesh->corners()[i];
            return CornerRec{h + first_half_edge(surface),
                             surface.mesh->half_edges()[h].fan_angles};
        });
    add_part(parts, surfaces, rows.angles * kRowBytes / sizeof(std::uint32_t), half_edges,
             first_half_edge, [](const PlacedSurface& surface, std::uint32_t h) {
                 return surface.mesh->half_edges()[h].fan_angles;
             });
}

Result<Done> add_radii(PlacedSurfaces surfaces, UploadParts& parts) {
    std::vector<float> all;
    for (const PlacedSurface& surface : surfaces) {
        const SampleParams& params = surface.params;
        const auto bounds = params.radii->reach_bounds(*surface.mesh, params.min_distance);
        GEODISK_TRY(bounds);
        all.insert(all.end(), bounds->begin(), bounds->end());
    }
    const std::uint32_t count = face_count(surfaces);
    add_part(
        parts, surfaces, count, count,
        [](const PlacedSurface& surface) { return surface.first_face; },
        [bounds = std::make_shared<const std::vector<float>>(std::move(all))](
            const PlacedSurface& surface, std::uint32_t f) {
            gpu::RadiiRec record = radii_of(surface.params, f);
            record.bound = (*bounds)[surface.first_face + f];
            return record;
        });
    return Done{};
}

/// Adds, for several surfaces, the keys of faces, the surface of each face, and a record per
/// surface; for one, its keys, if any.
void add_keys(PlacedSurfaces surfaces, UploadParts& parts) {
    const std::size_t bytes = key_bytes(surfaces);
    if (bytes == 0) {
        return;
    }
    const std::uint32_t faces = face_count(surfaces);
    const auto first_face = [](const PlacedSurface& surface) { return surface.first_face; };
    if (surfaces.size() == 1) {
        add_part(parts, surfaces, bytes / sizeof(std::uint32_t), faces, first_face, key_of);
        return;
    }
    add_part(parts, surfaces, faces, faces, first_face, key_of);
    add_part(parts, surfaces, faces, faces, first_face,
             [surfaces](const PlacedSurface& surface, std::uint32_t) {
                 return static_cast<std::uint32_t>(&surface - surfaces.data());
             });
    parts.push_back({sizeof(gpu::PartRec), surfaces.size(),
                     [surfaces](std::size_t begin, std::size_t end, std::byte* out) {
                         for (std::size_t i = begin; i < end; ++i) {
                             store(out, part_of(surfaces[i]));
                         }
                     }});
    const std::size_t written =
        std::size_t{2} * faces * sizeof(std::uint32_t) + parts.back().bytes();
    parts.push_back({bytes - written, bytes > written ? 1u : 0u,
                     [rest = bytes - written](std::size_t, std::size_t, std::byte* out) {
                         std::memset(out, 0, rest); // Where the last row ends early.
                     }});
}

} // namespace geodisk
