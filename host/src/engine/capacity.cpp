#include "engine/capacity.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <thread>

#include "constants.h"
#include "samples.h"

namespace geodisk {
namespace {

// Room for random fluctuations: number of standard deviations above the expected candidates of a
// stage.
constexpr double kDeviations = 8;
// Additional room, since the tail of a Poisson law is longer than that of a normal one: in all, and
// for each surface of those that are alike. By Bernstein's inequality e^-32 bounds the probability
// of more.
constexpr double kTail = 64;
constexpr double kTailOfAlike = 11;
// Candidates per range of orders when samples are sorted.
constexpr std::uint32_t kCandidatesPerBucket = 16;
constexpr std::uint32_t kMinBuckets = 256;
constexpr std::uint32_t kMaxBuckets = 1u << 22;

} // namespace

std::uint32_t capacity_for(const Stages& stages, std::uint32_t at_once) noexcept {
    const double expected = stages.expected_at_once(at_once);
    const double deviation = std::sqrt(stages.variance_at_once(at_once));
    const double tail = std::max(kTail, kTailOfAlike * stages.max_alike);
    const double most = std::ceil(expected + kDeviations * deviation + tail);
    return static_cast<std::uint32_t>(std::min<double>(most, kMaxCandidates));
}

std::uint32_t stages_at_once(const Stages& stages, std::uint64_t max_candidates) noexcept {
    std::uint32_t at_once = stages.max_at_once();
    while (at_once > 1 && capacity_for(stages, at_once) > max_candidates) {
        --at_once;
    }
    return at_once;
}

std::uint64_t state_words(std::uint32_t candidates) noexcept {
    return ((std::uint64_t{candidates} + 31) / 32 + 1) * 2;
}

std::uint32_t bucket_count(std::uint32_t capacity) noexcept {
    return std::clamp(std::bit_ceil(capacity / kCandidatesPerBucket), kMinBuckets, kMaxBuckets);
}

std::array<VkDeviceSize, 3> sample_bytes(std::uint32_t capacity, std::uint32_t buckets) noexcept {
    const VkDeviceSize records = VkDeviceSize{capacity} * sizeof(gpu::SampleRec);
    return {records, records, (VkDeviceSize{buckets} + 2 + capacity) * 4};
}

std::uint32_t cpu_threads() noexcept {
    return std::max(1u, std::thread::hardware_concurrency());
}

std::uint32_t cpu_lanes(const DeviceReport& report) {
    return cpu_threads() * std::max(1u, report.limits.subgroup_size);
}

double samples_to_expect(double full, std::uint32_t darts, std::uint32_t stop_count) noexcept {
    for (const std::uint32_t bound : {darts, stop_count}) {
        full = bound != 0 ? std::min<double>(full, bound) : full;
    }
    return full;
}

std::uint32_t pow2_at_least(double x) {
    return std::bit_ceil(static_cast<std::uint32_t>(std::clamp(x, 1.0, double{1u << 25})));
}

} // namespace geodisk
