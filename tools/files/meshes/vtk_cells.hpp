// The cells of VTK's files, of which polygons and strips of triangles become faces.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "files/meshes/array_fields.hpp"
#include "files/meshes/polygon_mesh.hpp"
#include "program/path.hpp"

namespace geodisk::tools {

/// Cells as files list them: points of all, one cell after another, and where each cell ends.
struct VtkCellArray {
    std::vector<double> corners, ends;

    std::size_t count() const { return ends.size(); }
};

/// Kinds of cells, which become no face, one, or several.
enum class VtkShape { no_face, polygon, pixel, strip };

/// Adds cells and their attributes to a mesh. A file consists of one piece or of several, with
/// points and cells of their own.
class VtkCells {
  public:
    /// All arguments must outlive it.
    VtkCells(const Path& path, const WantedFields& wanted, PolygonMesh& mesh);

    /// Begins a piece with so many points, which the mesh gets with it.
    void begin_piece(std::size_t points);

    /// Adds the next cell of the piece, which is number `index` of `cells`. Throws
    /// UserError(bad_input) for numbers that are none of points or of corners.
    void add(const VtkCellArray& cells, std::size_t index, VtkShape shape);
    /// Adds all cells, of one shape.
    void add(const VtkCellArray& cells, VtkShape shape);
    /// Passes over cells that make no faces.
    void skip(std::uint64_t count);

    /// Returns the number of cells of the piece so far.
    std::uint64_t count() const { return cells_; }

    /// Adds an array of the points or the cells of the piece, which has all its cells. `read` gives
    /// its numbers, those of a cell instead of those of a face.
    void add_array(const MeshArray& array, const ArrayFields::Read& read);

    /// Ends the mesh.
    void finish() { fields_.finish(); }

  private:
    [[noreturn]] void fail(const std::string& message) const;
    std::uint32_t corner_at(const VtkCellArray& cells, std::size_t index) const;
    std::vector<double> at_faces(const std::vector<double>& of_cells, std::size_t components) const;

    const Path& path_;
    PolygonMesh& mesh_;
    ArrayFields fields_;
    bool has_fields_;
    std::size_t first_point_ = 0, points_ = 0; ///< Points of the piece.
    std::uint64_t cells_ = 0;
    std::vector<std::uint64_t> cell_of_face_; ///< Cells of the faces of the piece.
};

} // namespace geodisk::tools
