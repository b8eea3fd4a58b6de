#include "analysis/surface_spectrum.hpp"

#include <cmath>
#include <numbers>
#include <numeric>

namespace geodisk::tools::analysis {
namespace {

/// Returns the sum of a function over the samples, by its values at the nodes.
double sum_of(const double* at_nodes, const Laplacian& laplacian, const PlacedSamples& samples) {
    double sum = 0;
    for (const auto& [face, weight1, weight2] : samples) {
        const std::uint32_t* const nodes = &laplacian.nodes[std::size_t{3} * face];
        sum += (1 - weight1 - weight2) * at_nodes[nodes[0]] + weight1 * at_nodes[nodes[1]] +
               weight2 * at_nodes[nodes[2]];
    }
    return sum;
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
            for (Eigen::Index i = 0; i < band.eigenvalues.size(); ++i) {
                const std::size_t harmonic = band.first + static_cast<std::size_t>(i);
                spectrum.frequencies[harmonic] =
                    std::sqrt(band.eigenvalues[i]) / (2 * std::numbers::pi);
                for (std::size_t set = 0; set < sets.size(); ++set) {
                    const double sum = sum_of(band.functions.col(i).data(), laplacian, sets[set]);
                    spectrum.powers[set][harmonic] =
                        sum * sum * laplacian.area / static_cast<double>(sets[set].size());
                }
            }
        },
        tell);
    return spectrum;
}

} // namespace geodisk::tools::analysis
