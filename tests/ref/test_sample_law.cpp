// Samples are as dense, and as evenly spread over unequal faces, as those of candidates that are
// independent and identically distributed. The figures to compare with were measured by sequential
// dart throwing over 20 such candidates per sample, drawn from an alias table of the faces.
#include <array>
#include <cmath>
#include <vector>

#include <doctest/doctest.h>

#include "kernels/pool.hpp"
#include "lib/frame.hpp"
#include "ref/dart_check.hpp"
#include "throw_darts.hpp"

using namespace geodisk;
using namespace geodisk::test;

namespace {

/// A mean over many runs, and its standard error.
struct Measured {
    double mean, error;
};

/// The faces of the samples.
std::vector<std::uint32_t> sampled_faces(const ref::Surface<float>& surface,
                                         const PreparedMesh& mesh, const SampleParams& params) {
    const auto pool = ref::draw_pool(surface, params);
    const ref::Tolerances tolerances = ref::frame_of(mesh, params).tolerances();
    std::vector<std::uint32_t> faces;
    for (const std::uint32_t rank : ref::throw_darts(surface, pool, tolerances).ranks) {
        faces.push_back(pool.candidate(rank).face);
    }
    return faces;
}

void check_rho(const TestMesh& shape, Measured expected) {
    constexpr std::uint64_t kSeeds = 20;
    constexpr double kMaxOff = 0.005; // Of the density.
    const PreparedMesh mesh = prepared(shape);
    SampleParams params = params_for(mesh, 2000);
    const ref::Surface<float> surface(mesh, params);
    double rho = 0;
    for (params.seed = 0; params.seed < kSeeds; ++params.seed) {
        const auto count = static_cast<double>(sampled_faces(surface, mesh, params).size());
        rho += packing_density(mesh.statistics().area, params.min_distance, count) / kSeeds;
    }
    CHECK(std::abs(rho / expected.mean - 1) < kMaxOff);
    // One run varies by 0.0022.
    CHECK(std::abs(rho - expected.mean) <
          5 * std::hypot(0.0022 / std::sqrt(kSeeds), expected.error));
}

} // namespace

TEST_CASE("sample law: packing density") {
    check_rho(builtin("torus-knot", 16), {0.72161, 0.00014});
    check_rho(builtin("icosphere", 4), {0.72122, 0.00015});
}

TEST_CASE("sample law: samples of each face") {
    // Columns and rows of unequal widths, two faces to each: 20,000 runs for 30 samples.
    const TestMesh shape = flat_lines({0, 0.1, 0.13, 0.6, 1}, {0, 0.5, 0.7, 1});
    constexpr std::array<Measured, 24> kExpected{{
        {1.03615, 0.00505}, {1.28265, 0.00517}, {0.19285, 0.00297}, {0.22155, 0.00312},
        {4.04045, 0.00645}, {3.47090, 0.00664}, {3.56495, 0.00626}, {3.46645, 0.00633},
        {0.34745, 0.00345}, {0.51290, 0.00372}, {0.07315, 0.00185}, {0.08080, 0.00193},
        {1.39810, 0.00525}, {1.38045, 0.00526}, {1.42085, 0.00488}, {1.19315, 0.00495},
        {0.53070, 0.00409}, {0.92505, 0.00428}, {0.14020, 0.00250}, {0.11935, 0.00233},
        {2.11210, 0.00582}, {2.61590, 0.00561}, {2.61950, 0.00522}, {1.80275, 0.00552},
    }};
    constexpr Measured kExpectedTotal{34.54835, 0.01197};
    constexpr std::uint32_t kSeeds = 1000;
    constexpr double kExpectedSeeds = 20000;
    // One in 60,000 of 25 right means is farther off.
    constexpr double kMaxErrors = 5;
    const PreparedMesh mesh = prepared(shape);
    SampleParams params = params_for(mesh, 30);
    const ref::Surface<float> surface(mesh, params);
    std::vector<double> sums(mesh.face_count(), 0);
    double total = 0;
    for (params.seed = 0; params.seed < kSeeds; ++params.seed) {
        for (const std::uint32_t face : sampled_faces(surface, mesh, params)) {
            sums[face] += 1;
            total += 1;
        }
    }
    const auto errors_off = [](double sum, Measured expected) {
        // The errors of both.
        const double error = expected.error * std::sqrt(1 + kExpectedSeeds / kSeeds);
        return std::abs(sum / kSeeds - expected.mean) / error;
    };
    for (std::uint32_t face = 0; face < mesh.face_count(); ++face) {
        CAPTURE(face);
        CHECK(errors_off(sums[face], kExpected[face]) < kMaxErrors);
    }
    CHECK(errors_off(total, kExpectedTotal) < kMaxErrors);
}
