// Radii as bytes: a header, then the arrays of a field. Derived values that a run could stumble
// over are checked, because the bytes may come from any source.
#include <algorithm>
#include <cmath>
#include <cstring>
#include <string>
#include <utility>

#include "geodisk/radius_field.hpp"
#include "mesh/density_values.hpp"
#include "mesh/inverse_square.hpp"
#include "support/guard.hpp"
#include "support/invalid.hpp"

namespace geodisk {
namespace {

constexpr char kRadiiMagic[8] = {'g', 'e', 'o', 'd', 'i', 's', 'k', 'R'};
constexpr std::uint32_t kRadiiVersion = 1;
constexpr std::uint32_t kRadiiByteOrder = 0x01020304;

struct RadiiHeader {
    char magic[8];
    std::uint32_t version;
    std::uint32_t byte_order;
    std::uint64_t faces;
    std::uint32_t has_packing;
    float largest_density;
    double effective_area;
    double min_density;
};
static_assert(sizeof(RadiiHeader) == 48);

bool are_within(std::span<const float> values, float least, float most) {
    return std::ranges::all_of(values, [&](float x) { return x >= least && x <= most; });
}

/// Returns true if a derived value is as it should be, up to rounding.
bool agrees(double value, double wanted) {
    constexpr double kRounding = 1e-4;
    return std::abs(value - wanted) <= kRounding * wanted;
}

/// Returns true if the values of a field that follow from others do.
bool is_consistent(const RadiusField& field) {
    const auto factors = field.factors(), spreads = field.spreads(), packing = field.packing();
    for (std::size_t i = 0; i < factors.size(); ++i) {
        const double g = double{factors[i]}, spread = double{spreads[i]};
        const bool is_right =
            packing.empty() ? agrees(spread * spread * spread, g * g)
                            : agrees(g * g * double{packing[i]}, 1) && spreads[i] <= packing[i];
        if (!is_right) {
            return false;
        }
    }
    for (std::size_t face = 0; face < field.densities().size(); ++face) {
        const float* const g = &factors[3 * face];
        const double candidates = packing.empty()
                                      ? mean_inverse_square(g[0], g[1], g[2])
                                      : mean_candidates(&spreads[3 * face], &packing[3 * face]);
        const float density = field.densities()[face];
        if (!agrees(double{density}, candidates) || density > field.largest_density()) {
            return false;
        }
    }
    return true;
}

} // namespace

Result<std::vector<std::byte>> RadiusField::save() const noexcept {
    return guarded([&]() -> Result<std::vector<std::byte>> {
        RadiiHeader header{{},
                           kRadiiVersion,
                           kRadiiByteOrder,
                           face_count(),
                           packing_.empty() ? 0u : 1u,
                           largest_density_,
                           effective_area_,
                           min_density_};
        std::memcpy(header.magic, kRadiiMagic, sizeof kRadiiMagic);
        std::vector<std::byte> bytes(sizeof header);
        std::memcpy(bytes.data(), &header, sizeof header);
        for (const std::vector<float>* values : {&factors_, &spreads_, &packing_, &densities_}) {
            const auto more = std::as_bytes(std::span(*values));
            bytes.insert(bytes.end(), more.begin(), more.end());
        }
        return bytes;
    });
}

Result<RadiusField> RadiusField::load(std::span<const std::byte> bytes) noexcept {
    return guarded([&]() -> Result<RadiusField> {
        RadiiHeader header;
        if (bytes.size() < sizeof header ||
            std::memcmp(bytes.data(), kRadiiMagic, sizeof kRadiiMagic) != 0) {
            return invalid("these bytes are no saved radii");
        }
        std::memcpy(&header, bytes.data(), sizeof header);
        if (header.byte_order != kRadiiByteOrder || header.version != kRadiiVersion) {
            return invalid("the radii were saved by another version, or by a machine of another "
                           "byte order");
        }
        bytes = bytes.subspan(sizeof header);
        const std::uint64_t per_face = header.has_packing != 0 ? 10 : 7;
        if (header.has_packing > 1 || bytes.size() % (per_face * sizeof(float)) != 0 ||
            bytes.size() / (per_face * sizeof(float)) != header.faces) {
            return invalid("the saved radii are not complete");
        }
        RadiusField field;
        field.largest_density_ = header.largest_density;
        field.effective_area_ = header.effective_area;
        field.min_density_ = header.min_density;
        const auto take = [&](std::vector<float>& values, std::uint64_t count) {
            values.resize(count);
            if (count > 0) {
                std::memcpy(values.data(), bytes.data(), count * sizeof(float));
            }
            bytes = bytes.subspan(count * sizeof(float));
        };
        take(field.factors_, 3 * header.faces);
        take(field.spreads_, 3 * header.faces);
        take(field.packing_, std::uint64_t{3} * header.has_packing * header.faces);
        take(field.densities_, header.faces);
        const auto least = static_cast<float>(kMinFactor);
        const float most = 1 / (least * least);
        if (!are_within(field.factors_, least, 1) || !are_within(field.spreads_, 0, most) ||
            !are_within(field.packing_, 1, most) || !are_within(field.densities_, 0, most) ||
            !(field.largest_density_ >= 0 && field.largest_density_ <= most) ||
            !(field.effective_area_ >= 0 && std::isfinite(field.effective_area_)) ||
            !(field.min_density_ >= 0) || !is_consistent(field)) {
            return invalid("the saved radii are damaged");
        }
        field.find_min_factor();
        return field;
    });
}

} // namespace geodisk
