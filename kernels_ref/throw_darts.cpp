#include "throw_darts.hpp"

#include <algorithm>

namespace geodisk::ref {
namespace {

/// Rejects candidates around points to avoid. Large disks are computed in a larger unit.
template <class Real>
void keep_out(const Surface<Real>& surface, const Pool<Real>& pool, const Tolerances& tolerances,
              std::span<const AvoidedPoint<Real>> avoided, std::uint8_t* decided,
              RunResult& result) {
    for (const AvoidedPoint<Real>& point : avoided) {
        const Real scale = scale_of(point.radius);
        const Surface<Real> large = scaled(surface, scale);
        const Bins<Real> bins(large, pool.bins.points);
        const Real limit = point.radius * scale + (tolerances.limit - Real{1});
        Detector<Real, false> detector(large, bins, tolerances, limit);
        const DiskCount disk = detector.run(
            point.center, [&](std::uint32_t q) { return !decided[bins.order[q]]; },
            [&](std::uint32_t q, Real) {
                const std::uint32_t place = bins.order[q];
                if (point.only_class == kAllClasses || pool.class_at(place) == point.only_class) {
                    decided[place] = 1;
                }
            });
        result.longest_chain = std::max(result.longest_chain, disk.chain);
    }
}

template <bool kMayVary, class Real>
RunResult throw_from(const Surface<Real>& surface, const Pool<Real>& pool,
                     const Tolerances& tolerances, std::uint32_t most,
                     std::span<const FacePoint<Real>> given,
                     std::span<const std::uint8_t> existing_classes,
                     std::span<const AvoidedPoint<Real>> avoided) {
    RunResult result;
    const std::uint32_t count = pool.size();
    // Use a pointer: the callbacks would reload the vector's address after every store.
    std::vector<std::uint8_t> flags = pool.dropped;
    flags.resize(count, 0);
    std::uint8_t* const decided = flags.data();
    keep_out(surface, pool, tolerances, avoided, decided, result);
    Detector<Real, kMayVary> detector(surface, pool.bins, tolerances, tolerances.limit);
    const auto reject = [&](const FacePoint<Real>& source, std::uint32_t own_class) {
        if (kMayVary && surface.has_classes()) {
            detector.set_class(own_class, pool.words);
        }
        const DiskCount disk = detector.run(
            source, [decided](std::uint32_t q) { return !decided[q]; },
            [decided](std::uint32_t q, Real) { decided[q] = 1; });
        result.windows += disk.windows;
        result.tested += disk.tested;
        result.max_waiting = std::max(result.max_waiting, disk.max_waiting);
        result.longest_chain = std::max(result.longest_chain, disk.chain);
    };
    for (std::size_t i = 0; i < given.size(); ++i) {
        reject(given[i], existing_classes.empty() ? 0 : existing_classes[i]);
    }
    for (std::uint32_t rank = 0; rank < count && given.size() + result.ranks.size() < most;
         ++rank) {
        const std::uint32_t place = pool.places[rank];
        if (decided[place]) {
            continue;
        }
        decided[place] = 1;
        result.ranks.push_back(rank);
        reject(pool.bins.points[place], surface.has_classes() ? pool.class_at(place) : 0);
    }
    return result;
}

} // namespace

template <class Real>
RunResult throw_darts(const Surface<Real>& surface, const Pool<Real>& pool,
                      const Tolerances& tolerances, std::uint32_t most,
                      std::span<const FacePoint<Real>> given,
                      std::span<const AvoidedPoint<Real>> avoided,
                      std::span<const std::uint8_t> existing_classes) {
    return surface.is_adaptive() || surface.has_classes()
               ? throw_from<true>(surface, pool, tolerances, most, given, existing_classes, avoided)
               : throw_from<false>(surface, pool, tolerances, most, given, existing_classes,
                                   avoided);
}

template RunResult throw_darts(const Surface<float>&, const Pool<float>&, const Tolerances&,
                               std::uint32_t, std::span<const FacePoint<float>>,
                               std::span<const AvoidedPoint<float>>, std::span<const std::uint8_t>);
template RunResult throw_darts(const Surface<double>&, const Pool<double>&, const Tolerances&,
                               std::uint32_t, std::span<const FacePoint<double>>,
                               std::span<const AvoidedPoint<double>>,
                               std::span<const std::uint8_t>);

} // namespace geodisk::ref
