#include "files/fingerprint.hpp"

#include <bit>

namespace geodisk::tools {
namespace {

class Fnv1a {
  public:
    void add(std::uint32_t word) {
        for (int byte = 0; byte < 4; ++byte) {
            hash_ = (hash_ ^ (word >> (8 * byte) & 0xff)) * 0x100000001b3;
        }
    }

    std::string text() const {
        std::string digits;
        for (int shift = 60; shift >= 0; shift -= 4) {
            digits += "0123456789abcdef"[hash_ >> shift & 0xf];
        }
        return digits;
    }

  private:
    std::uint64_t hash_ = 0xcbf29ce484222325;
};

} // namespace

std::string fingerprint_of(std::span<const SampleRow> rows) {
    Fnv1a hash;
    for (const SampleRow& row : rows) {
        hash.add(row.face);
        for (const float weight : row.bary) {
            hash.add(std::bit_cast<std::uint32_t>(weight));
        }
    }
    return hash.text();
}

std::string fingerprint_of(std::span<const double> coordinates) {
    Fnv1a hash;
    for (const double coordinate : coordinates) {
        const auto bits = std::bit_cast<std::uint64_t>(coordinate);
        hash.add(static_cast<std::uint32_t>(bits));
        hash.add(static_cast<std::uint32_t>(bits >> 32));
    }
    return hash.text();
}

} // namespace geodisk::tools
