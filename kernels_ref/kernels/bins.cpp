#include "kernels/bins.hpp"

#include <numeric>

namespace geodisk::ref {

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

template <class Real>
std::vector<Grid> Bins<Real>::lay_out(const Surface<Real>& surface) {
    const std::uint32_t faces = surface.face_count();
    std::vector<Grid> grids(faces);
    first_cell.assign(std::size_t{faces} + 1, 0);
    for (std::uint32_t f = 0; f < faces; ++f) {
        grids[f] = face_grid(surface, f);
        first_cell[std::size_t{f} + 1] = first_cell[f] + grids[f].columns * grids[f].rows;
    }
    return grids;
}

template <class Real>
Bins<Real>::Bins(const Surface<Real>& surface, std::span<const FacePoint<Real>> given) {
    const std::vector<Grid> grids = lay_out(surface);
    starts.assign(std::size_t{first_cell.back()} + 1, 0);
    std::vector<std::uint32_t> cells(given.size());
    for (std::size_t i = 0; i < given.size(); ++i) {
        const std::uint32_t f = given[i].face;
        cells[i] = first_cell[f] + cell_of(surface, grids[f], given[i]);
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

template Grid face_grid(const Surface<float>&, std::uint32_t);
template Grid face_grid(const Surface<double>&, std::uint32_t);
template struct Bins<float>;
template struct Bins<double>;

} // namespace geodisk::ref
