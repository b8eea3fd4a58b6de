#include "files/meshes/vtk_cells.hpp"

#include <algorithm>
#include <utility>

#include "files/meshes/triangle_strip.hpp"
#include "program/exact_text.hpp"
#include "program/failure.hpp"
#include "program/human_text.hpp"

namespace geodisk::tools {

VtkCells::VtkCells(const Path& path, const WantedFields& wanted, PolygonMesh& mesh)
    : path_(path), mesh_(mesh), fields_(path, wanted, mesh), has_fields_(wanted.are_given()) {}

void VtkCells::begin_piece(std::size_t points) {
    first_point_ += std::exchange(points_, points);
    cells_ = 0;
    cell_of_face_.clear();
}

void VtkCells::fail(const std::string& message) const {
    fail_input(path_, "cell " + std::to_string(cells_) + ": " + message);
}

std::uint32_t VtkCells::corner_at(const VtkCellArray& cells, std::size_t index) const {
    const double corner = cells.corners[index];
    if (!(corner >= 0 && corner < static_cast<double>(points_))) {
        fail("vertex index " + exact_text(corner) + " is out of range, there are " +
             counted(points_, "point", "points"));
    }
    return static_cast<std::uint32_t>(first_point_ + static_cast<std::size_t>(corner));
}

void VtkCells::add(const VtkCellArray& cells, std::size_t index, VtkShape shape) {
    const double before = index == 0 ? 0 : cells.ends[index - 1], after = cells.ends[index];
    if (!(after >= before && after <= static_cast<double>(cells.corners.size()))) {
        fail("its corners end at " + exact_text(after) + " of " +
             std::to_string(cells.corners.size()) + " and begin at " + exact_text(before));
    }
    const auto begin = static_cast<std::size_t>(before), end = static_cast<std::size_t>(after);
    const std::size_t faces = mesh_.face_ends.size();
    TriangleStrip strip(mesh_);
    for (std::size_t i = begin; i < end && shape != VtkShape::no_face; ++i) {
        if (shape == VtkShape::strip) {
            strip.add(corner_at(cells, i));
        } else {
            mesh_.corners.push_back(corner_at(cells, i));
        }
    }
    if (shape == VtkShape::pixel && end - begin == 4) { // Corners go row by row.
        std::swap(mesh_.corners.end()[-1], mesh_.corners.end()[-2]);
    }
    if (shape == VtkShape::polygon || shape == VtkShape::pixel) {
        mesh_.face_ends.push_back(mesh_.corners.size());
    }
    if (has_fields_) {
        cell_of_face_.resize(cell_of_face_.size() + mesh_.face_ends.size() - faces, cells_);
    }
    ++cells_;
}

void VtkCells::add(const VtkCellArray& cells, VtkShape shape) {
    for (std::size_t i = 0; i < cells.count(); ++i) {
        add(cells, i, shape);
    }
}

void VtkCells::skip(std::uint64_t count) {
    cells_ += count;
}

void VtkCells::add_array(const MeshArray& array, const ArrayFields::Read& read) {
    const bool is_of_faces = array.of == MeshField::Of::faces;
    fields_.add(array, [&] {
        const std::vector<double> values = read();
        const std::uint64_t needed = is_of_faces ? cells_ : points_;
        if (values.size() != needed * array.components) {
            fail_input(path_, in_quotes(array.name) + " has " +
                                  counted(values.size(), "number", "numbers") + " for " +
                                  counted(needed, is_of_faces ? "cell" : "point",
                                          is_of_faces ? "cells" : "points"));
        }
        return is_of_faces ? at_faces(values, array.components) : values;
    });
}

std::vector<double> VtkCells::at_faces(const std::vector<double>& of_cells,
                                       std::size_t components) const {
    std::vector<double> values;
    values.reserve(cell_of_face_.size() * components);
    for (const std::uint64_t cell : cell_of_face_) {
        const auto first = of_cells.begin() + static_cast<std::ptrdiff_t>(cell * components);
        values.insert(values.end(), first, first + static_cast<std::ptrdiff_t>(components));
    }
    return values;
}

} // namespace geodisk::tools
