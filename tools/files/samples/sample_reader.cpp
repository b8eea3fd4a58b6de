#include <algorithm>
#include <array>
#include <optional>
#include <string>
#include <utility>

#include "files/input_file.hpp"
#include "files/ply_file.hpp"
#include "files/samples/fingerprint.hpp"
#include "files/samples/sample_file.hpp"
#include "files/samples/sample_format.hpp"
#include "files/samples/sample_rows.hpp"
#include "files/text_file.hpp"
#include "program/exact_text.hpp"
#include "program/failure.hpp"

namespace geodisk::tools {
namespace {

/// Reads lines between vertices.
void read_ply_edges(PlyFile& file, const PlyElement& element, SampleFile& samples) {
    const std::size_t places[] = {*element.find_scalar("vertex1"), *element.find_scalar("vertex2")};
    file.read_records(element, [&](std::uint64_t index, const PlyRecord& record) {
        std::array<std::uint32_t, 2>& segment = samples.segments.emplace_back();
        for (std::size_t end = 0; end < 2; ++end) {
            const double vertex = record.scalars[places[end]];
            if (!set_index(segment[end], vertex)) {
                file.fail(element, index, exact_text(vertex) + " is no vertex");
            }
        }
    });
}

/// Checks that lines are between vertices that there are.
void check_edges(const Path& path, const SampleFile& samples) {
    for (std::size_t i = 0; i < samples.segments.size(); ++i) {
        const std::uint32_t last = std::max(samples.segments[i][0], samples.segments[i][1]);
        if (last >= samples.rows.size()) {
            fail_input(path, "edge " + std::to_string(i) + ": names vertex " +
                                 std::to_string(last) + ", but there are " +
                                 std::to_string(samples.rows.size()));
        }
    }
}

} // namespace

SampleFile read_ply_samples(const Path& path, std::string&& bytes, SampleDomain domain,
                            const std::string& numbers) {
    PlyFile file(path, std::move(bytes));
    SampleFile samples;
    for (const std::string& comment : file.comments()) {
        add_entry(samples.header, comment);
    }
    bool has_vertices = false, is_mesh = false;
    for (const PlyElement& element : file.elements()) {
        if (element.name == "edge" && element.find_scalar("vertex1") &&
            element.find_scalar("vertex2")) {
            read_ply_edges(file, element, samples);
            continue;
        }
        if (element.name != "vertex") {
            is_mesh |= element.name == "face" && element.count > 0;
            file.read_records(element, [](std::uint64_t, const PlyRecord&) {});
            continue;
        }
        file.check_unique(element);
        has_vertices = true;
        const auto place_of = [&](std::string_view name) { return element.find_scalar(name); };
        const ColumnPlaces places = find_places(path, domain, place_of);
        ExtraReader extra(path, place_of, numbers);
        samples.dimension = places.dimension();
        samples.has_faces = places.has_faces;
        samples.rows.reserve(file.possible_records(element));
        file.read_records(element, [&](std::uint64_t index, const PlyRecord& record) {
            samples.rows.push_back(make_row(
                places, [&](std::size_t place) { return record.scalars[place]; },
                [&](const std::string& message) { file.fail(element, index, message); }));
            extra.add_row([&](std::size_t place) { return std::optional(record.scalars[place]); });
        });
        std::move(extra).move_to(samples);
    }
    if (!has_vertices) {
        fail_input(path, "has no element vertex");
    }
    check_edges(path, samples);
    if (!samples.has_faces && is_mesh) {
        fail_input(path, "has faces, so this is a mesh and no file of samples");
    }
    if (file.trailing_bytes() > 0) {
        fail_input(path, "has data after the last sample");
    }
    if (file.ends_within_line()) {
        check_last_line(path, "-");
    }
    return samples;
}

namespace {

SampleFile read_in(const Path& path, SampleDomain domain, const std::string& numbers) {
    const std::optional<SampleFormat> named = find_format(path);
    if (named && facts_of(*named).read == nullptr) {
        fail_input(path, "geodisk writes samples as " + extension_of(*named) +
                             " but does not read them back; use " +
                             listed_formats(&FormatFacts::is_read_back));
    }
    std::string bytes = read_file(path);
    if (is_of_numpy(bytes)) {
        return read_numpy_samples(path, std::move(bytes), domain, numbers);
    }
    if (named == SampleFormat::vtp) {
        return read_vtp_samples(path, std::move(bytes), domain, numbers);
    }
    refuse_other_content(path, bytes);
    if (named == SampleFormat::npz || lower_extension(path) == ".npy") {
        fail_input(path, "is no file of numpy; write it with numpy.save or numpy.savez");
    }
    // The extension says the format, but files named .xyz may be of any; else how they begin does.
    const bool is_ply = bytes.starts_with("ply\n") || bytes.starts_with("ply\r");
    const bool is_pcd =
        bytes.starts_with("# .PCD") || bytes.starts_with("VERSION") || bytes.starts_with("FIELDS");
    const SampleReader read = named && named != SampleFormat::xyz ? facts_of(*named).read
                              : is_ply                            ? read_ply_samples
                              : is_pcd                            ? read_pcd_samples
                                                                  : read_table_samples;
    return read(path, std::move(bytes), domain, numbers);
}

} // namespace

SampleFile read_samples(const Path& path, const std::string& numbers) {
    SampleFile samples = read_in(path, SampleDomain::surface, numbers);
    check_digest(path, samples.header);
    samples.path = path.string();
    return samples;
}

SampleFile read_box_samples(const Path& path) {
    SampleFile samples = read_in(path, SampleDomain::box, {});
    samples.path = path.string();
    return samples;
}

} // namespace geodisk::tools
