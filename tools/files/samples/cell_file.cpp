#include "files/samples/cell_file.hpp"

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <string>
#include <vector>

#include "files/byte_order.hpp"
#include "files/input_file.hpp"
#include "files/output/block_writer.hpp"
#include "files/samples/vtp_arrays.hpp"
#include "program/exact_text.hpp"
#include "program/failure.hpp"

namespace geodisk::tools {
namespace {

constexpr const char *kSample = "sample", *kOther = "other", *kFace = "face";

/// Returns an index as files have it: -1 for none.
std::int32_t index_in_file(std::uint32_t index) {
    return index == CutCells::kNone ? -1 : static_cast<std::int32_t>(index);
}

std::size_t point_count(const CutCells& cells) {
    return cells.positions.size() / 3;
}

/// Returns the vertices that borders have, and puts their places there into `places`.
std::vector<std::uint32_t> border_vertices(const CutCells& cells,
                                           std::vector<std::uint32_t>& places) {
    std::vector<std::uint32_t> vertices;
    for (const CutCells::Border& border : cells.borders) {
        vertices.insert(vertices.end(), border.ends.begin(), border.ends.end());
    }
    std::ranges::sort(vertices);
    vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
    places.resize(point_count(cells));
    for (std::uint32_t i = 0; i < vertices.size(); ++i) {
        places[vertices[i]] = i;
    }
    return vertices;
}

void append_point(std::string& text, const CutCells& cells, std::size_t vertex) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
        text += ' ';
        append_number(text, cells.positions[3 * vertex + axis]);
    }
    text += '\n';
}

void write_obj_mesh(AtomicFile& file, const CutCells& cells) {
    write_each(file, point_count(cells), [&](std::string& text, std::size_t i) {
        text += 'v';
        append_point(text, cells, i);
    });
    std::vector<std::uint32_t> order(cells.triangles.size());
    std::iota(order.begin(), order.end(), 0u);
    std::ranges::stable_sort(order, {}, [&](std::uint32_t t) { return cells.samples[t]; });
    write_each(file, order.size(), [&](std::string& text, std::size_t i) {
        const std::uint32_t sample = cells.samples[order[i]];
        if (i == 0 || cells.samples[order[i - 1]] != sample) {
            text += "g ";
            text += sample == CutCells::kNone ? "none" : "sample_" + std::to_string(sample);
            text += '\n';
        }
        text += 'f';
        for (const std::uint32_t corner : cells.triangles[order[i]]) {
            text += ' ';
            append_number(text, corner + 1);
        }
        text += '\n';
    });
}

std::string ply_head(std::size_t points) {
    return "ply\nformat binary_little_endian 1.0\nelement vertex " + std::to_string(points) +
           "\nproperty double x\nproperty double y\nproperty double z\n";
}

void append_ply_point(std::string& bytes, const CutCells& cells, std::size_t vertex) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
        append_little_endian(bytes, cells.positions[3 * vertex + axis]);
    }
}

void write_ply_mesh(AtomicFile& file, const CutCells& cells) {
    file.write(ply_head(point_count(cells)) + "element face " +
               std::to_string(cells.triangles.size()) +
               "\nproperty list uchar int vertex_indices\nproperty int " + kSample +
               "\nproperty int " + kFace + "\nend_header\n");
    write_each(file, point_count(cells),
               [&](std::string& bytes, std::size_t i) { append_ply_point(bytes, cells, i); });
    write_each(file, cells.triangles.size(), [&](std::string& bytes, std::size_t i) {
        bytes += '\3';
        for (const std::uint32_t corner : cells.triangles[i]) {
            append_little_endian(bytes, corner);
        }
        append_little_endian(bytes, index_in_file(cells.samples[i]));
        append_little_endian(bytes, index_in_file(cells.faces[i]));
    });
}

void write_vtp_mesh(AtomicFile& file, const CutCells& cells) {
    const std::size_t count = cells.triangles.size();
    VtpArrays arrays(file, false);
    file.write("<Piece NumberOfPoints=\"" + std::to_string(point_count(cells)) +
               "\" NumberOfPolys=\"" + std::to_string(count) + "\">\n<Points>\n");
    arrays.add("Points", point_count(cells), 3,
               [&](std::size_t i, std::size_t k) { return cells.positions[3 * i + k]; });
    file.write("</Points>\n<Polys>\n");
    arrays.add("connectivity", 3 * count, 1, [&](std::size_t i, std::size_t) {
        return static_cast<std::int64_t>(cells.triangles[i / 3][i % 3]);
    });
    arrays.add("offsets", count, 1,
               [](std::size_t i, std::size_t) { return static_cast<std::int64_t>(3 * i + 3); });
    file.write("</Polys>\n<CellData>\n");
    arrays.add(kSample, count, 1,
               [&](std::size_t i, std::size_t) { return index_in_file(cells.samples[i]); });
    arrays.add(kFace, count, 1,
               [&](std::size_t i, std::size_t) { return index_in_file(cells.faces[i]); });
    file.write("</CellData>\n</Piece>\n");
    arrays.finish();
}

void write_obj_outlines(AtomicFile& file, const CutCells& cells) {
    std::vector<std::uint32_t> places;
    const std::vector<std::uint32_t> vertices = border_vertices(cells, places);
    write_each(file, vertices.size(), [&](std::string& text, std::size_t i) {
        text += 'v';
        append_point(text, cells, vertices[i]);
    });
    write_each(file, cells.borders.size(), [&](std::string& text, std::size_t i) {
        text += 'l';
        for (const std::uint32_t end : cells.borders[i].ends) {
            text += ' ';
            append_number(text, places[end] + 1);
        }
        text += '\n';
    });
}

void write_ply_outlines(AtomicFile& file, const CutCells& cells) {
    std::vector<std::uint32_t> places;
    const std::vector<std::uint32_t> vertices = border_vertices(cells, places);
    file.write(ply_head(vertices.size()) + "element edge " + std::to_string(cells.borders.size()) +
               "\nproperty int vertex1\nproperty int vertex2\nproperty int " + kSample +
               "\nproperty int " + kOther + "\nend_header\n");
    write_each(file, vertices.size(), [&](std::string& bytes, std::size_t i) {
        append_ply_point(bytes, cells, vertices[i]);
    });
    write_each(file, cells.borders.size(), [&](std::string& bytes, std::size_t i) {
        for (const std::uint32_t end : cells.borders[i].ends) {
            append_little_endian(bytes, places[end]);
        }
        for (const std::uint32_t sample : cells.borders[i].samples) {
            append_little_endian(bytes, index_in_file(sample));
        }
    });
}

void write_vtp_outlines(AtomicFile& file, const CutCells& cells) {
    std::vector<std::uint32_t> places;
    const std::vector<std::uint32_t> vertices = border_vertices(cells, places);
    const std::size_t count = cells.borders.size();
    VtpArrays arrays(file, false);
    file.write("<Piece NumberOfPoints=\"" + std::to_string(vertices.size()) +
               "\" NumberOfLines=\"" + std::to_string(count) + "\">\n<Points>\n");
    arrays.add("Points", vertices.size(), 3, [&](std::size_t i, std::size_t k) {
        return cells.positions[std::size_t{3} * vertices[i] + k];
    });
    file.write("</Points>\n<Lines>\n");
    arrays.add("connectivity", 2 * count, 1, [&](std::size_t i, std::size_t) {
        return static_cast<std::int64_t>(places[cells.borders[i / 2].ends[i % 2]]);
    });
    arrays.add("offsets", count, 1,
               [](std::size_t i, std::size_t) { return static_cast<std::int64_t>(2 * i + 2); });
    file.write("</Lines>\n<CellData>\n");
    for (std::size_t side = 0; side < 2; ++side) {
        arrays.add(side == 0 ? kSample : kOther, count, 1,
                   [&cells, side](std::size_t i, std::size_t) {
                       return index_in_file(cells.borders[i].samples[side]);
                   });
    }
    file.write("</CellData>\n</Piece>\n");
    arrays.finish();
}

} // namespace

CellFormat cell_format(const Path& path, const char* what) {
    const std::string extension = lower_extension(path);
    if (extension == ".obj") {
        return CellFormat::obj;
    }
    if (extension == ".ply") {
        return CellFormat::ply;
    }
    if (extension == ".vtp") {
        return CellFormat::vtp;
    }
    fail_usage(path.string() + ": " + what + " are written as .obj, .ply or .vtp");
}

void write_cell_mesh(AtomicFile& file, CellFormat format, const CutCells& cells) {
    switch (format) {
    case CellFormat::obj:
        write_obj_mesh(file, cells);
        return;
    case CellFormat::ply:
        write_ply_mesh(file, cells);
        return;
    case CellFormat::vtp:
        write_vtp_mesh(file, cells);
        return;
    }
}

void write_cell_outlines(AtomicFile& file, CellFormat format, const CutCells& cells) {
    switch (format) {
    case CellFormat::obj:
        write_obj_outlines(file, cells);
        return;
    case CellFormat::ply:
        write_ply_outlines(file, cells);
        return;
    case CellFormat::vtp:
        write_vtp_outlines(file, cells);
        return;
    }
}

} // namespace geodisk::tools
