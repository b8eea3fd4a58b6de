#include "ranged_rows.hpp"

#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <numeric>
#include <optional>
#include <string>
#include <system_error>
#include <utility>

#include <geodisk/exchange.hpp>
#include <geodisk/mesh.hpp>
#include <geodisk/mpi.hpp>

#include "files/output/block_writer.hpp"
#include "files/output/output_target.hpp"
#include "files/samples/fingerprint.hpp"
#include "geodisk/inputs/mesh_input.hpp"
#include "messages.hpp"
#include "process.hpp"
#include "shared_file.hpp"

namespace geodisk::tools {
namespace {

// Samples whose corners are found at once: all processes hear of their faces.
constexpr std::uint64_t kSamplesAtOnce = std::uint64_t{1} << 18;

/// Division of the samples.
struct Blocks {
    std::uint64_t count = 0;
    double min_distance = 0; ///< Minimum distance of the job.
    bool divides = false;

    /// Returns where the block of a process begins, or the end of the last one's.
    std::uint64_t begin(std::uint32_t process, std::uint32_t processes) const {
        const std::uint64_t all = process > 0 ? count : 0;
        return divides ? count / processes * process +
                             std::min<std::uint64_t>(process, count % processes)
                       : all;
    }
};

/// Facts about the rows of one process.
struct Block {
    std::uint64_t digest;
    SampleBox box;
    RadiusRange radii;
};

/// Returns records of the first process at one.
template <class Record>
std::vector<Record> sent_to(Messages& messages, std::span<const Record> of_first,
                            std::uint32_t process) {
    std::vector<Bytes> told(messages.is_first() ? messages.size() : 0);
    if (!told.empty()) {
        told[process] = bytes_of(of_first);
    }
    return records_of<Record>(messages.scatter(std::move(told)));
}

std::vector<std::uint32_t> faces_of(std::span<const Sample> samples) {
    std::vector<std::uint32_t> faces;
    faces.reserve(samples.size());
    for (const Sample& sample : samples) {
        faces.push_back(sample.face);
    }
    std::sort(faces.begin(), faces.end());
    faces.erase(std::unique(faces.begin(), faces.end()), faces.end());
    return faces;
}

/// Appends the rows of samples on faces at these places, of a job with such a distance.
void append_rows(std::vector<SampleRow>& rows, std::span<const Sample> samples,
                 std::span<const std::uint32_t> faces, PlacedFaces places,
                 const PreparedMesh& outline, double min_distance) {
    MeshInput mesh{{}, outline, std::nullopt, {}, 1, {}, 0, 0};
    mesh.radii = std::move(places.radii);
    mesh.file.positions = std::move(places.positions);
    mesh.file.triangles = std::move(places.triangles);
    const std::size_t first = rows.size();
    rows.resize(first + samples.size());
    for_rows(samples.size(), [&](std::size_t i) {
        SampleRow& row = rows[first + i];
        row.face = static_cast<std::uint32_t>(std::ranges::lower_bound(faces, samples[i].face) -
                                              faces.begin());
        std::copy_n(samples[i].weights, 3, row.bary);
        mesh.place(row);
        row.radius = mesh.radius(row.face, row.bary, min_distance);
        row.face = samples[i].face;
    });
}

/// Returns the bytes of rows.
std::string formatted(const RowFormat& format, std::span<const SampleRow> rows) {
    std::string bytes;
    for (std::size_t i = 0; i < rows.size(); ++i) {
        format.append(bytes, rows[i], i);
    }
    return bytes;
}

/// Writes the bytes of all behind each other by the first process.
void write_in_turn(Messages& messages, AtomicFile* file, const std::string& own) {
    Result<Done> written = Done{};
    for (std::uint32_t process = 0; process < messages.size(); ++process) {
        const std::span<const char> mine(own.data(), messages.rank() == process ? own.size() : 0);
        const auto of_all = messages.gather(mine);
        if (file != nullptr && written) {
            written = messages.caught([&] {
                file->write({of_all[process].data(), of_all[process].size()});
                return Done{};
            });
        }
    }
    messages.check(std::move(written));
}

RowFormat row_format(const SampleTarget& target, const RangedRows& rows) {
    SampleLayout layout = layout_in(target.format, 3, float_is_enough(rows.box, 3));
    layout.has_radius = rows.radii.do_vary();
    return {target, layout};
}

} // namespace

RangedRows& make_ranged_rows(Process& process, const RowsCall* call) {
    Messages& messages = process.messages;
    const std::span<const Sample> samples =
        call != nullptr ? call->samples : std::span<const Sample>();
    const Blocks blocks = messages.broadcast(
        call != nullptr ? Blocks{samples.size(), call->min_distance, call->divides} : Blocks());
    RangedRows made;
    made.count = blocks.count;
    for (std::uint32_t other = 0; other < messages.size(); ++other) {
        const std::uint64_t end = blocks.begin(other + 1, messages.size());
        for (std::uint64_t begin = blocks.begin(other, messages.size()); begin < end;
             begin += kSamplesAtOnce) {
            const auto some = samples.empty()
                                  ? samples
                                  : samples.subspan(begin, std::min(end - begin, kSamplesAtOnce));
            const std::vector<Sample> here = sent_to(messages, some, other);
            const std::vector<std::uint32_t> wanted = faces_of(some);
            const std::vector<std::uint32_t> faces =
                messages.broadcast_all(std::span(std::as_const(wanted)));
            append_rows(made.own, here, faces,
                        messages.known(process.surface->places(faces, other)),
                        process.surface->outline(), blocks.min_distance);
        }
    }
    const Block own{digest_number(made.own), SampleBox(made.own), RadiusRange(made.own)};
    for (const Block& block : messages.all_gather(own)) {
        made.digest += block.digest;
        made.box.add(block.box);
        made.radii.add(block.radii);
    }
    return process.rows = std::move(made);
}

Done write_ranged_rows(Process& process, const WriteCall* call) {
    Messages& messages = process.messages;
    const RangedRows& rows = process.rows;
    const SampleTarget target = call != nullptr ? call->target : process.job->out.target();
    const RowFormat format = row_format(target, rows);
    const std::filesystem::path of_first = messages.agree([&] {
        if (call == nullptr) {
            return std::filesystem::path();
        }
        call->file.write(format.head(call->header, rows.count));
        return call->file.share();
    });
    std::error_code none;
    const std::string& text = of_first.native();
    const auto path = messages.broadcast_all(std::span(text.data(), text.size()));
    const std::uint64_t first = messages.broadcast<std::uint64_t>(
        of_first.empty() ? 0 : std::filesystem::file_size(of_first, none));
    const SharedFile shared(std::string(path.begin(), path.end()), first);
    const auto sees = messages.all_gather<std::uint8_t>(shared.is_open() ? 1 : 0);
    const std::string bytes = formatted(format, rows.own);
    if (std::ranges::find(sees, 0) != sees.end()) {
        write_in_turn(messages, call != nullptr ? &call->file : nullptr, bytes);
        return {};
    }
    const std::vector<std::uint64_t> sizes = messages.all_gather<std::uint64_t>(bytes.size());
    const std::uint64_t offset =
        std::accumulate(sizes.begin(), sizes.begin() + messages.rank(), first);
    messages.check(shared.write(offset, bytes),
                   [&](const Error& error) { fail_to_write(target.path, error.message); });
    return {};
}

} // namespace geodisk::tools
