#include "engine/update/live_mesh.hpp"

#include <algorithm>
#include <numeric>

namespace geodisk {

LiveMesh::LiveMesh(const MeshView& mesh)
    : faces_(mesh.face_count()), starts_(mesh.vertex_count() + 1, 0) {
    for (std::size_t f = 0; f < faces_.size(); ++f) {
        faces_[f] = mesh.triangles.face(f);
        if (takes_part(faces_[f])) {
            for (const std::uint32_t vertex : faces_[f]) {
                ++starts_[vertex];
            }
        }
    }
    std::partial_sum(starts_.begin(), starts_.end(), starts_.begin());
    at_.resize(starts_.back());
    for (std::uint32_t f = face_count(); f-- > 0;) {
        if (takes_part(faces_[f])) {
            for (const std::uint32_t vertex : faces_[f]) {
                at_[--starts_[vertex]] = f;
            }
        }
    }
}

std::span<const std::uint32_t> LiveMesh::faces_at(std::uint32_t vertex) const {
    if (const auto own = edited_.find(vertex); own != edited_.end()) {
        return own->second;
    }
    if (std::size_t{vertex} + 1 >= starts_.size()) {
        return {};
    }
    return std::span(at_).subspan(starts_[vertex], starts_[vertex + 1] - starts_[vertex]);
}

std::vector<std::uint32_t>& LiveMesh::own_list(std::uint32_t vertex) {
    const auto before = faces_at(vertex);
    const auto [own, is_new] = edited_.try_emplace(vertex);
    if (is_new) {
        own->second.assign(before.begin(), before.end());
    }
    return own->second;
}

void LiveMesh::set(std::uint32_t face, const Corners& corners) {
    if (faces_[face] == corners) {
        return;
    }
    if (takes_part(face)) {
        for (const std::uint32_t vertex : faces_[face]) {
            std::erase(own_list(vertex), face);
        }
    }
    faces_[face] = corners;
    if (takes_part(face)) {
        for (const std::uint32_t vertex : corners) {
            std::vector<std::uint32_t>& list = own_list(vertex);
            list.insert(std::ranges::lower_bound(list, face), face);
        }
    }
}

} // namespace geodisk
