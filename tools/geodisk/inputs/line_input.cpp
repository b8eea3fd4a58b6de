#include "geodisk/inputs/line_input.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <span>
#include <utility>

#include "geodisk/options/distance_options.hpp"
#include "geometry/crease_edges.hpp"
#include "geometry/nearest_face.hpp"
#include "program/failure.hpp"
#include "program/human_text.hpp"
#include "program/interrupt.hpp"

namespace geodisk::tools {
namespace {

/// Length of a piece of a line between two disks, as a part of its radius.
constexpr double kPiece = 1.0 / 8;
/// The nearest point may jump from one side of a fold to the other; so short a part of a piece is
/// halved no further.
constexpr double kJump = 0x1p-20;

double length_of(const Vector& a, const Vector& b) {
    double length = 0;
    for (std::size_t axis = 0; axis < a.size(); ++axis) {
        length = std::hypot(length, b[axis] - a[axis]);
    }
    return length;
}

Vector between(const Vector& a, const Vector& b, double part) {
    Vector point{};
    for (std::size_t axis = 0; axis < a.size(); ++axis) {
        point[axis] = a[axis] + part * (b[axis] - a[axis]);
    }
    return point;
}

/// A point of a line, on the surface.
struct Place {
    Sample sample;
    Vector point;
    double radius;
    KeepOut* disk; ///< Grows with the pieces at the place.
};

/// A point of a face in the frame of one of its half-edges, which begins at (0, 0) and goes along
/// x.
struct InFrame {
    double x, y;

    InFrame(const PreparedMesh& mesh, const Sample& sample, std::uint32_t edge) {
        const HalfEdge& frame = mesh.half_edges()[edge];
        const double next = sample.weights[next_in_face(edge) % 3];
        const double apex = sample.weights[next_in_face(next_in_face(edge)) % 3];
        x = next * frame.length + apex * frame.apex_x;
        y = apex * frame.apex_y;
    }
};

/// Returns the length of a path over the faces of both points, if these have a corner in common;
/// infinity for others.
double path_between(const PreparedMesh& mesh, const Sample& a, const Sample& b) {
    const auto edges = mesh.half_edges();
    if (a.face == b.face) {
        const InFrame first(mesh, a, 3 * a.face), second(mesh, b, 3 * a.face);
        return std::hypot(second.x - first.x, second.y - first.y);
    }
    double shortest = std::numeric_limits<double>::infinity();
    for (std::uint32_t h = 3 * a.face; h < 3 * a.face + 3; ++h) {
        for (std::uint32_t other = 3 * b.face; other < 3 * b.face + 3; ++other) {
            const InFrame first(mesh, a, h);
            InFrame second(mesh, b, other);
            const std::uint32_t from = edges[h].origin, to = edges[next_in_face(h)].origin;
            const std::uint32_t start = edges[other].origin;
            if (start == from) { // Over the corner that both half-edges begin at.
                shortest = std::min(shortest,
                                    std::hypot(first.x, first.y) + std::hypot(second.x, second.y));
            }
            const std::uint32_t end = edges[next_in_face(other)].origin;
            const bool is_turned = start == to && end == from;
            if (!is_turned && !(start == from && end == to)) {
                continue;
            }
            // Over the edge, where a straight line crosses it.
            const double length = edges[h].length;
            second.x = is_turned ? length - second.x : second.x;
            const double away = first.y + second.y;
            const double at = away > 0 ? (first.x * second.y + second.x * first.y) / away : first.x;
            const double x = std::clamp(at, 0.0, length);
            shortest = std::min(shortest, std::hypot(first.x - x, first.y) +
                                              std::hypot(second.x - x, second.y));
        }
    }
    return shortest;
}

/// Covers one line after the other.
class Cover {
  public:
    Cover(const MeshInput& mesh, const std::string& path, const std::string& tolerance,
          std::vector<KeepOut>& between)
        : mesh_(mesh), path_(path), faces_(mesh.file),
          tolerance_(tolerance_on(tolerance, faces_.diagonal())), between_(between) {}

    double length() const { return length_; }

    /// Covers the line between two places.
    void add(const Place& a, const Place& b) {
        check_interrupted();
        const double piece = kPiece * std::min(a.radius, b.radius);
        const double path = path_between(mesh_.prepared, a.sample, b.sample);
        if (path <= piece) {
            const double radius = std::max(a.radius, b.radius) + path / 2;
            a.disk->radius = std::max(a.disk->radius, radius);
            b.disk->radius = std::max(b.disk->radius, radius);
            length_ += path;
            return;
        }
        if (length_of(a.point, b.point) <= kJump * piece) {
            return;
        }
        KeepOut disk{};
        const Place middle = place_between(a, b, disk);
        add(a, middle);
        add(middle, b);
        between_.push_back(disk);
    }

  private:
    Place place_between(const Place& a, const Place& b, KeepOut& disk) const {
        const Vector point = between(a.point, b.point, 0.5);
        const SurfacePoint nearest = faces_.find(std::span(point).first(mesh_.dimension()));
        if (nearest.distance > tolerance_) {
            fail_input(path_, "a line leaves " + mesh_.path + ": its point" + text_of(point) +
                                  " is " + rounded(nearest.distance, 3) +
                                  " away; give it more points, or raise --tolerance");
        }
        Place place{{nearest.face, {}}, {}, (a.radius + b.radius) / 2, &disk};
        for (std::size_t corner = 0; corner < 3; ++corner) {
            place.sample.weights[corner] = static_cast<float>(nearest.weights[corner]);
        }
        place.point = mesh_.point(place.sample.face, place.sample.weights);
        disk = {place.sample, place.radius};
        return place;
    }

    std::string text_of(const Vector& point) const {
        std::string text;
        for (std::size_t axis = 0; axis < mesh_.dimension(); ++axis) {
            text += ' ' + rounded(point[axis], 6);
        }
        return text;
    }

    const MeshInput& mesh_;
    const std::string& path_;
    NearestFace faces_;
    double tolerance_;
    std::vector<KeepOut>& between_;
    double length_ = 0;
};

bool is_border(const PreparedMesh& mesh, std::uint32_t edge) {
    return around_half_edge(mesh.half_edges()[edge].around) == edge;
}

/// Returns the edges of a kind, each by one of its half-edges.
std::vector<std::uint32_t> edges_of(const MeshInput& mesh, AvoidOption::Kind kind) {
    std::vector<std::uint32_t> found;
    if (kind == AvoidOption::Kind::border) {
        for (std::uint32_t edge = 0; edge < mesh.prepared.half_edges().size(); ++edge) {
            if (mesh.file.takes_part(edge / 3) && is_border(mesh.prepared, edge)) {
                found.push_back(edge);
            }
        }
        return found;
    }
    if (mesh.dimension() == 0) {
        fail_usage("--avoid creases needs the coordinates of the mesh, and it has edge lengths "
                   "alone");
    }
    return crease_edges({mesh.file.positions, mesh.file.triangles, mesh.file.dimension},
                        mesh.prepared);
}

} // namespace

LineCover::LineCover(const MeshInput& mesh, std::string path, std::string tolerance)
    : mesh_(mesh), path_(std::move(path)), tolerance_(std::move(tolerance)) {}

double LineCover::cover(const SampleFile& file, std::size_t first, std::vector<KeepOut>& disks,
                        std::vector<KeepOut>& between) const {
    if (file.segments.empty()) {
        return 0;
    }
    if (mesh_.dimension() == 0) {
        fail_input(path_, "has lines, which need the coordinates of the mesh, and it has edge "
                          "lengths alone");
    }
    Cover cover(mesh_, path_, tolerance_, between);
    // Radii of the points alone, before the disks grow.
    std::vector<Place> places;
    for (std::size_t i = first; i < first + file.rows.size(); ++i) {
        const Sample& sample = disks[i].center;
        places.push_back(
            {sample, mesh_.point(sample.face, sample.weights), disks[i].radius, &disks[i]});
    }
    for (const auto& [a, b] : file.segments) {
        cover.add(places[a], places[b]);
    }
    return cover.length();
}

double cover_edges(const MeshInput& mesh, AvoidOption::Kind kind, double radius,
                   std::vector<KeepOut>& disks) {
    constexpr std::size_t kNone = std::numeric_limits<std::size_t>::max();
    const auto edges = mesh.prepared.half_edges();
    std::vector<std::size_t> disk_of(mesh.prepared.fans().size(), kNone); // By vertex.
    double length = 0;
    for (const std::uint32_t edge : edges_of(mesh, kind)) {
        const double all = edges[edge].length;
        const double pieces = std::max(1.0, std::ceil(all / (kPiece * radius)));
        const double wider = radius + all / pieces / 2;
        const std::uint32_t next = next_in_face(edge);
        for (double i = 0; i <= pieces; ++i) {
            Sample sample{edge / 3, {}};
            sample.weights[next % 3] = static_cast<float>(i / pieces);
            sample.weights[edge % 3] = 1 - sample.weights[next % 3];
            if (i > 0 && i < pieces) {
                disks.push_back({sample, wider});
                continue;
            }
            std::size_t& known = disk_of[edges[i == 0 ? edge : next].origin];
            if (known == kNone) {
                known = disks.size();
                disks.push_back({sample, wider});
            }
            disks[known].radius = std::max(disks[known].radius, wider);
        }
        length += all;
    }
    return length;
}

} // namespace geodisk::tools
