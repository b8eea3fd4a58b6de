#include "engine/request/tries.hpp"

#include <algorithm>
#include <string>

#include "support/invalid.hpp"
#include "support/number_text.hpp"
#include "support/try.hpp"

namespace geodisk {
namespace {

/// Factor between two distances that give equally many samples, above which there is no room.
constexpr double kNoRoom = 16;
/// Factor likewise where no sample fits.
constexpr double kNoneFits = 4;

std::string samples_text(std::uint64_t count) {
    return std::to_string(count) + (count == 1 ? " sample" : " samples");
}

} // namespace

Tries::Tries(double distance, double count, bool is_exact)
    : wanted_(count), is_exact_(is_exact),
      search_(is_exact ? CountSearch::exact(static_cast<std::uint64_t>(count))
                       : CountSearch(count)),
      distance_(distance) {}

Result<bool> Tries::note(std::uint64_t samples) {
    ++tries_;
    const double distance = *distance_;
    if (wanted_ == 0) {
        distance_.reset();
        return true;
    }
    GEODISK_TRY(check_room(samples));
    max_ = std::max(max_, samples);
    distance_ = search_.note(distance, samples);
    if (!distance_ && is_exact_ && static_cast<double>(max_) < wanted_) {
        return invalid("count: no distance tried gave more than " + std::to_string(max_) + " of " +
                       samples_text(static_cast<std::uint64_t>(wanted_)) + ", down to " +
                       number_text(distance) + "; ask for fewer, or leave more room for samples");
    }
    return search_.is_nearest();
}

Result<Done> Tries::check_room(std::uint64_t samples) {
    const double distance = *distance_;
    if (samples != latest_) {
        latest_ = samples;
        largest_ = distance;
    }
    largest_ = std::max(largest_, distance);
    if (samples == 0 && distance * kNoneFits <= largest_) {
        return invalid("count: found no room for a sample, down to distance " +
                       number_text(distance) +
                       "; leave more room, such as by smaller radii of points to avoid");
    }
    if (static_cast<double>(samples) < wanted_ && distance * kNoRoom <= largest_) {
        return invalid("count: found room for " + samples_text(samples) +
                       " only, down to distance " + number_text(distance) +
                       "; leave more room, or give the minimum distance instead");
    }
    return Done{};
}

} // namespace geodisk
