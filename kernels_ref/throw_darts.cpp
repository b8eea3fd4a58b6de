#include "throw_darts.hpp"

#include <algorithm>

namespace geodisk::ref {
namespace {

template <bool kMayVary, class Real>
RunResult throw_from(const Surface<Real>& surface, const Pool<Real>& pool,
                     const Tolerances& tolerances, std::uint32_t most,
                     std::span<const FacePoint<Real>> given) {
    RunResult result;
    const std::uint32_t count = pool.size();
    // Use a pointer: the callbacks would reload the vector's address after every store.
    std::vector<std::uint8_t> flags(count, 0);
    std::uint8_t* const decided = flags.data();
    Detector<Real, kMayVary> detector(surface, pool.bins, tolerances, tolerances.limit);
    const auto reject = [&](const FacePoint<Real>& source) {
        const DiskCount disk = detector.run(
            source, [decided](std::uint32_t q) { return !decided[q]; },
            [decided](std::uint32_t q, Real) { decided[q] = 1; });
        result.windows += disk.windows;
        result.tested += disk.tested;
        result.most_waiting = std::max(result.most_waiting, disk.most_waiting);
        result.longest_chain = std::max(result.longest_chain, disk.chain);
    };
    std::ranges::for_each(given, reject);
    for (std::uint32_t rank = 0; rank < count && given.size() + result.ranks.size() < most;
         ++rank) {
        const std::uint32_t place = pool.places[rank];
        if (decided[place]) {
            continue;
        }
        decided[place] = 1;
        result.ranks.push_back(rank);
        reject(pool.bins.points[place]);
    }
    return result;
}

} // namespace

template <class Real>
RunResult throw_darts(const Surface<Real>& surface, const Pool<Real>& pool,
                      const Tolerances& tolerances, std::uint32_t most,
                      std::span<const FacePoint<Real>> given) {
    return surface.is_adaptive() ? throw_from<true>(surface, pool, tolerances, most, given)
                                 : throw_from<false>(surface, pool, tolerances, most, given);
}

template RunResult throw_darts(const Surface<float>&, const Pool<float>&, const Tolerances&,
                               std::uint32_t, std::span<const FacePoint<float>>);
template RunResult throw_darts(const Surface<double>&, const Pool<double>&, const Tolerances&,
                               std::uint32_t, std::span<const FacePoint<double>>);

} // namespace geodisk::ref
