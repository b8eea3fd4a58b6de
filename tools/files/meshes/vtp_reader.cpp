#include <algorithm>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "files/input_file.hpp"
#include "files/meshes/polygon_mesh.hpp"
#include "files/meshes/vtk_cells.hpp"
#include "files/meshes/vtp_data.hpp"
#include "files/samples/sample_writers.hpp"
#include "files/samples/told_samples.hpp"
#include "files/xml_file.hpp"
#include "program/failure.hpp"
#include "program/human_text.hpp"

namespace geodisk::tools {
namespace {

class VtpReader {
  public:
    VtpReader(const XmlFile& file, std::string_view appended, const WantedFields& fields)
        : file_(file), data_(file, appended), cells_(file.path(), fields, mesh_) {}

    PolygonMesh read() && {
        const pugi::xml_node data = file_.root().child("PolyData");
        for (const pugi::xml_node piece : data.children("Piece")) {
            read_piece(piece);
        }
        cells_.finish();
        return std::move(mesh_);
    }

  private:
    std::uint64_t count_in(const pugi::xml_node& node, const char* attribute) const {
        const std::uint64_t count = file_.count_in(node, attribute).value_or(0);
        if (count > std::numeric_limits<std::uint32_t>::max()) {
            file_.fail(node, std::string("has ") + attribute + "=" +
                                 in_quotes(std::to_string(count)) + ", more than can be numbered");
        }
        return count;
    }

    void read_piece(const pugi::xml_node& piece) {
        const std::uint64_t points = count_in(piece, "NumberOfPoints");
        const pugi::xml_node array = piece.child("Points").child("DataArray");
        if (points > 0 && !array) {
            file_.fail(piece, "has no array of Points");
        }
        std::vector<double> positions;
        if (points > 0) {
            positions = data_.read(array, 3 * points);
        }
        if (mesh_.positions.empty()) {
            mesh_.positions = std::move(positions);
        } else {
            mesh_.positions.insert(mesh_.positions.end(), positions.begin(), positions.end());
        }
        cells_.begin_piece(points);
        cells_.skip(count_in(piece, "NumberOfVerts"));
        cells_.skip(count_in(piece, "NumberOfLines"));
        read_cells(piece, "NumberOfPolys", "Polys", VtkShape::polygon);
        read_cells(piece, "NumberOfStrips", "Strips", VtkShape::strip);
        read_attributes(piece.child("PointData"), MeshField::Of::vertices, points);
        read_attributes(piece.child("CellData"), MeshField::Of::faces, cells_.count());
    }

    void read_cells(const pugi::xml_node& piece, const char* number, const char* name,
                    VtkShape shape) {
        const std::uint64_t count = count_in(piece, number);
        if (count == 0) {
            return;
        }
        const auto array_named = [&](const char* array) {
            const pugi::xml_node found =
                piece.child(name).find_child_by_attribute("DataArray", "Name", array);
            if (!found) {
                file_.fail(piece, "has " + std::string(number) + "=" +
                                      in_quotes(std::to_string(count)) + " but no array " +
                                      in_quotes(array) + " of " + name);
            }
            return found;
        };
        const pugi::xml_node ends = array_named("offsets"), corners = array_named("connectivity");
        VtkCellArray cells;
        cells.ends = data_.read(ends, count);
        const double last = cells.ends.back();
        if (!(last >= 0 && last <= std::numeric_limits<std::uint32_t>::max())) {
            file_.fail(ends, "does not end with a number of corners");
        }
        cells.corners = data_.read(corners, static_cast<std::uint64_t>(last));
        cells_.add(cells, shape);
    }

    void read_attributes(const pugi::xml_node& data, MeshField::Of of, std::uint64_t elements) {
        const std::string_view normals = data.attribute("Normals").value(),
                               uvs = data.attribute("TCoords").value();
        for (const pugi::xml_node node : data.children()) {
            const NumberType* const type = VtpData::type_of(node);
            if (type == nullptr) {
                continue;
            }
            MeshArray array{node.attribute("Name").value(), of};
            array.components = std::max<std::uint64_t>(count_in(node, "NumberOfComponents"), 1);
            array.is_whole = type->is_whole;
            array.role = array.name == normals                    ? MeshArray::Role::normals
                         : array.name == uvs                      ? MeshArray::Role::uvs
                         : type->is_byte && array.components >= 3 ? MeshArray::Role::colours
                                                                  : MeshArray::Role::numbers;
            const std::uint64_t count = elements * array.components;
            cells_.add_array(array, [&] { return data_.read(node, count); });
        }
    }

    const XmlFile& file_;
    VtpData data_;
    PolygonMesh mesh_;
    VtkCells cells_;
};

} // namespace

PolygonMesh read_vtp(const Path& path, const WantedFields& fields) {
    const std::string bytes = read_file(path);
    const VtpParts parts(bytes);
    const XmlFile file(path, parts.xml);
    check_polydata(file);
    if (std::string_view(parts.xml).substr(0, 200).find(kVtpSamples) != std::string_view::npos) {
        fail_input(path, kHoldsSamples);
    }
    return VtpReader(file, parts.appended, fields).read();
}

} // namespace geodisk::tools
