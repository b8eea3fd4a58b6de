// Interface of a metric for methods that choose samples from a pool.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace geodisk::ref {

/// Finds the candidates of a pool in the disk of one of them. The radius of the disk is the minimum
/// distance of the samples.
class DiskQuery {
  public:
    virtual ~DiskQuery() = default;

    /// Returns the number of candidates in the pool.
    virtual std::uint32_t size() const = 0;

    /// Replaces `found` by the ranks in the disk around `center` whose `wanted` is not 0, each
    /// once, without `center`. `wanted` has one entry per candidate.
    virtual void find(std::uint32_t center, std::span<const std::uint8_t> wanted,
                      std::vector<std::uint32_t>& found) = 0;
};

} // namespace geodisk::ref
