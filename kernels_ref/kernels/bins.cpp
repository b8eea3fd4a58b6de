#include "kernels/bins.hpp"

#include <algorithm>
#include <numeric>

namespace geodisk::ref {
namespace {

template <class Real>
std::uint32_t cell_index(Real x, std::uint32_t count, Real per_unit) {
    const Real scaled = x * per_unit;
    return scaled <= 0 ? 0 : std::min(static_cast<std::uint32_t>(scaled), count - 1);
}

template <class Real>
std::uint32_t cell_of(const Surface<Real>& surface, const Grid& grid, FacePoint<Real> point) {
    if (grid.single()) {
        return 0;
    }
    const auto at = position_in(surface, grid.base, point);
    const Real per_unit = surface.cells_per_unit(point.face);
    return cell_index(at.y, grid.rows, per_unit) * grid.columns +
           cell_index(at.x, grid.columns, per_unit);
}

} // namespace

template <class Real>
Grid face_grid(const Surface<Real>& surface, std::uint32_t face) {
    std::uint32_t base = 3 * face;
    for (std::uint32_t h = base + 1; h < 3 * face + 3; ++h) {
        base = surface.edges[h].length > surface.edges[base].length ? h : base;
    }
    const Edge<Real>& edge = surface.edges[base];
    const Real per_unit = surface.cells_per_unit(face);
    const auto count = [per_unit](Real extent) {
        return static_cast<std::uint32_t>(extent * per_unit) + 1;
    };
    return {count(edge.length), count(edge.apex_y), base};
}

template <class Real>
Position<Real> position_in(const Surface<Real>& surface, std::uint32_t h, FacePoint<Real> point) {
    const Edge<Real>& edge = surface.edges[h];
    const Real weights[3] = {Real{1} - point.weight1 - point.weight2, point.weight1, point.weight2};
    const std::uint32_t k = h % 3;
    const Real end = weights[(k + 1) % 3];
    const Real apex = weights[(k + 2) % 3];
    return {end * edge.length + apex * edge.apex_x, apex * edge.apex_y};
}

template <class Real>
Bins<Real>::Bins(const Surface<Real>& surface, std::span<const FacePoint<Real>> by_rank) {
    const std::uint32_t faces = surface.face_count();
    std::vector<Grid> grids(faces);
    first_cell.assign(std::size_t{faces} + 1, 0);
    for (std::uint32_t f = 0; f < faces; ++f) {
        grids[f] = face_grid(surface, f);
        first_cell[std::size_t{f} + 1] = first_cell[f] + grids[f].columns * grids[f].rows;
    }
    starts.assign(std::size_t{first_cell[faces]} + 1, 0);
    std::vector<std::uint32_t> cells(by_rank.size());
    for (std::size_t rank = 0; rank < by_rank.size(); ++rank) {
        const std::uint32_t f = by_rank[rank].face;
        cells[rank] = first_cell[f] + cell_of(surface, grids[f], by_rank[rank]);
        ++starts[std::size_t{cells[rank]} + 1];
    }
    std::partial_sum(starts.begin(), starts.end(), starts.begin());
    std::vector<std::uint32_t> cursor(starts.begin(), starts.end() - 1);
    order.resize(by_rank.size());
    points.resize(by_rank.size());
    for (std::uint32_t rank = 0; rank < by_rank.size(); ++rank) {
        const std::uint32_t place = cursor[cells[rank]]++;
        order[place] = rank;
        points[place] = by_rank[rank];
    }
}

template Grid face_grid(const Surface<float>&, std::uint32_t);
template Grid face_grid(const Surface<double>&, std::uint32_t);
template Position<float> position_in(const Surface<float>&, std::uint32_t, FacePoint<float>);
template Position<double> position_in(const Surface<double>&, std::uint32_t, FacePoint<double>);
template struct Bins<float>;
template struct Bins<double>;

} // namespace geodisk::ref
