#include "files/samples/dual_file.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "files/archives/npz_arrays.hpp"
#include "files/archives/zip_writer.hpp"
#include "files/input_file.hpp"
#include "files/output/block_writer.hpp"
#include "files/samples/row_format.hpp"
#include "files/samples/sample_writers.hpp"
#include "files/samples/vtp_arrays.hpp"
#include "program/exact_text.hpp"
#include "program/failure.hpp"
#include "program/human_text.hpp"

namespace geodisk::tools {
namespace {

/// The members of all items, one after the other.
template <std::size_t kCount>
std::vector<std::uint32_t> flattened(std::span<const std::array<std::uint32_t, kCount>> items) {
    std::vector<std::uint32_t> all;
    all.reserve(kCount * items.size());
    for (const auto& item : items) {
        all.insert(all.end(), item.begin(), item.end());
    }
    return all;
}

/// Returns the attribute of that name, or null.
const SampleField* find_field(const DualMesh& mesh, std::string_view name) {
    const auto found = std::ranges::find(mesh.fields, name, &SampleField::name);
    return found == mesh.fields.end() ? nullptr : &*found;
}

/// Appends the first `count` numbers of a row of numbers, each after a blank.
void append_numbers(std::string& bytes, std::span<const double> values, std::size_t row,
                    std::size_t width, std::size_t count) {
    for (const double value : values.subspan(row * width, count)) {
        bytes += ' ';
        append_number(bytes, value);
    }
}

void write_obj_dual(AtomicFile& file, const DualMesh& mesh) {
    const std::size_t samples = mesh.points.size() / 3;
    const SampleField* const colour = find_field(mesh, kColourField);
    const SampleField* const uv = find_field(mesh, kUvField);
    const auto write_lines = [&](std::size_t count, const auto& append) {
        write_each(file, count, [&](std::string& bytes, std::size_t i) {
            append(bytes, i);
            bytes += '\n';
        });
    };
    write_lines(samples, [&](std::string& bytes, std::size_t i) {
        bytes += 'v';
        append_numbers(bytes, mesh.points, i, 3, 3);
        if (colour != nullptr) {
            append_numbers(bytes, colour->values, i, colour->components.size(), 3);
        }
    });
    if (uv != nullptr) {
        write_lines(samples, [&](std::string& bytes, std::size_t i) {
            bytes += "vt";
            append_numbers(bytes, uv->values, i, uv->components.size(), 2);
        });
    }
    write_lines(mesh.triangles.size(), [&](std::string& bytes, std::size_t i) {
        bytes += 'f';
        for (const std::uint32_t corner : mesh.triangles[i]) {
            bytes += ' ';
            append_number(bytes, corner + 1);
            if (uv != nullptr) {
                bytes += '/';
                append_number(bytes, corner + 1);
            }
        }
    });
}

void write_ply_dual(AtomicFile& file, const DualMesh& mesh) {
    SampleLayout layout{3, 3, false, false};
    layout.is_on_surface = false;
    layout.further.fields = mesh.fields;
    layout.colours = ColourEncoding::bytes;
    const std::size_t samples = mesh.points.size() / 3;
    file.write("ply\nformat binary_little_endian 1.0\nelement vertex " + std::to_string(samples) +
               '\n' + ply_properties(layout) + "element face " +
               std::to_string(mesh.triangles.size()) +
               "\nproperty list uchar int vertex_indices\nend_header\n");
    write_each(file, samples, [&](std::string& bytes, std::size_t i) {
        SampleRow row;
        std::copy_n(&mesh.points[3 * i], 3, row.position);
        append_binary_row(bytes, row, i, layout);
    });
    write_each(file, mesh.triangles.size(), [&](std::string& bytes, std::size_t i) {
        bytes += '\3';
        for (const std::uint32_t corner : mesh.triangles[i]) {
            append_little_endian(bytes, corner);
        }
    });
}

constexpr const char *kPoints = "points", *kEdges = "edges", *kTriangles = "triangles";

void write_npz_dual(AtomicFile& file, const DualMesh& mesh) {
    const std::vector<std::uint32_t> edges = flattened(mesh.edges);
    const std::vector<std::uint32_t> triangles = flattened(mesh.triangles);
    ZipWriter zip(file);
    if (mesh.dimension > 0) {
        add_array<double>(zip, kPoints, "<f8", mesh.points, mesh.dimension);
    }
    add_array<std::uint32_t>(zip, kEdges, "<u4", edges, 2);
    add_array<std::uint32_t>(zip, kTriangles, "<u4", triangles, 3);
    for (const SampleField& field : mesh.fields) {
        add_field(zip, field);
    }
    zip.finish();
}

void write_vtp_dual(AtomicFile& file, const DualMesh& mesh) {
    const std::size_t samples = mesh.points.size() / 3;
    VtpArrays arrays(file, false);
    file.write("<Piece NumberOfPoints=\"" + std::to_string(samples) + "\" NumberOfPolys=\"" +
               std::to_string(mesh.triangles.size()) + "\">\n<Points>\n");
    arrays.add("Points", samples, 3,
               [&](std::size_t i, std::size_t k) { return mesh.points[3 * i + k]; });
    file.write("</Points>\n<Polys>\n");
    arrays.add("connectivity", 3 * mesh.triangles.size(), 1, [&](std::size_t i, std::size_t) {
        return std::int64_t{mesh.triangles[i / 3][i % 3]};
    });
    arrays.add("offsets", mesh.triangles.size(), 1,
               [](std::size_t i, std::size_t) { return static_cast<std::int64_t>(3 * i + 3); });
    file.write("</Polys>\n<PointData>\n");
    for (const SampleField& field : mesh.fields) {
        arrays.add_field(field, samples);
    }
    file.write("</PointData>\n</Piece>\n");
    arrays.finish();
}

} // namespace

DualFormat dual_format(const Path& path) {
    const std::string extension = lower_extension(path);
    if (extension == ".obj") {
        return DualFormat::obj;
    }
    if (extension == ".ply") {
        return DualFormat::ply;
    }
    if (extension == ".npz") {
        return DualFormat::npz;
    }
    if (extension == ".vtp") {
        return DualFormat::vtp;
    }
    fail_usage(path.string() + ": the dual graph is written as .obj, .ply, .vtp or .npz");
}

void check_dual(DualFormat format, std::uint32_t dimension, std::span<const MeshField> fields) {
    if (format != DualFormat::npz && dimension != 3) {
        fail_usage(std::string("--dual: .") +
                   (format == DualFormat::obj   ? "obj"
                    : format == DualFormat::ply ? "ply"
                                                : "vtp") +
                   " has vertices of three coordinates, but the mesh has " +
                   std::to_string(dimension) + "; write .npz");
    }
    for (const MeshField& field : fields) {
        const std::string& name = field.name;
        if (format == DualFormat::obj && name != kColourField && name != kUvField) {
            fail_usage("--dual: .obj has no attribute " + in_quotes(name) +
                       ", just color and uv; write .ply or .npz");
        }
        if (format == DualFormat::npz &&
            (name == kPoints || name == kEdges || name == kTriangles)) {
            fail_usage("--dual: .npz has an array " + in_quotes(name) +
                       " that is no attribute; write .ply");
        }
    }
}

void write_dual(AtomicFile& file, DualFormat format, const DualMesh& mesh) {
    switch (format) {
    case DualFormat::obj:
        write_obj_dual(file, mesh);
        return;
    case DualFormat::ply:
        write_ply_dual(file, mesh);
        return;
    case DualFormat::vtp:
        write_vtp_dual(file, mesh);
        return;
    case DualFormat::npz:
        write_npz_dual(file, mesh);
        return;
    }
}

} // namespace geodisk::tools
