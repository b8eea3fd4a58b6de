#include "engine/cells/grid_points.hpp"

#include <algorithm>
#include <tuple>

#include "engine/domain/existing.hpp"
#include "mesh/face_area.hpp"

namespace geodisk {

GridPoint GridPoints::on_edge(std::uint32_t half_edge, std::uint32_t steps) const {
    const auto order_of = [this](std::uint32_t h) {
        return std::tuple(!has_area(mesh_, h / 3), h);
    };
    GridPoint found{GridPoint::Kind::edge, half_edge, steps, 0};
    bool is_same_way = true;
    for (std::uint32_t h = half_edge;;) {
        const std::uint32_t around = mesh_.half_edges()[h].around;
        is_same_way = is_same_way == around_same_way(around);
        h = around_half_edge(around);
        if (h == half_edge) {
            return found;
        }
        if (order_of(h) < order_of(found.element)) {
            found.element = h;
            found.column = is_same_way ? steps : steps_ - steps;
        }
    }
}

GridPoint GridPoints::point(std::uint32_t face, std::uint32_t column, std::uint32_t row) const {
    const std::uint32_t first = steps_ - column - row;
    for (std::uint32_t k = 0; k < 3; ++k) {
        const std::uint32_t at = k == 0 ? first : k == 1 ? column : row;
        if (at == steps_) {
            return {GridPoint::Kind::vertex, mesh_.half_edges()[std::size_t{3} * face + k].origin,
                    0, 0};
        }
    }
    if (row == 0) {
        return on_edge(3 * face, column);
    }
    if (first == 0) {
        return on_edge(3 * face + 1, row);
    }
    if (column == 0) {
        return on_edge(3 * face + 2, first);
    }
    return {GridPoint::Kind::face, face, column, row};
}

GridPoint GridPoints::point(const Sample& sample) const {
    const auto [second, third] = rounded_weights(sample.weights);
    return point(sample.face, static_cast<std::uint32_t>(second * 0x1p24f),
                 static_cast<std::uint32_t>(third * 0x1p24f));
}

std::array<GridPoint, 3> GridPoints::corners(const GapCell& cell) const {
    const auto [face, column, row, level, is_turned] = cell;
    return is_turned
               ? std::array<GridPoint, 3>{point(face, column + 1, row),
                                          point(face, column, row + 1),
                                          point(face, column + 1, row + 1)}
               : std::array<GridPoint, 3>{point(face, column, row), point(face, column + 1, row),
                                          point(face, column, row + 1)};
}

FacePlace GridPoints::place(const GridPoint& point) const {
    const double step = 1.0 / steps_;
    std::uint32_t face = point.element;
    std::array<double, 3> weights{};
    if (point.kind == GridPoint::Kind::face) {
        return {face, {point.column * step, point.row * step}};
    }
    std::uint32_t half_edge = point.element;
    double along = point.column * step;
    if (point.kind == GridPoint::Kind::vertex) {
        const VertexFan& fan = mesh_.fans()[point.element];
        const auto corners = mesh_.corners().subspan(fan.first_corner, fan.corner_count);
        half_edge = *std::ranges::min_element(corners, {}, [this](std::uint32_t h) {
            return std::tuple(!has_area(mesh_, h / 3), h);
        });
        along = 0;
    }
    face = half_edge / 3;
    weights[half_edge % 3] = 1 - along;
    weights[next_in_face(half_edge) % 3] = along;
    return {face, {weights[1], weights[2]}};
}

} // namespace geodisk
