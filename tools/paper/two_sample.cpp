#include "paper/two_sample.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "baselines/random.hpp"

namespace geodisk::paper {
namespace {

using tools::analysis::decibels;
using tools::analysis::SpectrumRing;
using tools::analysis::SurfaceSpectrum;

constexpr double kLevel = 0.05, kPower = 0.9;
/// Halvings of what might be detectable.
constexpr int kSteps = 40;

/// Differences between a group and another one, ring by ring.
struct RingDifferences {
    std::vector<double> radial_mean, anisotropy;
};

RingDifferences differences(const SurfaceSpectrum& spectrum, std::span<const std::size_t> group,
                            std::span<const std::size_t> other) {
    const std::vector<SpectrumRing> a = spectrum.rings(group), b = spectrum.rings(other);
    RingDifferences result;
    for (std::size_t ring = 0; ring < a.size(); ++ring) {
        result.radial_mean.push_back(std::log(a[ring].mean / b[ring].mean));
        result.anisotropy.push_back(decibels(a[ring].anisotropy) - decibels(b[ring].anisotropy));
    }
    return result;
}

double size_of(std::span<const double> by_ring, std::span<const double> weights) {
    double sum = 0, total = 0;
    for (std::size_t ring = 0; ring < by_ring.size(); ++ring) {
        sum += weights[ring] * by_ring[ring] * by_ring[ring];
        total += weights[ring];
    }
    return std::sqrt(sum / total);
}

/// Chance variation of a quantity, deal by deal.
class Chance {
  public:
    explicit Chance(std::span<const double> weights) : weights_(weights) {}

    void add(std::vector<double> by_ring) {
        sizes_.push_back(size_of(by_ring, weights_));
        deals_.push_back(std::move(by_ring));
    }

    Difference judge(std::span<const double> by_ring, ref::RandomStream& random) const {
        const double size = size_of(by_ring, weights_);
        const auto as_large =
            std::count_if(sizes_.begin(), sizes_.end(), [&](double one) { return one >= size; });
        // The groups as they are count as a deal.
        const double p = static_cast<double>(as_large + 1) / static_cast<double>(sizes_.size() + 1);
        return {size, p, detectable(random)};
    }

  private:
    /// Returns what has to be added to each ring, with random signs.
    double detectable(ref::RandomStream& random) const {
        std::vector<double> sorted = sizes_;
        std::sort(sorted.begin(), sorted.end());
        const double critical =
            sorted[static_cast<std::size_t>((1 - kLevel) * static_cast<double>(sorted.size()))];
        std::vector<std::vector<double>> signs(deals_.size());
        for (std::size_t deal = 0; deal < deals_.size(); ++deal) {
            for (std::size_t ring = 0; ring < weights_.size(); ++ring) {
                signs[deal].push_back(random.below(2) == 0 ? -1 : 1);
            }
        }
        double low = 0, high = 4 * sorted.back();
        std::vector<double> changed(weights_.size());
        for (int step = 0; step < kSteps; ++step) {
            const double middle = (low + high) / 2;
            std::size_t found = 0;
            for (std::size_t deal = 0; deal < deals_.size(); ++deal) {
                for (std::size_t ring = 0; ring < weights_.size(); ++ring) {
                    changed[ring] = deals_[deal][ring] + middle * signs[deal][ring];
                }
                found += size_of(changed, weights_) > critical ? 1u : 0u;
            }
            (static_cast<double>(found) < kPower * static_cast<double>(deals_.size()) ? low
                                                                                      : high) =
                middle;
        }
        return high;
    }

    std::span<const double> weights_;
    std::vector<double> sizes_;
    std::vector<std::vector<double>> deals_;
};

} // namespace

SpectrumDifference compare_groups(const SurfaceSpectrum& spectrum,
                                  std::span<const std::size_t> group,
                                  std::span<const std::size_t> other, std::uint32_t deals,
                                  std::uint64_t seed) {
    std::vector<double> weights;
    for (const SpectrumRing& ring : spectrum.rings(group)) {
        weights.push_back(ring.count);
    }
    const RingDifferences found = differences(spectrum, group, other);
    std::vector<std::size_t> all(group.begin(), group.end());
    all.insert(all.end(), other.begin(), other.end());
    Chance radial_mean(weights), anisotropy(weights);
    ref::RandomStream random(seed);
    for (std::uint32_t deal = 0; deal < deals; ++deal) {
        for (auto rest = static_cast<std::uint32_t>(all.size()); rest > 1; --rest) {
            std::swap(all[rest - 1], all[random.below(rest)]);
        }
        const std::span<const std::size_t> dealt(all);
        RingDifferences chance =
            differences(spectrum, dealt.first(group.size()), dealt.subspan(group.size()));
        radial_mean.add(std::move(chance.radial_mean));
        anisotropy.add(std::move(chance.anisotropy));
    }
    return {radial_mean.judge(found.radial_mean, random),
            anisotropy.judge(found.anisotropy, random)};
}

} // namespace geodisk::paper
