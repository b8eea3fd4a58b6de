// Where METIS is not there.
#include "cut_surface.hpp"

namespace geodisk {

std::vector<std::uint32_t> metis_parts(const PreparedMesh&, std::span<const double>,
                                       std::uint32_t) {
    return {};
}

} // namespace geodisk
