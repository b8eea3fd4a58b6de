#include "files/archives/checksum.hpp"

#include <array>
#include <cstddef>
#include <vector>

#include "program/batches.hpp"

namespace geodisk::tools {
namespace {

// A checksum is the remainder of a polynomial over bits; the highest bit is the coefficient of 1.
using Bits = std::uint32_t;

constexpr Bits kDivisor = 0xedb88320; // Without x^32.
constexpr Bits kOne = Bits{1} << 31;
constexpr std::size_t kStep = 8;                     // Bytes taken at once.
constexpr std::size_t kBlock = std::size_t{1} << 18; // Bytes that a thread takes at once.

constexpr Bits times_x(Bits a) {
    return a >> 1 ^ (a & 1 ? kDivisor : 0);
}

/// Returns the remainder of a product.
constexpr Bits times(Bits a, Bits b) {
    Bits product = 0;
    for (; a != 0; a <<= 1, b = times_x(b)) {
        product ^= a & kOne ? b : 0;
    }
    return product;
}

/// Returns the remainder of x^(8 * bytes).
constexpr Bits shift_by(std::size_t bytes) {
    Bits power = kOne, square = kOne >> 8;
    for (; bytes != 0; bytes >>= 1, square = times(square, square)) {
        power = bytes & 1 ? times(power, square) : power;
    }
    return power;
}

/// Remainders of each byte with `k` zero bytes behind it, by k.
constexpr auto remainders() {
    std::array<std::array<Bits, 256>, kStep> tables{};
    for (Bits byte = 0; byte < 256; ++byte) {
        Bits remainder = byte;
        for (std::size_t k = 0; k < kStep; ++k) {
            for (int bit = 0; bit < 8; ++bit) {
                remainder = times_x(remainder);
            }
            tables[k][byte] = remainder;
        }
    }
    return tables;
}

constexpr auto kRemainders = remainders();

Bits checksum(std::string_view bytes) {
    Bits crc = ~Bits{0};
    const auto byte = [&bytes](std::size_t i) {
        return static_cast<Bits>(static_cast<unsigned char>(bytes[i]));
    };
    for (; bytes.size() >= kStep; bytes.remove_prefix(kStep)) {
        Bits next = 0;
        for (std::size_t i = 0; i < kStep; ++i) {
            const Bits before = i < sizeof crc ? crc >> 8 * i & 0xff : 0;
            next ^= kRemainders[kStep - 1 - i][byte(i) ^ before];
        }
        crc = next;
    }
    for (std::size_t i = 0; i < bytes.size(); ++i) {
        crc = kRemainders[0][(crc ^ byte(i)) & 0xff] ^ crc >> 8;
    }
    return ~crc;
}

} // namespace

std::uint32_t crc32_of(std::string_view bytes) {
    std::vector<Bits> parts(batch_count(bytes.size(), kBlock));
    const auto make_worker = [&] {
        return [&](std::size_t block, std::size_t begin, std::size_t end) {
            parts[block] = checksum(bytes.substr(begin, end - begin));
        };
    };
    in_batches(bytes.size(), kBlock, make_worker, PartDone());
    const Bits shift = shift_by(kBlock);
    Bits crc = 0;
    for (std::size_t block = 0; block < parts.size(); ++block) {
        const bool is_last = block + 1 == parts.size();
        crc = times(crc, is_last ? shift_by(bytes.size() - block * kBlock) : shift) ^ parts[block];
    }
    return crc;
}

} // namespace geodisk::tools
