// MeshView and LengthMeshView: triangle meshes in the caller's memory.
// Stable.
#pragma once

#include <array>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <span>

namespace geodisk {

/// A view of vertex coordinates, double or float. Floats give exactly the same results as equal
/// doubles. Copies and owns nothing.
class PositionView {
  public:
    constexpr PositionView() noexcept = default;
    /// Views any contiguous range of packed vertices: the coordinates of each vertex directly
    /// follow those of the vertex before.
    template <class Range>
    requires std::convertible_to<const Range&, std::span<const double>>
    constexpr PositionView(const Range& packed) noexcept
        : PositionView(std::span<const double>(packed)) {}
    /// Views packed floats.
    template <class Range>
    requires std::convertible_to<const Range&, std::span<const float>>
    constexpr PositionView(const Range& packed) noexcept
        : PositionView(std::span<const float>(packed)) {}
    /// Views a span of packed doubles.
    constexpr PositionView(std::span<const double> packed) noexcept
        : data_(packed.data()), count_(packed.size()) {}
    /// Views a span of packed floats.
    constexpr PositionView(std::span<const float> packed) noexcept
        : data_(packed.data()), count_(packed.size()), is_float_(true) {}
    /// Views `count` vertices, `stride` bytes apart. The coordinates of a vertex are adjacent.
    /// `stride` must be a multiple of the size of a coordinate, and at least the size of a vertex.
    constexpr PositionView(const double* first, std::size_t count, std::size_t stride) noexcept
        : data_(first), count_(count), stride_(stride), is_packed_(false) {}
    /// Views vertices of floats, `stride` bytes apart.
    constexpr PositionView(const float* first, std::size_t count, std::size_t stride) noexcept
        : data_(first), count_(count), stride_(stride), is_float_(true), is_packed_(false) {}

    constexpr const void* data() const noexcept { return data_; }
    constexpr bool is_float() const noexcept { return is_float_; }
    /// Returns true if vertices are packed.
    constexpr bool is_packed() const noexcept { return is_packed_; }
    /// Returns the number of coordinates if packed, else of vertices.
    constexpr std::size_t count() const noexcept { return count_; }
    /// Returns the bytes from one vertex to the next, for this many coordinates per vertex.
    constexpr std::size_t stride(std::uint32_t dimension) const noexcept {
        return is_packed_ ? dimension * (is_float_ ? sizeof(float) : sizeof(double)) : stride_;
    }

  private:
    const void* data_ = nullptr;
    std::size_t count_ = 0;
    std::size_t stride_ = 0;
    bool is_float_ = false;
    bool is_packed_ = true;
};

/// A view of vertex indices of 32 or 16 bits, three per face. Copies and owns nothing.
class IndexView {
  public:
    constexpr IndexView() noexcept = default;
    /// Views any contiguous range of adjacent indices.
    template <class Range>
    requires std::convertible_to<const Range&, std::span<const std::uint32_t>>
    constexpr IndexView(const Range& packed) noexcept
        : IndexView(std::span<const std::uint32_t>(packed)) {}
    /// Views adjacent indices of 16 bits.
    template <class Range>
    requires std::convertible_to<const Range&, std::span<const std::uint16_t>>
    constexpr IndexView(const Range& packed) noexcept
        : IndexView(std::span<const std::uint16_t>(packed)) {}
    /// Views a span of adjacent indices.
    constexpr IndexView(std::span<const std::uint32_t> packed) noexcept
        : IndexView(packed.data(), packed.size(), sizeof(std::uint32_t)) {}
    /// Views a span of adjacent indices of 16 bits.
    constexpr IndexView(std::span<const std::uint16_t> packed) noexcept
        : IndexView(packed.data(), packed.size(), sizeof(std::uint16_t)) {}
    /// Views `count` indices, `stride` bytes apart, for example to skip other indices between them.
    /// `stride` must be a multiple of the size of an index, and not 0.
    constexpr IndexView(const std::uint32_t* first, std::size_t count, std::size_t stride) noexcept
        : data_(first), count_(count), stride_(stride) {}
    /// Views indices of 16 bits, `stride` bytes apart.
    constexpr IndexView(const std::uint16_t* first, std::size_t count, std::size_t stride) noexcept
        : data_(first), count_(count), stride_(stride), is_short_(true) {}

    constexpr const void* data() const noexcept { return data_; }
    constexpr bool is_short() const noexcept { return is_short_; }
    constexpr std::size_t stride() const noexcept { return stride_; }
    /// Returns the number of indices, three per face.
    constexpr std::size_t size() const noexcept { return count_; }
    /// Returns the vertex of corner `i % 3` of face `i / 3`.
    std::uint32_t operator[](std::size_t i) const noexcept {
        const auto* const at = static_cast<const std::byte*>(data_) + i * stride_;
        return is_short_ ? *reinterpret_cast<const std::uint16_t*>(at)
                         : *reinterpret_cast<const std::uint32_t*>(at);
    }
    /// Returns the vertices of a face.
    std::array<std::uint32_t, 3> face(std::size_t f) const noexcept {
        if (!is_short_ && stride_ == sizeof(std::uint32_t)) { // Common case: one test for three.
            const auto* const first = static_cast<const std::uint32_t*>(data_) + 3 * f;
            return {first[0], first[1], first[2]};
        }
        return {(*this)[3 * f], (*this)[3 * f + 1], (*this)[3 * f + 2]};
    }

  private:
    const void* data_ = nullptr;
    std::size_t count_ = 0;
    std::size_t stride_ = sizeof(std::uint32_t);
    bool is_short_ = false;
};

/// A triangle mesh in the caller's memory. `PreparedMesh::prepare` copies what it needs.
///
/// Any number of faces may share an edge. Faces may have either orientation, touch in single
/// vertices, have zero area, and leave borders open. Vertices that no face uses are ignored.
struct MeshView {
    PositionView positions;      ///< `dimension` coordinates per vertex.
    IndexView triangles;         ///< Three vertex indices per face.
    std::uint32_t dimension = 3; ///< Coordinates per vertex, 2 to 8.
    /// Connect only faces that share vertices. Otherwise PreparedMesh and Updater first join border
    /// edges that lie exactly on others, as join_seams() does.
    bool keep_seams = false;

    std::size_t vertex_count() const noexcept {
        return positions.is_packed() && dimension > 0 ? positions.count() / dimension
                                                      : positions.count();
    }
    std::size_t face_count() const noexcept { return triangles.size() / 3; }
    /// Returns a coordinate; checks nothing.
    double coordinate(std::size_t vertex, std::size_t axis) const noexcept {
        const auto* const at =
            static_cast<const std::byte*>(positions.data()) + vertex * positions.stride(dimension);
        return positions.is_float() ? double{reinterpret_cast<const float*>(at)[axis]}
                                    : reinterpret_cast<const double*>(at)[axis];
    }
};

/// A triangle mesh in the caller's memory, given by edge lengths. It needs no coordinates, and no
/// space that it would fit in.
///
/// The faces of an edge must agree about its length to a billionth. Each face must satisfy the
/// triangle inequality to a millionth of its longest edge, as lengths rounded to float do. A face
/// that violates it by less than that has no area.
struct LengthMeshView {
    IndexView triangles; ///< Three vertex indices per face, each below `vertex_count`.
    /// Three lengths per face, in mesh units: from the first corner to the second, to the third,
    /// and back. `lengths[h]` is the length of half-edge h.
    std::span<const double> lengths;
    std::uint32_t vertex_count = 0;
};

} // namespace geodisk
