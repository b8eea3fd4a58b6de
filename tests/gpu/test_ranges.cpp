// A surface that no part holds whole: what each part gets of it.
#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <memory>
#include <random>
#include <vector>

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
        return {positions[3 * vertex], positions[3 * vertex + 1], 0};
    }
    /// Returns what one of some processes reads.
    MeshRange range(std::uint32_t process, std::uint32_t processes) const {
        MeshRange range;
        range.faces = {face_count(), processes};
        range.vertices = {positions.size() / 3, processes};
        const auto copy = [process](const Blocks& blocks, const auto& from, auto& to) {
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
