// Text files beside a mesh file that say what its format cannot: coordinates beyond three, values
// of vertices, and the lengths of edges. Blank lines and what follows a '#' are ignored.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <unordered_map>
#include <vector>

#include "files/meshes/value_files.hpp"
#include "program/path.hpp"

namespace geodisk::tools {

struct Coordinates {
    std::vector<double> positions; ///< `dimension` per vertex.
    std::uint32_t dimension = 0;
};

/// Reads one line per vertex of 3 to 8 finite numbers, the same on all lines. Throws
/// UserError(bad_input) naming the file and the line, like the others.
Coordinates read_coordinates(const Path& path);

/// Reads one finite number per line, or the values of vertices in a file of value_files.hpp, for a
/// mesh of so many vertices. Of these, only a list of vertices needs their number; other files may
/// have more or fewer values.
VertexValues read_values(const Path& path, std::size_t vertex_count);

/// An edge by its vertices, numbered from 0, and the line of the file that names it.
struct NamedEdge {
    std::array<std::uint32_t, 2> vertices;
    std::size_t line;
};

/// Reads one line "V0 V1" per edge. Vertices are numbered from `first_vertex` there.
std::vector<NamedEdge> read_edges(const Path& path, std::uint32_t first_vertex);

/// Lengths by edge. Vertices are numbered from 0 here, whatever the file does.
class EdgeLengths {
  public:
    /// Reads one line "V0 V1 LENGTH" per edge, in any order. Vertices are numbered from
    /// `first_vertex`, which messages do as well.
    EdgeLengths(const Path& path, std::uint32_t first_vertex);

    /// Throws UserError(bad_input) if the file has no length for the edge.
    double between(std::uint32_t a, std::uint32_t b);

    /// Returns how many edges nobody has asked for.
    std::size_t unused() const;

  private:
    struct Entry {
        double length;
        std::size_t line;
        bool is_used;
    };
    void add(std::size_t line, std::uint32_t a, std::uint32_t b, double length);

    Path path_;
    std::uint32_t first_vertex_;
    std::unordered_map<std::uint64_t, Entry> edges_; ///< By both vertices, the lower one high.
};

} // namespace geodisk::tools
