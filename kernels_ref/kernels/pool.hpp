// Pool: the candidates of a job, drawn face by face into cells and listed in dart order.
#pragma once

#include <cstdint>
#include <vector>

#include "geodisk/params.hpp"
#include "kernels/bins.hpp"
#include "lib/surface.hpp"

namespace geodisk::ref {

/// A candidate's rank is its position in dart order: by stage, priority, face and weights; where
/// faces have keys by stage, priority and weights.
template <class Real>
struct Pool {
    Bins<Real> bins;
    std::vector<std::uint32_t> words; ///< Order words in the order of the bins, see order_word().
    /// By place, 1 for a candidate that is no dart; empty if all are darts.
    std::vector<std::uint8_t> dropped;
    std::vector<std::uint32_t> places; ///< Places in the bins, by rank.

    std::uint32_t size() const { return static_cast<std::uint32_t>(places.size()); }
    FacePoint<Real> candidate(std::uint32_t rank) const { return bins.points[places[rank]]; }
    std::uint32_t word(std::uint32_t rank) const { return words[places[rank]]; }
    /// Returns the class of a place, if candidates have classes.
    std::uint32_t class_at(std::uint32_t place) const { return words[place] % 8; }
    std::vector<FacePoint<Real>> by_rank() const;
    /// Returns the ranks in the order of the bins.
    std::vector<std::uint32_t> ranks() const;
};

/// Draws all candidates of `stages` stages of a job, from `first` on. `surface` is that of the mesh
/// and the parameters.
template <class Real>
Pool<Real> draw_stages(const Surface<Real>& surface, const SampleParams& params,
                       std::uint32_t first, std::uint32_t stages);

/// Draws all candidates of a job: the stages of a pool, or its first `params.darts`.
template <class Real>
Pool<Real> draw_pool(const Surface<Real>& surface, const SampleParams& params);

} // namespace geodisk::ref
