#include "kernels/grid.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numeric>
#include <utility>

#include "lib/rng.hpp"

namespace geodisk::ref {

BoxPoint draw_in_box(std::uint64_t seed, std::uint32_t rank, std::size_t dimension) {
    BoxPoint point{};
    for (std::size_t i = 0; i < dimension; ++i) {
        point[i] = philox(seed, rank, static_cast<std::uint32_t>(i / 4))[i % 4];
    }
    return point;
}

template <class Real>
BoxCellTable<Real>::BoxCellTable(const BoxParams& box, std::uint32_t candidates, double guard)
    : is_periodic(box.is_periodic), limit2(static_cast<float>((1 + guard) * (1 + guard))) {
    constexpr std::uint32_t kHashStrides[] = {1u,          0x9E3779B1u, 0xB5297A4Du,
                                              0x68E31DA5u, 0x1B56C4E9u, 0x7FEB352Du};
    const double longest = *std::max_element(box.extents.begin(), box.extents.end());
    double diagonal2 = 0;
    for (const double side : box.extents) {
        diagonal2 += (side / longest) * (side / longest);
    }
    const double unit = std::min(box.min_distance, 1.01 * longest * std::sqrt(diagonal2));
    double all_cells = 1;
    for (const double extent : box.extents) {
        const double side = extent / unit;
        const double cells = std::max(1.0, std::floor(side * 2 / (1 + 4 * guard)));
        all_cells *= cells;
        axes.push_back({static_cast<std::uint32_t>(cells), 1,
                        side < 0x1p-20 ? Real{0} : static_cast<Real>(side * 0x1p-32),
                        static_cast<Real>(side / cells)});
    }
    heads = std::bit_ceil(static_cast<std::uint32_t>(std::min(all_cells, 2.0 * candidates)));
    for (std::size_t i = 1; i < axes.size(); ++i) {
        axes[i].stride =
            all_cells <= heads ? axes[i - 1].stride * axes[i - 1].cells : kHashStrides[i];
    }
}

template <class Real>
std::uint32_t BoxCellTable<Real>::head_of(const BoxPoint& point) const {
    std::uint32_t head = 0;
    for (std::size_t i = 0; i < axes.size(); ++i) {
        head += static_cast<std::uint32_t>(std::uint64_t{point[i]} * axes[i].cells >> 32) *
                axes[i].stride;
    }
    return head & (heads - 1);
}

std::vector<BoxPoint> draw_pool(const BoxParams& box, std::uint32_t candidates) {
    std::vector<BoxPoint> points(candidates);
    for (std::uint32_t rank = 0; rank < candidates; ++rank) {
        points[rank] = draw_in_box(box.seed, rank, box.extents.size());
    }
    return points;
}

template <class Real>
BoxPool<Real>::BoxPool(const BoxParams& box, std::uint32_t candidates)
    : BoxPool(box, draw_pool(box, candidates), kBoxGuard) {}

template <class Real>
BoxPool<Real>::BoxPool(const BoxParams& box, std::vector<BoxPoint> by_rank, double guard)
    : table(box, static_cast<std::uint32_t>(by_rank.size()), guard), points(std::move(by_rank)),
      order(points.size()) {
    std::vector<std::uint32_t> heads(points.size());
    starts.assign(std::size_t{table.heads} + 1, 0);
    for (std::size_t rank = 0; rank < points.size(); ++rank) {
        heads[rank] = table.head_of(points[rank]);
        ++starts[std::size_t{heads[rank]} + 1];
    }
    std::partial_sum(starts.begin(), starts.end(), starts.begin());
    std::vector<std::uint32_t> cursor(starts.begin(), starts.end() - 1);
    for (std::uint32_t rank = 0; rank < points.size(); ++rank) {
        order[cursor[heads[rank]]++] = rank;
    }
}

template <class Real>
std::vector<std::uint32_t> throw_darts(const BoxPool<Real>& pool) {
    std::vector<std::uint32_t> accepted;
    std::vector<std::uint8_t> decided(pool.points.size(), 0);
    BoxDetector<Real> detector(pool);
    for (std::uint32_t rank = 0; rank < decided.size(); ++rank) {
        if (decided[rank] != 0) {
            continue;
        }
        decided[rank] = 1;
        accepted.push_back(rank);
        detector.run(
            rank, [&](std::uint32_t q) { return decided[q] == 0; },
            [&](std::uint32_t q) { decided[q] = 1; });
    }
    return accepted;
}

template struct BoxCellTable<float>;
template struct BoxCellTable<double>;
template struct BoxPool<float>;
template struct BoxPool<double>;
template std::vector<std::uint32_t> throw_darts(const BoxPool<float>&);
template std::vector<std::uint32_t> throw_darts(const BoxPool<double>&);

} // namespace geodisk::ref
