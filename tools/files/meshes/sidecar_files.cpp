#include "files/meshes/sidecar_files.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <string_view>
#include <utility>

#include "files/input_file.hpp"
#include "files/text_file.hpp"
#include "files/text_lines.hpp"
#include "geometry/mesh.hpp"
#include "program/exact_text.hpp"
#include "program/failure.hpp"
#include "program/human_text.hpp"

namespace geodisk::tools {
namespace {

[[noreturn]] void fail_line(const Path& path, std::size_t line, const std::string& message) {
    fail_input(path, "line " + std::to_string(line) + ": " + message);
}

/// Calls visit(line, tokens) for every line that holds any.
template <typename Visit>
void for_each_line(std::string_view bytes, const Visit& visit) {
    std::vector<std::string_view> tokens;
    TextLines lines(bytes);
    for (std::string_view line; lines.next(line);) {
        split_tokens(without_comment(line), tokens);
        if (!tokens.empty()) {
            visit(lines.number(), tokens);
        }
    }
}

double number_at(const Path& path, std::size_t line, std::string_view token) {
    const std::optional<double> value = parse_real(token);
    if (!value) {
        fail_line(path, line, in_quotes(token) + " is not a number");
    }
    if (!std::isfinite(*value)) {
        fail_line(path, line, in_quotes(token) + " is not finite");
    }
    return *value;
}

/// Returns a vertex, numbered from 0.
std::uint32_t vertex_at(const Path& path, std::size_t line, std::string_view token,
                        std::uint32_t first_vertex) {
    const std::optional<std::uint32_t> vertex = parse_integer<std::uint32_t>(token);
    if (!vertex || *vertex < first_vertex) {
        fail_line(path, line,
                  in_quotes(token) + " is not a vertex; they are numbered from " +
                      std::to_string(first_vertex));
    }
    return *vertex - first_vertex;
}

std::uint64_t key_of(std::uint32_t a, std::uint32_t b) {
    return std::uint64_t{std::min(a, b)} << 32 | std::max(a, b);
}

std::string edge_text(std::uint32_t a, std::uint32_t b, std::uint32_t first_vertex) {
    return "edge " + std::to_string(std::uint64_t{a} + first_vertex) + "-" +
           std::to_string(std::uint64_t{b} + first_vertex);
}

} // namespace

Coordinates read_coordinates(const Path& path) {
    Coordinates result;
    const std::string bytes = read_text(path);
    for_each_line(bytes, [&](std::size_t line, const std::vector<std::string_view>& tokens) {
        if (result.dimension == 0) {
            if (tokens.size() < kFewestCoordinates || tokens.size() > kMaxCoordinates) {
                fail_line(path, line,
                          "has " + std::to_string(tokens.size()) +
                              " numbers; a vertex has 3 to 8 coordinates");
            }
            result.dimension = static_cast<std::uint32_t>(tokens.size());
        }
        if (tokens.size() != result.dimension) {
            fail_line(path, line,
                      "has " + std::to_string(tokens.size()) + " numbers instead of " +
                          std::to_string(result.dimension));
        }
        for (const std::string_view token : tokens) {
            result.positions.push_back(number_at(path, line, token));
        }
    });
    if (result.positions.empty()) {
        fail_input(path, "has no coordinates");
    }
    return result;
}

VertexValues read_values(const Path& path, std::size_t vertex_count) {
    if (lower_extension(path) == ".gii") {
        return read_gifti_values(path);
    }
    const std::string bytes = read_file(path);
    if (is_freesurfer_values(bytes)) {
        return {read_freesurfer_values(path, bytes), {}, false};
    }
    if (lower_extension(path) == ".annot") {
        return read_freesurfer_annotation(path, bytes);
    }
    if (is_freesurfer_label(path, bytes)) {
        return read_freesurfer_label(path, bytes, vertex_count);
    }
    refuse_other_content(path, bytes);
    std::vector<double> values;
    for_each_line(bytes, [&](std::size_t line, const std::vector<std::string_view>& tokens) {
        if (tokens.size() != 1) {
            fail_line(path, line,
                      "has " + std::to_string(tokens.size()) + " numbers instead of one");
        }
        values.push_back(number_at(path, line, tokens[0]));
    });
    return {std::move(values), {}, false};
}

std::vector<NamedEdge> read_edges(const Path& path, std::uint32_t first_vertex) {
    std::vector<NamedEdge> edges;
    const std::string bytes = read_text(path);
    for_each_line(bytes, [&](std::size_t line, const std::vector<std::string_view>& tokens) {
        if (tokens.size() != 2) {
            fail_line(path, line, "an edge reads 'VERTEX VERTEX'");
        }
        edges.push_back({{vertex_at(path, line, tokens[0], first_vertex),
                          vertex_at(path, line, tokens[1], first_vertex)},
                         line});
    });
    if (edges.empty()) {
        fail_input(path, "has no edges");
    }
    return edges;
}

EdgeLengths::EdgeLengths(const Path& path, std::uint32_t first_vertex)
    : path_(path), first_vertex_(first_vertex) {
    const std::string bytes = read_text(path_);
    for_each_line(bytes, [&](std::size_t line, const std::vector<std::string_view>& tokens) {
        if (tokens.size() != 3) {
            fail_line(path_, line, "an edge reads 'VERTEX VERTEX LENGTH'");
        }
        const std::uint32_t a = vertex_at(path_, line, tokens[0], first_vertex_);
        const std::uint32_t b = vertex_at(path_, line, tokens[1], first_vertex_);
        add(line, a, b, number_at(path_, line, tokens[2]));
    });
}

void EdgeLengths::add(std::size_t line, std::uint32_t a, std::uint32_t b, double length) {
    if (!(length > 0)) {
        fail_line(path_, line,
                  edge_text(a, b, first_vertex_) + " has a length that is not positive");
    }
    const auto [entry, is_new] = edges_.try_emplace(key_of(a, b), Entry{length, line, false});
    if (!is_new && entry->second.length != length) {
        fail_line(path_, line,
                  edge_text(a, b, first_vertex_) + " has another length than in line " +
                      std::to_string(entry->second.line));
    }
}

double EdgeLengths::between(std::uint32_t a, std::uint32_t b) {
    const auto found = edges_.find(key_of(a, b));
    if (found == edges_.end()) {
        fail_input(path_, "has no length for " + edge_text(a, b, first_vertex_));
    }
    found->second.is_used = true;
    return found->second.length;
}

std::size_t EdgeLengths::unused() const {
    return static_cast<std::size_t>(std::count_if(
        edges_.begin(), edges_.end(), [](const auto& edge) { return !edge.second.is_used; }));
}

} // namespace geodisk::tools
