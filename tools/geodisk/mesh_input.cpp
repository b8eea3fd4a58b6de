#include "geodisk/mesh_input.hpp"

#include <chrono>
#include <iostream>
#include <utility>

#include "geodisk/progress.hpp"
#include "program/failure.hpp"
#include "program/human_text.hpp"
#include "program/interrupt.hpp"

namespace geodisk::tools {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
    return std::chrono::duration<double>(Clock::now() - start).count();
}

/// The reader has told of faces that repeat a vertex or have no area.
void print_warnings(const std::string& path, const MeshInput& mesh) {
    for (const std::string& warning : mesh.file.warnings) {
        print_warning(path + ": " + warning);
    }
    if (const std::uint64_t edges = mesh.prepared.statistics().nonmanifold_edges; edges > 0) {
        print_warning(
            path + ": " +
            counted(edges, "edge joins three or more faces", "edges join three or more faces") +
            "; distances count paths across all of them");
    }
}

} // namespace

Vec3 MeshInput::point(std::uint32_t face, const float (&weights)[3]) const {
    Vec3 sum;
    for (std::uint32_t corner = 0; corner < 3; ++corner) {
        sum = sum + static_cast<double>(weights[corner]) * vertex(face, corner);
    }
    return sum;
}

Vec3 MeshInput::normal(std::uint32_t face) const {
    const Vec3 a = vertex(face, 0);
    // Edges of unit length first: products of very short or long ones leave the range of double.
    const Vec3 ab = vertex(face, 1) - a;
    const Vec3 ac = vertex(face, 2) - a;
    if (!(length(ab) > 0) || !(length(ac) > 0)) {
        return {};
    }
    const Vec3 n = cross(normalized(ab), normalized(ac));
    return length(n) > 0 ? normalized(n) : Vec3{};
}

MeshInput load_mesh(const std::string& path, ProgressLine& progress) {
    progress.begin_stage("reading the mesh");
    auto start = Clock::now();
    MeshFile file = read_mesh(path);
    const double load_seconds = seconds_since(start);
    check_interrupted();

    progress.begin_stage("preparing the mesh");
    start = Clock::now();
    PreparedMesh prepared = take(PreparedMesh::prepare({file.positions, file.triangles}), path);
    MeshInput mesh{std::move(file), std::move(prepared), load_seconds, seconds_since(start)};
    check_interrupted();
    progress.clear();
    print_warnings(path, mesh);
    return mesh;
}

void print_warning(const std::string& message) {
    std::cerr << "geodisk: warning: " << one_line(message) << '\n';
}

} // namespace geodisk::tools
