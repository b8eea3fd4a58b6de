#include "support/same_mesh.hpp"

#include <algorithm>
#include <bit>
#include <cstdint>
#include <tuple>

namespace geodisk::test {
namespace {

std::uint64_t bits(double x) {
    return std::bit_cast<std::uint64_t>(x);
}

auto fields(const HalfEdge& e) {
    return std::tuple(bits(e.length), bits(e.apex_x), bits(e.apex_y), e.origin, e.around,
                      e.fan_angles);
}

auto fields(const VertexFan& fan) {
    return std::tuple(fan.first_corner, fan.corner_count, fan.total_angle, fan.flags);
}

auto fields(const MeshStatistics& s) {
    return std::tuple(s.vertices, s.triangles, s.components, s.boundary_edges,
                      s.coinciding_border_edges, s.nonmanifold_edges, s.repeated_index_faces,
                      s.zero_area_faces, bits(s.area), bits(s.diagonal), bits(s.longest_edge));
}

template <class Range>
bool same(const Range& a, const Range& b) {
    return std::ranges::equal(a, b,
                              [](const auto& x, const auto& y) { return fields(x) == fields(y); });
}

} // namespace

bool same_mesh(const PreparedMesh& a, const PreparedMesh& b) {
    return same_surface(a, b) && fields(a.statistics()) == fields(b.statistics());
}

bool same_surface(const PreparedMesh& a, const PreparedMesh& b) {
    return same(a.half_edges(), b.half_edges()) && same(a.fans(), b.fans()) &&
           std::ranges::equal(a.corners(), b.corners());
}

} // namespace geodisk::test
