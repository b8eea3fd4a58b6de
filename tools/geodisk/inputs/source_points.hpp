// Sources of searches: vertices of a mesh by their numbers, or points of a file.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <geodisk/sample.hpp>

#include "files/samples/sample_file.hpp"
#include "geodisk/inputs/mesh_input.hpp"
#include "geodisk/outputs/progress.hpp"
#include "program/command.hpp"

namespace geodisk::tools {

/// Points of a mesh with the numbers that a file gives them.
struct NumberedPoints {
    std::vector<Sample> points;
    std::vector<std::uint32_t> numbers; ///< Empty for 0, 1, 2 ...
};

/// Vertices from the first to the last.
struct VertexRange {
    std::uint32_t first, last;
};

/// Sources as given on the command line.
struct SourceOptions {
    std::string points, vertices, tolerance;

    /// Appends the files that are read for them.
    void add_files(std::vector<NamedFile>& read) const;
    /// Returns the vertices; none if none are named. Throws UserError, also where points are given
    /// too.
    std::vector<VertexRange> ranges() const;
    /// Reads the points of a file, at least one, onto the mesh, with the numbers of a column unless
    /// that is "". Throws UserError.
    SampleFile read(const std::string& path, const std::string& column, const MeshInput& mesh,
                    std::vector<MeshWarning>& warnings, ProgressLine& progress) const;
};

/// Adds the option of the vertices, and that of the tolerance of points.
void add_source_options(Command command, SourceOptions& options, const std::string& vertices_help);

// Of a vertex on walls, its place is on the side of its lowest face.

/// Returns the places of vertices that faces use, each by the lowest of those that are joined.
NumberedPoints places_of(const MeshInput& mesh);

/// Returns the vertices of the mesh that faces use, or those of `wanted` in that order. Of vertices
/// that are joined, each has the place of all. Throws UserError(usage) for one that there is not,
/// or that no face uses.
NumberedPoints vertices_of(const MeshInput& mesh, const std::vector<VertexRange>& wanted);

} // namespace geodisk::tools
