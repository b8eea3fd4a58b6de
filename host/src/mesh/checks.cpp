#include "mesh/checks.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>

#include "mesh/connectivity.hpp"
#include "support/invalid.hpp"
#include "support/number_text.hpp"
#include "support/try.hpp"

namespace geodisk {
namespace {

// Some words hold half-edge indices with two flag bits; the cell word of a face also has two.
constexpr std::uint64_t kMaxFaces = (std::uint64_t{1} << 30) / 3;
// Kernels keep two flags above the vertex number.
constexpr std::uint64_t kMaxVertices = std::uint64_t{1} << 30;
// Larger coordinates could make squared lengths overflow double.
constexpr double kLargestCoordinate = 1e100;
constexpr double kSmallestExtent = 1e-100;
/// Allowed violation of the triangle inequality, relative to the longest side. Lengths rounded to
/// float need it.
constexpr double kRoundedLength = 1e-6;
constexpr double kAgreement = 1e-9;

Error rejected(std::string message, std::uint64_t element = kNoElement) {
    return Error{Status::mesh_rejected, std::move(message), element};
}

Error index_rejected(std::size_t corner, std::uint32_t vertex, std::uint64_t vertices) {
    return rejected("face " + std::to_string(corner / 3) + " names vertex " +
                        std::to_string(vertex) + ", but there are only " + std::to_string(vertices),
                    corner / 3);
}

/// Checks the layout of an array: elements `stride` bytes apart, made of parts of a type's size.
Result<Done> check_layout(const std::string& name, const void* data, std::size_t count,
                          std::size_t stride, std::size_t element, std::size_t part) {
    if (count == 0) {
        return Done{};
    }
    if (data == nullptr) {
        return invalid("there are " + std::to_string(count) + " " + name + ", but no data");
    }
    if (stride < element) {
        return invalid("the stride of " + name + " is " + std::to_string(stride) +
                       " bytes, less than the " + std::to_string(element) + " of one");
    }
    if (stride % part != 0 || reinterpret_cast<std::uintptr_t>(data) % part != 0) {
        return invalid(name + " must lie at multiples of " + std::to_string(part) + " bytes");
    }
    return Done{};
}

Result<Done> check_layout(const PositionView& positions, std::uint32_t dimension) {
    const std::size_t part = positions.is_float() ? sizeof(float) : sizeof(double);
    return check_layout("positions", positions.data(), positions.count(),
                        positions.stride(dimension), part * dimension, part);
}

Result<Done> check_layout(const IndexView& triangles) {
    const std::size_t part = triangles.is_short() ? sizeof(std::uint16_t) : sizeof(std::uint32_t);
    return check_layout("indices", triangles.data(), triangles.size(), triangles.stride(), part,
                        part);
}

Result<Done> check_shape(const MeshView& mesh) {
    if (mesh.dimension < 2 || mesh.dimension > kMaxDimensions) {
        return invalid("the dimension must be 2 to 8, not " + std::to_string(mesh.dimension));
    }
    if ((mesh.positions.is_packed() && mesh.positions.count() % mesh.dimension != 0) ||
        mesh.triangles.size() % 3 != 0) {
        return invalid("positions must hold whole vertices and triangles whole faces");
    }
    GEODISK_TRY(check_layout(mesh.positions, mesh.dimension));
    GEODISK_TRY(check_layout(mesh.triangles));
    return check_counts(mesh.face_count(), mesh.vertex_count());
}

/// Returns true if all coordinates, also of unused vertices, are finite and not too large.
template <class Coordinate>
bool all_coordinates_fit(const MeshView& mesh) {
    const PositionView& positions = mesh.positions;
    // Packed coordinates are one long row.
    const std::size_t rows = positions.is_packed() ? 1 : positions.count();
    const std::size_t length = positions.is_packed() ? positions.count() : mesh.dimension;
    bool fit = true;
    for (std::size_t row = 0; row < rows; ++row) {
        const auto* const first =
            reinterpret_cast<const Coordinate*>(static_cast<const std::byte*>(positions.data()) +
                                                row * positions.stride(mesh.dimension));
        for (std::size_t i = 0; i < length; ++i) {
            fit &= std::abs(first[i]) <= kLargestCoordinate; // Also false for NaN.
        }
    }
    return fit;
}

bool all_elements_fit(const MeshView& mesh) {
    std::uint32_t largest = 0;
    for (std::size_t f = 0; f < mesh.face_count(); ++f) {
        const auto [a, b, c] = mesh.triangles.face(f);
        largest = std::max({largest, a, b, c});
    }
    return largest < mesh.vertex_count() &&
           (mesh.positions.is_float() ? all_coordinates_fit<float>(mesh)
                                      : all_coordinates_fit<double>(mesh));
}

Result<Done> check_vertex(const MeshView& mesh, std::uint32_t v) {
    for (std::uint32_t axis = 0; axis < mesh.dimension; ++axis) {
        const double x = mesh.coordinate(v, axis);
        if (!std::isfinite(x)) {
            return rejected("vertex " + std::to_string(v) + " is not finite", v);
        }
        if (std::abs(x) > kLargestCoordinate) {
            return rejected("vertex " + std::to_string(v) + " is beyond 1e100; rescale the mesh",
                            v);
        }
    }
    return Done{};
}

Result<Done> check_elements(const MeshView& mesh) {
    if (all_elements_fit(mesh)) {
        return Done{}; // Checked in memory order: several times faster than face by face.
    }
    const std::uint64_t vertices = mesh.vertex_count();
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
        const std::uint32_t v = mesh.triangles[i];
        if (v >= vertices) {
            return index_rejected(i, v, vertices);
        }
        GEODISK_TRY(check_vertex(mesh, v));
    }
    return Done{};
}

Result<Done> check_face(std::size_t face, std::span<const double> lengths) {
    const std::string name = "face " + std::to_string(face);
    for (const double length : lengths) {
        if (!(length > 0) || length > kLargestCoordinate) {
            return rejected(name + " has an edge of length " + exact_text(length) +
                                "; lengths must be positive and at most 1e100",
                            face);
        }
    }
    const double longest = std::max({lengths[0], lengths[1], lengths[2]});
    const double rest = lengths[0] + lengths[1] + lengths[2] - longest;
    if (rest < longest * (1 - kRoundedLength)) {
        return rejected(name + " violates the triangle inequality: its edges have the lengths " +
                            exact_text(lengths[0]) + ", " + exact_text(lengths[1]) + " and " +
                            exact_text(lengths[2]),
                        face);
    }
    return Done{};
}

} // namespace

Result<Done> check_counts(std::uint64_t faces, std::uint64_t vertices) {
    if (faces == 0) {
        return rejected("the mesh has no faces");
    }
    if (faces > kMaxFaces || vertices > kMaxVertices) {
        return rejected("the mesh is too large: at most 357,913,941 faces and 1,073,741,824 "
                        "vertices can be indexed");
    }
    return Done{};
}

Result<Done> check_mesh(const MeshView& mesh) {
    GEODISK_TRY(check_shape(mesh));
    return check_elements(mesh);
}

Result<Done> check_faces(const MeshView& mesh, std::span<const std::uint32_t> faces) {
    GEODISK_TRY(check_shape(mesh));
    const std::uint64_t vertices = mesh.vertex_count();
    for (const std::uint32_t face : faces) {
        for (std::size_t i = std::size_t{3} * face; i < std::size_t{3} * face + 3; ++i) {
            const std::uint32_t v = mesh.triangles[i];
            if (v >= vertices) {
                return index_rejected(i, v, vertices);
            }
            GEODISK_TRY(check_vertex(mesh, v));
        }
    }
    return Done{};
}

Result<Done> check_mesh(const LengthMeshView& mesh) {
    if (mesh.triangles.size() % 3 != 0 || mesh.lengths.size() != mesh.triangles.size()) {
        return invalid("triangles must hold whole faces and lengths three per face");
    }
    GEODISK_TRY(check_layout(mesh.triangles));
    const std::size_t faces = mesh.triangles.size() / 3;
    GEODISK_TRY(check_counts(faces, mesh.vertex_count));
    for (std::size_t f = 0; f < faces; ++f) {
        const auto face = mesh.triangles.face(f);
        for (const std::uint32_t v : face) {
            if (v >= mesh.vertex_count) {
                return index_rejected(3 * f, v, mesh.vertex_count);
            }
        }
        if (takes_part(face)) {
            GEODISK_TRY(check_face(f, mesh.lengths.subspan(3 * f, 3)));
        }
    }
    return Done{};
}

Result<Done> check_agreement(std::span<const HalfEdge> half_edges) {
    for (std::uint32_t h = 0; h < half_edges.size(); ++h) {
        const std::uint32_t other = around_half_edge(half_edges[h].around);
        const double a = half_edges[h].length;
        const double b = half_edges[other].length;
        if (std::abs(a - b) > kAgreement * std::max(a, b)) {
            const auto [low, high] = std::minmax(h, other);
            return rejected("faces " + std::to_string(low / 3) + " and " +
                                std::to_string(high / 3) + " disagree about edge " +
                                std::to_string(half_edges[low].origin) + "-" +
                                std::to_string(half_edges[next_in_face(low)].origin) +
                                ": its length is " + exact_text(half_edges[low].length) + " and " +
                                exact_text(half_edges[high].length),
                            low / 3);
        }
    }
    return Done{};
}

bool has_area(double area, double extent) {
    return area > 1e-13 * extent * extent && extent >= kSmallestExtent;
}

Result<Done> check_area(double area, double extent) {
    if (has_area(area, extent)) {
        return Done{};
    }
    const bool is_small = extent > 0 && extent < kSmallestExtent;
    return Error{Status::mesh_rejected, is_small ? "the mesh is smaller than 1e-100; rescale it"
                                                 : "no face has area: all are degenerate"};
}

Result<Done> check_threads(const ThreadOptions& threads) {
    if (threads.max_threads == 0) {
        return invalid("max_threads must be at least 1, not 0");
    }
    return Done{};
}

} // namespace geodisk
