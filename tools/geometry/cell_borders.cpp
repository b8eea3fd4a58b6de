#include "geometry/cell_borders.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <utility>

#include "geometry/bisected_mesh.hpp"
#include "geometry/triangle_edges.hpp"

namespace geodisk::tools {
namespace {

constexpr std::uint32_t kNoSample = CutCells::kNone;

/// Halvings of an edge between two cells: to the resolution of weights in faces.
constexpr int kHalvings = 20;
/// Parts of an edge that are looked at on their own for cells that reach across it.
constexpr std::size_t kProbes = 4;
/// Splits of triangles at which three cells meet, beyond those for the longest edge.
constexpr int kFinerSplits = 6;
/// Triangles that a mesh is split into at most, besides those that it has.
constexpr std::size_t kMostTriangles = std::size_t{1} << 22;

bool takes_part(const BisectedMesh& mesh, std::size_t triangle) {
    return names_three(&mesh.triangles()[3 * triangle]);
}

/// A place on an edge where one cell ends and another begins.
struct Crossing {
    double at; ///< From the lower end, as a part of the edge.
    std::uint32_t before, behind;
    std::uint32_t vertex = kNoSample;
};

/// A part of an edge between two places in different cells.
struct Gap {
    std::uint32_t edge;
    double begin, end;
    std::uint32_t before, behind;
};

/// Cuts the triangles of a mesh that is split finely enough.
class Cutter {
  public:
    Cutter(const BisectedMesh& mesh, std::uint32_t dimension, std::span<const std::uint8_t> mask,
           const FindNearest& nearest)
        : mesh_(mesh), mask_(mask), nearest_(nearest), edges_(mesh.triangles()) {
        result_.dimension = dimension;
        result_.positions = mesh.positions();
    }

    CutCells take() && {
        find_crossings();
        for (std::size_t t = 0; t < mesh_.triangle_count(); ++t) {
            if (is_taken(t)) {
                cut(t);
            }
        }
        return std::move(result_);
    }

  private:
    /// A corner of the outline of a part of a triangle, and the cell from there to the next one.
    struct Corner {
        std::uint32_t vertex;
        std::uint32_t sample;
    };

    bool is_taken(std::size_t triangle) const {
        return takes_part(mesh_, triangle) &&
               (mask_.empty() || mask_[mesh_.parts()[triangle].face] != 0);
    }

    /// Returns the point of an edge this far from its lower end.
    Sample point_on(std::uint32_t edge, double at) const {
        const std::uint32_t corner = edges_.on(edge).front();
        const bool is_upward = mesh_.triangles()[corner] == edges_.ends[edge][0];
        Sample point{corner / 3, {}};
        const std::uint32_t next = corner % 3 == 2 ? 0 : corner % 3 + 1;
        point.weights[next] = static_cast<float>(is_upward ? at : 1 - at);
        point.weights[corner % 3] = 1 - point.weights[next];
        return mesh_.whole(point);
    }

    std::vector<std::uint32_t>
    samples_at(std::span<const std::pair<std::uint32_t, double>> places) {
        std::vector<Sample> points;
        points.reserve(places.size());
        for (const auto& [edge, at] : places) {
            points.push_back(point_on(edge, at));
        }
        return nearest_(points);
    }

    /// Finds the cell that each vertex is in, once for all edges there.
    void find_vertices() {
        at_vertex_.assign(mesh_.vertex_count(), kNoSample);
        std::vector<std::pair<std::uint32_t, double>> places;
        std::vector<std::uint32_t> vertices;
        for (std::uint32_t edge = 0; edge < edges_.ends.size(); ++edge) {
            for (std::size_t end = 0; end < 2; ++end) {
                std::uint32_t& known = at_vertex_[edges_.ends[edge][end]];
                if (known == kNoSample) {
                    known = 0;
                    places.emplace_back(edge, static_cast<double>(end));
                    vertices.push_back(edges_.ends[edge][end]);
                }
            }
        }
        const std::vector<std::uint32_t> found = samples_at(places);
        for (std::size_t i = 0; i < vertices.size(); ++i) {
            at_vertex_[vertices[i]] = found[i];
        }
    }

    void find_crossings() {
        find_vertices();
        std::vector<std::pair<std::uint32_t, double>> places;
        for (std::uint32_t edge = 0; edge < edges_.ends.size(); ++edge) {
            for (std::size_t i = 1; i < kProbes; ++i) {
                places.emplace_back(edge, static_cast<double>(i) / kProbes);
            }
        }
        const std::vector<std::uint32_t> found = samples_at(places);
        std::vector<Gap> gaps;
        for (std::uint32_t edge = 0; edge < edges_.ends.size(); ++edge) {
            std::array<std::uint32_t, kProbes + 1> own{};
            own.front() = at_vertex_[edges_.ends[edge][0]];
            own.back() = at_vertex_[edges_.ends[edge][1]];
            std::copy_n(&found[edge * (kProbes - 1)], kProbes - 1, &own[1]);
            for (std::size_t i = 0; i < kProbes; ++i) {
                if (own[i] != own[i + 1]) {
                    gaps.push_back({edge, static_cast<double>(i) / kProbes,
                                    static_cast<double>(i + 1) / kProbes, own[i], own[i + 1]});
                }
            }
        }
        for (int halving = 0; halving < kHalvings && !gaps.empty(); ++halving) {
            halve(gaps);
        }
        crossings_.resize(edges_.ends.size());
        for (const Gap& gap : gaps) {
            crossings_[gap.edge].push_back({(gap.begin + gap.end) / 2, gap.before, gap.behind});
        }
        for (std::uint32_t edge = 0; edge < edges_.ends.size(); ++edge) {
            std::ranges::sort(crossings_[edge], {}, &Crossing::at);
            for (Crossing& crossing : crossings_[edge]) {
                const auto& [from, to] = edges_.ends[edge];
                crossing.vertex = add_vertex({{from, 1 - crossing.at}, {to, crossing.at}});
            }
        }
    }

    void halve(std::vector<Gap>& gaps) {
        std::vector<std::pair<std::uint32_t, double>> middles;
        middles.reserve(gaps.size());
        for (const Gap& gap : gaps) {
            middles.emplace_back(gap.edge, (gap.begin + gap.end) / 2);
        }
        const std::vector<std::uint32_t> found = samples_at(middles);
        std::vector<Gap> more;
        for (std::size_t i = 0; i < gaps.size(); ++i) {
            Gap& gap = gaps[i];
            const double middle = middles[i].second;
            if (found[i] == gap.before) {
                gap.begin = middle;
            } else if (found[i] == gap.behind) {
                gap.end = middle;
            } else { // A third cell lies between.
                more.push_back({gap.edge, middle, gap.end, found[i], gap.behind});
                gap.end = middle;
                gap.behind = found[i];
            }
        }
        gaps.insert(gaps.end(), more.begin(), more.end());
    }

    std::uint32_t add_vertex(std::span<const std::pair<std::uint32_t, double>> weights) {
        const auto vertex =
            static_cast<std::uint32_t>(result_.positions.size() / result_.dimension);
        for (std::size_t axis = 0; axis < result_.dimension; ++axis) {
            double sum = 0;
            for (const auto& [of, weight] : weights) {
                sum += weight * result_.positions[of * std::size_t{result_.dimension} + axis];
            }
            result_.positions.push_back(sum);
        }
        return vertex;
    }
    std::uint32_t add_vertex(std::initializer_list<std::pair<std::uint32_t, double>> weights) {
        return add_vertex(std::span(weights.begin(), weights.size()));
    }

    /// Returns the outline of a triangle: its corners, and the crossings of its edges between.
    std::vector<Corner> outline_of(std::size_t triangle) const {
        std::vector<Corner> outline;
        for (std::size_t corner = 3 * triangle; corner < 3 * triangle + 3; ++corner) {
            const std::uint32_t edge = edges_.of_corner[corner];
            const std::uint32_t vertex = mesh_.triangles()[corner];
            const std::vector<Crossing>& own = crossings_[edge];
            if (vertex == edges_.ends[edge][0]) {
                outline.push_back({vertex, at_vertex_[vertex]});
                for (const Crossing& crossing : own) {
                    outline.push_back({crossing.vertex, crossing.behind});
                }
                continue;
            }
            outline.push_back({vertex, at_vertex_[vertex]});
            for (std::size_t i = own.size(); i-- > 0;) {
                outline.push_back({own[i].vertex, own[i].before});
            }
        }
        return outline;
    }

    void cut(std::size_t triangle) {
        std::vector<Corner> outline = outline_of(triangle);
        face_ = mesh_.parts()[triangle].face;
        for (;;) {
            const std::vector<std::size_t> changes = changes_of(outline);
            if (changes.size() <= 1) {
                add_fan(outline, outline.front().sample);
                return;
            }
            const auto own = cut_off(outline, changes);
            if (!own) {
                meet(outline, changes);
                return;
            }
            outline = *own;
        }
    }

    /// Returns where the cell of an outline changes: the corners that begin another one.
    static std::vector<std::size_t> changes_of(const std::vector<Corner>& outline) {
        std::vector<std::size_t> changes;
        for (std::size_t i = 0; i < outline.size(); ++i) {
            const Corner& before = outline[i == 0 ? outline.size() - 1 : i - 1];
            if (before.sample != outline[i].sample) {
                changes.push_back(i);
            }
        }
        return changes;
    }

    /// Cuts off a cell that has the same one on both sides, by a straight line. Returns the rest;
    /// nothing if there is none.
    std::optional<std::vector<Corner>> cut_off(const std::vector<Corner>& outline,
                                               const std::vector<std::size_t>& changes) {
        const std::size_t count = changes.size();
        for (std::size_t i = 0; i < count; ++i) {
            const std::size_t begin = changes[i], end = changes[(i + 1) % count];
            const std::uint32_t own = outline[begin].sample, behind = outline[end].sample;
            const std::uint32_t before =
                outline[begin == 0 ? outline.size() - 1 : begin - 1].sample;
            if (before != behind) {
                continue;
            }
            std::vector<Corner> part, rest;
            for (std::size_t k = begin; k != end; k = (k + 1) % outline.size()) {
                part.push_back(outline[k]);
            }
            part.push_back({outline[end].vertex, own});
            add_fan(part, own);
            for (std::size_t k = end; k != begin; k = (k + 1) % outline.size()) {
                rest.push_back(outline[k]);
            }
            rest.push_back({outline[begin].vertex, before});
            add_border(outline[begin].vertex, outline[end].vertex, own, before);
            return rest;
        }
        return std::nullopt;
    }

    /// Lets the borders of three or more cells meet in the mean of where they come from.
    void meet(const std::vector<Corner>& outline, const std::vector<std::size_t>& changes) {
        std::vector<std::pair<std::uint32_t, double>> weights;
        weights.reserve(changes.size());
        for (const std::size_t change : changes) {
            weights.emplace_back(outline[change].vertex, 1.0 / static_cast<double>(changes.size()));
        }
        const std::uint32_t middle = add_vertex(weights);
        for (std::size_t i = 0; i < changes.size(); ++i) {
            const std::size_t begin = changes[i], end = changes[(i + 1) % changes.size()];
            const std::uint32_t own = outline[begin].sample;
            std::size_t k = begin;
            do {
                const std::size_t next = (k + 1) % outline.size();
                add_triangle(outline[k].vertex, outline[next].vertex, middle, own);
                k = next;
            } while (k != end);
            const std::uint32_t before =
                outline[begin == 0 ? outline.size() - 1 : begin - 1].sample;
            add_border(outline[begin].vertex, middle, own, before);
        }
    }

    /// Adds a convex part, in triangles around the corner by which the thinnest one is widest:
    /// corners lie in line along edges.
    void add_fan(const std::vector<Corner>& part, std::uint32_t sample) {
        const std::size_t count = part.size();
        std::size_t best = 0;
        double widest = -1;
        for (std::size_t apex = 0; apex < count; ++apex) {
            double least = HUGE_VAL;
            for (std::size_t i = 1; i + 1 < count; ++i) {
                least = std::min(least, area2(part[apex].vertex, part[(apex + i) % count].vertex,
                                              part[(apex + i + 1) % count].vertex));
            }
            best = least > widest ? apex : best;
            widest = std::max(widest, least);
        }
        for (std::size_t i = 1; i + 1 < count; ++i) {
            add_triangle(part[best].vertex, part[(best + i) % count].vertex,
                         part[(best + i + 1) % count].vertex, sample);
        }
    }

    /// Returns the square of twice the area of a triangle.
    double area2(std::uint32_t a, std::uint32_t b, std::uint32_t c) const {
        double bb = 0, cc = 0, bc = 0;
        for (std::size_t axis = 0; axis < result_.dimension; ++axis) {
            const auto coordinate = [&](std::uint32_t v) {
                return result_.positions[std::size_t{v} * result_.dimension + axis];
            };
            const double to_b = coordinate(b) - coordinate(a), to_c = coordinate(c) - coordinate(a);
            bb += to_b * to_b;
            cc += to_c * to_c;
            bc += to_b * to_c;
        }
        return bb * cc - bc * bc;
    }

    void add_triangle(std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t sample) {
        result_.triangles.push_back({a, b, c});
        result_.samples.push_back(sample);
        result_.faces.push_back(face_);
    }

    void add_border(std::uint32_t from, std::uint32_t to, std::uint32_t one, std::uint32_t other) {
        result_.borders.push_back({{from, to}, {std::min(one, other), std::max(one, other)}});
    }

    const BisectedMesh& mesh_;
    std::span<const std::uint8_t> mask_;
    const FindNearest& nearest_;
    TriangleEdges edges_;
    std::vector<std::uint32_t> at_vertex_; ///< Sample whose cell each vertex is in.
    std::vector<std::vector<Crossing>> crossings_;
    CutCells result_;
    std::uint32_t face_ = 0;
};

double longest_edge(const BisectedMesh& mesh, std::uint32_t dimension, std::size_t triangle) {
    double longest2 = 0;
    const std::uint32_t* const corners = &mesh.triangles()[3 * triangle];
    for (std::size_t k = 0; k < 3; ++k) {
        double sum = 0;
        for (std::size_t axis = 0; axis < dimension; ++axis) {
            const double side =
                mesh.positions()[corners[k] * std::size_t{dimension} + axis] -
                mesh.positions()[corners[(k + 1) % 3] * std::size_t{dimension} + axis];
            sum += side * side;
        }
        longest2 = std::max(longest2, sum);
    }
    return std::sqrt(longest2);
}

/// Splits triangles until no edge is longer than that.
void split_long(BisectedMesh& mesh, std::uint32_t dimension, double longest, std::size_t most) {
    for (;;) {
        std::vector<bool> wanted(mesh.triangle_count());
        for (std::size_t t = 0; t < wanted.size(); ++t) {
            wanted[t] = longest_edge(mesh, dimension, t) > longest;
        }
        if (!mesh.split(wanted, most)) {
            return;
        }
    }
}

/// Splits triangles at which three or more cells meet.
void split_meetings(BisectedMesh& mesh, std::size_t most, const FindNearest& nearest) {
    constexpr float kThird = 1.0f / 3;
    constexpr float kPlaces[7][3] = {{1, 0, 0},
                                     {0, 1, 0},
                                     {0, 0, 1},
                                     {0.5f, 0.5f, 0},
                                     {0, 0.5f, 0.5f},
                                     {0.5f, 0, 0.5f},
                                     {kThird, kThird, 1 - 2 * kThird}};
    constexpr std::size_t kCount = std::size(kPlaces);
    for (int round = 0; round < kFinerSplits; ++round) {
        std::vector<Sample> points;
        std::vector<std::uint32_t> triangles;
        for (std::uint32_t t = 0; t < mesh.triangle_count(); ++t) {
            if (takes_part(mesh, t)) {
                triangles.push_back(t);
                for (const auto& place : kPlaces) {
                    points.push_back(mesh.whole({t, {place[0], place[1], place[2]}}));
                }
            }
        }
        const std::vector<std::uint32_t> found = nearest(points);
        std::vector<bool> wanted(mesh.triangle_count());
        for (std::size_t i = 0; i < triangles.size(); ++i) {
            std::array<std::uint32_t, kCount> own{};
            std::copy_n(&found[kCount * i], kCount, own.begin());
            std::ranges::sort(own);
            wanted[triangles[i]] = std::unique(own.begin(), own.end()) - own.begin() > 2;
        }
        if (!mesh.split(wanted, most)) {
            return;
        }
    }
}

} // namespace

CutCells cut_cells(const MeshFile& mesh, std::span<const std::uint8_t> mask, double longest,
                   const FindNearest& nearest) {
    BisectedMesh parts(mesh);
    const std::size_t most = parts.triangle_count() + kMostTriangles;
    split_long(parts, mesh.dimension, longest, most);
    split_meetings(parts, most, nearest);
    return Cutter(parts, mesh.dimension, mask, nearest).take();
}

} // namespace geodisk::tools
