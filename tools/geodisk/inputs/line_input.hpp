// Lines to avoid: disks around points along them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include <geodisk/sample.hpp>

#include "files/samples/sample_file.hpp"
#include "geodisk/inputs/mesh_input.hpp"
#include "geodisk/options/constraint_options.hpp"

namespace geodisk::tools {

/// Points and lines to avoid, as disks that new samples keep out of.
struct Avoided {
    std::vector<KeepOut> disks;        ///< Those of points in files come first.
    std::vector<std::uint8_t> classes; ///< Class that each keeps out, or kAllClasses.
    std::size_t points = 0;            ///< Points in files, the ends of lines among them.
    double length = 0;                 ///< Length of all lines along the surface.

    bool empty() const { return disks.empty(); }
};

/// Covers the lines of a file, whose points are on the mesh already.
///
/// A line has disks around points that are at most an eighth of its radius R apart along the
/// surface. Each disk is wider than R by half of that, so that no point within R of the line is
/// left out, and none farther than 17/16 R is covered. Between two points of the file a line is
/// halved, and the middle moved to the nearest face, until both halves are short enough.
class LineCover {
  public:
    /// `path` names the file in errors; points may be moved by `tolerance`.
    LineCover(const MeshInput& mesh, std::string path, std::string tolerance);

    /// Adds the disks of the segments of `file`, whose rows have the disks from `first` on; these
    /// become wider. Further disks are appended to `between`. Returns the length of the lines.
    /// Throws UserError(bad_input) for a line that leaves the mesh.
    double cover(const SampleFile& file, std::size_t first, std::vector<KeepOut>& disks,
                 std::vector<KeepOut>& between) const;

  private:
    const MeshInput& mesh_;
    std::string path_, tolerance_;
};

/// Appends disks that cover, in the same way, all borders of the mesh, or all edges where faces
/// meet at more than 30 degrees and those of more than two faces. Returns their length.
double cover_edges(const MeshInput& mesh, AvoidOption::Kind kind, double radius,
                   std::vector<KeepOut>& disks);

} // namespace geodisk::tools
