#include "geodisk/inputs/source_points.hpp"

#include <algorithm>
#include <optional>
#include <string_view>
#include <utility>

#include <geodisk/neighbours.hpp>

#include "files/text_file.hpp"
#include "files/text_lines.hpp"
#include "geodisk/checks/sample_input.hpp"
#include "geodisk/options/distance_options.hpp"
#include "program/arguments.hpp"
#include "program/exact_text.hpp"
#include "program/failure.hpp"
#include "program/human_text.hpp"

namespace geodisk::tools {
namespace {

/// Returns the range of a text such as "5" or "10-20"; nothing for another text.
std::optional<VertexRange> parsed_range(std::string_view text) {
    const std::size_t dash = text.find('-');
    const auto first = parse_integer<std::uint32_t>(text.substr(0, dash));
    const auto last = dash == std::string_view::npos
                          ? first
                          : parse_integer<std::uint32_t>(text.substr(dash + 1));
    return first && last && *first <= *last ? std::optional(VertexRange{*first, *last})
                                            : std::nullopt;
}

std::string no_range_text(std::string_view text) {
    return in_quotes(std::string(text)) + " is neither a number nor a range such as 10-20";
}

/// Returns the name of the file of vertices; "" if they are on the command line.
std::string vertex_file(const std::string& vertices) {
    return vertices.starts_with('@') ? vertices.substr(1) : "";
}

/// Reads numbers and ranges between blanks, commas and lines; '#' begins a comment.
std::vector<VertexRange> vertices_in(const std::string& file) {
    std::vector<VertexRange> ranges;
    const std::string text = read_text(file);
    TextLines lines(text);
    for (std::string_view read; lines.next(read);) {
        std::string line(without_comment(read));
        std::ranges::replace(line, ',', ' ');
        std::vector<std::string_view> words;
        split_tokens(line, words);
        for (const std::string_view word : words) {
            const auto range = parsed_range(word);
            if (!range) {
                fail_input(file,
                           "line " + std::to_string(lines.number()) + ": " + no_range_text(word));
            }
            ranges.push_back(*range);
        }
    }
    if (ranges.empty()) {
        fail_input(file, "names no vertex");
    }
    return ranges;
}

/// Leaves out copies of vertices, which walls made.
NumberedPoints of_file(const MeshInput& mesh, VertexPoints points) {
    const std::size_t count = mesh.file.file_vertices(mesh.prepared.vertex_count());
    const auto first = std::ranges::lower_bound(points.vertices, count);
    points.points.resize(static_cast<std::size_t>(first - points.vertices.begin()));
    points.vertices.resize(points.points.size());
    return {std::move(points.points), std::move(points.vertices)};
}

} // namespace

void SourceOptions::add_files(std::vector<NamedFile>& read) const {
    if (!points.empty()) {
        read.push_back({"the sources", points});
    }
    if (const std::string file = vertex_file(vertices); !file.empty()) {
        read.push_back({"the vertices", file});
    }
}

std::vector<VertexRange> SourceOptions::ranges() const {
    if (!points.empty() && !vertices.empty()) {
        fail_usage("--vertices contradicts POINTS: sources are either");
    }
    if (const std::string file = vertex_file(vertices); !file.empty()) {
        return vertices_in(file);
    }
    std::vector<VertexRange> found;
    for (const std::string& part : parts_of(vertices)) {
        const std::string_view item = trimmed(part);
        const auto range = parsed_range(item);
        if (!range) {
            fail_usage("--vertices: " + no_range_text(item));
        }
        found.push_back(*range);
    }
    return found;
}

SampleFile SourceOptions::read(const std::string& path, const std::string& column,
                               const MeshInput& mesh, std::vector<MeshWarning>& warnings,
                               ProgressLine& progress) const {
    SampleFile file =
        read_samples_silently_on(path, mesh, tolerance, warnings, progress, {"point", column});
    if (file.rows.empty()) {
        fail_input(path, "has no points");
    }
    return file;
}

void add_source_options(Command command, SourceOptions& options, const std::string& vertices_help) {
    command.add_option("--vertices", options.vertices, "LIST", vertices_help);
    add_tolerance_option(command, options.tolerance);
}

NumberedPoints places_of(const MeshInput& mesh) {
    return of_file(mesh, take(vertex_points(mesh.prepared)));
}

NumberedPoints vertices_of(const MeshInput& mesh, const std::vector<VertexRange>& wanted) {
    NumberedPoints all = of_file(mesh, take(vertex_points(mesh.prepared, mesh.file.joined)));
    if (wanted.empty()) {
        return all;
    }
    const std::size_t count = mesh.file.file_vertices(mesh.prepared.vertex_count());
    NumberedPoints found;
    for (const auto& [first, last] : wanted) {
        if (last >= count) {
            fail_usage("--vertices: there is no vertex " + std::to_string(last) +
                       ", since the mesh has " + grouped(count) + ", counted from 0");
        }
        auto at = std::ranges::lower_bound(all.numbers, first);
        for (std::uint32_t vertex = first; vertex <= last; ++vertex, ++at) {
            if (at == all.numbers.end() || *at != vertex) {
                fail_usage("--vertices: no face uses vertex " + std::to_string(vertex));
            }
            found.points.push_back(all.points[static_cast<std::size_t>(at - all.numbers.begin())]);
            found.numbers.push_back(vertex);
        }
    }
    return found;
}

} // namespace geodisk::tools
