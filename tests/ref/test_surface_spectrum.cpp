// Spectra of surfaces against dense algebra and the waves of a rectangle, and what chance must
// give.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <mutex>
#include <numbers>
#include <stdexcept>
#include <vector>

#include <Eigen/Eigenvalues>
#include <doctest/doctest.h>

#include "analysis/laplacian.hpp"
#include "analysis/manifold_harmonics.hpp"
#include "analysis/surface_spectrum.hpp"
#include "support/meshes.hpp"

using namespace geodisk;
using namespace geodisk::test;
using tools::analysis::compute_spectrum;
using tools::analysis::HarmonicBand;
using tools::analysis::Laplacian;
using tools::analysis::make_laplacian;
using tools::analysis::ManifoldHarmonics;
using tools::analysis::PlacedSamples;
using tools::analysis::SurfaceSpectrum;

namespace {

Laplacian laplacian_of(const TestMesh& mesh) {
    return make_laplacian(prepared(mesh), mesh.triangles);
}

/// All bands put together.
struct Harmonics {
    Eigen::VectorXd eigenvalues;
    Eigen::MatrixXd functions;
    std::size_t visited = 0;

    Harmonics(const Laplacian& laplacian, std::size_t count)
        : eigenvalues(static_cast<Eigen::Index>(count)),
          functions(laplacian.mass.rows(), eigenvalues.size()) {
        std::mutex mutex;
        ManifoldHarmonics(laplacian).compute(
            count,
            [&](const HarmonicBand& band) {
                const std::scoped_lock lock(mutex);
                const auto first = static_cast<Eigen::Index>(band.first);
                eigenvalues.segment(first, band.eigenvalues.size()) = band.eigenvalues;
                functions.middleCols(first, band.functions.cols()) = band.functions;
                visited += static_cast<std::size_t>(band.eigenvalues.size());
            },
            {});
    }
};

/// Solves for what dense algebra finds, without those of the lowest frequency.
Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> dense(const Laplacian& laplacian) {
    return Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd>(
        Eigen::MatrixXd(laplacian.stiffness), Eigen::MatrixXd(laplacian.mass));
}

/// `copies` of a mesh, which do not touch.
TestMesh several(const TestMesh& mesh, std::uint32_t copies) {
    TestMesh result;
    for (std::uint32_t copy = 0; copy < copies; ++copy) {
        const std::uint32_t first = result.vertex_count();
        result.positions.insert(result.positions.end(), mesh.positions.begin(),
                                mesh.positions.end());
        for (const std::uint32_t vertex : mesh.triangles) {
            result.triangles.push_back(first + vertex);
        }
    }
    return result;
}

} // namespace

TEST_CASE("harmonics are all of those that dense algebra finds") {
    for (const TestMesh& mesh :
         {flat_irregular(17, 4), builtin("cube", 6), several(builtin("cube", 3), 5)}) {
        const Laplacian laplacian = laplacian_of(mesh);
        const auto expected = dense(laplacian);
        const std::size_t count = ManifoldHarmonics(laplacian).count();
        CAPTURE(count);
        REQUIRE(count > 190);
        const auto constants =
            static_cast<Eigen::Index>(laplacian.size()) - static_cast<Eigen::Index>(count);
        CHECK(std::abs(expected.eigenvalues()[constants - 1]) < 1e-8);
        const Harmonics found(laplacian, count);
        CHECK(found.visited == count);
        for (Eigen::Index i = 0; i < found.eigenvalues.size(); ++i) {
            CHECK(found.eigenvalues[i] ==
                  doctest::Approx(expected.eigenvalues()[constants + i]).epsilon(1e-9));
        }
        const Eigen::MatrixXd products =
            found.functions.transpose() * laplacian.mass * found.functions;
        CHECK((products - Eigen::MatrixXd::Identity(products.rows(), products.cols()))
                  .cwiseAbs()
                  .maxCoeff() < 1e-8);
    }
}

TEST_CASE("harmonics of a rectangle are its waves") {
    const double width = 2, height = 1;
    const TestMesh mesh = flat_grid(80, 40, width, height);
    const Laplacian laplacian = laplacian_of(mesh);
    CHECK(laplacian.area == doctest::Approx(width * height));
    const Harmonics found(laplacian, 250);
    std::vector<double> expected;
    for (int i = 0; i < 60; ++i) {
        for (int k = i == 0 ? 1 : 0; k < 60; ++k) {
            expected.push_back(std::pow(std::numbers::pi, 2) *
                               (i * i / (width * width) + k * k / (height * height)));
        }
    }
    std::sort(expected.begin(), expected.end());
    const double cell = width / 80;
    for (std::size_t i = 0; i < 250; ++i) {
        // Finite elements are stiffer than what they stand for, by the square of cell to wave.
        const double error = found.eigenvalues[static_cast<Eigen::Index>(i)] / expected[i] - 1;
        CHECK(error > -1e-9);
        CHECK(error < 0.25 * expected[i] * cell * cell);
    }
}

TEST_CASE("powers are those of plain sums, with any number of bands") {
    const TestMesh mesh = flat_irregular(24, 9);
    const PreparedMesh surface = prepared(mesh);
    const Laplacian laplacian = make_laplacian(surface, mesh.triangles);
    const ManifoldHarmonics harmonics(laplacian);
    const std::vector<PlacedSamples> sets{random_points(surface, 1, 40),
                                          random_points(surface, 2, 70)};
    const SurfaceSpectrum spectrum = compute_spectrum(laplacian, harmonics, 333, sets, {});
    REQUIRE(spectrum.frequencies.size() == 333);
    CHECK(std::is_sorted(spectrum.frequencies.begin(), spectrum.frequencies.end()));
    const auto expected = dense(laplacian);
    for (std::size_t set = 0; set < sets.size(); ++set) {
        for (std::size_t i = 0; i < 333; ++i) {
            const auto function = expected.eigenvectors().col(static_cast<Eigen::Index>(i) + 1);
            double sum = 0;
            for (const Point& point : sets[set]) {
                const std::uint32_t* nodes = &laplacian.nodes[std::size_t{3} * point.face];
                sum += (1 - point.weight1 - point.weight2) * function[nodes[0]] +
                       point.weight1 * function[nodes[1]] + point.weight2 * function[nodes[2]];
            }
            CHECK(spectrum.powers[set][i] == doctest::Approx(sum * sum * laplacian.area /
                                                             static_cast<double>(sets[set].size()))
                                                 .epsilon(1e-5)
                                                 .scale(1e-3));
        }
    }
}

TEST_CASE("independent samples of a surface are white, and no direction is another") {
    const TestMesh mesh = builtin("showpiece", 60);
    const PreparedMesh surface = prepared(mesh);
    const Laplacian laplacian = make_laplacian(surface, mesh.triangles);
    const std::size_t count = 400, set_count = 20;
    std::vector<PlacedSamples> sets;
    for (std::size_t seed = 0; seed < set_count; ++seed) {
        sets.push_back(random_points(surface, seed, 300));
    }
    const SurfaceSpectrum spectrum =
        compute_spectrum(laplacian, ManifoldHarmonics(laplacian), count, sets, {});
    double powers = 0, anisotropy = 0, harmonics = 0;
    for (const auto& ring : spectrum.rings()) {
        powers += ring.mean * ring.count;
        anisotropy += ring.anisotropy * ring.count;
        harmonics += ring.count;
    }
    CHECK(harmonics >= 395);
    CHECK(powers / harmonics == doctest::Approx(1).epsilon(0.05));
    CHECK(anisotropy / harmonics == doctest::Approx(2.0 / set_count).epsilon(0.2));
    const std::vector<std::size_t> first{0};
    CHECK(spectrum.rings(first).size() == spectrum.rings().size());
}

TEST_CASE("flat and collapsed triangles are no obstacle") {
    TestMesh mesh = flat_grid(12, 12, 1, 1);
    const Harmonics expected(laplacian_of(mesh), 100);
    const std::uint32_t corner = mesh.add_vertex({2, 0, 0});
    mesh.add_triangle(corner, corner, 0);
    const std::uint32_t middle = mesh.add_vertex({1.0 / 24, 0, 0});
    mesh.add_triangle(0, middle, 1);
    const Laplacian laplacian = laplacian_of(mesh);
    CHECK(laplacian.size() == 13 * 13 + 1);
    CHECK(laplacian.nodes[laplacian.nodes.size() - 6] == Laplacian::kNoNode);
    const Harmonics found(laplacian, 100);
    for (Eigen::Index i = 0; i < 100; ++i) {
        CHECK(found.eigenvalues[i] == doctest::Approx(expected.eigenvalues[i]).epsilon(1e-4));
    }
}

TEST_CASE("harmonics are the same in any unit") {
    const TestMesh mesh = flat_irregular(12, 3);
    const Harmonics expected(laplacian_of(mesh), 100);
    for (const double unit : {1e-60, 1e-12, 1e12, 1e60}) {
        CAPTURE(unit);
        TestMesh scaled = mesh;
        for (double& coordinate : scaled.positions) {
            coordinate *= unit;
        }
        const Harmonics found(laplacian_of(scaled), 100);
        for (Eigen::Index i = 0; i < 100; ++i) {
            CHECK(found.eigenvalues[i] * unit * unit ==
                  doctest::Approx(expected.eigenvalues[i]).epsilon(1e-9));
            CHECK(found.functions.col(i).cwiseAbs().maxCoeff() * unit ==
                  doctest::Approx(expected.functions.col(i).cwiseAbs().maxCoeff()).epsilon(1e-6));
        }
    }
}

TEST_CASE("harmonics stop when they are told to") {
    const TestMesh mesh = builtin("showpiece", 60);
    const Laplacian laplacian = laplacian_of(mesh);
    const ManifoldHarmonics harmonics(laplacian);
    int calls = 0;
    CHECK_THROWS_AS(harmonics.compute(
                        600, [](const HarmonicBand&) {},
                        [&](double) {
                            if (++calls == 30) {
                                throw std::runtime_error("enough");
                            }
                        }),
                    std::runtime_error);
    CHECK(calls == 30);
    const auto [seconds, bytes] = harmonics.cost(600);
    CHECK(seconds > 0);
    CHECK(bytes > 0);
}
