#include "common/ply_reader.hpp"

#include "common/file_input.hpp"
#include "common/ply_file.hpp"
#include "common/text.hpp"

#include <limits>

namespace geodisk::tools {

namespace {

void read_vertices(const std::filesystem::path& path, PlyFile& file, const PlyElement& element,
                   PolygonMesh& mesh) {
    std::size_t columns[3];
    for (int axis = 0; axis < 3; ++axis) {
        const char name[] = {"xyz"[axis], '\0'};
        const std::optional<std::size_t> column = element.find_scalar(name);
        if (!column) {
            fail_input(path, std::string("element vertex has no property ") + name);
        }
        columns[axis] = *column;
    }
    mesh.positions.reserve(3 * file.possible_records(element));
    file.read_records(element, [&](std::uint64_t, const PlyRecord& record) {
        for (const std::size_t column : columns) {
            mesh.positions.push_back(record.scalars[column]);
        }
    });
}

void read_faces(const std::filesystem::path& path, PlyFile& file, const PlyElement& element,
                PolygonMesh& mesh) {
    std::optional<std::size_t> column = element.find_list("vertex_indices");
    if (!column) {
        column = element.find_list("vertex_index");
    }
    if (!column) {
        fail_input(path, "element face has no list property vertex_indices");
    }
    mesh.face_ends.reserve(file.possible_records(element));
    file.read_records(element, [&](std::uint64_t index, const PlyRecord& record) {
        for (const double value : record.lists[*column]) {
            const bool in_range = value >= 0 && value <= std::numeric_limits<std::uint32_t>::max();
            const std::uint32_t corner = in_range ? static_cast<std::uint32_t>(value) : 0;
            if (!in_range || static_cast<double>(corner) != value) {
                std::string message = "vertex index ";
                append_number(message, value);
                file.fail(element, index, message + " is out of range or not a whole number");
            }
            mesh.corners.push_back(corner);
        }
        mesh.face_ends.push_back(mesh.corners.size());
    });
}

} // namespace

PolygonMesh read_ply(const std::filesystem::path& path) {
    PlyFile file(path);
    PolygonMesh mesh;
    bool has_vertices = false;
    bool has_faces = false;
    for (const PlyElement& element : file.elements()) {
        if (element.name == "vertex") {
            has_vertices = true;
            read_vertices(path, file, element, mesh);
        } else if (element.name == "face") {
            has_faces = true;
            read_faces(path, file, element, mesh);
        } else {
            file.read_records(element, [](std::uint64_t, const PlyRecord&) {});
        }
    }
    if (!has_vertices) {
        fail_input(path, "has no element vertex");
    }
    if (!has_faces) {
        fail_input(path, "has no faces: there is no element face");
    }
    if (std::string warning = file.trailing_data_warning(); !warning.empty()) {
        mesh.warnings.push_back(std::move(warning));
    }
    return mesh;
}

} // namespace geodisk::tools
