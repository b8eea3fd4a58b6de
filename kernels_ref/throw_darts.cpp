#include "throw_darts.hpp"

namespace geodisk::ref {
namespace {

template <bool kMayVary, class Real>
RunResult throw_from(const Surface<Real>& surface, const Pool<Real>& pool,
                     const Tolerances& tolerances, std::uint32_t most) {
    RunResult result;
    const std::uint32_t count = pool.size();
    // Use a pointer: the callbacks would reload the vector's address after every store.
    std::vector<std::uint8_t> flags(count, 0);
    std::uint8_t* const decided = flags.data();
    Detector<Real, kMayVary> detector(surface, pool.bins, tolerances, tolerances.limit);
    for (std::uint32_t rank = 0; rank < count && result.ranks.size() < most; ++rank) {
        const std::uint32_t place = pool.places[rank];
        if (decided[place]) {
            continue;
        }
        decided[place] = 1;
        result.ranks.push_back(rank);
        const DiskCount disk = detector.run(
            pool.bins.points[place], [decided](std::uint32_t q) { return !decided[q]; },
            [decided](std::uint32_t q, Real) { decided[q] = 1; });
        result.windows += disk.windows;
        result.tested += disk.tested;
        result.most_waiting = std::max(result.most_waiting, disk.most_waiting);
        result.longest_chain = std::max(result.longest_chain, disk.chain);
    }
    return result;
}

} // namespace

template <class Real>
RunResult throw_darts(const Surface<Real>& surface, const Pool<Real>& pool,
                      const Tolerances& tolerances, std::uint32_t most) {
    return surface.is_adaptive() ? throw_from<true>(surface, pool, tolerances, most)
                                 : throw_from<false>(surface, pool, tolerances, most);
}

template RunResult throw_darts(const Surface<float>&, const Pool<float>&, const Tolerances&,
                               std::uint32_t);
template RunResult throw_darts(const Surface<double>&, const Pool<double>&, const Tolerances&,
                               std::uint32_t);

} // namespace geodisk::ref
