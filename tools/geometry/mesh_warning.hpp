// Warnings about a mesh, and the words to report them in.
#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

namespace geodisk::tools {

/// An oddity that does not keep the mesh from being used: a line for people, an entry in reports.
struct MeshWarning {
    std::string kind; ///< For programs, such as "duplicate_faces".
    std::uint64_t count = 0;
    std::string first;   ///< Place of the first one, in the words of the file; "" for no place.
    std::string message; ///< For people, with count and place.
    std::string file;    ///< File that it is about, if that is not the mesh.
};

/// Number of elements that something was found of, and the lowest of them.
struct Found {
    static constexpr std::uint64_t kNone = std::numeric_limits<std::uint64_t>::max();

    std::uint64_t count = 0;
    std::uint64_t first = kNone;

    void add(std::uint64_t element) {
        ++count;
        first = std::min(first, element);
    }
};

/// Names by which a file identifies its faces and vertices. Records with lines are named by line,
/// counted from 1, others by record, counted from 0.
struct ElementNames {
    std::string face = "face ", vertex = "vertex "; ///< Before the record.
    std::vector<std::uint32_t> face_lines, vertex_lines;
    std::uint32_t first_vertex = 0; ///< The number that the file gives its first vertex.

    std::string of_face(std::uint64_t index) const;
    std::string of_vertex(std::uint64_t index) const;
    /// As the file numbers it.
    std::string vertex_number(std::uint64_t index) const;
};

/// Appends a warning of "COUNT ONE" or "COUNT MANY", and where the first is, unless there is none.
void add_warning(std::vector<MeshWarning>& warnings, std::string_view kind, std::uint64_t count,
                 const std::string& first, std::string_view one, std::string_view many);

/// Appends a warning of faces that name a vertex twice, unless there are none.
void warn_of_repeated_vertices(std::vector<MeshWarning>& warnings, std::uint64_t count,
                               const std::string& first);

} // namespace geodisk::tools
