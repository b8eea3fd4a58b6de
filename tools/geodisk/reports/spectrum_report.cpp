#include "geodisk/reports/spectrum_report.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>

#include "geodisk/reports/json.hpp"
#include "program/exact_text.hpp"
#include "program/human_text.hpp"
#include "program/table.hpp"

namespace geodisk::tools {
namespace {

using analysis::decibels;
using analysis::SpectrumRing;

/// Up to this part of a wave per minimum distance, blue noise has hardly any power.
constexpr double kLow = 0.5;
/// Findings that people look for first.
struct Findings {
    double peak = 0, peak_at = 0; ///< Peak of the radial mean, at a frequency in minimum distances.
    double low = 0;               ///< The mean power at low frequencies.
    double anisotropy = 0;        ///< Mean over rings, in decibels.

    explicit Findings(const SpectrumReport& report) {
        double low_count = 0;
        for (const SpectrumRing& ring : report.rings) {
            const double frequency = ring.frequency * report.min_distance;
            if (ring.mean > peak) {
                peak = ring.mean;
                peak_at = frequency;
            }
            if (frequency < kLow) {
                low += ring.mean * ring.count;
                low_count += ring.count;
            }
            anisotropy += decibels(ring.anisotropy) / static_cast<double>(report.rings.size());
        }
        low /= std::max(1.0, low_count);
    }
};

} // namespace

std::string SpectrumReport::text() const {
    const Findings found(*this);
    std::ostringstream out;
    out << "samples       " << rounded(samples, 6)
        << (sets() > 1 ? " on average in " + grouped(sets()) + " sets" : "") << '\n'
        << "power         " << rounded(found.low, 3) << " below " << rounded(kLow, 2)
        << " waves per minimum distance, peak " << rounded(found.peak, 3) << " at "
        << rounded(found.peak_at, 3) << "; 1 is white noise\n"
        << "anisotropy    " << fixed(found.anisotropy, 2) << " dB on average over "
        << counted(rings.size(), "ring", "rings") << "; " << fixed(decibels(expected_anisotropy), 2)
        << " dB without a preferred direction\n";
    return out.str();
}

void SpectrumReport::add_to(Json& report) const {
    const Findings found(*this);
    Json frequency = Json::array(), count = Json::array(), power = Json::array(),
         anisotropy = Json::array();
    for (const SpectrumRing& ring : rings) {
        frequency.push_back(ring.frequency * min_distance);
        count.push_back(ring.count);
        power.push_back(ring.mean);
        anisotropy.push_back(decibels(ring.anisotropy));
    }
    report.update({{"samples_files", samples_files},
                   {"min_distance", min_distance},
                   {"samples", samples},
                   {"sets", sets()},
                   {"low_power", found.low},
                   {"peak", {{"power", found.peak}, {"frequency", found.peak_at}}},
                   {"mean_anisotropy_db", found.anisotropy},
                   {"expected_anisotropy_db", decibels(expected_anisotropy)},
                   {"rings",
                    {{"frequency", frequency},
                     {"count", count},
                     {"power", power},
                     {"anisotropy_db", anisotropy}}}});
}

std::string SpectrumReport::csv() const {
    Table table({"frequency", "frequencies", "power", "anisotropy_db"});
    for (const SpectrumRing& ring : rings) {
        table.add({exact_text(ring.frequency * min_distance), std::to_string(ring.count),
                   exact_text(ring.mean), exact_text(decibels(ring.anisotropy))});
    }
    return table.csv();
}

} // namespace geodisk::tools
