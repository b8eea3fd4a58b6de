#include "parts/ranges/ranged_halo.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <queue>
#include <unordered_map>
#include <unordered_set>
#include <utility>

#include "mesh/connectivity.hpp"
#include "mesh/mesh_pieces.hpp"
#include "parts/halo.hpp"
#include "parts/ranges/homes.hpp"
#include "parts/ranges/vertex_numbers.hpp"

namespace geodisk {
namespace {

VertexNumbers numbers_of(std::span<const WholeFace> faces) {
    std::vector<std::uint32_t> vertices;
    vertices.reserve(3 * faces.size());
    for (const WholeFace& face : faces) {
        vertices.insert(vertices.end(), face.corners, face.corners + 3);
    }
    return VertexNumbers(std::move(vertices));
}

/// Own faces at each vertex.
class FacesAtVertices {
  public:
    explicit FacesAtVertices(std::span<const WholeFace> faces)
        : numbers_(numbers_of(faces)), starts_(numbers_.size() + 1, 0), faces_(3 * faces.size()) {
        for_corners(faces, [&](std::uint32_t vertex, std::uint32_t) { ++starts_[vertex + 1]; });
        for (std::size_t vertex = 1; vertex < starts_.size(); ++vertex) {
            starts_[vertex] += starts_[vertex - 1];
        }
        std::vector<std::uint32_t> next(starts_.begin(), starts_.end() - 1);
        for_corners(faces, [&](std::uint32_t vertex, std::uint32_t face) {
            faces_[next[vertex]++] = face;
        });
    }

    /// Returns the faces that take part, by their place among own ones.
    std::span<const std::uint32_t> at(std::uint32_t vertex) const {
        const std::uint32_t number = numbers_.of(vertex);
        return std::span(faces_).subspan(starts_[number], starts_[number + 1] - starts_[number]);
    }

  private:
    template <class Visit>
    void for_corners(std::span<const WholeFace> faces, const Visit& visit) const {
        for (std::uint32_t i = 0; i < faces.size(); ++i) {
            const auto& corners = faces[i].corners;
            if (takes_part({corners[0], corners[1], corners[2]})) {
                for (const std::uint32_t vertex : corners) {
                    visit(numbers_.of(vertex), i);
                }
            }
        }
    }

    VertexNumbers numbers_;
    std::vector<std::uint32_t> starts_, faces_;
};

/// Asks a process for its faces at a vertex, and so many rings of its faces in all.
struct Request {
    std::uint32_t vertex, rings;
};

constexpr std::uint32_t kMostRings = 64;
// Ways along edges are longer than distances, by about so much.
constexpr double kShorter = 0.75;
// Lower bounds are shorter still where angles are obtuse. There the halo has to grow again, and
// then takes ways for shorter by this factor each time, so that it needs few turns.
constexpr double kShorterEachTime = 0.5;

/// A halo that grows.
class Halo {
  public:
    Halo(Talk& talk, const KnownSurface& known, double reach)
        : talk_(talk), known_(known), reach_(reach), own_(known.faces),
          is_shared_(known.directory.shared().begin(), known.directory.shared().end()),
          mean_edge_(known.statistics.longest_edge) {
        for (const WholeFace& face : known.faces) {
            if (std::ranges::any_of(face.corners,
                                    [&](std::uint32_t v) { return is_shared_.contains(v); })) {
                rim_.push_back(face);
            }
        }
        for (const WholeFace& face : rim_) {
            for (const std::uint32_t vertex : face.corners) {
                // All faces at other own vertices are own ones.
                ways_[vertex] = {.length = 0, .is_complete = !is_shared_.contains(vertex)};
            }
        }
    }

    /// Adds rings until ways along edges are longer than the reach. Returns true if there was one.
    bool grow() {
        bool has_grown = false;
        for (;;) {
            const std::vector<std::uint32_t> open = open_within(reach_);
            if (talk_.sum(open.size()) == 0) {
                break;
            }
            has_grown = true;
            for (const std::uint32_t vertex : open) {
                ways_[vertex].is_complete = true;
            }
            add_rings(open);
        }
        shorter_ *= kShorterEachTime;
        return has_grown;
    }

    /// Shortens ways to lower bounds on distances.
    void measure() {
        std::vector<WholeFace> faces = rim_;
        for (const HaloFace& one : faces_) {
            faces.push_back(one.face);
        }
        std::ranges::sort(faces, {}, &WholeFace::face);
        const FacePlaces places = places_of(talk_, known_, faces);
        const auto turn = talk_.exchange().turn();
        const PreparedMesh mesh =
            MeshPieces::piece(MeshView{places.positions, places.triangles, 3}, known_.statistics);
        std::vector<std::uint8_t> is_own(faces.size());
        for (std::size_t i = 0; i < faces.size(); ++i) {
            is_own[i] = seen_.contains(faces[i].face) ? 0 : 1;
        }
        const std::vector<double> distances = distances_from(mesh, is_own, reach_);
        const VertexNumbers numbers = numbers_of(faces);
        for (std::size_t i = 0; i < numbers.size(); ++i) {
            ways_[numbers.vertices()[i]].length = distances[i];
        }
    }

    std::vector<HaloFace> take() {
        for (HaloFace& one : faces_) {
            const auto length = [&](std::uint32_t v) { return ways_[v].length; };
            const auto& [a, b, c] = one.face.corners;
            one.distance = std::min({length(a), length(b), length(c)});
        }
        std::erase_if(faces_, [&](const HaloFace& one) { return one.distance > reach_; });
        std::ranges::sort(faces_, {}, [](const HaloFace& one) { return one.face.face; });
        return std::move(faces_);
    }

  private:
    struct Edge {
        std::uint32_t end;
        float length; ///< Only decides how far the halo grows at a time.
    };

    /// Length of a way from own faces, whether all faces at its end are known, and edges there.
    struct Way {
        double length = HUGE_VAL;
        bool is_complete = false;
        std::vector<Edge> edges{};
    };

    /// Returns the vertices, in ascending order, to which a way is no longer than `limit`, and
    /// whose faces are not all known.
    std::vector<std::uint32_t> open_within(double limit) const {
        std::vector<std::uint32_t> open;
        for (const auto& [vertex, way] : ways_) {
            if (!way.is_complete && way.length <= limit) {
                open.push_back(vertex);
            }
        }
        std::ranges::sort(open);
        return open;
    }

    /// Asks for the faces at open vertices, and as many rings around them as the reach takes.
    void add_rings(const std::vector<std::uint32_t>& open) {
        const auto asked = talk_.swap(by_home(known_.vertices, open));
        ByProcess<std::uint32_t> told(talk_.size());
        for (std::uint32_t other = 0; other < talk_.size(); ++other) {
            for (const std::uint32_t vertex : asked[other]) {
                const auto holders = known_.directory.holders(vertex);
                told[other].push_back(static_cast<std::uint32_t>(holders.size()));
                told[other].insert(told[other].end(), holders.begin(), holders.end());
            }
        }
        ByProcess<Request> wanted(talk_.size());
        auto vertex = open.begin();
        for (const auto& heard : talk_.swap(std::move(told))) {
            for (std::size_t at = 0; at < heard.size(); at += 1 + heard[at]) {
                for (const std::uint32_t holder : std::span(heard).subspan(at + 1, heard[at])) {
                    if (holder != talk_.rank()) {
                        wanted[holder].push_back({*vertex, rings_from(ways_[*vertex].length)});
                    }
                }
                ++vertex;
            }
        }
        const auto requests = talk_.swap(std::move(wanted));
        ByProcess<WholeFace> faces(talk_.size());
        ByProcess<std::uint32_t> complete(talk_.size());
        for (std::uint32_t other = 0; other < talk_.size(); ++other) {
            answer(requests[other], faces[other], complete[other]);
        }
        faces = talk_.swap(std::move(faces));
        complete = talk_.swap(std::move(complete));
        const std::size_t before = faces_.size();
        for (std::uint32_t owner = 0; owner < talk_.size(); ++owner) {
            for (const WholeFace& face : faces[owner]) {
                if (seen_.insert(face.face).second) {
                    faces_.push_back({face, owner, 0});
                }
            }
            for (const std::uint32_t one : complete[owner]) {
                ways_[one].is_complete = true;
            }
        }
        follow_edges(before);
    }

    std::uint32_t rings_from(double length) const {
        return 1 + static_cast<std::uint32_t>(
                       std::min<double>(kMostRings, (reach_ - length) / mean_edge_));
    }

    /// Finds the own faces that another process asks for, and vertices of which these are all.
    void answer(const std::vector<Request>& requests, std::vector<WholeFace>& faces,
                std::vector<std::uint32_t>& complete) const {
        ByProcess<std::uint32_t> by_rings(kMostRings + 2);
        for (const Request& request : requests) {
            by_rings[std::min(request.rings, kMostRings + 1)].push_back(request.vertex);
        }
        std::unordered_set<std::uint32_t> vertices, sent;
        for (std::uint32_t rings = kMostRings + 1; rings > 0; --rings) {
            for (const std::uint32_t vertex : by_rings[rings]) {
                if (!vertices.insert(vertex).second) {
                    continue;
                }
                if (!is_shared_.contains(vertex)) {
                    complete.push_back(vertex);
                }
                for (const std::uint32_t i : own_.at(vertex)) {
                    if (sent.insert(i).second) {
                        faces.push_back(known_.faces[i]);
                    }
                    const auto& corners = known_.faces[i].corners;
                    by_rings[rings - 1].insert(by_rings[rings - 1].end(), corners, corners + 3);
                }
            }
            by_rings[rings] = {};
        }
    }

    /// Takes ways along the edges of the newest faces.
    void follow_edges(std::size_t first) {
        std::vector<WholeFace> newest;
        for (const HaloFace& one : std::span(faces_).subspan(first)) {
            newest.push_back(one.face);
        }
        const VertexNumbers numbers = numbers_of(newest);
        const std::vector<double> positions =
            fetch_positions(talk_, known_.vertices, known_.positions, numbers.vertices());
        const auto between = [&](std::uint32_t from, std::uint32_t to) {
            const double* const a = &positions[std::size_t{3} * numbers.of(from)];
            const double* const b = &positions[std::size_t{3} * numbers.of(to)];
            return std::hypot(b[0] - a[0], b[1] - a[1], b[2] - a[2]);
        };
        std::vector<std::uint32_t> changed;
        for (const WholeFace& face : newest) {
            for (int side = 0; side < 3; ++side) {
                const std::uint32_t from = face.corners[side], to = face.corners[(side + 1) % 3];
                const double length = between(from, to);
                edges_ += length;
                ways_[from].edges.push_back({to, static_cast<float>(length)});
                ways_[to].edges.push_back({from, static_cast<float>(length)});
                changed.push_back(from);
            }
        }
        shorten(std::move(changed));
        if (edges_ > 0) {
            mean_edge_ = edges_ / (3.0 * static_cast<double>(faces_.size()));
        }
    }

    /// Shortens ways that lead through vertices that have changed.
    void shorten(std::vector<std::uint32_t> changed) {
        using Entry = std::pair<double, std::uint32_t>;
        std::priority_queue<Entry, std::vector<Entry>, std::greater<>> next;
        for (const std::uint32_t vertex : changed) {
            next.emplace(ways_[vertex].length, vertex);
        }
        while (!next.empty()) {
            const auto [length, vertex] = next.top();
            next.pop();
            const Way& way = ways_[vertex];
            if (length > way.length) {
                continue;
            }
            for (const Edge& edge : way.edges) {
                double& there = ways_[edge.end].length;
                if (length + shorter_ * edge.length < there) {
                    there = length + shorter_ * edge.length;
                    next.emplace(there, edge.end);
                }
            }
        }
    }

    Talk& talk_;
    const KnownSurface& known_;
    double reach_;
    double shorter_ = kShorter; ///< For ways along edges, when it grows next.
    FacesAtVertices own_;
    std::unordered_set<std::uint32_t> is_shared_; ///< Own vertices that others hold too.
    double mean_edge_, edges_ = 0;                ///< Edges of the halo.
    std::vector<WholeFace> rim_;                  ///< Own faces at vertices that are shared.
    std::unordered_map<std::uint32_t, Way> ways_;
    std::unordered_set<std::uint32_t> seen_; ///< Faces of the halo.
    std::vector<HaloFace> faces_;
};

} // namespace

FacePlaces places_of(Talk& talk, const KnownSurface& known, std::span<const WholeFace> faces) {
    FacePlaces places;
    const VertexNumbers numbers = numbers_of(faces);
    places.positions = fetch_positions(talk, known.vertices, known.positions, numbers.vertices());
    places.triangles.reserve(3 * faces.size());
    for (const WholeFace& face : faces) {
        for (const std::uint32_t vertex : face.corners) {
            places.triangles.push_back(numbers.of(vertex));
        }
    }
    return places;
}

// Every path out of a piece leaves it at a vertex, or between two, whose faces are not all known.
// Where the lower bounds there are beyond the reach, so is all that is outside.
std::vector<HaloFace> find_halo(Talk& talk, const KnownSurface& known, double reach) {
    Halo halo(talk, known, reach);
    while (halo.grow()) {
        halo.measure();
    }
    return halo.take();
}

} // namespace geodisk
