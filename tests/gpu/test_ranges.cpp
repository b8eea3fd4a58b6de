// A surface that no part holds whole: what each part gets of it.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <memory>
#include <optional>
#include <random>
#include <utility>
#include <vector>

#include <geodisk/checkpoint.hpp>
#include <geodisk/mesh_range.hpp>

#include "parts/mesh_turn.hpp"
#include "parts/ranges/nearest_place.hpp"
#include "parts/ranges/ranged_surface.hpp"
#include "threads_exchange.hpp"

namespace geodisk::test {
namespace {

/// A flat square of right triangles with legs of length 1: distances on it are those in the plane.
struct Sheet {
    std::uint32_t side;
    std::vector<std::uint32_t> triangles;
    std::vector<double> positions;

    explicit Sheet(std::uint32_t faces_a_side) : side(faces_a_side) {
        for (std::uint32_t y = 0; y <= side; ++y) {
            for (std::uint32_t x = 0; x <= side; ++x) {
                positions.insert(positions.end(), {double(x), double(y), 0.0});
                if (x < side && y < side) {
                    const std::uint32_t a = y * (side + 1) + x, b = a + side + 1;
                    triangles.insert(triangles.end(), {a, a + 1, b + 1, a, b + 1, b});
                }
            }
        }
    }
    std::uint32_t face_count() const { return 2 * side * side; }
    Place place(std::uint32_t vertex) const {
        const std::size_t at = std::size_t{3} * vertex;
        return {positions[at], positions[at + 1], 0};
    }
    /// Returns what one of some processes reads.
    MeshRange range(std::uint32_t process, std::uint32_t processes) const {
        MeshRange range;
        range.faces = {face_count(), processes};
        range.vertices = {positions.size() / 3, processes};
        const auto copy = [process](const MeshBlocks& blocks, const auto& from, auto& to) {
            const auto first =
                from.begin() + static_cast<std::ptrdiff_t>(3 * blocks.first(process));
            to.assign(first, first + static_cast<std::ptrdiff_t>(3 * blocks.size(process)));
        };
        copy(range.faces, triangles, range.triangles);
        copy(range.vertices, positions, range.positions);
        return range;
    }
};

double distance(const Place& a, const Place& b) {
    return std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
}

/// Values on the sheet that make radii or a mask, and what a job on the whole has of them.
struct Fields {
    RadiusKind kind;
    std::vector<double> values;                       ///< Values at vertices.
    std::vector<std::uint8_t> vertex_mask, face_mask; ///< Empty without a mask.

    /// Factors, or a density that is 0 somewhere.
    Fields(const Sheet& sheet, RadiusKind radii, bool has_mask) : kind(radii) {
        for (std::uint32_t v = 0; v < sheet.positions.size() / 3 && kind != RadiusKind::same; ++v) {
            const Place at = sheet.place(v);
            const double wave = std::sin(0.3 * at[0]) * std::cos(0.2 * at[1]);
            values.push_back(kind == RadiusKind::factor ? 0.6 + 0.4 * wave
                                                        : std::max(0.0, 50 * wave));
        }
        for (std::uint32_t v = 0; v < sheet.positions.size() / 3 && has_mask; ++v) {
            vertex_mask.push_back(sheet.place(v)[0] < 0.8 * sheet.side ? 1 : 0);
        }
        for (std::uint32_t face = 0; face < sheet.face_count() && has_mask; ++face) {
            face_mask.push_back(face % 5 != 0 ? 1 : 0);
        }
    }
    void add_to(MeshRange& range, std::uint32_t process) const {
        const auto copy = [process](const MeshBlocks& blocks, const auto& from, auto& to) {
            for (std::uint64_t i = 0; i < blocks.size(process) && !from.empty(); ++i) {
                to.push_back(from[blocks.first(process) + i]);
            }
        };
        range.radii = kind;
        copy(range.vertices, values, range.values);
        range.has_mask = !face_mask.empty();
        copy(range.vertices, vertex_mask, range.vertex_mask);
        copy(range.faces, face_mask, range.face_mask);
        range.needs_borders = true;
    }
    std::optional<RadiusField> radii(const PreparedMesh& mesh) const {
        if (kind == RadiusKind::same) {
            return std::nullopt;
        }
        return kind == RadiusKind::factor ? *RadiusField::prepare(mesh, values)
                                          : *RadiusField::from_density(mesh, values);
    }
    std::vector<std::uint8_t> mask(const Sheet& sheet) const {
        std::vector<std::uint8_t> mask = face_mask;
        for (std::size_t i = 0; i < sheet.triangles.size() && !mask.empty(); ++i) {
            mask[i / 3] &= vertex_mask[sheet.triangles[i]];
        }
        return mask;
    }
};

void check_same(const RadiusField& a, const RadiusField& b) {
    CHECK(std::ranges::equal(a.factors(), b.factors()));
    CHECK(std::ranges::equal(a.spreads(), b.spreads()));
    CHECK(std::ranges::equal(a.packing(), b.packing()));
    CHECK(std::ranges::equal(a.densities(), b.densities()));
    CHECK(a.effective_area() == b.effective_area());
    CHECK(a.largest_density() == b.largest_density());
    CHECK(a.min_density() == b.min_density());
}

/// Findings of one of some threads about a surface and its fields.
struct Ranged {
    double area = 0, borders = 0, min_factor = 1;
    std::uint64_t digest = 0;
    std::unique_ptr<Part> part; ///< With its mesh.
};

/// Returns what so many threads find. The job's own radii and mask are not read.
std::vector<Ranged> ranged(const Sheet& sheet, const Fields& fields, SampleParams params,
                           std::uint32_t count) {
    params.radii = nullptr;
    params.face_mask = {};
    std::vector<Ranged> all(count);
    run_threads(count, [&](Exchange& exchange) {
        MeshRange range = sheet.range(exchange.rank(), count);
        fields.add_to(range, exchange.rank());
        const auto surface = RangedSurface::create(exchange, std::move(range));
        const auto frame = surface ? surface->frame(params) : Result<JobFrame>(surface.error());
        if (!frame) {
            return;
        }
        Ranged& found = all[exchange.rank()];
        found.area = surface->statistics().effective_area;
        found.borders = surface->statistics().borders;
        found.min_factor = surface->radii() != nullptr ? surface->radii()->min_factor() : 1;
        found.digest = surface->statistics().digest;
        auto part = surface->part(exchange, params, *frame, 0x1p26, CheckpointTerms());
        if (part) {
            found.part = std::move(*part);
            const MeshTurn turn(exchange, *found.part); // Held for good.
        }
    });
    return all;
}

/// Returns the parts of a job on a surface that so many threads read in ranges.
std::vector<std::unique_ptr<Part>> parts_of(const Sheet& sheet, const SampleParams& params,
                                            std::uint32_t count) {
    std::vector<std::unique_ptr<Part>> parts(count);
    run_threads(count, [&](Exchange& exchange) {
        const std::uint32_t rank = exchange.rank();
        const auto surface = RangedSurface::create(exchange, sheet.range(rank, count));
        const auto frame = surface ? surface->frame(params) : Result<JobFrame>(surface.error());
        if (frame) {
            auto part = surface->part(exchange, params, *frame, 0x1p26, CheckpointTerms());
            parts[rank] = part ? std::move(*part) : nullptr;
        }
    });
    return parts;
}

} // namespace

TEST_SUITE("parts") {
    TEST_CASE("a halo has all faces within reach, and few beyond") {
        const Sheet sheet(90);
        SampleParams params;
        params.min_distance = 5;
        for (const std::uint32_t count : {2u, 5u, 8u}) {
            CAPTURE(count);
            for (const auto& part : parts_of(sheet, params, count)) {
                REQUIRE(part);
                std::vector<std::uint8_t> role(sheet.face_count(), 0);
                std::vector<Place> own;
                for (std::size_t i = 0; i < part->faces.size(); ++i) {
                    const std::uint32_t face = part->faces[i];
                    role[face] = part->roles[i] == FaceRole::surface ? 1 : 2;
                    for (std::uint32_t k = 0; k < 3 && part->roles[i] == FaceRole::own; ++k) {
                        own.push_back(sheet.place(sheet.triangles[3 * face + k]));
                    }
                }
                const NearestPlace nearest(std::move(own));
                std::size_t missing = 0, beyond = 0;
                for (std::uint32_t face = 0; face < sheet.face_count(); ++face) {
                    double least = 1e9;
                    for (std::uint32_t k = 0; k < 3; ++k) {
                        const Place corner = sheet.place(sheet.triangles[3 * face + k]);
                        least = std::min(least, nearest.distance(corner, 1e9));
                    }
                    const int needed = least <= part->reach ? 2 : least <= 2 * part->reach ? 1 : 0;
                    missing += role[face] < needed;
                    // Bounds are too short by one and a half edges.
                    beyond += role[face] != 0 && least > 2 * part->reach + 1.5 * std::sqrt(2.0);
                }
                CHECK(missing == 0);
                CHECK(beyond == 0);
            }
        }
    }

    TEST_CASE("radii and masks of ranges are those of the whole") {
        const Sheet sheet(40);
        const PreparedMesh mesh =
            *PreparedMesh::prepare(MeshView{sheet.positions, sheet.triangles, 3});
        for (const auto kind : {RadiusKind::same, RadiusKind::factor, RadiusKind::density}) {
            for (const bool has_mask : {false, true}) {
                CAPTURE(static_cast<int>(kind));
                CAPTURE(has_mask);
                const Fields fields(sheet, kind, has_mask);
                const auto radii = fields.radii(mesh);
                const auto mask = fields.mask(sheet);
                SampleParams params;
                params.min_distance = 3;
                params.radii = radii ? &*radii : nullptr;
                params.face_mask = mask;
                const JobFrame frame = *frame_of(mesh, params);
                for (const std::uint32_t count : {1u, 3u, 4u}) {
                    CAPTURE(count);
                    for (const Ranged& found : ranged(sheet, fields, params, count)) {
                        REQUIRE(found.part);
                        const Part& part = *found.part;
                        CHECK(part.frame == frame);
                        CHECK(found.digest == surface_digest(mesh, params));
                        CHECK(found.area == effective_area(mesh, params));
                        CHECK(distance_for_count(found.area, found.borders, 200) ==
                              distance_for_count(mesh, params, 200));
                        CHECK(part.mask.size() == (has_mask ? part.faces.size() : 0));
                        for (std::size_t i = 0; i < part.mask.size(); ++i) {
                            CHECK(part.mask[i] == mask[part.faces[i]]);
                        }
                        REQUIRE(part.radii.has_value() == radii.has_value());
                        if (radii) {
                            check_same(*part.radii, radii->on_part(part.mesh, part.faces));
                            CHECK(found.min_factor == radii->min_factor());
                        }
                    }
                }
            }
        }
    }

    TEST_CASE("the nearest place is the nearest") {
        std::mt19937 random(7);
        // Many places have the same coordinates.
        const auto some = [&] {
            return Place{double(random() % 9), double(random() % 9), double(random() % 9) / 2};
        };
        for (const std::size_t count : {0u, 1u, 2u, 3u, 40u, 500u}) {
            std::vector<Place> places(count);
            std::ranges::generate(places, some);
            const NearestPlace nearest(places);
            for (int i = 0; i < 200; ++i) {
                const Place from = some();
                double least = 3.5;
                for (const Place& place : places) {
                    least = std::min(least, distance(place, from));
                }
                CHECK(nearest.distance(from, 3.5) == least);
            }
        }
    }
}

} // namespace geodisk::test
