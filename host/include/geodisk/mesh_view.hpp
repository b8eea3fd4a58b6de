// Triangle meshes in the caller's memory.
#pragma once

#include <array>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <span>

namespace geodisk {

/// Where the coordinates of vertices lie, as double or float. Floats give exactly what the same
/// values give as doubles. Nothing is copied or owned.
class PositionView {
  public:
    constexpr PositionView() noexcept = default;
    /// All coordinates of one vertex after those of the one before, in any contiguous range.
    template <class Range>
    requires std::convertible_to<const Range&, std::span<const double>>
    constexpr PositionView(const Range& packed) noexcept
        : PositionView(std::span<const double>(packed)) {}
    /// The same, of floats.
    template <class Range>
    requires std::convertible_to<const Range&, std::span<const float>>
    constexpr PositionView(const Range& packed) noexcept
        : PositionView(std::span<const float>(packed)) {}
    /// The same, by a span.
    constexpr PositionView(std::span<const double> packed) noexcept
        : data_(packed.data()), count_(packed.size()) {}
    /// The same, by a span of floats.
    constexpr PositionView(std::span<const float> packed) noexcept
        : data_(packed.data()), count_(packed.size()), is_float_(true) {}
    /// `count` vertices, each `stride` bytes after the one before, with its coordinates side by
    /// side. `stride` must be a multiple of the size of a coordinate and hold a vertex.
    constexpr PositionView(const double* first, std::size_t count, std::size_t stride) noexcept
        : data_(first), count_(count), stride_(stride), is_packed_(false) {}
    /// The same, of floats.
    constexpr PositionView(const float* first, std::size_t count, std::size_t stride) noexcept
        : data_(first), count_(count), stride_(stride), is_float_(true), is_packed_(false) {}

    constexpr const void* data() const noexcept { return data_; }
    constexpr bool is_float() const noexcept { return is_float_; }
    /// Whether it was given as a range.
    constexpr bool is_packed() const noexcept { return is_packed_; }
    /// Coordinates where packed, else vertices.
    constexpr std::size_t count() const noexcept { return count_; }
    /// Bytes from one vertex of so many coordinates to the next.
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

/// Where the vertex indices of faces lie, three per face, as 32 or 16 bits each. Nothing is copied
/// or owned.
class IndexView {
  public:
    constexpr IndexView() noexcept = default;
    /// One index after the other, in any contiguous range.
    template <class Range>
    requires std::convertible_to<const Range&, std::span<const std::uint32_t>>
    constexpr IndexView(const Range& packed) noexcept
        : IndexView(std::span<const std::uint32_t>(packed)) {}
    /// The same, of 16 bits.
    template <class Range>
    requires std::convertible_to<const Range&, std::span<const std::uint16_t>>
    constexpr IndexView(const Range& packed) noexcept
        : IndexView(std::span<const std::uint16_t>(packed)) {}
    /// The same, by a span.
    constexpr IndexView(std::span<const std::uint32_t> packed) noexcept
        : IndexView(packed.data(), packed.size(), sizeof(std::uint32_t)) {}
    /// The same, by a span of 16 bits.
    constexpr IndexView(std::span<const std::uint16_t> packed) noexcept
        : IndexView(packed.data(), packed.size(), sizeof(std::uint16_t)) {}
    /// `count` indices, each `stride` bytes after the one before, as where an index of something
    /// else lies between. `stride` must be a multiple of the size of an index, and not 0.
    constexpr IndexView(const std::uint32_t* first, std::size_t count, std::size_t stride) noexcept
        : data_(first), count_(count), stride_(stride) {}
    /// The same, of 16 bits.
    constexpr IndexView(const std::uint16_t* first, std::size_t count, std::size_t stride) noexcept
        : data_(first), count_(count), stride_(stride), is_short_(true) {}

    constexpr const void* data() const noexcept { return data_; }
    constexpr bool is_short() const noexcept { return is_short_; }
    constexpr std::size_t stride() const noexcept { return stride_; }
    /// Indices, three per face.
    constexpr std::size_t size() const noexcept { return count_; }
    /// The index in place `i`, of corner `i % 3` of face `i / 3`.
    std::uint32_t operator[](std::size_t i) const noexcept {
        const auto* const at = static_cast<const std::byte*>(data_) + i * stride_;
        return is_short_ ? *reinterpret_cast<const std::uint16_t*>(at)
                         : *reinterpret_cast<const std::uint32_t*>(at);
    }
    /// The vertices of a face.
    std::array<std::uint32_t, 3> face(std::size_t f) const noexcept {
        if (!is_short_ && stride_ == sizeof(std::uint32_t)) { // As most are: one test for three.
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

/// A triangle mesh in the caller's memory; nothing is copied until `PreparedMesh::prepare`.
///
/// `positions` holds `dimension` coordinates per vertex, 2 to 8, `triangles` three vertex indices
/// per face. Faces may be oriented either way, share an edge by any number, touch in single
/// vertices, have zero area, and leave borders open. Vertices that no face uses are ignored.
struct MeshView {
    PositionView positions;
    IndexView triangles;
    std::uint32_t dimension = 3;

    std::size_t vertex_count() const noexcept {
        return positions.is_packed() && dimension > 0 ? positions.count() / dimension
                                                      : positions.count();
    }
    std::size_t face_count() const noexcept { return triangles.size() / 3; }
    /// As the view has it; nothing is checked.
    double coordinate(std::size_t vertex, std::size_t axis) const noexcept {
        const auto* const at =
            static_cast<const std::byte*>(positions.data()) + vertex * positions.stride(dimension);
        return positions.is_float() ? double{reinterpret_cast<const float*>(at)[axis]}
                                    : reinterpret_cast<const double*>(at)[axis];
    }
};

/// A triangle mesh given by the lengths of its edges alone, also in the caller's memory: no
/// coordinates need exist, and no space that it would fit in.
///
/// `lengths` holds three per face, in mesh units: from its first corner to the second, to the third
/// and back, so `lengths[h]` is that of half-edge h. The faces of an edge must agree about its
/// length to a billionth. Each face must satisfy the triangle inequality to a millionth of its
/// longest edge, as lengths rounded to float do; one that does no more than that has no area.
/// Vertices are numbered below `vertex_count`.
struct LengthMeshView {
    IndexView triangles;
    std::span<const double> lengths;
    std::uint32_t vertex_count = 0;
};

} // namespace geodisk
