#include "parts/ranges/ranged_halo.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <iterator>
#include <numeric>
#include <queue>
#include <unordered_set>
#include <utility>

#include "mesh/connectivity.hpp"
#include "mesh/mesh_pieces.hpp"
#include "parts/halo.hpp"
#include "parts/ranges/homes.hpp"
#include "parts/ranges/nearest_place.hpp"
#include "parts/ranges/vertex_numbers.hpp"
#include "support/free_memory.hpp"

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

constexpr std::uint32_t kMaxRings = 64;
// Ways along edges are longer than distances, by about so much.
constexpr double kShorter = 0.75;
// Lower bounds are shorter still where angles are obtuse, and now and then far too short where the
// halo ends. There it has to grow again, by so many rings, and then by more of them each time.
constexpr std::uint32_t kFirstRings = 2;
constexpr double kFar = 1.25; // So much farther than a reach is far enough.
constexpr double kRounded = 1 - 0x1p-40;

/// A halo that grows. All of it is in flat arrays, since each part of a process has one.
class Halo {
  public:
    Halo(Talk& talk, const KnownSurface& known, double reach)
        : talk_(talk), known_(known), reach_(reach), own_(known.faces),
          mean_edge_(known.statistics.longest_edge) {
        for (const WholeFace& face : known.faces) {
            if (std::ranges::any_of(face.corners, [&](std::uint32_t v) { return is_shared(v); })) {
                rim_.push_back(face);
            }
        }
        numbers_ = numbers_of(rim_);
        for (const std::uint32_t vertex : numbers_.vertices()) {
            lengths_.push_back(0);
            // All faces at other own vertices are own ones.
            is_complete_.push_back(is_shared(vertex) ? 0 : 1);
        }
    }

    /// Adds rings until ways along edges are longer than the reach; once measured, a few where
    /// lower bounds are not. Returns true if there was one.
    bool grow() {
        bool has_grown = false;
        for (;;) {
            const std::vector<std::uint32_t> open = open_within(reach_);
            if (talk_.sum(open.size()) == 0) {
                break;
            }
            has_grown = true;
            add_rings(open);
            if (rings_ > 0) {
                break;
            }
        }
        rings_ = rings_ > 0 ? std::min(kMaxRings, 2 * rings_) : kFirstRings;
        return has_grown;
    }

    /// Shortens ways to lower bounds on distances.
    void measure() {
        std::vector<WholeFace> faces = rim_;
        faces.reserve(rim_.size() + faces_.size());
        for (const Member& one : faces_) {
            faces.push_back(one.face);
        }
        std::ranges::sort(faces, {}, &WholeFace::face);
        const FacePlaces places = places_of(talk_, known_, faces);
        const auto turn = talk_.exchange().turn();
        const PreparedMesh mesh =
            MeshPieces::piece(MeshView{places.positions, places.triangles, 3}, known_.statistics);
        std::vector<std::uint8_t> is_own(faces.size());
        std::vector<std::uint32_t> own;
        for (std::uint32_t i = 0; i < faces.size(); ++i) {
            if (!std::ranges::binary_search(faces_, faces[i].face, {}, &Member::number)) {
                is_own[i] = 1;
                own.push_back(i);
            }
        }
        HaloSearch halo(mesh);
        halo.search(own, reach_);
        for (std::uint32_t vertex = 0; vertex < mesh.vertex_count(); ++vertex) {
            lengths_[vertex] = halo.distance(vertex); // Of the same vertices.
        }
        lengthen_by_chords(mesh, places, is_own);
    }

    std::vector<HaloFace> take() const {
        std::vector<HaloFace> faces;
        for (const Member& one : faces_) {
            const auto length = [&](std::uint32_t v) { return lengths_[numbers_.of(v)]; };
            const auto& [a, b, c] = one.face.corners;
            const double distance = std::min({length(a), length(b), length(c)});
            if (distance <= reach_) {
                faces.push_back({one.face, one.owner, distance});
            }
        }
        return faces;
    }

  private:
    /// A face of the halo, and the lengths of its sides, each from its corner to the next. They
    /// only decide how far the halo grows at a time.
    struct Member {
        WholeFace face;
        std::uint32_t owner;
        float sides[3];

        std::uint32_t number() const { return face.face; }
    };

    /// Lengthens lower bounds to those by straight lines through space, which no path is shorter
    /// than. A path leaves own faces across an edge of shared vertices, and one of them is at most
    /// half an edge away. Beyond the reach, such a bound holds for all faces at a vertex, not only
    /// for the vertex: else it would not go together with bounds that are linear in faces.
    void lengthen_by_chords(const PreparedMesh& mesh, const FacePlaces& places,
                            std::span<const std::uint8_t> is_own) {
        const auto place = [&](std::size_t i) {
            const double* const at = &places.positions[3 * i];
            return Place{at[0], at[1], at[2]};
        };
        std::vector<Place> shared;
        for (std::size_t i = 0; i < lengths_.size(); ++i) {
            if (is_shared(numbers_.vertices()[i])) {
                shared.push_back(place(i));
            }
        }
        double longest_own = 0;
        std::vector<double> longest(lengths_.size(), 0); // Edge at each vertex.
        const auto edges = mesh.half_edges();
        for (std::uint32_t h = 0; h < edges.size(); ++h) {
            for (const std::uint32_t end : {edges[h].origin, edges[next_in_face(h)].origin}) {
                longest[end] = std::max(longest[end], edges[h].length);
            }
            if (is_own[h / 3] != 0) {
                longest_own = std::max(longest_own, edges[h].length);
            }
        }
        const NearestPlace nearest(std::move(shared));
        for (std::size_t i = 0; i < lengths_.size(); ++i) {
            const double slack = longest_own / 2 + longest[i];
            if (lengths_[i] <= reach_) {
                const double chord = nearest.distance(place(i), kFar * (reach_ + slack));
                lengths_[i] = std::max(lengths_[i], kRounded * chord - slack);
            }
        }
    }

    bool is_shared(std::uint32_t vertex) const {
        return std::ranges::binary_search(known_.directory.shared(), vertex);
    }

    /// Returns the vertices, in ascending order, to which a way is no longer than `limit`, and
    /// whose faces are not all known. They are, from then on.
    std::vector<std::uint32_t> open_within(double limit) {
        std::vector<std::uint32_t> open;
        for (std::size_t i = 0; i < lengths_.size(); ++i) {
            if (is_complete_[i] == 0 && lengths_[i] <= limit) {
                open.push_back(numbers_.vertices()[i]);
                is_complete_[i] = 1;
            }
        }
        return open;
    }

    /// Asks for the faces at open vertices, and as many rings around them as the reach takes.
    void add_rings(const std::vector<std::uint32_t>& open) {
        const auto asked = talk_.all_to_all(by_home(known_.vertices, open));
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
        for (const auto& heard : talk_.all_to_all(std::move(told))) {
            for (std::size_t at = 0; at < heard.size(); at += 1 + heard[at]) {
                const std::uint32_t rings = rings_from(lengths_[numbers_.of(*vertex)]);
                for (const std::uint32_t holder : std::span(heard).subspan(at + 1, heard[at])) {
                    if (holder != talk_.rank()) {
                        wanted[holder].push_back({*vertex, rings});
                    }
                }
                ++vertex;
            }
        }
        const auto requests = talk_.all_to_all(std::move(wanted));
        ByProcess<WholeFace> faces(talk_.size());
        ByProcess<std::uint32_t> complete(talk_.size());
        for (std::uint32_t other = 0; other < talk_.size(); ++other) {
            answer(requests[other], faces[other], complete[other]);
        }
        faces = talk_.all_to_all(std::move(faces));
        complete = talk_.all_to_all(std::move(complete));
        add(faces);
        for (const auto& vertices : complete) {
            for (const std::uint32_t one : vertices) {
                is_complete_[numbers_.of(one)] = 1;
            }
        }
    }

    /// Adds the faces that are not yet known, by their owners, and follows their edges.
    void add(const ByProcess<WholeFace>& faces) {
        std::vector<Member> newest;
        for (std::uint32_t owner = 0; owner < talk_.size(); ++owner) {
            for (const WholeFace& face : faces[owner]) {
                if (!std::ranges::binary_search(faces_, face.face, {}, &Member::number)) {
                    newest.push_back({face, owner, {}});
                }
            }
        }
        std::ranges::sort(newest, {}, &Member::number);
        const auto is_same = [](const Member& a, const Member& b) {
            return a.number() == b.number();
        };
        newest.erase(std::unique(newest.begin(), newest.end(), is_same), newest.end());
        measure_sides(newest);
        if (newest.empty()) {
            return;
        }
        std::vector<Member> all;
        all.reserve(faces_.size() + newest.size());
        std::ranges::merge(faces_, newest, std::back_inserter(all), {}, &Member::number,
                           &Member::number);
        faces_ = std::move(all);
        number_again();
        const auto turn = talk_.exchange().turn();
        shorten(newest);
    }

    std::uint32_t rings_from(double length) const {
        return rings_ > 0 ? rings_
                          : 1 + static_cast<std::uint32_t>(
                                    std::min<double>(kMaxRings, (reach_ - length) / mean_edge_));
    }

    /// Finds the own faces that another process asks for, and vertices of which these are all.
    void answer(const std::vector<Request>& requests, std::vector<WholeFace>& faces,
                std::vector<std::uint32_t>& complete) const {
        ByProcess<std::uint32_t> by_rings(kMaxRings + 2);
        for (const Request& request : requests) {
            by_rings[std::min(request.rings, kMaxRings + 1)].push_back(request.vertex);
        }
        std::unordered_set<std::uint32_t> vertices, sent;
        for (std::uint32_t rings = kMaxRings + 1; rings > 0; --rings) {
            for (const std::uint32_t vertex : by_rings[rings]) {
                if (!vertices.insert(vertex).second) {
                    continue;
                }
                if (!is_shared(vertex)) {
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
            free_memory(by_rings[rings]);
        }
    }

    void measure_sides(std::vector<Member>& newest) {
        std::vector<std::uint32_t> vertices;
        vertices.reserve(3 * newest.size());
        for (const Member& one : newest) {
            vertices.insert(vertices.end(), one.face.corners, one.face.corners + 3);
        }
        const VertexNumbers numbers(std::move(vertices));
        const std::vector<double> positions =
            fetch_positions(talk_, known_.vertices, known_.positions, numbers.vertices());
        for (Member& one : newest) {
            for (std::size_t side = 0; side < 3; ++side) {
                const double* const a =
                    &positions[std::size_t{3} * numbers.of(one.face.corners[side])];
                const double* const b =
                    &positions[std::size_t{3} * numbers.of(one.face.corners[(side + 1) % 3])];
                const double length = std::hypot(b[0] - a[0], b[1] - a[1], b[2] - a[2]);
                edges_ += length;
                one.sides[side] = static_cast<float>(length);
            }
        }
        const auto faces = static_cast<double>(faces_.size() + newest.size());
        if (edges_ > 0) {
            mean_edge_ = edges_ / (3 * faces);
        }
    }

    /// Numbers the vertices once more, with those of new faces.
    void number_again() {
        std::vector<std::uint32_t> vertices = numbers_.vertices();
        vertices.reserve(vertices.size() + 3 * faces_.size());
        for (const Member& one : faces_) {
            vertices.insert(vertices.end(), one.face.corners, one.face.corners + 3);
        }
        VertexNumbers numbers(std::move(vertices));
        std::vector<double> lengths(numbers.size(), HUGE_VAL);
        std::vector<std::uint8_t> is_complete(numbers.size(), 0);
        for (std::size_t i = 0; i < lengths_.size(); ++i) {
            const std::uint32_t number = numbers.of(numbers_.vertices()[i]);
            lengths[number] = lengths_[i];
            is_complete[number] = is_complete_[i];
        }
        numbers_ = std::move(numbers);
        lengths_ = std::move(lengths);
        is_complete_ = std::move(is_complete);
    }

    /// Shortens ways that lead along the edges of new faces.
    void shorten(const std::vector<Member>& newest) {
        struct Edge {
            std::uint32_t end;
            float length;
        };
        const auto for_edges = [&](const auto& visit) {
            for (const Member& one : faces_) {
                for (std::size_t side = 0; side < 3; ++side) {
                    const std::uint32_t from = numbers_.of(one.face.corners[side]);
                    const std::uint32_t to = numbers_.of(one.face.corners[(side + 1) % 3]);
                    visit(from, Edge{to, one.sides[side]});
                    visit(to, Edge{from, one.sides[side]});
                }
            }
        };
        std::vector<std::uint32_t> starts(numbers_.size() + 1, 0);
        for_edges([&](std::uint32_t from, const Edge&) { ++starts[from + 1]; });
        std::partial_sum(starts.begin(), starts.end(), starts.begin());
        std::vector<Edge> edges(starts.back());
        std::vector<std::uint32_t> places(starts.begin(), starts.end() - 1);
        for_edges([&](std::uint32_t from, const Edge& edge) { edges[places[from]++] = edge; });
        using Entry = std::pair<double, std::uint32_t>;
        std::priority_queue<Entry, std::vector<Entry>, std::greater<>> next;
        for (const Member& one : newest) {
            for (const std::uint32_t vertex : one.face.corners) {
                const std::uint32_t number = numbers_.of(vertex);
                if (lengths_[number] < HUGE_VAL) {
                    next.emplace(lengths_[number], number);
                }
            }
        }
        while (!next.empty()) {
            const auto [length, vertex] = next.top();
            next.pop();
            if (length > lengths_[vertex]) {
                continue;
            }
            for (std::uint32_t at = starts[vertex]; at < starts[vertex + 1]; ++at) {
                const double there = length + kShorter * edges[at].length;
                if (there < lengths_[edges[at].end]) {
                    lengths_[edges[at].end] = there;
                    next.emplace(there, edges[at].end);
                }
            }
        }
    }

    Talk& talk_;
    const KnownSurface& known_;
    double reach_;
    std::uint32_t rings_ = 0; ///< To grow by, or 0 until distances are measured.
    FacesAtVertices own_;
    double mean_edge_, edges_ = 0;          ///< Edges of the halo.
    std::vector<WholeFace> rim_;            ///< Own faces at vertices that are shared.
    std::vector<Member> faces_;             ///< Ascending.
    VertexNumbers numbers_{{}};             ///< Vertices of the rim and the halo.
    std::vector<double> lengths_;           ///< Length of a way from own faces to each of them.
    std::vector<std::uint8_t> is_complete_; ///< 1 if all faces at a vertex are known.
};

FacePlaces places_of(Talk& talk, const KnownSurface& known, std::span<const WholeFace> faces,
                     const VertexNumbers& numbers) {
    FacePlaces places;
    places.positions = fetch_positions(talk, known.vertices, known.positions, numbers.vertices());
    places.triangles.reserve(3 * faces.size());
    for (const WholeFace& face : faces) {
        for (const std::uint32_t vertex : face.corners) {
            places.triangles.push_back(numbers.of(vertex));
        }
    }
    return places;
}

} // namespace

FacePlaces places_of(Talk& talk, const KnownSurface& known, std::span<const WholeFace> faces) {
    return places_of(talk, known, faces, numbers_of(faces));
}

FacePlaces places_and_radii_of(Talk& talk, const KnownSurface& known,
                               std::span<const WholeFace> faces) {
    const VertexNumbers numbers = numbers_of(faces);
    FacePlaces places = places_of(talk, known, faces, numbers);
    places.radii = known.fields.radii_at(talk, known.vertices, numbers.vertices());
    if (const RadiusField* const radii = known.fields.radii()) {
        places.of_whole = *radii;
    }
    return places;
}

// Every path out of a piece leaves it at a vertex, or between two, whose faces are not all known.
// If the lower bounds there are beyond the reach, so is all that is outside.
std::vector<HaloFace> find_halo(Talk& talk, const KnownSurface& known, double reach) {
    Halo halo(talk, known, reach);
    while (halo.grow()) {
        halo.measure();
    }
    return halo.take();
}

} // namespace geodisk
