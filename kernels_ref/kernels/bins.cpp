#include "kernels/bins.hpp"

#include <numeric>

namespace geodisk::ref {
namespace {

template <class Real>
Grid face_grid(const Surface<Real>& surface, std::uint32_t face) {
    std::uint32_t base = 3 * face;
    for (std::uint32_t h = base + 1; h < 3 * face + 3; ++h) {
        base = surface.edges[h].length > surface.edges[base].length ? h : base;
    }
    if (surface.one_cell_each) {
        return {1, 1, base};
    }
    const Edge<Real>& edge = surface.edges[base];
    const Real per_unit = surface.cells_per_unit(face);
    const auto count = [per_unit](Real extent) {
        return static_cast<std::uint32_t>(extent * per_unit) + 1;
    };
    return {count(edge.length), count(edge.apex_y), base};
}

} // namespace

template <class Real>
std::size_t Bins<Real>::lay_out(const Surface<Real>& surface) {
    grids.clear();
    grids.reserve(surface.face_count());
    std::uint32_t cells = 0;
    for (std::uint32_t f = 0; f < surface.face_count(); ++f) {
        Grid& grid = grids.emplace_back(face_grid(surface, f));
        grid.first_cell = cells;
        cells += grid.cells();
    }
    return cells;
}

template <class Real>
Bins<Real>::Bins(const Surface<Real>& surface, std::span<const FacePoint<Real>> given) {
    starts.assign(lay_out(surface) + 1, 0);
    std::vector<std::uint32_t> cells(given.size());
    for (std::size_t i = 0; i < given.size(); ++i) {
        const std::uint32_t f = given[i].face;
        cells[i] = grids[f].first_cell + cell_of(surface, grids[f], given[i]);
        ++starts[std::size_t{cells[i]} + 1];
    }
    std::partial_sum(starts.begin(), starts.end(), starts.begin());
    std::vector<std::uint32_t> cursor(starts.begin(), starts.end() - 1);
    order.resize(given.size());
    points.resize(given.size());
    for (std::uint32_t i = 0; i < given.size(); ++i) {
        const std::uint32_t place = cursor[cells[i]]++;
        order[place] = i;
        points[place] = given[i];
    }
}

template struct Bins<float>;
template struct Bins<double>;

} // namespace geodisk::ref
