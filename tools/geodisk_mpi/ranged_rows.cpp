#include "ranged_rows.hpp"

#include <algorithm>
#include <exception>
#include <optional>
#include <string>
#include <system_error>
#include <utility>

#include "files/output/block_writer.hpp"
#include "files/samples/fingerprint.hpp"
#include "geodisk/inputs/mesh_input.hpp"
#include "parts/ranges/talk.hpp"
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

/// Returns records of the first process at all, or at one alone.
template <class Record>
std::vector<Record> heard(Talk& talk, std::span<const Record> of_first,
                          std::optional<std::uint32_t> one = std::nullopt) {
    ByProcess<Record> told(talk.rank() == 0 ? talk.size() : 0);
    for (std::uint32_t process = 0; process < told.size(); ++process) {
        if (!one || *one == process) {
            told[process].assign(of_first.begin(), of_first.end());
        }
    }
    return talk.scatter(told);
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
                 std::span<const std::uint32_t> faces, FacePlaces places,
                 const RangedSurface& surface, double min_distance) {
    MeshInput mesh{{}, surface.outline(), std::nullopt, {}, 1, {}, 0, 0};
    if (surface.radii() != nullptr) {
        mesh.radii = RadiusPieces::factors_on(places.triangles, places.radii);
    }
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

/// Writes the bytes of all behind each other by the first process. What that throws, it throws when
/// it has heard all.
void write_in_turn(Talk& talk, AtomicFile* file, const std::string& own) {
    std::exception_ptr failure;
    for (std::uint32_t process = 0; process < talk.size(); ++process) {
        const std::span<const char> mine(own.data(), talk.rank() == process ? own.size() : 0);
        const auto of_all = talk.gather(mine);
        if (file == nullptr || failure) {
            continue;
        }
        try {
            file->write({of_all[process].data(), of_all[process].size()});
        } catch (...) {
            failure = std::current_exception();
        }
    }
    if (failure) {
        std::rethrow_exception(failure);
    }
}

} // namespace

Result<RangedRows> RangedRows::make(Exchange& exchange, RangedParts& parts,
                                    std::span<const Sample> samples, double min_distance,
                                    bool divides) {
    return geodisk::caught([&]() -> Result<RangedRows> {
        Talk talk(exchange);
        const Blocks given{samples.size(), min_distance, divides};
        const Blocks blocks = heard(talk, std::span(&given, 1)).front();
        RangedRows made;
        made.count_ = blocks.count;
        for (std::uint32_t process = 0; process < talk.size(); ++process) {
            const std::uint64_t end = blocks.begin(process + 1, talk.size());
            for (std::uint64_t begin = blocks.begin(process, talk.size()); begin < end;
                 begin += kSamplesAtOnce) {
                const auto some =
                    samples.empty() ? samples
                                    : samples.subspan(begin, std::min(end - begin, kSamplesAtOnce));
                const std::vector<Sample> here = heard(talk, some, process);
                const std::vector<std::uint32_t> wanted = faces_of(some);
                const std::vector<std::uint32_t> faces =
                    heard(talk, std::span(std::as_const(wanted)));
                auto places = parts.places(faces, process);
                if (!places) {
                    return places.error();
                }
                append_rows(made.own_, here, faces, std::move(*places), parts.surface(),
                            blocks.min_distance);
            }
        }
        const Block own{digest_number(made.own_), SampleBox(made.own_), RadiusRange(made.own_)};
        for (const Block& block : talk.all(own)) {
            made.digest_ += block.digest;
            made.box_.add(block.box);
            made.radii_.add(block.radii);
        }
        return made;
    });
}

Result<Done> RangedRows::write(Exchange& exchange, const RowFormat& format, AtomicFile* file,
                               const std::filesystem::path& path) const {
    return geodisk::caught([&]() -> Result<Done> {
        Talk talk(exchange);
        std::error_code none;
        const std::uint64_t head = path.empty() ? 0 : std::filesystem::file_size(path, none);
        const std::string& text = path.native();
        const std::vector<char> shared_path = heard(talk, std::span(text.data(), text.size()));
        const std::uint64_t first = heard(talk, std::span(&head, 1)).front();
        const SharedFile shared(std::string(shared_path.begin(), shared_path.end()), first);
        const bool all_see = talk.sum(shared.is_open() ? 1 : 0) == talk.size();
        const std::string bytes = formatted(format, own_);
        if (!all_see) {
            write_in_turn(talk, file, bytes);
            return Done{};
        }
        std::uint64_t offset = first;
        const std::vector<std::uint64_t> sizes = talk.all(std::uint64_t{bytes.size()});
        for (std::uint32_t process = 0; process < talk.rank(); ++process) {
            offset += sizes[process];
        }
        std::optional<Error> error;
        if (const int code = shared.write(offset, bytes); code != 0) {
            error = Error{Status::internal, std::generic_category().message(code)};
        }
        talk.check(error ? &*error : nullptr);
        return Done{};
    });
}

} // namespace geodisk::tools
