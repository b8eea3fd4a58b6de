// Attributes of mesh files that hold arrays of numbers with names, as VTK and GIFTI do.
#pragma once

#include <cstddef>
#include <functional>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "files/meshes/mesh_fields.hpp"
#include "files/meshes/polygon_mesh.hpp"
#include "geometry/mesh.hpp"
#include "program/path.hpp"

namespace geodisk::tools {

/// An array with some numbers for each vertex or face.
struct MeshArray {
    enum class Role { numbers, colours, normals, uvs };

    std::string name;
    MeshField::Of of = MeshField::Of::vertices;
    std::size_t components = 1; ///< Numbers of a vertex or face.
    bool is_whole = false;      ///< Integers. Colours of integers go up to 255.
    Role role = Role::numbers;
};

/// Lists in `mesh` the arrays that a file has as attributes, and reads the wanted ones: "color",
/// "uv", and others by their names. The first array of colours is "color". An array whose name an
/// earlier attribute has is called face_NAME or vertex_NAME.
class ArrayFields {
  public:
    /// Returns all numbers of an array, or throws UserError(bad_input).
    using Read = std::function<std::vector<double>()>;

    /// All arguments must outlive it.
    ArrayFields(const Path& path, const WantedFields& wanted, PolygonMesh& mesh)
        : path_(path), wanted_(wanted), mesh_(mesh) {}

    /// Adds an array, or appends to one that another piece of the mesh has. Throws UserError for
    /// an array that is asked for and cannot be read; others are left out, with a warning.
    void add(MeshArray array, const Read& read);

    /// Ends the mesh, which has all its faces.
    void finish();

  private:
    using Key = std::pair<MeshField::Of, std::string>;

    void add_normals(const MeshArray& array, const Read& read);
    MeshField field_of(const MeshArray& array) const;
    void read_into(MeshField& field, const MeshArray& array, const Read& read);
    bool is_needed(const MeshField& field) const;

    const Path& path_;
    const WantedFields& wanted_;
    PolygonMesh& mesh_;
    std::size_t components_ = 0;        ///< Numbers per element of all arrays.
    std::map<Key, std::size_t> places_; ///< Indices of attributes, by what the file calls them.
};

} // namespace geodisk::tools
