// FaceSet: some faces of a mesh, cleared without a pass over all.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

namespace geodisk {

/// A set of faces in the order of their insertion. Keeps a word per face of the mesh.
class FaceSet {
  public:
    /// Empties it, for a mesh of this many faces.
    void clear(std::uint32_t faces) {
        members_.clear();
        grow(faces);
        if (++stamp_ == 0) {
            std::ranges::fill(stamps_, 0u);
            stamp_ = 1;
        }
    }
    /// Keeps it, for a mesh of at least this many faces.
    void grow(std::uint32_t faces) {
        stamps_.resize(std::max<std::size_t>(stamps_.size(), faces), 0);
    }
    /// Inserts a face. Returns true if it was not there.
    bool insert(std::uint32_t face) {
        if (has(face)) {
            return false;
        }
        stamps_[face] = stamp_;
        members_.push_back(face);
        return true;
    }
    bool has(std::uint32_t face) const { return stamps_[face] == stamp_; }
    const std::vector<std::uint32_t>& members() const { return members_; }
    bool empty() const { return members_.empty(); }
    std::size_t size() const { return members_.size(); }

  private:
    std::vector<std::uint32_t> members_;
    std::vector<std::uint32_t> stamps_;
    std::uint32_t stamp_ = 1;
};

} // namespace geodisk
