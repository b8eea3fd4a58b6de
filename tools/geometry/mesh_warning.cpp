#include "geometry/mesh_warning.hpp"

#include "program/human_text.hpp"

namespace geodisk::tools {

std::string ElementNames::of_face(std::uint64_t index) const {
    return face_lines.empty() ? face + std::to_string(index)
                              : "line " + std::to_string(face_lines[index]);
}

std::string ElementNames::of_vertex(std::uint64_t index) const {
    return vertex_lines.empty()
               ? vertex + std::to_string(index)
               : "line " + std::to_string(vertex_lines[index]) + ", vertex " + vertex_number(index);
}

std::string ElementNames::vertex_number(std::uint64_t index) const {
    return std::to_string(index + first_vertex);
}

void add_warning(std::vector<MeshWarning>& warnings, std::string_view kind, std::uint64_t count,
                 const std::string& first, std::string_view one, std::string_view many) {
    if (count > 0) {
        std::string message = counted(count, one, many);
        message += first.empty() ? "" : count == 1 ? " (" + first + ")" : " (first: " + first + ")";
        warnings.push_back({std::string(kind), count, first, std::move(message), {}});
    }
}

void warn_of_repeated_vertices(std::vector<MeshWarning>& warnings, std::uint64_t count,
                               const std::string& first) {
    add_warning(warnings, "repeated_vertices", count, first,
                "face with a repeated vertex dropped or simplified",
                "faces with a repeated vertex dropped or simplified");
}

} // namespace geodisk::tools
