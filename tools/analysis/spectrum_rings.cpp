#include "analysis/spectrum_rings.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace geodisk::tools::analysis {

double mean_anisotropy(std::span<const SpectrumRing> rings) {
    double sum = 0, count = 0;
    for (const SpectrumRing& ring : rings) {
        sum += ring.anisotropy * ring.count;
        count += ring.count;
    }
    return sum / count;
}

double decibels(double ratio) {
    constexpr double kMin = 1e-12;
    return 10 * std::log10(std::max(ratio, kMin));
}

RingSums::RingSums(double width, double highest)
    : width_(width), highest_(highest), sums_(static_cast<std::size_t>(highest / width) + 1) {}

void RingSums::add(double frequency, double power) {
    const auto ring = static_cast<std::size_t>(frequency / width_);
    if (frequency <= highest_ && ring < sums_.size()) {
        sums_[ring].count += 1;
        sums_[ring].powers += power;
        sums_[ring].squares += power * power;
    }
}

std::vector<SpectrumRing> RingSums::rings() const {
    std::vector<SpectrumRing> rings;
    for (std::size_t i = 0; i < sums_.size(); ++i) {
        const auto& [count, powers, squares] = sums_[i];
        if (count < 2) {
            continue;
        }
        const double mean = powers / count;
        const double variance = std::max(0.0, squares - powers * mean) / (count - 1);
        rings.push_back({(static_cast<double>(i) + 0.5) * width_, static_cast<std::uint32_t>(count),
                         mean, mean > 0 ? variance / (mean * mean) : 0});
    }
    return rings;
}

} // namespace geodisk::tools::analysis
