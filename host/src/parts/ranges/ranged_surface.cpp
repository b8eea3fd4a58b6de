#include "parts/ranges/ranged_surface.hpp"

#include <algorithm>
#include <string>
#include <utility>

#include "engine/domain/stages.hpp"
#include "mesh/mesh_pieces.hpp"
#include "parts/ranges/curve.hpp"
#include "parts/ranges/examine.hpp"
#include "parts/ranges/ranged_halo.hpp"
#include "parts/ranges/ranged_reach.hpp"
#include "parts/ranges/talk.hpp"
#include "parts/reach.hpp"
#include "support/free_memory.hpp"
#include "support/try.hpp"

namespace geodisk {
namespace {

/// Sends the faces of a range to their owners. Returns own ones, ascending.
std::vector<WholeFace> own_faces_of(Talk& talk, const MeshRange& range,
                                    const std::vector<std::uint32_t>& owners) {
    const std::uint64_t turns = turns_for(range.faces.each() * sizeof(WholeFace));
    const std::uint64_t first = range.faces.first(talk.rank());
    std::vector<WholeFace> own;
    ByProcess<std::uint64_t> counts(talk.size(), {0});
    for (const std::uint32_t owner : owners) {
        ++counts[owner].front();
    }
    std::uint64_t count = 0;
    for (const auto& some : talk.all_to_all(std::move(counts))) {
        count += some.front();
    }
    own.reserve(count);
    for (std::uint64_t turn = 0; turn < turns; ++turn) {
        ByProcess<WholeFace> sent(talk.size());
        const std::size_t end = owners.size() * (turn + 1) / turns;
        for (std::size_t face = owners.size() * turn / turns; face < end; ++face) {
            const std::uint32_t* const corners = &range.triangles[3 * face];
            sent[owners[face]].push_back(
                {static_cast<std::uint32_t>(first + face), {corners[0], corners[1], corners[2]}});
        }
        for (const auto& some : talk.all_to_all(std::move(sent))) {
            own.insert(own.end(), some.begin(), some.end());
        }
    }
    std::ranges::sort(own, {}, &WholeFace::face);
    return own;
}

Error needs_whole(std::string why) {
    return Error{Status::mesh_rejected, std::move(why)};
}

std::uint32_t place_in(const std::vector<std::uint32_t>& faces, std::uint32_t face) {
    return static_cast<std::uint32_t>(std::ranges::lower_bound(faces, face) - faces.begin());
}

/// Returns how far conflicts may be from each face of a halo, in minimum distances.
std::vector<double> bounds_of(Talk& talk, const KnownSurface& known, std::span<const HaloFace> halo,
                              RangedReach& reach) {
    if (known.fields.radii() == nullptr) {
        return std::vector<double>(halo.size(), 1.0);
    }
    std::vector<WholeFace> faces;
    faces.reserve(halo.size());
    for (const HaloFace& one : halo) {
        faces.push_back(one.face);
    }
    const FacePlaces places = places_of(talk, known, faces);
    std::vector<double> bounds;
    bounds.reserve(halo.size());
    for (std::size_t face = 0; face < halo.size(); ++face) {
        bounds.push_back(reach.on_face(places, face));
    }
    return bounds;
}

/// Tells the owners of near faces, and hears who is near own ones.
void link(Talk& talk, ByProcess<std::uint32_t> near, Part& part) {
    std::vector<bool> is_asked;
    for (const auto& faces : near) {
        is_asked.push_back(!faces.empty());
    }
    const auto asked = talk.all_to_all(std::move(near));
    for (std::uint32_t other = 0; other < talk.size(); ++other) {
        if (is_asked[other] || !asked[other].empty()) {
            Neighbour& neighbour = part.neighbours.emplace_back();
            neighbour.process = other;
            for (const std::uint32_t face : asked[other]) {
                neighbour.faces.push_back(place_in(part.faces, face));
            }
        }
    }
}

} // namespace

Result<RangedSurface> RangedSurface::create(Exchange& exchange, MeshRange range) {
    return caught([&]() -> Result<RangedSurface> {
        Talk talk(exchange);
        if (range.faces.count < talk.size()) {
            return needs_whole("it has fewer faces than there are processes");
        }
        RangedSurface surface;
        {
            RangeFaces faces = faces_of(talk, range);
            const RangeFindings findings = examine(talk, range, faces);
            surface.fields_ = RangedFields::create(talk, range, faces, findings.statistics);
            free_memory(range.values);
            free_memory(range.vertex_mask);
            free_memory(range.face_mask);
            RangedStatistics& statistics = surface.statistics_;
            statistics.mesh = findings.statistics;
            statistics.turned_edges = findings.turned_edges;
            statistics.digest = findings.digest + surface.fields_.digest();
            statistics.effective_area = surface.fields_.areas().taken;
            statistics.borders = surface.fields_.borders();
            statistics.masked_faces = surface.fields_.masked_faces();
            const auto owners =
                divide_by_curve(talk, range, std::move(faces), findings, statistics.effective_area);
            surface.faces_ = own_faces_of(talk, range, owners);
        }
        free_memory(range.triangles);
        surface.vertices_ = range.vertices;
        surface.face_blocks_ = range.faces;
        surface.positions_ = std::move(range.positions);
        surface.directory_ = Directory::create(talk, surface.vertices_, surface.faces_);
        surface.statistics_.mesh.components = surface.directory_.components().count;
        surface.statistics_.mesh.vertices = surface.directory_.components().vertices;
        surface.statistics_.unused_vertices =
            surface.vertices_.count - surface.statistics_.mesh.vertices;
        surface.outline_ = MeshPieces::outline(surface.statistics_.mesh);
        return surface;
    });
}

KnownSurface RangedSurface::known() const {
    return {vertices_, positions_, faces_, directory_, statistics_.mesh, fields_};
}

SampleParams RangedSurface::with_radii(const SampleParams& params) const {
    SampleParams own = params;
    own.radii = fields_.radii();
    return own;
}

Result<JobFrame> RangedSurface::frame(const SampleParams& params) const {
    if (params.min_distance > statistics_.mesh.diagonal) {
        return needs_whole("the distance is larger than it");
    }
    const SampleParams own = with_radii(params);
    GEODISK_TRY(check_params(outline_, own));
    auto frame = frame_with(outline_, own, fields_.areas());
    if (!frame && fields_.masked_faces()) {
        return needs_whole(frame.error().message);
    }
    if (frame) {
        const Stages stages = stages_in(*frame, own);
        const double most = std::max(stages.expected(0), stages.expected(kLastOtherStage));
        if (!(fields_.largest_area() / fields_.areas().taken * most <= kMaxPerFace)) {
            return needs_whole("a face alone expects too many candidates");
        }
    }
    return frame;
}

Result<std::unique_ptr<Part>> RangedSurface::part(Exchange& exchange, const SampleParams& params,
                                                  const JobFrame& frame, double max_candidates,
                                                  const CheckpointTerms& checkpoints) const {
    return caught([&]() -> Result<std::unique_ptr<Part>> {
        Talk talk(exchange);
        auto part = std::make_unique<Part>(part_for(params, frame, max_candidates, checkpoints));
        const KnownSurface known = this->known();
        RangedReach reach(talk, known, params.min_distance);
        const double unit = part->reach;
        part->reach = unit * reach.on_own();
        const auto halo = find_halo(talk, known, unit * widths_for(reach.on_own()).all);
        const auto bounds = bounds_of(talk, known, halo, reach);
        std::vector<WholeFace> faces;
        const std::size_t count = faces_.size() + halo.size();
        faces.reserve(count);
        part->faces.reserve(count);
        part->roles.reserve(count);
        ByProcess<std::uint32_t> near(talk.size());
        const auto add = [&](const WholeFace& face, FaceRole role) {
            faces.push_back(face);
            part->faces.push_back(face.face);
            part->roles.push_back(role);
        };
        auto own = faces_.begin();
        for (std::size_t i = 0; i < halo.size(); ++i) {
            const HaloFace& one = halo[i];
            const HaloWidths widths = widths_for(std::min(reach.on_own(), bounds[i]));
            if (one.distance > unit * widths.all) {
                continue;
            }
            for (; own != faces_.end() && own->face < one.face.face; ++own) {
                add(*own, FaceRole::own);
            }
            const bool is_near = one.distance <= unit * widths.near;
            add(one.face, is_near ? FaceRole::near : FaceRole::surface);
            if (is_near) {
                near[one.owner].push_back(one.face.face);
            }
        }
        for (; own != faces_.end(); ++own) {
            add(*own, FaceRole::own);
        }
        part->whole = statistics_.mesh;
        part->places = places_and_radii_of(talk, known, faces);
        part->mask = fields_.mask_of(talk, face_blocks_, part->faces);
        link(talk, std::move(near), *part);
        return part;
    });
}

Result<FacePlaces> RangedSurface::places(Exchange& exchange,
                                         std::span<const std::uint32_t> own) const {
    return caught([&]() -> Result<FacePlaces> {
        Talk talk(exchange);
        std::vector<WholeFace> faces;
        faces.reserve(own.size());
        for (const std::uint32_t face : own) {
            faces.push_back(*std::ranges::lower_bound(faces_, face, {}, &WholeFace::face));
        }
        return places_and_radii_of(talk, known(), faces);
    });
}

} // namespace geodisk
