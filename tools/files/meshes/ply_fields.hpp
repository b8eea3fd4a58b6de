// The attributes of vertices and faces of PLY files.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "files/meshes/mesh_fields.hpp"
#include "files/meshes/polygon_mesh.hpp"
#include "files/ply_file.hpp"

namespace geodisk::tools {

/// Returns the columns of texture coordinates s t, u v or texture_u texture_v; none without them.
std::vector<std::size_t> find_uv_columns(const PlyElement& element);

/// The unit of the colours of an element: integers, and numbers of which some exceed 1, are divided
/// to be from 0 to 1.
class PlyColours {
  public:
    explicit PlyColours(const PlyElement& element);

    /// Columns of red, green, blue and, if there is one, alpha; none without them.
    const std::vector<std::size_t>& columns() const { return columns_; }
    /// Regards a record.
    void add(const PlyRecord& record);
    /// Scales the values of a column if it is one of these, once all records were regarded.
    void scale(std::size_t column, std::vector<double>& values) const;

  private:
    std::vector<std::size_t> columns_;
    double scale_ = 1;
    bool is_scaled_ = false;
};

/// Lists in `mesh` the attributes that the element `vertex` or `face` has, and reads the wanted
/// ones: colours, texture coordinates, and scalar properties by their names. An attribute whose
/// name an earlier one has is called face_NAME or vertex_NAME.
class PlyFieldReader {
  public:
    /// All arguments must outlive the reader.
    PlyFieldReader(const PlyFile& file, const PlyElement& element, const WantedFields& wanted,
                   PolygonMesh& mesh);

    /// Reads the attributes of record `index`, with `corners` of a face.
    void add(std::uint64_t index, const PlyRecord& record, std::size_t corners = 0);

    /// Ends the element: scales colours, and moves texture coordinates of corners into the mesh, in
    /// place of those of vertices.
    void finish();

  private:
    struct Columns {
        std::vector<MeshField> PolygonMesh::*list; ///< Attributes, or columns by their own names.
        std::size_t field;                         ///< Index there.
        std::vector<std::size_t> columns;
    };

    void find();
    void find_uvs(std::vector<bool>& used);
    void find_own();
    void list(MeshField field, const std::vector<std::size_t>& columns);
    std::string prefix_for(std::string_view name) const;
    template <class Fail>
    void lose_uvs(const Fail& fail);
    void add_corner_uvs(std::uint64_t index, const PlyRecord& record, std::size_t corners);

    const PlyFile& file_;
    const PlyElement& element_;
    const WantedFields& wanted_;
    PolygonMesh& mesh_;
    bool of_faces_;
    PlyColours colours_;
    std::vector<Columns> columns_;
    std::vector<std::size_t> normals_;
    std::optional<std::size_t> corner_uvs_; ///< List of the texture coordinates of a face.
    std::vector<double> uvs_;
    std::vector<std::uint32_t> uv_indices_;
};

} // namespace geodisk::tools
