#include <algorithm>
#include <array>
#include <cstddef>
#include <utility>

#include "engine/domain/listed.hpp"
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

CandidateDraw Part::draw() const {
    SampleParams drawn = params();
    drawn.darts = of_whole.darts;
    return {mesh, drawn, frame};
}

Stages Part::list_stages() const {
    return listed_stages(frame.samples, std::max<std::size_t>(1, listed.size()),
                         CandidateSource::list);
}

Result<Bytes> message_of(const Part& part) {
    auto mesh = part.mesh.save();
    GEODISK_TRY(mesh);
    std::vector<std::byte> radii;
    if (part.radii) {
        auto saved = part.radii->save();
        GEODISK_TRY(saved);
        radii = std::move(*saved);
    }
    MessageWriter message;
    message.put(to_bytes(part.frame));
    message.put_all(*mesh);
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
        auto loaded = PreparedMesh::load(mesh);
        GEODISK_TRY(loaded);
        part->mesh = std::move(*loaded);
        if (!radii.empty()) {
            auto field = RadiusField::load(radii);
            GEODISK_TRY(field);
            part->radii = std::move(*field);
        }
        return part;
    });
}

} // namespace geodisk
