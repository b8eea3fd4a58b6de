#include "files/samples/dual_file.hpp"

#include <cstddef>

#include "files/archives/npz_arrays.hpp"
#include "files/archives/zip_writer.hpp"
#include "files/input_file.hpp"
#include "files/output/block_writer.hpp"
#include "program/exact_text.hpp"
#include "program/failure.hpp"

namespace geodisk::tools {
namespace {

/// The members of all items, one after the other.
template <std::size_t count>
std::vector<std::uint32_t> flattened(std::span<const std::array<std::uint32_t, count>> items) {
    std::vector<std::uint32_t> all;
    all.reserve(count * items.size());
    for (const auto& item : items) {
        all.insert(all.end(), item.begin(), item.end());
    }
    return all;
}

void write_obj_dual(AtomicFile& file, const DualMesh& mesh) {
    write_rows(file, mesh.points.size() / 3,
               [&](std::string& bytes, std::size_t begin, std::size_t end) {
                   for (std::size_t i = 3 * begin; i < 3 * end; i += 3) {
                       bytes += 'v';
                       for (std::size_t axis = 0; axis < 3; ++axis) {
                           bytes += ' ';
                           append_number(bytes, mesh.points[i + axis]);
                       }
                       bytes += '\n';
                   }
               });
    write_rows(file, mesh.triangles.size(),
               [&](std::string& bytes, std::size_t begin, std::size_t end) {
                   for (std::size_t i = begin; i < end; ++i) {
                       bytes += 'f';
                       for (const std::uint32_t corner : mesh.triangles[i]) {
                           bytes += ' ';
                           append_number(bytes, corner + 1);
                       }
                       bytes += '\n';
                   }
               });
}

} // namespace

DualFormat dual_format(const Path& path) {
    const std::string extension = lower_extension(path);
    if (extension != ".obj" && extension != ".npz") {
        fail_usage(path.string() + ": the dual graph is written as .obj or .npz");
    }
    return extension == ".obj" ? DualFormat::obj : DualFormat::npz;
}

void write_dual(AtomicFile& file, DualFormat format, const DualMesh& mesh) {
    if (format == DualFormat::obj) {
        write_obj_dual(file, mesh);
        return;
    }
    const std::vector<std::uint32_t> edges = flattened(mesh.edges);
    const std::vector<std::uint32_t> triangles = flattened(mesh.triangles);
    ZipWriter zip(file);
    if (mesh.dimension > 0) {
        add_array<double>(zip, "points", "<f8", mesh.points, mesh.dimension);
    }
    add_array<std::uint32_t>(zip, "edges", "<u4", edges, 2);
    add_array<std::uint32_t>(zip, "triangles", "<u4", triangles, 3);
    zip.finish();
}

} // namespace geodisk::tools
