#include <geodisk/levels.hpp>

#include <array>
#include <cmath>
#include <string>

#include <geodisk/detail/philox.hpp>

#include "engine/request/check_fields.hpp"
#include "support/invalid.hpp"
#include "support/number_text.hpp"
#include "support/try.hpp"

namespace geodisk {
namespace {

/// First word of the counter by which seeds of levels are drawn.
constexpr std::uint32_t kLevelCounter = 0x4c455645; // "LEVE".

std::uint64_t seed_of_level(std::uint64_t seed, std::uint32_t level) {
    if (level == 0) {
        return seed;
    }
    const std::array<std::uint32_t, 4> words = philox(seed, {kLevelCounter, level, 0, 0});
    return std::uint64_t{words[1]} << 32 | words[0];
}

} // namespace

// Multiplies, since the distance decides the samples and pow() differs between machines.
double Levels::scale(std::uint32_t level) const noexcept {
    double scale = 1;
    for (std::uint32_t below = level + 1; below < count; ++below) {
        scale *= factor;
    }
    return scale;
}

Levels levels_for(const PreparedMesh& mesh, const SampleParams& last, double factor) noexcept {
    Levels levels{1, factor};
    double samples = expected_count(effective_area(mesh, last), last.min_distance);
    while (levels.count < kMaxLevels && samples >= kFirstLevelSamples * factor * factor) {
        samples /= factor * factor;
        ++levels.count;
    }
    return levels;
}

Result<SampleParams> params_of_level(const SampleParams& last, const Levels& levels,
                                     std::uint32_t level, std::span<const Sample> before) noexcept {
    if (levels.count < 1 || levels.count > kMaxLevels) {
        return invalid("there are " + std::to_string(levels.count) + " levels, not 1 to " +
                       std::to_string(kMaxLevels));
    }
    if (!(levels.factor >= kMinLevelFactor) || !(levels.factor <= kMaxLevelFactor)) {
        return invalid("the factor between levels is " + number_text(levels.factor) + ", not " +
                       number_text(kMinLevelFactor) + " to " + number_text(kMaxLevelFactor));
    }
    if (level >= levels.count) {
        return invalid("there is no level " + std::to_string(level) + " of " +
                       std::to_string(levels.count));
    }
    GEODISK_TRY(check_fields(last, RequestField::progressive));
    SampleParams params = last;
    params.min_distance = last.min_distance * levels.scale(level);
    params.seed = seed_of_level(last.seed, level);
    if (level > 0) {
        params.existing = before;
    }
    return params;
}

} // namespace geodisk
