// The Laplacian of a surface, by linear finite elements.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <Eigen/SparseCore>

#include <geodisk/mesh.hpp>

namespace geodisk::tools::analysis {

/// For the functions that are linear in each triangle and continuous, by their values at the nodes,
/// which are the vertices of triangles: the product of two of them integrated over the surface is
/// x' mass y, and that of their gradients x' stiffness y. Borders are free (Neumann). The stiffness
/// has the cotangents of Pinkall and Polthier, "Computing discrete minimal surfaces and their
/// conjugates", 1993; the mass is not lumped, so a function is taken for what it is between the
/// nodes too.
struct Laplacian {
    static constexpr std::uint32_t kNoNode = ~0u;

    Eigen::SparseMatrix<double> stiffness, mass;
    /// Three per triangle; kNoNode for one that names a vertex twice or is a single point, which is
    /// no part of the surface.
    std::vector<std::uint32_t> nodes;
    double area = 0;

    std::uint32_t size() const { return static_cast<std::uint32_t>(mass.rows()); }
};

/// `triangles` are the vertices that `mesh` was made of, whose edge lengths are all that is used,
/// so the surface may lie in any space. Triangles flatter than a millionth of their longest side
/// count as that wide.
Laplacian make_laplacian(const PreparedMesh& mesh, std::span<const std::uint32_t> triangles);

} // namespace geodisk::tools::analysis
