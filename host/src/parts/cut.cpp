#include "parts/cut.hpp"

#include <deque>
#include <string>

#include "engine/domain/stages.hpp"
#include "support/invalid.hpp"

namespace geodisk {
namespace {

constexpr std::uint32_t kNone = ~std::uint32_t{0};

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

std::vector<std::uint32_t> grown_parts(const PreparedMesh& mesh, std::span<const double> work,
                                       std::uint32_t parts) {
    const std::uint32_t faces = mesh.face_count();
    std::vector<std::uint32_t> part_of(faces, kNone);
    std::vector<std::uint32_t> seen(faces, kNone); // By the last part that saw the face.
    std::deque<std::uint32_t> next;
    double done = 0;
    std::uint32_t taken = 0, first_left = 0;
    for (std::uint32_t part = 0; part < parts; ++part) {
        // The next part goes on from the first face that this one leaves.
        if (!next.empty()) {
            next.resize(1);
            seen[next.front()] = part;
        }
        const double end = static_cast<double>(part + 1) / parts;
        const bool is_last = part + 1 == parts;
        for (bool is_empty = true; is_empty || is_last || done < end; is_empty = false) {
            if (faces - taken <= parts - part - 1) {
                break; // One face for each part that follows.
            }
            if (next.empty()) {
                while (first_left < faces && part_of[first_left] != kNone) {
                    ++first_left;
                }
                if (first_left == faces) {
                    break;
                }
                next.push_back(first_left);
                seen[first_left] = part;
            }
            const std::uint32_t face = next.front();
            next.pop_front();
            part_of[face] = part;
            done += work[face];
            ++taken;
            for_faces_beside(mesh, face, [&](std::uint32_t other) {
                if (part_of[other] == kNone && seen[other] != part) {
                    seen[other] = part;
                    next.push_back(other);
                }
            });
        }
    }
    return part_of;
}

} // namespace geodisk
