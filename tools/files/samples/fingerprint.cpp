#include "files/samples/fingerprint.hpp"

#include <bit>

#include <geodisk/detail/fnv1a.hpp>

#include "program/exact_text.hpp"
#include "program/failure.hpp"
#include "program/human_text.hpp"

namespace geodisk::tools {
namespace {

using detail::hexadecimal;

class Hash : public detail::Fnv1a {
  public:
    void add_word(std::uint32_t word) {
        for (int byte = 0; byte < 4; ++byte) {
            add(word >> (8 * byte) & 0xff);
        }
    }

    void add_row(const SampleRow& row) {
        add_word(row.face);
        for (const float weight : row.bary) {
            add_word(std::bit_cast<std::uint32_t>(weight));
        }
    }
};

} // namespace

std::string fingerprint_of(std::span<const SampleRow> rows) {
    Hash hash;
    for (const SampleRow& row : rows) {
        hash.add_row(row);
    }
    return hexadecimal(hash.value());
}

std::string fingerprint_of(std::span<const double> coordinates) {
    Hash hash;
    for (const double coordinate : coordinates) {
        const auto bits = std::bit_cast<std::uint64_t>(coordinate);
        hash.add_word(static_cast<std::uint32_t>(bits));
        hash.add_word(static_cast<std::uint32_t>(bits >> 32));
    }
    return hexadecimal(hash.value());
}

std::uint64_t digest_number(std::span<const SampleRow> rows) {
    std::uint64_t sum = 0;
    for (const SampleRow& row : rows) {
        Hash hash;
        hash.add_row(row);
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
    if (text.size() != 16 || text.find_first_not_of("0123456789abcdef") != std::string_view::npos) {
        fail_input(path, "its header has " +
                             (text.empty() ? "an empty digest" : "the digest " + in_quotes(text)) +
                             ", not one of 16 hexadecimal digits; give the file as geodisk wrote "
                             "it, or remove the entry");
    }
}

} // namespace geodisk::tools
