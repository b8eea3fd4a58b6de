#include "geometry/covered_parts.hpp"

#include <algorithm>
#include <functional>
#include <limits>
#include <queue>
#include <utility>

#include "geometry/mesh_parts.hpp"

namespace geodisk::tools {
namespace {

/// Factor on bounds, for the rounding of single precision.
constexpr double kMargin = 1.01;

double longest_edge(const PreparedMesh& mesh, std::uint32_t face) {
    const auto edges = mesh.half_edges().subspan(std::size_t{3} * face, 3);
    return std::max({edges[0].length, edges[1].length, edges[2].length});
}

bool takes_part(const PreparedMesh& mesh, std::uint32_t face) {
    const auto edges = mesh.half_edges().subspan(std::size_t{3} * face, 3);
    return edges[0].origin != edges[1].origin && edges[1].origin != edges[2].origin &&
           edges[2].origin != edges[0].origin;
}

/// Finds the faces within a distance, one point after the other.
class Reach {
  public:
    explicit Reach(const PreparedMesh& mesh)
        : mesh_(mesh), bounds_(mesh.face_count(), std::numeric_limits<double>::infinity()) {}

    /// Returns the faces that hang together with `first` by edges; none if the bound of one of them
    /// is larger than `radius`.
    const std::vector<std::uint32_t>& all_around(std::uint32_t first, double radius) {
        for (const std::uint32_t face : seen_) {
            bounds_[face] = std::numeric_limits<double>::infinity();
        }
        seen_.clear();
        std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
        const auto reach = [&](std::uint32_t face, double before) {
            const double bound = before + kMargin * longest_edge(mesh_, face);
            if (bound < bounds_[face]) {
                if (bounds_[face] == std::numeric_limits<double>::infinity()) {
                    seen_.push_back(face);
                }
                bounds_[face] = bound;
                queue.emplace(bound, face);
            }
        };
        reach(first, 0);
        while (!queue.empty()) {
            const auto [bound, face] = queue.top();
            queue.pop();
            if (!(bound <= radius)) {
                last_.clear();
                return last_;
            }
            for (std::uint32_t edge = 3 * face; bound == bounds_[face] && edge < 3 * face + 3;
                 ++edge) {
                for (std::uint32_t other = around_half_edge(mesh_.half_edges()[edge].around);
                     other != edge; other = around_half_edge(mesh_.half_edges()[other].around)) {
                    reach(other / 3, bound);
                }
            }
        }
        last_ = seen_;
        return last_;
    }

  private:
    using Entry = std::pair<double, std::uint32_t>;

    const PreparedMesh& mesh_;
    std::vector<double> bounds_;      ///< Indexed by face: distance of its farthest point.
    std::vector<std::uint32_t> seen_; ///< Faces with a bound.
    std::vector<std::uint32_t> last_;
};

/// Returns the number of faces of the part of each face: parts that touch in a vertex are one.
std::vector<std::size_t> part_sizes(const PreparedMesh& mesh) {
    const std::vector<std::uint32_t> parts = part_of_faces(mesh);
    std::vector<std::size_t> counts(parts.size()), sizes(parts.size());
    for (const std::uint32_t part : parts) {
        counts[part == kNoPart ? 0 : part] += part != kNoPart;
    }
    for (std::size_t face = 0; face < parts.size(); ++face) {
        sizes[face] = parts[face] == kNoPart ? 0 : counts[parts[face]];
    }
    return sizes;
}

} // namespace

bool CoveredParts::cover_all(const PreparedMesh& mesh,
                             std::span<const std::uint8_t> face_mask) const {
    for (std::uint32_t face = 0; face < mesh.face_count(); ++face) {
        const bool may_have_samples =
            takes_part(mesh, face) && (face_mask.empty() || face_mask[face] != 0);
        if (may_have_samples && (faces.empty() || faces[face] == 0)) {
            return false;
        }
    }
    return true;
}

CoveredParts covered_parts(const PreparedMesh& mesh, std::span<const KeepOut> avoid) {
    CoveredParts covered;
    std::vector<std::size_t> sizes;
    std::vector<std::uint8_t> covers(avoid.size());
    Reach reach(mesh);
    for (std::size_t i = 0; i < avoid.size(); ++i) {
        const auto& [center, radius] = avoid[i];
        if (!covered.faces.empty() && covered.faces[center.face] != 0) {
            continue;
        }
        const std::vector<std::uint32_t>& all = reach.all_around(center.face, radius);
        if (all.empty()) {
            continue;
        }
        if (sizes.empty()) {
            sizes = part_sizes(mesh);
        }
        if (all.size() == sizes[center.face]) {
            covers[i] = 1;
            covered.faces.resize(mesh.face_count());
            for (const std::uint32_t face : all) {
                covered.faces[face] = 1;
            }
        }
    }
    for (std::size_t i = 0; i < avoid.size(); ++i) {
        const std::uint32_t face = avoid[i].center.face;
        if (covers[i] != 0 || covered.faces.empty() || covered.faces[face] == 0) {
            covered.needed.push_back(avoid[i]);
        }
    }
    return covered;
}

} // namespace geodisk::tools
