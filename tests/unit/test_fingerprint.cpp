#include <doctest/doctest.h>

#include <vector>

#include "files/samples/fingerprint.hpp"

namespace geodisk::tools {
namespace {

SampleRow row(std::uint32_t face, float a, float b, float c) {
    SampleRow row;
    row.face = face;
    row.bary[0] = a;
    row.bary[1] = b;
    row.bary[2] = c;
    return row;
}

} // namespace

TEST_CASE("a fingerprint is FNV-1a over faces and weights") {
    CHECK(fingerprint_of(std::vector<SampleRow>{}) == "cbf29ce484222325");
    // By hand: the bytes 01 00 00 00, then 00 00 80 3e twice and 00 00 00 3f.
    CHECK(fingerprint_of(std::vector{row(1, 0.25f, 0.25f, 0.5f)}) == "02704a5eb7efb789");
    CHECK(fingerprint_of(std::vector<double>{0.5, 1}) == "275267d4e548d335");
}

TEST_CASE("a fingerprint hangs on every value and on the order") {
    const std::vector<SampleRow> rows{row(1, 0.25f, 0.25f, 0.5f), row(2, 0.5f, 0.25f, 0.25f)};
    std::vector<SampleRow> swapped{rows[1], rows[0]};
    CHECK(fingerprint_of(rows) != fingerprint_of(swapped));
    for (int field = 0; field < 4; ++field) {
        std::vector<SampleRow> other = rows;
        if (field == 0) {
            other[1].face = 3;
        } else {
            other[1].bary[field - 1] += 0x1p-24f;
        }
        CHECK(fingerprint_of(rows) != fingerprint_of(other));
        CHECK(digest_of(rows) != digest_of(other));
    }
}

TEST_CASE("a digest is the sum of fingerprints, in any order") {
    CHECK(digest_of(std::vector<SampleRow>{}) == "0000000000000000");
    const SampleRow a = row(1, 0.25f, 0.25f, 0.5f), b = row(2, 0.5f, 0.25f, 0.25f);
    CHECK(digest_of(std::vector{a}) == fingerprint_of(std::vector{a}));
    CHECK(digest_of(std::vector{a, b}) == digest_of(std::vector{b, a}));
    CHECK(digest_of(std::vector{a, b}) != digest_of(std::vector{a}));
    CHECK(digest_of(std::vector{a, a}) == "04e094bd6fdf6f12"); // Twice the above.
}

} // namespace geodisk::tools
