#include "parts/cut.hpp"

#include <algorithm>
#include <numeric>
#include <string>

#include "engine/domain/stages.hpp"
#include "support/blocks.hpp"
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

/// Halves pieces of a surface, all at once.
class Halving {
  public:
    Halving(const PreparedMesh& mesh, std::span<const double> work)
        : mesh_(mesh), work_(work), piece_of_(mesh.face_count(), 0), faces_(mesh.face_count()),
          next_(mesh.face_count()), walk_of_(mesh.face_count(), 0) {
        std::iota(faces_.begin(), faces_.end(), 0u);
    }

    std::vector<std::uint32_t> parts(std::uint32_t count) && {
        std::vector<Piece> pieces{{0, faces_.size(), 0, count}};
        while (!pieces.empty()) {
            for_parts({}, pieces.size(), [&](std::size_t i) { put_far_ends_apart(pieces[i]); });
            std::vector<Piece> halves;
            for (const Piece& piece : pieces) {
                const std::uint32_t left = piece.parts / 2;
                const std::size_t middle =
                    piece.begin + cut_at(faces_of(piece), work_, left, piece.parts);
                halves.push_back({piece.begin, middle, piece.first, left});
                halves.push_back({middle, piece.end, piece.first + left, piece.parts - left});
            }
            for_parts({}, halves.size(), [&](std::size_t i) {
                for (const std::uint32_t face : faces_of(halves[i])) {
                    piece_of_[face] = halves[i].first;
                }
            });
            std::erase_if(halves, [](const Piece& piece) { return piece.parts == 1; });
            pieces = std::move(halves);
            walks_ += 2;
        }
        return std::move(piece_of_);
    }

  private:
    std::span<std::uint32_t> faces_of(const Piece& piece) {
        return std::span(faces_).subspan(piece.begin, piece.end - piece.begin);
    }

    /// Puts the faces of a piece in order from one end to the other.
    void put_far_ends_apart(const Piece& piece) {
        walk(piece, faces_of(piece).front(), static_cast<std::uint8_t>(walks_ + 1));
        walk(piece, faces_of(piece).back(), static_cast<std::uint8_t>(walks_ + 2));
    }

    /// Puts the faces in the order in which a walk from face to face across edges comes to them,
    /// and then to those that no edges join to them.
    void walk(const Piece& piece, std::uint32_t from, std::uint8_t number) {
        const auto faces = faces_of(piece);
        const auto next = std::span(next_).subspan(piece.begin, faces.size());
        std::size_t seen = 0, visited = 0;
        const auto see = [&](std::uint32_t face) {
            if (piece_of_[face] == piece.first && walk_of_[face] != number) {
                walk_of_[face] = number;
                next[seen++] = face;
            }
        };
        see(from);
        for (const std::uint32_t first : faces) {
            see(first);
            for (; visited < seen; ++visited) {
                for_faces_beside(mesh_, next[visited], see);
            }
        }
        std::ranges::copy(next, faces.begin());
    }

    const PreparedMesh& mesh_;
    std::span<const double> work_;
    std::vector<std::uint32_t> piece_of_; ///< First part of the piece of each face.
    std::vector<std::uint32_t> faces_;    ///< Piece by piece.
    std::vector<std::uint32_t> next_;
    std::vector<std::uint8_t> walk_of_; ///< Number of the last walk that came to a face.
    std::uint32_t walks_ = 0;           ///< Two for each time that pieces were halved.
};

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
    return parts > 1 ? Halving(mesh, work).parts(parts)
                     : std::vector<std::uint32_t>(mesh.face_count(), 0);
}

} // namespace geodisk
