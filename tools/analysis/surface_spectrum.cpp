#include "analysis/surface_spectrum.hpp"

#include <cmath>
#include <numbers>
#include <numeric>

namespace geodisk::tools::analysis {
namespace {

/// Of all functions of a band at the samples of a set.
Eigen::VectorXd sums_of(const HarmonicBand& band, const Laplacian& laplacian,
                        const PlacedSamples& samples) {
    Eigen::VectorXd at_nodes = Eigen::VectorXd::Zero(laplacian.mass.rows());
    for (const auto& [face, weight1, weight2] : samples) {
        const std::uint32_t* const nodes = &laplacian.nodes[std::size_t{3} * face];
        at_nodes[nodes[0]] += 1 - weight1 - weight2;
        at_nodes[nodes[1]] += weight1;
        at_nodes[nodes[2]] += weight2;
    }
    return band.functions.transpose() * at_nodes;
}

} // namespace

std::vector<SpectrumRing> SurfaceSpectrum::rings(std::span<const std::size_t> sets) const {
    if (frequencies.empty()) {
        return {};
    }
    RingSums sums(1 / std::sqrt(area), frequencies.back());
    for (std::size_t i = 0; i < frequencies.size(); ++i) {
        double power = 0;
        for (const std::size_t set : sets) {
            power += powers[set][i];
        }
        sums.add(frequencies[i], power / static_cast<double>(sets.size()));
    }
    return sums.rings();
}

std::vector<SpectrumRing> SurfaceSpectrum::rings() const {
    std::vector<std::size_t> sets(powers.size());
    std::iota(sets.begin(), sets.end(), std::size_t{0});
    return rings(sets);
}

SurfaceSpectrum compute_spectrum(const Laplacian& laplacian, const ManifoldHarmonics& harmonics,
                                 std::size_t count, std::span<const PlacedSamples> sets,
                                 const PartDone& tell) {
    SurfaceSpectrum spectrum{laplacian.area, std::vector<double>(count),
                             std::vector(sets.size(), std::vector<double>(count))};
    harmonics.compute(
        count,
        [&](const HarmonicBand& band) {
            const auto size = static_cast<std::size_t>(band.eigenvalues.size());
            for (std::size_t i = 0; i < size; ++i) {
                spectrum.frequencies[band.first + i] =
                    std::sqrt(band.eigenvalues[static_cast<Eigen::Index>(i)]) /
                    (2 * std::numbers::pi);
            }
            for (std::size_t set = 0; set < sets.size(); ++set) {
                const Eigen::VectorXd sums = sums_of(band, laplacian, sets[set]);
                const double scale = laplacian.area / static_cast<double>(sets[set].size());
                for (std::size_t i = 0; i < size; ++i) {
                    const double sum = sums[static_cast<Eigen::Index>(i)];
                    spectrum.powers[set][band.first + i] = scale * sum * sum;
                }
            }
        },
        tell);
    return spectrum;
}

} // namespace geodisk::tools::analysis
