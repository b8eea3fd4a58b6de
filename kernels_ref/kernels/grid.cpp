#include "kernels/grid.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numeric>

namespace geodisk::ref {

template <class Real>
BoxCellTable<Real>::BoxCellTable(const BoxLattice& lattice, std::size_t candidates, double guard)
    : is_periodic(lattice.is_periodic), limit2(static_cast<float>((1 + guard) * (1 + guard))) {
    constexpr std::uint32_t kHashStrides[] = {1u,          0x9E3779B1u, 0xB5297A4Du,
                                              0x68E31DA5u, 0x1B56C4E9u, 0x7FEB352Du};
    double all_cells = 1;
    for (std::size_t i = 0; i < lattice.axes.size(); ++i) {
        const auto length = static_cast<double>(lattice.axes[i].length);
        const double side = length * lattice.relative_step(i);
        const double cells = std::max(1.0, std::floor(side * 2 / (1 + 4 * guard)));
        all_cells *= cells;
        // Rounded down: cells are not narrower and not more numerous than planned.
        const double per_step = cells > 1 ? std::floor(cells * 0x1p32 / length) : 0;
        const double width = cells > 1 ? 0x1p32 / per_step * lattice.relative_step(i) : side;
        axes.push_back({static_cast<std::uint32_t>(cells), 1,
                        static_cast<Real>(lattice.relative_step(i)), static_cast<Real>(width),
                        static_cast<std::uint32_t>(per_step)});
    }
    heads = std::bit_ceil(static_cast<std::uint32_t>(
        std::clamp(2.0 * static_cast<double>(candidates), 1.0, all_cells)));
    for (std::size_t i = 1; i < axes.size(); ++i) {
        axes[i].stride =
            all_cells <= heads ? axes[i - 1].stride * axes[i - 1].cells : kHashStrides[i];
    }
}

template <class Real>
std::uint32_t BoxCellTable<Real>::head_of(const BoxPoint& point) const {
    std::uint32_t head = 0;
    for (std::size_t i = 0; i < axes.size(); ++i) {
        head += axes[i].cell_of(point[i]) * axes[i].stride;
    }
    return head & (heads - 1);
}

template <class Real>
BoxPool<Real>::BoxPool(const BoxParams& box)
    : BoxPool(BoxLattice(box), draw_in_box(box).points, kBoxGuard) {}

template <class Real>
BoxPool<Real>::BoxPool(const BoxLattice& lattice, std::span<const BoxPoint> by_rank, double guard,
                       std::size_t capacity)
    : table(lattice, capacity != 0 ? capacity : by_rank.size(), guard), points(by_rank.size()),
      order(by_rank.size()), places(by_rank.size()) {
    starts.assign(std::size_t{table.heads} + 1, 0);
    for (std::size_t rank = 0; rank < by_rank.size(); ++rank) {
        places[rank] = table.head_of(by_rank[rank]);
        ++starts[std::size_t{places[rank]} + 1];
    }
    std::partial_sum(starts.begin(), starts.end(), starts.begin());
    std::vector<std::uint32_t> cursor(starts.begin(), starts.end() - 1);
    for (std::uint32_t rank = 0; rank < by_rank.size(); ++rank) {
        const std::uint32_t place = cursor[places[rank]]++;
        places[rank] = place;
        order[place] = rank;
        points[place] = by_rank[rank];
    }
}

template <class Real>
void BoxPool<Real>::set_normals(std::span<const std::array<float, 3>> by_rank) {
    normals.resize(points.size());
    for (std::size_t rank = 0; rank < by_rank.size(); ++rank) {
        const std::array<float, 3>& normal = by_rank[rank];
        normals[places[rank]] = {normal[0], normal[1], normal[2]};
    }
}

template <class Real>
std::vector<std::uint32_t> throw_darts(const BoxPool<Real>& pool, std::uint32_t most) {
    std::vector<std::uint32_t> accepted;
    std::vector<std::uint8_t> decided(pool.size(), 0);
    BoxDetector<Real> detector(pool);
    for (std::uint32_t rank = 0; rank < pool.size() && accepted.size() < most; ++rank) {
        const std::uint32_t place = pool.places[rank];
        if (decided[place] != 0) {
            continue;
        }
        decided[place] = 1;
        accepted.push_back(rank);
        detector.run(
            place, [&](std::uint32_t q) { return decided[q] == 0; },
            [&](std::uint32_t q) { decided[q] = 1; });
    }
    return accepted;
}

template struct BoxCellTable<float>;
template struct BoxCellTable<double>;
template struct BoxPool<float>;
template struct BoxPool<double>;
template std::vector<std::uint32_t> throw_darts(const BoxPool<float>&, std::uint32_t);
template std::vector<std::uint32_t> throw_darts(const BoxPool<double>&, std::uint32_t);

} // namespace geodisk::ref
