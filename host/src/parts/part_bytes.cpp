#include <algorithm>
#include <array>
#include <cstddef>
#include <utility>

#include "engine/domain/listed.hpp"
#include "engine/domain/stages.hpp"
#include "mesh/mesh_pieces.hpp"
#include "parts/part.hpp"
#include "support/guard.hpp"
#include "support/try.hpp"

namespace geodisk {
namespace {

/// Passes what a message holds as it is to `one`, or an array to `all`, in the order of the
/// message.
template <class AnyPart, class One, class All>
void for_fields(AnyPart& part, const One& one, const All& all) {
    one(part.reach);
    one(part.of_whole);
    one(part.all_existing);
    one(part.max_stages);
    one(part.checkpoints);
    one(part.has_keys);
    one(part.is_listed);
    all(part.faces);
    all(part.roles);
    all(part.keys);
    all(part.mask);
    all(part.existing);
    all(part.avoid);
    all(part.class_factors);
    all(part.existing_classes);
    all(part.avoid_classes);
    all(part.listed);
    all(part.settled);
}

} // namespace

SampleParams Part::params() const {
    SampleParams params = of_whole;
    params.darts = 0; // They are counted over all parts, as samples are.
    params.stop_count = 0;
    params.radii = radii ? &*radii : nullptr;
    params.face_keys = has_keys ? keys : faces;
    params.face_mask = mask;
    params.existing = existing;
    params.avoid = avoid;
    params.class_factors = class_factors;
    params.existing_classes = existing_classes;
    params.avoid_classes = avoid_classes;
    return params;
}

std::uint32_t Part::local(std::uint32_t face) const {
    return ranks.size() > 0
               ? ranks.of(face)
               : static_cast<std::uint32_t>(std::ranges::lower_bound(faces, face) - faces.begin());
}

std::unique_ptr<Part> Part::cut_out(std::span<const std::uint32_t> some_faces) const {
    auto some = std::make_unique<Part>();
    some->frame = frame;
    some->reach = reach;
    some->of_whole = of_whole;
    some->has_keys = has_keys;
    some->class_factors = class_factors;
    for (const std::uint32_t place : some_faces) {
        some->faces.push_back(faces[place]);
        if (has_keys) {
            some->keys.push_back(keys[place]);
        }
        if (!mask.empty()) {
            some->mask.push_back(mask[place]);
        }
    }
    some->mesh = MeshPieces::part(mesh, some_faces);
    if (radii) {
        some->radii = radii->on_part(some->mesh, some_faces);
    }
    return some;
}

CandidateDraw Part::draw() const {
    SampleParams drawn = params();
    drawn.darts = of_whole.darts;
    return {mesh, drawn, frame};
}

Stages Part::stages() const {
    return is_listed ? listed_stages(frame.samples, std::max<std::size_t>(1, listed.size()),
                                     CandidateSource::list)
                     : stages_in(frame, of_whole);
}

Result<Bytes> message_of(const Part& part) {
    std::vector<std::byte> mesh, radii;
    if (part.mesh.face_count() > 0) {
        auto saved = part.mesh.save();
        GEODISK_TRY(saved);
        mesh = std::move(*saved);
    }
    if (part.radii) {
        auto saved = part.radii->save();
        GEODISK_TRY(saved);
        radii = std::move(*saved);
    }
    MessageWriter message;
    message.put(to_bytes(part.frame));
    message.put_all(mesh);
    message.put_all(radii);
    for_fields(
        part, [&](const auto& value) { message.put(value); },
        [&](const auto& values) { message.put_all(values); });
    message.put(part.neighbours.size());
    for (const Neighbour& neighbour : part.neighbours) {
        message.put(neighbour.process);
        message.put_all(neighbour.faces);
    }
    return message.take();
}

Result<std::unique_ptr<Part>> part_of(std::span<const std::byte> bytes) {
    return guarded([&]() -> Result<std::unique_ptr<Part>> {
        auto part = std::make_unique<Part>();
        MessageReader message(bytes);
        std::array<std::byte, kJobFrameBytes> frame{};
        std::vector<std::byte> mesh, radii;
        std::size_t neighbours = 0;
        message.get(frame);
        message.get_all(mesh);
        message.get_all(radii);
        for_fields(
            *part, [&](auto& value) { message.get(value); },
            [&](auto& values) { message.get_all(values); });
        message.get(neighbours);
        for (std::size_t i = 0; i < neighbours && i < bytes.size(); ++i) {
            Neighbour& neighbour = part->neighbours.emplace_back();
            message.get(neighbour.process);
            message.get_all(neighbour.faces);
        }
        if (!message.is_complete()) {
            return Error{Status::internal, "the part of the surface came incomplete"};
        }
        auto of_whole = frame_from_bytes(frame);
        GEODISK_TRY(of_whole);
        part->frame = *of_whole;
        if (!mesh.empty()) {
            auto loaded = PreparedMesh::load(mesh);
            GEODISK_TRY(loaded);
            part->mesh = std::move(*loaded);
        }
        if (!radii.empty()) {
            auto field = RadiusField::load(radii);
            GEODISK_TRY(field);
            part->radii = std::move(*field);
        }
        return part;
    });
}

} // namespace geodisk
