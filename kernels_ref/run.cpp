#include "run.hpp"

namespace geodisk::ref {
namespace {

template <bool kMayVary, class Real>
RunResult throw_from(const Surface<Real>& surface, const Bins<Real>& bins,
                     const Tolerances& tolerances, std::uint32_t most) {
    RunResult result;
    const auto count = static_cast<std::uint32_t>(bins.order.size());
    std::vector<std::uint32_t> places(count);
    for (std::uint32_t place = 0; place < count; ++place) {
        places[bins.order[place]] = place;
    }
    // By its address: the callbacks would load a vector's own after every store.
    std::vector<std::uint8_t> flags(count, 0);
    std::uint8_t* const decided = flags.data();
    Detector<Real, kMayVary> detector(surface, bins, tolerances, tolerances.limit);
    for (std::uint32_t rank = 0; rank < count && result.ranks.size() < most; ++rank) {
        const std::uint32_t place = places[rank];
        if (decided[place]) {
            continue;
        }
        decided[place] = 1;
        result.ranks.push_back(rank);
        const DiskCount disk = detector.run(
            bins.points[place], [decided](std::uint32_t q) { return !decided[q]; },
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
RunResult throw_darts(const Surface<Real>& surface, const Bins<Real>& bins,
                      const Tolerances& tolerances, std::uint32_t most) {
    return surface.is_adaptive() ? throw_from<true>(surface, bins, tolerances, most)
                                 : throw_from<false>(surface, bins, tolerances, most);
}

template RunResult throw_darts(const Surface<float>&, const Bins<float>&, const Tolerances&,
                               std::uint32_t);
template RunResult throw_darts(const Surface<double>&, const Bins<double>&, const Tolerances&,
                               std::uint32_t);

} // namespace geodisk::ref
