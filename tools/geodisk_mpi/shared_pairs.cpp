#include "shared_pairs.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>

#include <geodisk/exchange.hpp>
#include <geodisk/mesh.hpp>
#include <geodisk/mpi.hpp>

#include "messages.hpp"
#include "process.hpp"
#include "program/failure.hpp"

namespace geodisk::tools {
namespace {

// Share of a face in the work, where that of all samples is 1: its memory.
constexpr double kFaceWork = 0.25;
// Beyond what is looked for, so that rounding leaves nothing out.
constexpr double kMargin = 1 + 0x1p-20;

/// A search by one process: what PairSearch refers to.
struct PartSearch {
    PreparedMesh mesh;
    ref::Frame frame;
    double longest = 0, cut = 0;
    std::vector<Sample> samples;
    std::vector<std::uint32_t> rows; ///< Row in the whole of each sample.
    std::vector<std::uint8_t> sources;
    std::vector<std::uint32_t> existing;
    bool has_distances = false;
    std::vector<double> radii;
    std::vector<std::uint32_t> classes;
    ClassTable table;
    double min_distance = 0;

    PairSearch search() const {
        PairSearch search{mesh, frame, longest, samples};
        if (has_distances) {
            search.distances = PairDistances{radii, classes, table, min_distance};
        }
        search.cut = cut;
        search.existing = existing;
        search.sources = sources;
        return search;
    }
};

/// Passes all but the mesh to `one`, or an array to `all`, in the order of the message.
template <class Part, class One, class All>
void for_fields(Part& part, const One& one, const All& all) {
    one(part.frame);
    one(part.longest);
    one(part.cut);
    one(part.has_distances);
    one(part.table.count);
    one(part.min_distance);
    all(part.samples);
    all(part.rows);
    all(part.sources);
    all(part.existing);
    all(part.radii);
    all(part.classes);
    all(part.table.distances);
}

std::vector<double> work_of(const PairSearch& search) {
    const std::size_t faces = search.mesh.face_count();
    const double all = static_cast<double>(search.samples.size()) + kFaceWork;
    std::vector<double> work(faces, kFaceWork / static_cast<double>(faces) / all);
    for (const Sample& sample : search.samples) {
        work[sample.face] += 1 / all;
    }
    return work;
}

/// Appends the value of a row, where there are values.
template <class T>
void copy_row(std::span<const T> from, std::uint32_t row, std::vector<T>& to) {
    if (!from.empty()) {
        to.push_back(from[row]);
    }
}

/// Returns the message with the samples on the faces of a process, and all near them.
Bytes part_message(const PairSearch& whole, std::span<const std::uint32_t> owners,
                   std::uint32_t process) {
    PartSearch part;
    part.frame = whole.frame;
    part.longest = whole.longest;
    part.cut = whole.cut;
    part.has_distances = whole.distances.has_value();
    const PairDistances distances = whole.distances.value_or(PairDistances{{}});
    part.table = distances.table;
    part.min_distance = distances.min_distance;
    double reach = 0;
    for (std::uint32_t row = 0; row < whole.samples.size(); ++row) {
        if (owners[whole.samples[row].face] == process) {
            reach = std::max(reach, std::min(whole.reach(row), whole.longest));
        }
    }
    reach *= kMargin;
    std::vector<std::uint8_t> is_own(owners.size());
    for (std::size_t face = 0; face < owners.size(); ++face) {
        is_own[face] = owners[face] == process ? 1 : 0;
    }
    const std::vector<std::uint32_t> faces = take(faces_within(whole.mesh, is_own, reach));
    constexpr std::uint32_t kOutside = ~0u;
    std::vector<std::uint32_t> local(owners.size(), kOutside);
    for (std::uint32_t at = 0; at < faces.size(); ++at) {
        local[faces[at]] = at;
    }
    for (std::uint32_t row = 0; row < whole.samples.size(); ++row) {
        Sample sample = whole.samples[row];
        if (local[sample.face] == kOutside) {
            continue;
        }
        part.sources.push_back(is_own[sample.face]);
        sample.face = local[sample.face];
        part.samples.push_back(sample);
        part.rows.push_back(row);
        copy_row(whole.existing, row, part.existing);
        copy_row(distances.radii, row, part.radii);
        copy_row(distances.classes, row, part.classes);
    }
    MessageWriter message;
    message.put_all(take(take(whole.mesh.part(faces)).save()));
    for_fields(
        part, [&](const auto& value) { message.put(value); },
        [&](const auto& values) { message.put_all(values); });
    return message.take();
}

std::vector<Bytes> part_messages(const PairSearch& whole, std::uint32_t processes) {
    const auto owners = take(divide_faces(whole.mesh, work_of(whole), processes));
    std::vector<Bytes> messages;
    for (std::uint32_t process = 0; process < processes; ++process) {
        messages.push_back(part_message(whole, owners, process));
    }
    return messages;
}

std::vector<NotedPair> note_in_part(std::span<const std::byte> bytes, ProgressLine& progress) {
    MessageReader message(bytes);
    std::vector<std::byte> mesh;
    PartSearch part;
    message.get_all(mesh);
    for_fields(
        part, [&](auto& value) { message.get(value); },
        [&](auto& values) { message.get_all(values); });
    if (!message.is_complete()) {
        throw UserError(ExitCode::internal, "the part of the surface came incomplete");
    }
    part.mesh = take(PreparedMesh::load(mesh));
    std::vector<NotedPair> noted = note_pairs(part.search(), progress);
    for (NotedPair& one : noted) {
        one.source = part.rows[one.source];
        one.pair.row_a = part.rows[one.pair.row_a];
        one.pair.row_b = part.rows[one.pair.row_b];
    }
    return noted;
}

} // namespace

std::vector<NotedPair> note_together(Process& process, const NoteCall* call) {
    Messages& messages = process.messages;
    std::vector<Bytes> parts = messages.agree([&] {
        return call != nullptr ? part_messages(call->search, messages.size())
                               : std::vector<Bytes>();
    });
    const Bytes part = messages.scatter(std::move(parts));
    ProgressLine quiet(true);
    const std::vector<NotedPair> own = messages.agree(
        [&] { return note_in_part(part, call != nullptr ? call->progress : quiet); });
    std::vector<NotedPair> all;
    for (const auto& some : messages.gather(std::span(own))) {
        all.insert(all.end(), some.begin(), some.end());
    }
    return call != nullptr ? merged_pairs(call->search, std::move(all)) : all;
}

} // namespace geodisk::tools
