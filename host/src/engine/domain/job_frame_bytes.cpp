// Frames as bytes: a magic word, a version, the lengths and numbers, the rules as bits, the version
// of the sampling, zeros, and a checksum; all with the low byte first.
#include <algorithm>
#include <bit>
#include <concepts>
#include <cstdint>
#include <string>

#include "engine/domain/check_frame.hpp"
#include "geodisk/job_frame.hpp"
#include "geodisk/version.hpp"
#include "support/checksums.hpp"
#include "support/guard.hpp"
#include "support/invalid.hpp"
#include "support/try.hpp"

namespace geodisk {
namespace {

constexpr std::uint32_t kMagic = 0x464a4447; // "GDJF"
constexpr std::uint32_t kVersion = 2;

constexpr double JobFrame::*kNumbers[] = {&JobFrame::min_distance, &JobFrame::unit,
                                          &JobFrame::samples,      &JobFrame::pool_ratio,
                                          &JobFrame::longest_edge, &JobFrame::error_bound};
constexpr bool JobFrame::*kRules[] = {&JobFrame::radii_vary, &JobFrame::nearest_first,
                                      &JobFrame::splits_once, &JobFrame::straight_faces};
constexpr std::uint32_t kAllRules = (1u << std::size(kRules)) - 1;
constexpr std::size_t kSumAt = kJobFrameBytes - sizeof(std::uint32_t);
static_assert(4 * sizeof(std::uint32_t) + sizeof(double) * std::size(kNumbers) <= kSumAt);

template <std::unsigned_integral Word>
void put(std::span<std::byte> bytes, std::size_t& at, Word word) {
    for (std::size_t i = 0; i < sizeof word; ++i) {
        bytes[at++] = static_cast<std::byte>(word >> 8 * i & 0xffu);
    }
}

template <std::unsigned_integral Word>
Word get(std::span<const std::byte> bytes, std::size_t& at) {
    Word word = 0;
    for (std::size_t i = 0; i < sizeof word; ++i) {
        word |= static_cast<Word>(bytes[at++]) << 8 * i;
    }
    return word;
}

/// FNV-1a.
std::uint32_t checksum_of(std::span<const std::byte> bytes) {
    std::uint32_t sum = 0x811c9dc5u;
    for (const std::byte byte : bytes) {
        sum = (sum ^ std::to_integer<std::uint32_t>(byte)) * 0x01000193u;
    }
    return sum;
}

} // namespace

std::array<std::byte, kJobFrameBytes> to_bytes(const JobFrame& frame) noexcept {
    std::array<std::byte, kJobFrameBytes> bytes{};
    std::size_t at = 0;
    put(bytes, at, kMagic);
    put(bytes, at, kVersion);
    for (const auto number : kNumbers) {
        put(bytes, at, std::bit_cast<std::uint64_t>(frame.*number));
    }
    std::uint32_t rules = 0;
    for (std::size_t i = 0; i < std::size(kRules); ++i) {
        rules |= frame.*kRules[i] ? 1u << i : 0u;
    }
    put(bytes, at, rules);
    put(bytes, at, std::uint32_t{GEODISK_SAMPLING_VERSION});
    at = kSumAt;
    put(bytes, at, checksum_of(std::span(bytes).first(kSumAt)));
    return bytes;
}

Result<JobFrame> frame_from_bytes(std::span<const std::byte> bytes) noexcept {
    return guarded([&]() -> Result<JobFrame> {
        if (bytes.size() != kJobFrameBytes) {
            return invalid("a job frame has " + std::to_string(kJobFrameBytes) +
                           " bytes, there are " + std::to_string(bytes.size()));
        }
        std::size_t at = 0;
        if (get<std::uint32_t>(bytes, at) != kMagic) {
            return invalid("the bytes are not a job frame");
        }
        if (const auto version = get<std::uint32_t>(bytes, at); version != kVersion) {
            return invalid("the job frame has version " + std::to_string(version) +
                           ", and only version " + std::to_string(kVersion) +
                           " is read; make it again with frame_of()");
        }
        JobFrame frame;
        for (const auto number : kNumbers) {
            frame.*number = std::bit_cast<double>(get<std::uint64_t>(bytes, at));
        }
        const auto rules = get<std::uint32_t>(bytes, at);
        for (std::size_t i = 0; i < std::size(kRules); ++i) {
            frame.*kRules[i] = (rules >> i & 1u) != 0;
        }
        const auto sampling = get<std::uint32_t>(bytes, at);
        const bool has_rest = std::ranges::any_of(
            bytes.subspan(at, kSumAt - at), [](std::byte byte) { return byte != std::byte{0}; });
        at = kSumAt;
        const auto sum = get<std::uint32_t>(bytes, at);
        if ((kComparesChecksums && sum != checksum_of(bytes.first(kSumAt))) || rules > kAllRules ||
            has_rest) {
            return invalid("the job frame is damaged: its checksum is wrong");
        }
        if (sampling != GEODISK_SAMPLING_VERSION) {
            return invalid("the job frame is of sampling version " + std::to_string(sampling) +
                           ", and this is " + std::to_string(GEODISK_SAMPLING_VERSION) +
                           ", in which a seed gives other sets");
        }
        GEODISK_TRY(check_values(frame));
        return frame;
    });
}

} // namespace geodisk
