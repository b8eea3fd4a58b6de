// Numbers of some vertices of a mesh among themselves.
#pragma once

#include <algorithm>
#include <cstdint>
#include <utility>
#include <vector>

namespace geodisk {

/// Some vertices of a whole mesh, numbered in their order.
class VertexNumbers {
  public:
    /// Takes vertices in any order, each any number of times.
    explicit VertexNumbers(std::vector<std::uint32_t> vertices) : vertices_(std::move(vertices)) {
        std::sort(vertices_.begin(), vertices_.end());
        vertices_.erase(std::unique(vertices_.begin(), vertices_.end()), vertices_.end());
        vertices_.shrink_to_fit();
        if (vertices_.empty()) {
            return;
        }
        starts_.reserve(vertices_.size() + 1);
        for (std::uint32_t number = 0; number < vertices_.size(); ++number) {
            while (starts_.size() <= bucket_of(vertices_[number])) {
                starts_.push_back(number);
            }
        }
        starts_.push_back(static_cast<std::uint32_t>(vertices_.size()));
    }

    const std::vector<std::uint32_t>& vertices() const { return vertices_; }
    std::size_t size() const { return vertices_.size(); }

    /// Returns the number of one of the vertices.
    std::uint32_t of(std::uint32_t vertex) const {
        const std::uint64_t bucket = bucket_of(vertex);
        const auto first = vertices_.begin() + starts_[bucket];
        const auto last = vertices_.begin() + starts_[bucket + 1];
        return static_cast<std::uint32_t>(std::lower_bound(first, last, vertex) -
                                          vertices_.begin());
    }

  private:
    /// Vertices are spread over as many buckets as there are.
    std::uint64_t bucket_of(std::uint32_t vertex) const {
        const std::uint64_t range = std::uint64_t{vertices_.back()} - vertices_.front() + 1;
        return (std::uint64_t{vertex} - vertices_.front()) * vertices_.size() / range;
    }

    std::vector<std::uint32_t> vertices_;
    std::vector<std::uint32_t> starts_; ///< First number in each bucket.
};

} // namespace geodisk
