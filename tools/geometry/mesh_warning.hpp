// What is odd about a mesh, and the words to tell it in.
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
    std::string first;   ///< Where the first one is, in the words of the file; "" for no place.
    std::string message; ///< For people, with count and place.
    std::string file;    ///< Which file it is about, where that is not the mesh.
};

/// How many elements something was found of, and the lowest of them.
struct Found {
    static constexpr std::uint64_t kNone = std::numeric_limits<std::uint64_t>::max();

    std::uint64_t count = 0;
    std::uint64_t first = kNone;

    void add(std::uint64_t element) {
        ++count;
        first = std::min(first, element);
    }
};

/// How a file tells where its faces and vertices are: by line, counted from 1, where records have
/// lines, else by record, counted from 0.
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
