#include "files/fingerprint.hpp"

#include <algorithm>
#include <bit>

#include "program/exact_text.hpp"
#include "program/failure.hpp"
#include "program/human_text.hpp"

namespace geodisk::tools {
namespace {

class Fnv1a {
  public:
    void add(std::uint32_t word) {
        for (int byte = 0; byte < 4; ++byte) {
            hash_ = (hash_ ^ (word >> (8 * byte) & 0xff)) * 0x100000001b3;
        }
    }

    void add(const SampleRow& row) {
        add(row.face);
        for (const float weight : row.bary) {
            add(std::bit_cast<std::uint32_t>(weight));
        }
    }

    std::uint64_t value() const { return hash_; }

  private:
    std::uint64_t hash_ = 0xcbf29ce484222325;
};

constexpr std::string_view kHexDigits = "0123456789abcdef";

std::string hexadecimal(std::uint64_t number) {
    std::string digits;
    for (int shift = 60; shift >= 0; shift -= 4) {
        digits += kHexDigits[number >> shift & 0xf];
    }
    return digits;
}

} // namespace

std::string fingerprint_of(std::span<const SampleRow> rows) {
    Fnv1a hash;
    for (const SampleRow& row : rows) {
        hash.add(row);
    }
    return hexadecimal(hash.value());
}

std::string fingerprint_of(std::span<const double> coordinates) {
    Fnv1a hash;
    for (const double coordinate : coordinates) {
        const auto bits = std::bit_cast<std::uint64_t>(coordinate);
        hash.add(static_cast<std::uint32_t>(bits));
        hash.add(static_cast<std::uint32_t>(bits >> 32));
    }
    return hexadecimal(hash.value());
}

std::uint64_t digest_number(std::span<const SampleRow> rows) {
    std::uint64_t sum = 0;
    for (const SampleRow& row : rows) {
        Fnv1a hash;
        hash.add(row);
        sum += hash.value();
    }
    return sum;
}

std::string digest_text(std::uint64_t number) {
    return hexadecimal(number);
}

std::string digest_of(std::span<const SampleRow> rows) {
    return digest_text(digest_number(rows));
}

void check_digest(const Path& path, const SampleHeader& header) {
    const std::string* const digest = header.find(kDigest);
    if (digest == nullptr) {
        return;
    }
    const std::string_view text = trimmed(*digest);
    if (text.size() != 16 || text.find_first_not_of(kHexDigits) != std::string_view::npos) {
        fail_input(path, "its header has " +
                             (text.empty() ? "an empty digest" : "the digest " + in_quotes(text)) +
                             ", not one of 16 hexadecimal digits; give the file as geodisk wrote "
                             "it, or remove the entry");
    }
}

} // namespace geodisk::tools
