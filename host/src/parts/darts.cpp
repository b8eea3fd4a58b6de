#include "parts/darts.hpp"

#include <cstring>
#include <type_traits>

namespace geodisk {

static_assert(std::has_unique_object_representations_v<DrawnCandidate>);

void append(Bytes& bytes, std::span<const DrawnCandidate> darts) {
    const auto more = std::as_bytes(darts);
    bytes.insert(bytes.end(), more.begin(), more.end());
}

Darts darts_of(std::span<const std::byte> bytes) {
    Darts darts(bytes.size() / sizeof(DrawnCandidate));
    if (!darts.empty()) {
        std::memcpy(darts.data(), bytes.data(), darts.size() * sizeof(DrawnCandidate));
    }
    return darts;
}

} // namespace geodisk
