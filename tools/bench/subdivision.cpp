#include "bench/subdivision.hpp"

#include <cstddef>
#include <unordered_map>
#include <vector>

namespace geodisk::bench {
namespace {

using tools::MeshFile;

class Subdivider {
  public:
    Subdivider(const MeshFile& mesh, std::uint32_t parts) : mesh_(mesh), parts_(parts) {
        result_.positions = mesh.positions;
        result_.dimension = mesh.dimension;
        row_starts_.resize(std::size_t{parts} + 2);
        for (std::uint32_t row = 0; row <= parts; ++row) {
            row_starts_[row + 1] = row_starts_[row] + parts - row + 1;
        }
        grid_.resize(row_starts_.back());
    }

    MeshFile run() && {
        for (std::size_t i = 0; i < mesh_.triangles.size(); i += 3) {
            fill_grid(&mesh_.triangles[i]);
            add_triangles();
        }
        return std::move(result_);
    }

  private:
    /// The vertex `row` steps from corner 0 towards corner 2 and `column` steps towards corner 1.
    std::uint32_t& at(std::uint32_t row, std::uint32_t column) {
        return grid_[row_starts_[row] + column];
    }

    std::uint32_t vertex_count() const {
        return static_cast<std::uint32_t>(result_.positions.size() / mesh_.dimension);
    }

    void add_vertex(const std::uint32_t (&corners)[3], const std::uint32_t (&steps)[3]) {
        for (std::size_t axis = 0; axis < mesh_.dimension; ++axis) {
            double sum = 0;
            for (int k = 0; k < 3; ++k) {
                sum += steps[k] * mesh_.positions[std::size_t{corners[k]} * mesh_.dimension + axis];
            }
            result_.positions.push_back(sum / parts_);
        }
    }

    /// The first of the parts - 1 vertices inside edge a-b with a < b, in order from a. They are
    /// made when first asked for.
    std::uint32_t edge_start(std::uint32_t a, std::uint32_t b) {
        const std::uint64_t key = std::uint64_t{a} << 32 | b;
        const auto [entry, is_new] = edges_.try_emplace(key, vertex_count());
        for (std::uint32_t step = 1; is_new && step < parts_; ++step) {
            add_vertex({a, b, a}, {parts_ - step, step, 0});
        }
        return entry->second;
    }

    /// The vertex `step` steps from a towards b, both excluded.
    std::uint32_t on_edge(std::uint32_t a, std::uint32_t b, std::uint32_t step) {
        return a < b ? edge_start(a, b) + step - 1 : edge_start(b, a) + parts_ - step - 1;
    }

    void fill_grid(const std::uint32_t* face) {
        const std::uint32_t corners[3] = {face[0], face[1], face[2]};
        at(0, 0) = corners[0];
        at(0, parts_) = corners[1];
        at(parts_, 0) = corners[2];
        for (std::uint32_t step = 1; step < parts_; ++step) {
            at(0, step) = on_edge(corners[0], corners[1], step);
            at(step, parts_ - step) = on_edge(corners[1], corners[2], step);
            at(step, 0) = on_edge(corners[0], corners[2], step);
        }
        for (std::uint32_t row = 1; row < parts_; ++row) {
            for (std::uint32_t column = 1; row + column < parts_; ++column) {
                at(row, column) = vertex_count();
                add_vertex(corners, {parts_ - row - column, column, row});
            }
        }
    }

    void add_triangles() {
        const auto add = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
            result_.triangles.insert(result_.triangles.end(), {a, b, c});
        };
        for (std::uint32_t row = 0; row < parts_; ++row) {
            for (std::uint32_t column = 0; row + column < parts_; ++column) {
                add(at(row, column), at(row, column + 1), at(row + 1, column));
                if (row + column + 1 < parts_) {
                    add(at(row, column + 1), at(row + 1, column + 1), at(row + 1, column));
                }
            }
        }
    }

    const MeshFile& mesh_;
    std::uint32_t parts_;
    MeshFile result_;
    std::vector<std::size_t> row_starts_;
    std::vector<std::uint32_t> grid_; ///< Vertices of the triangle being cut, row by row.
    std::unordered_map<std::uint64_t, std::uint32_t> edges_; ///< See edge_start().
};

} // namespace

MeshFile subdivide(const MeshFile& mesh, std::uint32_t parts) {
    return parts == 1 ? mesh : Subdivider(mesh, parts).run();
}

} // namespace geodisk::bench
