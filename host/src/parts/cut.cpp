#include "parts/cut.hpp"

#include <algorithm>
#include <numeric>
#include <string>

#include "engine/domain/stages.hpp"
#include "support/invalid.hpp"

namespace geodisk {
namespace {

/// Calls `visit` for each face that shares an edge with this one.
template <class Visit>
void for_faces_beside(const PreparedMesh& mesh, std::uint32_t face, const Visit& visit) {
    for (std::uint32_t h = 3 * face; h < 3 * face + 3; ++h) {
        const auto next = [&](std::uint32_t edge) {
            return around_half_edge(mesh.half_edges()[edge].around);
        };
        for (std::uint32_t other = next(h); other != h; other = next(other)) {
            visit(other / 3);
        }
    }
}

/// Faces that are still to be cut into parts.
struct Piece {
    std::size_t begin, end;     ///< Of the faces.
    std::uint32_t first, parts; ///< Number of the first part, and how many there are.
};

/// Puts the faces of a piece in order from one end to the other.
class Halving {
  public:
    explicit Halving(const PreparedMesh& mesh)
        : mesh_(mesh), piece_of_(mesh.face_count(), 0), next_(mesh.face_count()) {}

    void put_far_ends_apart(std::span<std::uint32_t> faces) {
        walk(faces, faces.front());
        walk(faces, faces.back());
    }

  private:
    /// Puts the faces in the order in which a walk from face to face across edges comes to them,
    /// and then to those that no edges join to them.
    void walk(std::span<std::uint32_t> faces, std::uint32_t from) {
        ++walk_;
        for (const std::uint32_t face : faces) {
            piece_of_[face] = walk_;
        }
        std::size_t seen = 0, visited = 0;
        const auto see = [&](std::uint32_t face) {
            if (piece_of_[face] == walk_) {
                piece_of_[face] = 0;
                next_[seen++] = face;
            }
        };
        see(from);
        for (const std::uint32_t first : faces) {
            see(first);
            for (; visited < seen; ++visited) {
                for_faces_beside(mesh_, next_[visited], see);
            }
        }
        std::copy_n(next_.begin(), seen, faces.begin());
    }

    const PreparedMesh& mesh_;
    std::vector<std::uint32_t> piece_of_; ///< Number of the walk that is still to come to a face.
    std::vector<std::uint32_t> next_;
    std::uint32_t walk_ = 0;
};

/// Returns how many of the faces of some parts, from the first on, are those of the first of them.
std::size_t cut_at(std::span<const std::uint32_t> faces, std::span<const double> work,
                   std::uint32_t first, std::uint32_t parts) {
    double all = 0, done = 0;
    for (const std::uint32_t face : faces) {
        all += work[face];
    }
    std::size_t count = 0;
    while (count < faces.size() && (count < first || done < all * first / parts)) {
        done += work[faces[count++]];
    }
    return std::min(count, faces.size() - (parts - first));
}

} // namespace

std::vector<double> work_of_faces(const PreparedMesh& mesh, const SampleParams& params) {
    const double samples = effective_area(mesh, params);
    std::vector<double> work(mesh.face_count());
    for (std::uint32_t face = 0; face < mesh.face_count(); ++face) {
        work[face] =
            (expected_in_face(mesh, params, face, 1) / samples + 1.0 / mesh.face_count()) / 2;
    }
    return work;
}

Result<Done> check_processes(const PreparedMesh& mesh, std::uint32_t processes) {
    const std::uint32_t faces = mesh.face_count();
    if (processes > faces) {
        return invalid("there are " + std::to_string(processes) + " processes, but the mesh has " +
                       std::to_string(faces) + " faces; start at most as many processes");
    }
    return Done{};
}

std::vector<std::uint32_t> halved_parts(const PreparedMesh& mesh, std::span<const double> work,
                                        std::uint32_t parts) {
    std::vector<std::uint32_t> part_of(mesh.face_count());
    std::vector<std::uint32_t> faces(mesh.face_count());
    std::iota(faces.begin(), faces.end(), 0u);
    Halving halving(mesh);
    std::vector<Piece> pieces{{0, faces.size(), 0, parts}};
    while (!pieces.empty()) {
        const Piece piece = pieces.back();
        pieces.pop_back();
        const auto own = std::span(faces).subspan(piece.begin, piece.end - piece.begin);
        if (piece.parts == 1) {
            for (const std::uint32_t face : own) {
                part_of[face] = piece.first;
            }
            continue;
        }
        halving.put_far_ends_apart(own);
        const std::uint32_t left = piece.parts / 2;
        const std::size_t middle = piece.begin + cut_at(own, work, left, piece.parts);
        pieces.push_back({middle, piece.end, piece.first + left, piece.parts - left});
        pieces.push_back({piece.begin, middle, piece.first, left});
    }
    return part_of;
}

} // namespace geodisk
