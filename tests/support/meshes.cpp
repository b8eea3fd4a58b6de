#include "support/meshes.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <map>
#include <numbers>
#include <random>
#include <set>
#include <stdexcept>
#include <utility>

#include "files/meshes/mesh_file.hpp"
#include "kernels/pool.hpp"
#include "shapes/builtin_shapes.hpp"
#include "support/data_file.hpp"
#include "support/stand_in_meshes.hpp"

namespace geodisk::test {
namespace {

void add_quad(TestMesh& mesh, std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) {
    mesh.add_triangle(a, b, c);
    mesh.add_triangle(a, c, d);
}

/// Returns true if d lies outside the circle through a, b, c (counter-clockwise, z = 0).
bool outside_circle(Vec3 a, Vec3 b, Vec3 c, Vec3 d) {
    const Vec3 p = a - d;
    const Vec3 q = b - d;
    const Vec3 r = c - d;
    const double p2 = dot(p, p);
    const double q2 = dot(q, q);
    const double r2 = dot(r, r);
    const double sum =
        p.x * (q.y * r2 - q2 * r.y) - p.y * (q.x * r2 - q2 * r.x) + p2 * (q.x * r.y - q.y * r.x);
    return sum <= 0;
}

double uniform(std::mt19937_64& random) {
    return static_cast<double>(random() >> 11) * 0x1p-53;
}

TestMesh mesh_of(tools::MeshFile file) {
    return {std::move(file.positions), std::move(file.triangles), file.dimension};
}

std::optional<TestMesh> mesh_of(const std::optional<std::filesystem::path>& path) {
    if (!path) {
        return std::nullopt;
    }
    tools::MeshSources sources;
    sources.mesh = path->string();
    sources.keep_seams = true; // As the file connects its faces.
    return mesh_of(tools::read_mesh(sources));
}

} // namespace

Vec3 TestMesh::vertex(std::uint32_t v) const {
    const std::size_t i = std::size_t{3} * v;
    return {positions[i], positions[i + 1], positions[i + 2]};
}

Vec3 TestMesh::position(const Point& point) const {
    return (1 - point.weight1 - point.weight2) * corner(point.face, 0) +
           point.weight1 * corner(point.face, 1) + point.weight2 * corner(point.face, 2);
}

std::uint32_t TestMesh::add_vertex(Vec3 p) {
    positions.insert(positions.end(), {p.x, p.y, p.z});
    return vertex_count() - 1;
}

void TestMesh::add_triangle(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    triangles.insert(triangles.end(), {a, b, c});
}

TestMesh soup_of(const TestMesh& mesh) {
    TestMesh soup{{}, {}, mesh.dimension, false};
    for (const std::uint32_t vertex : mesh.triangles) {
        soup.triangles.push_back(static_cast<std::uint32_t>(soup.triangles.size()));
        for (std::uint32_t axis = 0; axis < mesh.dimension; ++axis) {
            soup.positions.push_back(mesh.positions[std::size_t{vertex} * mesh.dimension + axis]);
        }
    }
    return soup;
}

PreparedMesh prepared(const TestMesh& mesh) {
    auto result = PreparedMesh::prepare(mesh.view());
    if (!result) {
        throw std::runtime_error(result.error().message);
    }
    return std::move(*result);
}

std::optional<TestMesh> shared_mesh(const std::string& name) {
    return mesh_of(data_file(name));
}

TestMesh stand_in_mesh(std::string_view name) {
    return mesh_of(stand_in(name).make());
}

std::vector<NamedMesh> meshes_like(const std::vector<std::string>& names) {
    constexpr std::string_view kReal = "meshes/";
    std::vector<NamedMesh> meshes;
    std::set<std::string_view> standing;
    for (const std::string& name : names) {
        const bool is_real = name.starts_with(kReal);
        if (is_real) {
            const std::string_view one = stand_in(name.substr(kReal.size())).known.name;
            if (standing.insert(one).second) {
                meshes.push_back({std::string(one), stand_in_mesh(one)});
            }
        }
        if (auto mesh = mesh_of(data_file(name, is_real))) {
            meshes.push_back({name, std::move(*mesh)});
        }
    }
    return meshes;
}

TestMesh builtin(std::string_view name, int resolution) {
    return mesh_of(tools::make_builtin(name, resolution));
}

Point face_point(std::uint32_t face, double weight1, double weight2) {
    const double first = std::round(weight1 * 0x1p24) * 0x1p-24;
    const double both = std::round((weight1 + weight2) * 0x1p24) * 0x1p-24;
    return {face, first, both - first};
}

Point point_at(const TestMesh& mesh, double x, double y) {
    for (std::uint32_t f = 0; f < mesh.face_count(); ++f) {
        const Vec3 a = mesh.corner(f, 0);
        const Vec3 u = mesh.corner(f, 1) - a;
        const Vec3 v = mesh.corner(f, 2) - a;
        const double area = u.x * v.y - u.y * v.x;
        const double w1 = ((x - a.x) * v.y - (y - a.y) * v.x) / area;
        const double w2 = (u.x * (y - a.y) - u.y * (x - a.x)) / area;
        if (w1 >= -1e-12 && w2 >= -1e-12 && w1 + w2 <= 1 + 1e-12) {
            return face_point(f, w1, w2);
        }
    }
    throw std::runtime_error("no face holds the point");
}

std::vector<Point> points_at_vertex(const TestMesh& mesh, std::uint32_t v) {
    std::vector<Point> points;
    for (std::uint32_t i = 0; i < mesh.triangles.size(); ++i) {
        if (mesh.triangles[i] == v) {
            points.push_back({i / 3, i % 3 == 1 ? 1.0 : 0.0, i % 3 == 2 ? 1.0 : 0.0});
        }
    }
    return points;
}

std::vector<Point> random_points(const PreparedMesh& mesh, std::uint64_t seed,
                                 std::uint32_t count) {
    SampleParams params;
    params.min_distance = distance_for_count(mesh.statistics().area, count / kStageRatio);
    params.seed = seed;
    params.darts = count;
    return ref::draw_pool(ref::Surface<double>(mesh, params), params).by_rank();
}

std::vector<std::uint8_t> mask_above(const TestMesh& mesh, std::size_t axis) {
    const std::size_t dimension = mesh.dimension;
    double least = mesh.positions[axis], most = least;
    for (std::size_t i = axis; i < mesh.positions.size(); i += dimension) {
        least = std::min(least, mesh.positions[i]);
        most = std::max(most, mesh.positions[i]);
    }
    std::vector<std::uint8_t> mask;
    for (std::size_t face = 0; face < mesh.face_count(); ++face) {
        double sum = 0;
        for (std::size_t k = 3 * face; k < 3 * face + 3; ++k) {
            sum += mesh.positions[mesh.triangles[k] * dimension + axis];
        }
        mask.push_back(sum / 3 > (least + most) / 2 ? 1 : 0);
    }
    return mask;
}

TestMesh subdivided(const TestMesh& mesh, int times) {
    if (times == 0) {
        return mesh;
    }
    TestMesh result;
    result.positions = mesh.positions;
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middles;
    const auto middle = [&](std::uint32_t a, std::uint32_t b) {
        const auto [at, is_new] = middles.try_emplace(std::minmax(a, b), 0u);
        if (is_new) {
            at->second = result.add_vertex(0.5 * (mesh.vertex(a) + mesh.vertex(b)));
        }
        return at->second;
    };
    for (std::size_t i = 0; i < mesh.triangles.size(); i += 3) {
        const std::uint32_t a = mesh.triangles[i];
        const std::uint32_t b = mesh.triangles[i + 1];
        const std::uint32_t c = mesh.triangles[i + 2];
        const std::uint32_t ab = middle(a, b);
        const std::uint32_t bc = middle(b, c);
        const std::uint32_t ca = middle(c, a);
        result.add_triangle(a, ab, ca);
        result.add_triangle(ab, b, bc);
        result.add_triangle(ca, bc, c);
        result.add_triangle(ab, bc, ca);
    }
    return subdivided(result, times - 1);
}

TestMesh flat_grid(std::uint32_t columns, std::uint32_t rows, double width, double height) {
    TestMesh mesh;
    for (std::uint32_t j = 0; j <= rows; ++j) {
        for (std::uint32_t i = 0; i <= columns; ++i) {
            mesh.add_vertex({width * i / columns, height * j / rows, 0});
        }
    }
    for (std::uint32_t j = 0; j < rows; ++j) {
        for (std::uint32_t i = 0; i < columns; ++i) {
            const std::uint32_t a = j * (columns + 1) + i;
            add_quad(mesh, a, a + 1, a + columns + 2, a + columns + 1);
        }
    }
    return mesh;
}

TestMesh flat_lines(const std::vector<double>& xs, const std::vector<double>& ys) {
    TestMesh mesh;
    for (const double y : ys) {
        for (const double x : xs) {
            mesh.add_vertex({x, y, 0});
        }
    }
    const auto columns = static_cast<std::uint32_t>(xs.size());
    for (std::uint32_t j = 0; j + 1 < ys.size(); ++j) {
        for (std::uint32_t i = 0; i + 1 < columns; ++i) {
            const std::uint32_t a = j * columns + i;
            const std::uint32_t d = a + columns;
            (i + j) % 2 == 0 ? add_quad(mesh, a, a + 1, d + 1, d)
                             : add_quad(mesh, a + 1, d + 1, d, a);
        }
    }
    return mesh;
}

TestMesh flat_irregular(std::uint32_t parts, std::uint64_t seed) {
    TestMesh mesh;
    std::mt19937_64 random(seed);
    const double cell = 1.0 / parts;
    const auto moved = [&](std::uint32_t i) {
        const double shift = 0.7 * (uniform(random) - 0.5);
        return cell * (i + (i == 0 || i == parts ? 0 : shift));
    };
    for (std::uint32_t j = 0; j <= parts; ++j) {
        for (std::uint32_t i = 0; i <= parts; ++i) {
            const double x = moved(i);
            mesh.add_vertex({x, moved(j), 0});
        }
    }
    for (std::uint32_t j = 0; j < parts; ++j) {
        for (std::uint32_t i = 0; i < parts; ++i) {
            const std::uint32_t a = j * (parts + 1) + i;
            const std::uint32_t b = a + 1;
            const std::uint32_t d = a + parts + 1;
            const std::uint32_t c = d + 1;
            if (outside_circle(mesh.vertex(a), mesh.vertex(b), mesh.vertex(c), mesh.vertex(d))) {
                add_quad(mesh, a, b, c, d);
            } else {
                add_quad(mesh, b, c, d, a);
            }
        }
    }
    return mesh;
}

TestMesh flat_obtuse_fan(std::uint32_t parts_per_side) {
    TestMesh mesh;
    mesh.add_vertex({0.5, 0.001, 0});
    const Vec3 corners[] = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
    for (std::uint32_t side = 0; side < 4; ++side) {
        for (std::uint32_t i = 0; i < parts_per_side; ++i) {
            const double t = static_cast<double>(i) / parts_per_side;
            mesh.add_vertex((1 - t) * corners[side] + t * corners[(side + 1) % 4]);
        }
    }
    const std::uint32_t count = 4 * parts_per_side;
    for (std::uint32_t i = 0; i < count; ++i) {
        mesh.add_triangle(0, 1 + i, 1 + (i + 1) % count);
    }
    return mesh;
}

TestMesh two_sided_square() {
    return {{0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0}, {0, 1, 2, 0, 2, 3, 0, 3, 1, 1, 3, 2}};
}

TestMesh prism_tube(std::uint32_t sides, double side, double height, std::uint32_t rows) {
    TestMesh mesh;
    const double step = 2 * std::numbers::pi / sides;
    const double radius = side / (2 * std::sin(step / 2));
    for (std::uint32_t j = 0; j <= rows; ++j) {
        for (std::uint32_t i = 0; i < sides; ++i) {
            mesh.add_vertex(
                {radius * std::cos(step * i), radius * std::sin(step * i), height * j / rows});
        }
    }
    for (std::uint32_t j = 0; j < rows; ++j) {
        for (std::uint32_t i = 0; i < sides; ++i) {
            const std::uint32_t a = j * sides + i;
            const std::uint32_t b = j * sides + (i + 1) % sides;
            add_quad(mesh, a, b, b + sides, a + sides);
        }
    }
    return mesh;
}

TestMesh tetrahedra(std::uint32_t parts, double shift) {
    TestMesh mesh;
    std::mt19937_64 random(1);
    const auto moved = [&](std::uint32_t i) { return i + shift * (2 * uniform(random) - 1); };
    const std::uint32_t side = parts + 1;
    for (std::uint32_t v = 0; v < side * side * side; ++v) {
        const double x = moved(v / (side * side));
        const double y = moved(v / side % side);
        mesh.add_vertex({x, y, moved(v % side)});
    }
    const std::uint32_t steps[] = {side * side, side, 1};
    std::set<std::array<std::uint32_t, 3>> faces;
    for (std::uint32_t cell = 0; cell < parts * parts * parts; ++cell) {
        const std::uint32_t corner =
            cell / (parts * parts) * steps[0] + cell / parts % parts * steps[1] + cell % parts;
        std::array<int, 3> order{0, 1, 2};
        do {
            std::array<std::uint32_t, 4> path{corner};
            for (std::size_t k = 0; k < 3; ++k) {
                path[k + 1] = path[k] + steps[order[k]];
            }
            for (std::size_t left_out = 0; left_out < 4; ++left_out) {
                std::array<std::uint32_t, 3> face{};
                std::copy_if(path.begin(), path.end(), face.begin(),
                             [&](std::uint32_t v) { return v != path[left_out]; });
                faces.insert(face); // Ascending, as paths are.
            }
        } while (std::next_permutation(order.begin(), order.end()));
    }
    for (const auto& [a, b, c] : faces) {
        mesh.add_triangle(a, b, c);
    }
    return mesh;
}

TestMesh tetrahedra_beyond_sheet(std::uint32_t parts, double shift, std::uint32_t cells) {
    TestMesh mesh = tetrahedra(parts, shift);
    std::mt19937_64 random(2);
    std::vector<std::uint32_t> grid;
    for (std::uint32_t row = 0; row <= cells; ++row) {
        for (std::uint32_t column = 0; column <= cells; ++column) {
            if (row == 0 && column < 2) {
                grid.push_back(column);
                continue;
            }
            grid.push_back(static_cast<std::uint32_t>(mesh.positions.size() / 3));
            mesh.add_vertex({shift * (2 * uniform(random) - 1), -1.0 * row, 1.0 * column});
        }
    }
    for (std::uint32_t row = 0; row < cells; ++row) {
        for (std::uint32_t column = 0; column < cells; ++column) {
            const std::uint32_t at = row * (cells + 1) + column;
            add_quad(mesh, grid[at], grid[at + 1], grid[at + cells + 2], grid[at + cells + 1]);
        }
    }
    return mesh;
}

TestMesh needle_disk(std::uint32_t needles) {
    TestMesh mesh;
    mesh.add_vertex({0, 0, 0});
    for (std::uint32_t i = 0; i < needles; ++i) {
        const double angle = 2 * std::numbers::pi * i / needles;
        mesh.add_vertex({std::cos(angle), std::sin(angle), 0});
        mesh.triangles.insert(mesh.triangles.end(), {0, 1 + i, 1 + (i + 1) % needles});
    }
    return mesh;
}

TestMesh needle_strip(std::uint32_t needles, double length) {
    TestMesh mesh;
    for (std::uint32_t i = 0; i < needles + 2; ++i) {
        mesh.add_vertex({length * i / needles, i % 2 == 0 ? 0.0 : 1.0, 0});
    }
    for (std::uint32_t i = 0; i < needles; ++i) {
        const std::uint32_t odd = i % 2;
        mesh.triangles.insert(mesh.triangles.end(), {i, i + 1 + odd, i + 2 - odd});
    }
    return mesh;
}

TestMesh needle_sheets() {
    constexpr double kAside = 3.00001;
    return {{kAside, kAside, kAside,  kAside, 3, 3,       3, 3, kAside, kAside, 2,
             1,      1,      2.00001, 6,      1, 6.00001, 8, 4, 4,      6.00001},
            {6, 1, 6, 4, 0, 2, 0, 5, 2, 0, 3, 2, 3, 1, 2, 2, 1, 3,
             3, 2, 3, 3, 2, 5, 0, 2, 5, 2, 0, 3, 0, 1, 2, 2, 0, 3}};
}

TestMesh all_triangles(std::uint32_t points) {
    TestMesh mesh;
    std::mt19937_64 random(1);
    for (std::uint32_t i = 0; i < points; ++i) {
        const double x = uniform(random);
        const double y = uniform(random);
        mesh.add_vertex({x, y, uniform(random)});
        for (std::uint32_t j = 0; j < i; ++j) {
            for (std::uint32_t k = 0; k < j; ++k) {
                mesh.triangles.insert(mesh.triangles.end(), {i, j, k});
            }
        }
    }
    return mesh;
}

TestMesh moebius_double_cover(int resolution) {
    const TestMesh strip = builtin("moebius", resolution);
    const auto across = static_cast<std::uint32_t>(resolution);
    const std::uint32_t vertices = strip.vertex_count();
    const std::uint32_t along = vertices / (across + 1);
    TestMesh cover;
    cover.positions = strip.positions;
    cover.positions.insert(cover.positions.end(), strip.positions.begin(), strip.positions.end());
    for (std::uint32_t sheet = 0; sheet < 2; ++sheet) {
        for (std::uint32_t f = 0; f < strip.face_count(); ++f) {
            const std::uint32_t column = f / (2 * across);
            for (std::uint32_t k = 0; k < 3; ++k) {
                // The second sheet runs the other way, so that the two agree where they meet: at
                // the far side of the last column, the only vertices of the other sheet.
                const std::uint32_t v = strip.triangles[3 * f + (sheet == 0 ? k : (3 - k) % 3)];
                const bool far = column + 1 == along && v / (across + 1) == 0;
                cover.triangles.push_back(v + (sheet == (far ? 1u : 0u) ? 0 : vertices));
            }
        }
    }
    return cover;
}

} // namespace geodisk::test
